"""Your own printer: a workshop file of a few lines, what it changes in a robot, and whether the robot still prints.

Run `python examples/custom_printer.py [--folder out]`.
"""

import argparse
from pathlib import Path

import jumpcad

MY_WORKSHOP = """\
base = "default"

[printer]
name = "a small printer in the corner"
bed_mm = [120.0, 120.0, 150.0]
nozzle_mm = 0.4

[fits]
sliding_mm = 0.25
loose_mm = 0.35
"""


def main() -> None:
    """Build one robot in two workshops and compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, default=Path("custom-printer"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    mine = arguments.folder / "my-workshop.toml"
    mine.write_text(MY_WORKSHOP, encoding="utf-8")
    for name in ("default", mine):
        workshop = jumpcad.load_workshop(name)
        robot = jumpcad.build(jumpcad.load_design("kenan-2.0"), workshop)
        print(f"{workshop.printer.name}: {len(robot.parts)} printed parts, robot of {1000 * robot.mass_kg:.1f} g")
        for finding in jumpcad.check(robot):
            if finding.severity != "info":
                print(f"  {finding.severity}: {finding.name}: {finding.message}")


if __name__ == "__main__":
    main()
