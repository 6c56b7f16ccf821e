"""Both kits on every template: volts, pins, masses, and whether every part and tool reaches its place.

    python benchmarks/kits.py [--write]

prints the tables; with --write they replace those in `docs/kits.md`. About half a minute of CPU a row.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from jumpcad.building import build
from jumpcad.catalogue import load_catalogue
from jumpcad.checks import check
from jumpcad.design import load_design
from jumpcad.electronics.nets import wiring_of
from jumpcad.electronics.supply import chosen_parts
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.robot.electronics.limits import links
from jumpcad.robot.robot import Robot
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, own_workshop

PAGE = Path(__file__).resolve().parents[1] / "docs" / "kits.md"
BEGIN, END = "<!-- begin benchmarks/kits.py -->", "<!-- end benchmarks/kits.py -->"
ELECTRIC = (
    "battery",
    "controller",
    "driver",
    "regulator",
    "motor",
    "motor_shaft",
    "sensor",
    "switch",
    "plug",
    "capacitor",
)


def main() -> None:
    """Print the tables, or write them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="replace the tables in docs/kits.md")
    write = parser.parse_args().write
    text = "\n".join(tables()).strip() + "\n"
    print(text)
    if write:
        page = PAGE.read_text(encoding="utf-8")
        before, after = page.partition(BEGIN)[0], page.partition(END)[2]
        PAGE.write_text(f"{before}{BEGIN}\n\n{text}\n{END}{after}", encoding="utf-8")


def tables() -> Iterator[str]:
    """Yield the lines of a table for each kit: its chain and pins, then its robots."""
    for kit in load_catalogue().kits:
        shop = load_workshop()
        bought = shop.bought.model_copy(update=load_catalogue().kits[kit].model_dump() | {"kit": kit})
        shop = shop.model_copy(update={"bought": bought})
        robots = {
            name: build(load_design(name), shop, name)
            for name in template_names("robots")
            if own_workshop(name) == DEFAULT
        }
        yield from (f"## {kit}", "")
        yield from _chain(shop, list(robots.values()))
        yield from (
            "",
            "| design | mass g | of it electrical g | one jump J | winding s | free paths | tool access | errors |",
        )
        yield "|---|--:|--:|--:|--:|---|---|--:|"
        for name, robot in robots.items():
            print(f"{kit} {name}", file=sys.stderr, flush=True)
            yield _row(name, robot)
        yield ""


def _chain(shop: Workshop, robots: list[Robot]) -> Iterator[str]:
    """Yield the chain of voltages, the widest over all robots, and the controller's pins."""
    wiring = wiring_of(chosen_parts(shop), shop.bought.pins)
    yield from ("| link | input | gets V | bears V |", "|---|---|---|---|")
    for chained in zip(*(links(robot) for robot in robots), strict=True):
        low, high = min(link.gets_v[0] for link in chained), max(link.gets_v[1] for link in chained)
        link = chained[0]
        bears = "not known" if link.bears_v is None else f"{link.bears_v[0]:.2f} to {link.bears_v[1]:.2f}"
        yield f"| {link.role}: {link.name} | {link.pin} | {low:.2f} to {high:.2f} | {bears} |"
    pins = ", ".join(f"{pin} {signal}" for signal, pin in wiring.pins.items())
    yield from ("", f"Pins of {shop.bought.controller}: {pins}; sensor at its contact {wiring.contact}.")


def _row(name: str, robot: Robot) -> str:
    """Return a robot's row."""
    findings = check(robot)
    found = {finding.name: finding for finding in findings}
    words = ["yes" if found[key].severity == "info" else "no" for key in ("assembly_paths", "tool_access")]
    grams = [
        1000.0 * item.mass_kg for item in robot.hardware if item.name in ELECTRIC or item.name.startswith("wiring_")
    ]
    train = robot.layout.drive.train
    return (
        f"| {name} | {1000.0 * robot.mass_kg:.1f} | {sum(grams):.1f} | {train.electrical_j:.2f} | "
        f"{train.winding_s:.1f} | {words[0]} | {words[1]} | {len(errors(findings))} |"
    )


if __name__ == "__main__":
    main()
