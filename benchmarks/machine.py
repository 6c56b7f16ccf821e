"""Does the machine work, by programs that know nothing of jumpcad?

Every template and random designs in the three shipped workshops are built and exported. The programs of `tests/clients`
then read the bundles alone: `spring_pins` rebuilds the springs, `release_contact` simulates the release with contacts,
`clearances` looks for pieces that meet in 60 positions of leg and cam, from loaded springs to the stop and its pad's
give. A robot that `jumpcad evaluate` rejects is not buildable: it is counted, and another is drawn.

Run `python benchmarks/machine.py [--workshop NAME]… [--only LABEL]… [--designs N] [--workers N]`. One line a bundle;
the exit status is 1 if one is wrong.
"""

import argparse
import itertools
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from jumpcad.building import build
from jumpcad.bundle.export import export
from jumpcad.checks import quick_findings
from jumpcad.design import Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.search import Space
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from clients import clearances, release_contact, spring_pins

TEMPLATES = (
    "kenan-1.0",
    "kenan-2.0",
    "best-ga",
    "best-bo",
    "best-printable",
    "best-upright",
    "best-range",
    "best-compact",
)
WORKSHOPS = ("default", "fine", "light")
LEAST_ENERGY = 0.97
"""Share of the springs' energy that must be kept, the lever's bending aside."""
TRIED = 10
"""Random designs that are tried for each that is wanted: most are refused."""
BATCH = 20
SEED = 3


@dataclass
class Judged:
    """What the programs say of one bundle.

    Energy and kicks are None where the robot is too weak to jump and stays on its cam. `kick_ratio` is the kick in the
    contact simulation over the manifest's, `kick_share` the same over its limit.
    """

    label: str
    rejected: tuple[str, ...] = ()
    arms_deg: float = 0.0
    energy_ratio: float | None = None
    kick_ratio: float | None = None
    kick_share: float | None = None
    stop_deg: float = 0.0
    wrong: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        """Return the bundle's line."""
        if self.rejected:
            return f"{self.label}: rejected by {', '.join(self.rejected)}"
        released = "does not jump"
        if self.energy_ratio is not None and self.kick_ratio is not None and self.kick_share is not None:
            released = (
                f"release keeps {100.0 * self.energy_ratio:.2f} %, kick {100.0 * self.kick_share:.0f} % of the limit, "
                f"{self.kick_ratio:.3f} of the manifest's"
            )
        said = f"{self.label}: arms {self.arms_deg:.5f}°, stop {self.stop_deg:.1f}°, {released}"
        return "; ".join([said, *self.wrong])


def judged(label: str, design: Design, workshop: str) -> Judged | None:
    """Return what the programs say of a design, None if it cannot be built; in the default workshop a template can."""
    try:
        robot = build(design, load_workshop(workshop), "robot")
    except CannotBuildError as refusal:
        if label not in TEMPLATES:
            return None
        if workshop != WORKSHOPS[0]:
            return Judged(label, rejected=(str(refusal),))
        return Judged(label, wrong=[str(refusal)])
    jump = simulate(robot)
    found = Judged(label)
    rejected = errors((*jump.findings, *quick_findings(robot)))
    if rejected and label not in TEMPLATES:
        return Judged(label, rejected=tuple(sorted({one.name for one in rejected})))
    found.wrong += [f"finding {one.name}: {one.message}" for one in rejected]
    with tempfile.TemporaryDirectory() as folder:
        bundle = Path(folder) / "robot"
        try:
            export(robot, bundle, pictures=False)
        except CannotBuildError as refusal:
            found.wrong.append(str(refusal))
            return found
        for fit in spring_pins.fits(bundle):
            found.arms_deg = max(found.arms_deg, abs(fit.angle_error_deg))
            found.wrong += [f"{fit.side} spring: {reason}" for reason in fit.wrong]
        room = clearances.Bundle(bundle)
        found.stop_deg = float(room.manifest["stop"]["angle_deg"])
        meetings = {(a, b): (volume, pose) for a, b, volume, pose in room.meetings()}
        found.wrong += [f"{a} and {b} share {volume:.2f} mm³, {pose}" for (a, b), (volume, pose) in meetings.items()]
        if jump.verdict == "jump":
            _release(found, bundle, room.manifest["drive"]["release"])
    return found


def _release(found: Judged, bundle: Path, said: dict[str, Any]) -> None:
    """Simulate the release with contacts, with every motor that the manifest assumes."""
    contact = release_contact.Contact(bundle)
    outcomes = [contact.run(motor) for motor in said["assumed"]]
    kick = max(outcome.kick_nm for outcome in outcomes)
    found.energy_ratio = min(outcome.energy_ratio for outcome in outcomes) / said["bending_ratio"]
    found.kick_ratio, found.kick_share = kick / said["kick_nm"], kick / said["kick_limit_nm"]
    if found.energy_ratio < LEAST_ENERGY:
        found.wrong.append(f"the release keeps {100.0 * found.energy_ratio:.1f} % of the energy")
    if found.kick_share > 1.0:
        found.wrong.append(f"the release kicks with {100.0 * found.kick_share:.0f} % of the limit")


def candidates(count: int) -> Iterator[tuple[str, Design]]:
    """Yield the templates, then random designs."""
    space, rng = Space.default(), np.random.default_rng(SEED)
    yield from ((name, load_design(name)) for name in TEMPLATES)
    yield from ((f"random-{number}", space.to_design(rng.random(space.dimension))) for number in range(TRIED * count))


def main(arguments: list[str] | None = None) -> int:
    """Run and print a line for each bundle and each workshop."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workshop", action="append", help="name or file; may be repeated")
    parser.add_argument(
        "--only", action="append", help="of the templates and draws, such as random-12; may be repeated"
    )
    parser.add_argument("--designs", type=int, default=67, help="random ones that are buildable, in each workshop")
    parser.add_argument("--workers", type=int, default=2)
    options, bad = parser.parse_args(arguments), 0
    with ProcessPoolExecutor(options.workers) as pool:
        for workshop in options.workshop or WORKSHOPS:
            wanted = options.designs + len(TEMPLATES)
            found, rejected, refused = list[Judged](), list[Judged](), 0
            waiting = (one for one in candidates(options.designs) if one[0] in (options.only or [one[0]]))
            while len(found) < wanted and (batch := list(itertools.islice(waiting, BATCH))):
                for one in pool.map(judged, *zip(*batch, strict=True), itertools.repeat(workshop)):
                    refused += one is None
                    if one is None or len(found) == wanted:
                        continue
                    print(f"{workshop}: {one}", flush=True)
                    (rejected if one.rejected else found).append(one)
            bad += _told(workshop, found, rejected, refused)
    return int(bad > 0)


def _told(workshop: str, found: list[Judged], rejected: list[Judged], refused: int) -> int:
    """Print what was found in a workshop, and return how many bundles have something wrong."""
    ratios = [one.energy_ratio for one in found if one.energy_ratio is not None]
    shares = [one.kick_share for one in found if one.kick_share is not None]
    kicks = [one.kick_ratio for one in found if one.kick_ratio is not None]
    wrong = sum(bool(one.wrong) for one in found)
    print(f"{workshop}: {len(found)} bundles; not buildable: {refused} refused, {len(rejected)} rejected by a finding")
    print(f"{workshop}: arms at most {max(one.arms_deg for one in found):.4f}° from their pins")
    if ratios:
        print(
            f"{workshop}: {len(ratios)} releases keep at least {100.0 * min(ratios):.1f} % and kick with at most "
            f"{100.0 * max(shares):.0f} % of their limit, {min(kicks):.2f} to {max(kicks):.2f} of the manifest's kick"
        )
    print(f"{workshop}: {wrong} have something wrong", flush=True)
    return wrong


if __name__ == "__main__":
    sys.exit(main())
