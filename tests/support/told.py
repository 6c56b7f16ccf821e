"""Numbers that a page of the documentation tells its readers, in digits or in words."""

import re

from support.places import ROOT

WORDS = {
    "half": 0.5, "third": 1.0 / 3.0, "quarter": 0.25, "fifth": 0.2, "tenth": 0.1, "once": 1.0, "twice": 2.0,
    "one": 1.0, "two": 2.0, "three": 3.0, "four": 4.0, "five": 5.0, "six": 6.0, "seven": 7.0, "eight": 8.0,
    "nine": 9.0, "ten": 10.0, "eleven": 11.0, "twelve": 12.0,
}  # fmt: skip
NUMBER = r"(\d+(?:\.\d+)?|" + "|".join(WORDS) + ")"


def told(page: str, *sentences: str) -> tuple[float, ...]:
    """Return the numbers that stand at each `{}` of some sentences of `docs/PAGE.md`."""
    text = " ".join((ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8").split())
    found: list[float] = []
    for sentence in sentences:
        matched = re.search(NUMBER.join(map(re.escape, sentence.split("{}"))), text, re.IGNORECASE)
        assert matched, f"docs/{page}.md does not say: {sentence}"
        found += [WORDS.get(word.lower()) or float(word) for word in matched.groups()]
    return tuple(found)


def told_default(command: str, option: str) -> str:
    """Return the default of a command's option as `docs/reference/commands.md` has it."""
    page = (ROOT / "docs" / "reference" / "commands.md").read_text(encoding="utf-8")
    rows = page.partition(f"\n## jumpcad {command}\n")[2].partition("\n## ")[0]
    (default,) = re.findall(rf"^\|[^|]*`{option}[ `].*\| ([^|]*) \|$", rows, re.MULTILINE)
    return str(default).strip("`")
