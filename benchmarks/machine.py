"""Does the machine work, by programs that know nothing of jumpcad?

Every template and random designs in the three shipped workshops are built and exported. The programs of `tests/clients`
then read the bundles alone: `spring_pins` rebuilds the springs, `release_contact` simulates the release with contacts,
`clearances` looks for pieces that meet in 60 positions of leg and cam, from loaded springs to the stop and its pad's
give.

Run `python benchmarks/machine.py [--designs N] [--contacts N] [--workers N]`. The exit status is 1 if one is wrong.
"""

import argparse
import itertools
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from buildable import random_designs

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "clients"))
import clearances
import release_contact
import spring_pins

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable")
WORKSHOPS = ("default", "fine", "light")
LEAST_ENERGY = 0.97
"""Share of the springs' energy that must be kept, the lever's bending aside."""
TRIED = 5
"""Random designs that are tried for each that is wanted: most are refused."""


@dataclass
class Judged:
    """What the programs say of one bundle; the contact simulation's figures are None where it was not run."""

    label: str
    arms_deg: float = 0.0
    energy_ratio: float | None = None
    kick_share: float | None = None
    stop_deg: float = 0.0
    wrong: list[str] = field(default_factory=list)


def judged(label: str, design: Design, workshop: str, contacts: bool) -> Judged | None:
    """Return what the programs say of a design, None if it cannot be built."""
    try:
        robot = build(design, load_workshop(workshop), "robot")
    except CannotBuildError as refusal:
        return Judged(label, wrong=[str(refusal)]) if label in TEMPLATES else None
    found = Judged(label, wrong=[f"finding {one.name}: {one.message}" for one in errors(robot.release.findings)])
    with tempfile.TemporaryDirectory() as folder:
        bundle = Path(folder) / "robot"
        try:
            export(robot, bundle, pictures=False)
        except CannotBuildError as refusal:
            return Judged(label, wrong=[str(refusal)])
        for fit in spring_pins.fits(bundle):
            found.arms_deg = max(found.arms_deg, abs(fit.angle_error_deg))
            found.wrong += [f"{fit.side} spring: {reason}" for reason in fit.wrong]
        room = clearances.Bundle(bundle)
        found.stop_deg = float(room.manifest["stop"]["angle_deg"])
        found.wrong += [f"{a} and {b} share {volume:.2f} mm³, {pose}" for a, b, volume, pose in room.meetings()]
        if contacts and simulate(robot).verdict == "jump":  # a robot that is too weak stays on its cam
            contact, said = release_contact.Contact(bundle), room.manifest["drive"]["release"]
            outcomes = [contact.run(motor) for motor in said["assumed"]]
            found.energy_ratio = min(outcome.energy_ratio for outcome in outcomes) / said["bending_ratio"]
            found.kick_share = max(outcome.kick_nm for outcome in outcomes) / said["kick_limit_nm"]
            if found.energy_ratio < LEAST_ENERGY:
                found.wrong.append(f"the release keeps {100.0 * found.energy_ratio:.1f} % of the energy")
            if found.kick_share > 1.0:
                found.wrong.append(f"the release kicks with {100.0 * found.kick_share:.0f} % of the limit")
    return found


def candidates(count: int) -> Iterator[tuple[str, Design]]:
    """Yield the templates, then random designs."""
    yield from ((name, load_design(name)) for name in TEMPLATES)
    yield from ((f"random-{number}", design) for number, design in enumerate(random_designs(TRIED * count)))


def main(arguments: list[str] | None = None) -> int:
    """Run and print a line for each workshop, and what is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=67, help="random ones that build, in each workshop")
    parser.add_argument(
        "--contacts", type=int, default=20, help="how many of them are released with contacts, if they jump"
    )
    parser.add_argument("--workers", type=int, default=2)
    options, bad = parser.parse_args(arguments), 0
    with ProcessPoolExecutor(options.workers) as pool:
        for workshop in WORKSHOPS:
            number = itertools.count(-len(TEMPLATES))
            tasks = [
                (label, design, workshop, next(number) < options.contacts)
                for label, design in candidates(options.designs)
            ]
            found: list[Judged] = []
            waiting = iter(tasks)
            while len(found) < options.designs + len(TEMPLATES) and (batch := list(itertools.islice(waiting, 20))):
                found += [one for one in pool.map(judged, *zip(*batch, strict=True)) if one is not None]
            found = found[: options.designs + len(TEMPLATES)]
            bad += _told(workshop, found)
    return int(bad > 0)


def _told(workshop: str, found: list[Judged]) -> int:
    """Print what was found in a workshop, and return how many bundles have something wrong."""
    for one in found:
        for reason in one.wrong:
            print(f"{workshop}: {one.label}: {reason}")
    ratios = [one.energy_ratio for one in found if one.energy_ratio is not None]
    kicks = [one.kick_share for one in found if one.kick_share is not None]
    print(
        f"{workshop}: {len(found)} bundles, arms at most {max(one.arms_deg for one in found):.4f}° from their pins; "
        f"{len(ratios)} releases keep at least {100.0 * min(ratios):.1f} % and kick with at most "
        f"{100.0 * max(kicks):.0f} % of their limit; {sum(bool(one.wrong) for one in found)} have something wrong",
        flush=True,
    )
    return sum(bool(one.wrong) for one in found)


if __name__ == "__main__":
    sys.exit(main())
