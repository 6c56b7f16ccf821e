// Points and links with data-design show their robot, when clicked or focused; the arrow keys go to the next one.
const links = [...document.querySelectorAll("a[data-design]")];
const designs = [...document.querySelectorAll(".design")];

function show(number) {
  for (const design of designs) design.hidden = design.id !== `design-${number}`;
  for (const link of links) {
    const chosen = link.dataset.design === number;
    link.classList.toggle("chosen", chosen);
    link.setAttribute("aria-current", String(chosen));
  }
}

for (const link of links) {
  link.addEventListener("focus", () => show(link.dataset.design));
  link.addEventListener("click", (event) => {
    event.preventDefault();
    show(link.dataset.design);
    document.getElementById("robots").scrollIntoView({ block: "nearest" });
  });
  link.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 };
    const next = links[links.indexOf(link) + steps[event.key]];
    if (!next || next.parentNode.tagName !== link.parentNode.tagName) return;
    event.preventDefault();
    next.focus();
  });
}
if (designs.length) show("1");
