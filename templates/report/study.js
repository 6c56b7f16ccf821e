// Points and links with data-design show their robot, when clicked or focused; the arrow keys go to the next one.
// What has data-of belongs to a design too, and is seen while this is chosen.
const links = [...document.querySelectorAll("a[data-design]")];
const points = links.filter((link) => link.closest(".chart"));
const designs = [...document.querySelectorAll(".design")];
const marks = [...document.querySelectorAll("[data-of]")];
const details = designs.flatMap((design) => [...design.querySelectorAll("details")]);
// Points of the chart that are nearer to each other than this (pixels) are shown by one click after the other.
const NEAR = 5;
let chosen = "";

function show(number) {
  chosen = number;
  for (const design of designs) design.hidden = design.id !== `design-${number}`;
  for (const link of links) {
    link.classList.toggle("chosen", link.dataset.design === number);
    link.setAttribute("aria-current", String(link.dataset.design === number));
  }
  for (const mark of marks) mark.classList.toggle("chosen", mark.dataset.of === number);
}

// The point of the chart nearest to a click; of several there, the one after the chosen one.
function nearest(event) {
  const away = (point) => {
    const box = point.lastElementChild.getBoundingClientRect();
    return Math.hypot(box.x + box.width / 2 - event.clientX, box.y + box.height / 2 - event.clientY);
  };
  const least = Math.min(...points.map(away));
  const there = points.filter((point) => away(point) <= least + NEAR);
  const place = there.findIndex((point) => point.dataset.design === chosen);
  return there[(place + 1) % there.length];
}

for (const link of links) {
  link.addEventListener("focus", () => {
    if (link.matches(":focus-visible")) show(link.dataset.design);
  });
  link.addEventListener("click", (event) => {
    event.preventDefault();
    const byHand = event.detail > 0 && points.includes(link);
    show((byHand ? nearest(event) : link).dataset.design);
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
for (const one of details) {
  one.addEventListener("toggle", () => details.forEach((other) => (other.open = one.open)));
}
if (designs.length) {
  document.getElementById("turn").hidden = false;
  for (const [id, step] of [["before", -1], ["after", 1]]) {
    document.getElementById(id).addEventListener("click", () => {
      show(String(((Number(chosen) - 1 + step + designs.length) % designs.length) + 1));
    });
  }
  show(document.getElementById("robots").dataset.first);
}
