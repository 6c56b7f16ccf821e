"""Do the springs of random designs fit their pins, and does nothing meet?

Every template and random designs in the three shipped workshops: each robot's manifest and URDF are written and given
to `tests/clients/spring_pins.py`, which rebuilds the springs from them; then the pieces are looked at from rest through
winding and drop.

Run `python benchmarks/springs.py [--designs N]`. The exit status is 1 if a spring does not fit or pieces meet.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

from buildable import random_designs

from jumpcad.building import build
from jumpcad.bundle.springs import spring_facts
from jumpcad.checks.interference import overlaps
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.exporters.urdf import urdf_files
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "clients"))
import spring_pins  # noqa: E402

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable")
WORKSHOPS = ("default", "fine", "light")


def written(robot: Robot, folder: Path) -> Path:
    """Write what the client reads of a robot."""
    facts = {"name": robot.name, "drive": {"springs": spring_facts(robot)}}
    (folder / "manifest.json").write_text(json.dumps(facts))
    for path, content in urdf_files(robot):
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content.encode() if isinstance(content, str) else content)
    return folder


def main(arguments: list[str] | None = None) -> int:
    """Run and print the largest angle of every workshop, and what went wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=60, help="random ones that build, in each workshop")
    count, bad = parser.parse_args(arguments).designs, 0
    for name in WORKSHOPS:
        workshop, worst, built = load_workshop(name), 0.0, 0
        designs = {template: load_design(template) for template in TEMPLATES}
        designs |= {f"random-{number}": design for number, design in enumerate(random_designs(2 * count))}
        for label, design in designs.items():
            if built == count + len(TEMPLATES):
                break
            try:
                robot = build(design, workshop, "robot")
            except CannotBuildError as refusal:
                if label in TEMPLATES:
                    print(f"{name}: {label}: {refusal}")
                continue
            built += 1
            with tempfile.TemporaryDirectory() as folder:
                found = spring_pins.fits(written(robot, Path(folder)))
            wrong = [f"{fit.side} spring: {reason}" for fit in found for reason in fit.wrong]
            wrong += [f"{a} and {b} share {volume:.2f} mm³, {when}" for a, b, when, volume in overlaps(robot)]
            worst = max([worst, *(abs(fit.angle_error_deg) for fit in found)])
            bad += len(wrong)
            for line in wrong:
                print(f"{name}: {label}: {line}")
        print(f"{name}: {built} robots, arms at most {worst:.4f}° from their pins", flush=True)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
