"""Is every figure of README and docs what the program gives today? Exit code 1 and a list of what differs, if not.

Compared are the figures between `<!-- NAME -->` and `<!-- / -->` in README.md, docs/*.md and docs/decisions/*.md, and
the picture and report of `best-printable`. Words have to be the same. Numbers may be a unit of their last digit apart;
those of the search, which may take another path on another processor or library, 1 %; those of a sampler 5 %; CPU
times, a factor of 1.5.

Run `python benchmarks/readme.py [--cheap | --only search|masses|speed|calibration|effects|parameters ...] [--write]`.
All but what follows from the templates takes minutes: `--cheap` leaves it out, as the tests do; `--only` takes those
that it names. `--write` corrects pages, picture and report.
"""

import argparse
import re
import sys
from collections.abc import Callable, Iterator
from itertools import zip_longest
from pathlib import Path

import calibrated
import figures
import parameters
import validated

from jumpcad.bundle.export import report_page
from jumpcad.bundle.renders import renders
from jumpcad.files.outputs import write_atomically

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs" / "decisions").glob("*.md"))]
PICTURE = ROOT / "docs" / "best-printable.png"
COMPARED = ROOT / "templates" / "compared"
REPORT = ROOT / "examples" / "best-printable-report.html"
SPEED_SLACK = 1.0 - 1.0 / figures.SPEED_FACTOR
"""By how much of the greater one two numbers may be apart."""

Maker = Callable[[], dict[str, str]]
CHEAP: dict[Maker, float] = {
    figures.of_robots: 0.0,
    figures.of_results: 0.0,
    figures.of_engines: 0.0,
    figures.of_prototypes: 0.0,
    figures.of_best_printable: 0.0,
    figures.of_springs: 0.0,
    figures.of_loads: 0.0,
    figures.of_assumptions: 0.0,
}
COSTLY: dict[str, tuple[Maker, float]] = {
    "search": (figures.of_search, figures.SEARCH_SLACK),
    "masses": (figures.of_masses, 0.0),
    "landings": (figures.of_landings, 0.0),
    "speed": (figures.of_speed, SPEED_SLACK),
    "calibration": (calibrated.of_calibration, calibrated.SAMPLER_SLACK),
    "effects": (calibrated.of_effects, 0.0),
    "order": (figures.of_order, 0.0),
    "parameters": (lambda: {"parameters": parameters.table()}, 0.0),
    "validation": (validated.of_validation, calibrated.SAMPLER_SLACK),
}

FIGURE = re.compile(r"<!-- ([\w' -]+) -->(\n?)(.*?)(\n?)<!-- / -->", re.S)
NUMBER = re.compile(r"\d+(?:\.\d+)?")


def shown(page: str) -> dict[str, str]:
    """Return the figures that a page shows, by name."""
    return {found[1]: found[3] for found in FIGURE.finditer(page)}


def rewritten(page: str, made: dict[str, str]) -> str:
    """Return a page with other figures."""
    return FIGURE.sub(
        lambda found: f"<!-- {found[1]} -->{found[2]}{made.get(found[1], found[3])}{found[4] or found[2]}<!-- / -->",
        page,
    )


def differences(name: str, written: str, made: str, slack: float = 0.0) -> Iterator[str]:
    """Yield a sentence for every line of a figure that differs from what it should be."""
    for there, here in zip_longest(written.splitlines(), made.splitlines(), fillvalue=""):
        numbers = zip(NUMBER.findall(there), NUMBER.findall(here), strict=False)
        if NUMBER.sub("0", there) != NUMBER.sub("0", here) or any(apart(*pair, slack) for pair in numbers):
            yield f"{name}: says {there!r}, should say {here!r}"


def apart(written: str, made: str, slack: float = 0.0) -> bool:
    """Whether two numbers differ by more than a unit of their last digit, and by more than the slack."""
    digits = min(len(number.partition(".")[2]) for number in (written, made))
    one, other = float(written), float(made)
    return abs(one - other) > max(1.001 * 10.0**-digits, slack * max(one, other))


def picture_differences(write: bool) -> Iterator[str]:
    """Yield a sentence if the template's picture is not what is drawn today."""
    picture = renders(figures.built("best-printable")[0])["rest"]
    if write:
        PICTURE.write_bytes(picture)
    elif PICTURE.read_bytes() != picture:
        yield f"{PICTURE.name}: is not the picture of best-printable at rest"


def report_differences(write: bool) -> Iterator[str]:
    """Yield a sentence if the template's report is not what `jumpcad report best-printable` writes today."""
    page = report_page(figures.built("best-printable")[0])
    if write:
        write_atomically(REPORT, page, force=True)
    elif REPORT.read_text(encoding="utf-8") != page:
        yield f"{REPORT.name}: is not the report of best-printable"


def compared_differences(write: bool) -> Iterator[str]:
    """Yield a sentence for every line of the shipped predictions that is not what calibrations say today."""
    for name, text in calibrated.comparisons().items():
        path = COMPARED / f"{name}.toml"
        if write:
            write_atomically(path, text, force=True)
        else:
            yield from differences(path.name, path.read_text(encoding="utf-8"), text, calibrated.SAMPLER_SLACK)


def main(arguments: list[str] | None = None) -> int:
    """Compare or write; print what differs and return 1 if something does."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    some = parser.add_mutually_exclusive_group()
    some.add_argument("--cheap", action="store_true", help="without search, slicer and CPU times")
    some.add_argument("--only", nargs="+", choices=COSTLY, default=[*COSTLY], help="which of these")
    parser.add_argument("--write", action="store_true", help="correct pages, picture and report")
    options = parser.parse_args(arguments)
    wrong, costly = list[str](), [] if options.cheap else options.only
    if "calibration" in costly:
        wrong += compared_differences(options.write)
    wrong += picture_differences(options.write)
    wrong += report_differences(options.write)
    made, slack = dict[str, str](), dict[str, float]()
    for make, off in (CHEAP | dict(COSTLY[name] for name in costly)).items():
        found = make()
        made |= found
        slack |= dict.fromkeys(found, off)
    there = set[str]()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        written = shown(text)
        there |= written.keys()
        if options.write:
            write_atomically(page, rewritten(text, made), force=True)
            continue
        for name in made.keys() & written.keys():
            wrong += differences(f"{page.name}, {name}", written[name], made[name], slack[name])
    wrong += [f"{name}: is on no page" for name in sorted(made.keys() - there)]
    if len(costly) == len(COSTLY):
        wrong += [f"{name}: nothing computes it" for name in sorted(there - made.keys())]
    print("\n".join(wrong) or "every figure is what the program gives")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
