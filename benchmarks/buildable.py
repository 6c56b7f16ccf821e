"""Is every design either a robot that can be printed and put together, or refused for a named reason?

Random designs within the search bounds, and designs near the published best ones, each with two workshops. A robot
counts as built if the re-read STL file of every part is one closed part that fits the bed, and no two pieces meet from
rest through winding and drop. Run `python benchmarks/buildable.py [--designs N] [--json]`.
"""

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, dataclass, field
from time import process_time

import numpy as np

from jumpcad.assembly import build
from jumpcad.checks.interference import overlaps
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.exporters.plates import packed
from jumpcad.exporters.stl import write_stl
from jumpcad.robot import Robot
from jumpcad.solids.finish import faults
from jumpcad.workshop import Workshop, load_workshop

WORKSHOPS = ("default", "fine")
BEST = ("best-ga", "best-bo")
SHARE_NEAR = 2 / 7
"""Of all designs, those near the best ones."""
NEAR = 0.05
SEED = 3
REASONS = {
    r"^loop": "loop: foot and front link do not reach each other",
    r"^below_ground": "below_ground: the wound body would lie below its feet",
    r"^the springs are wound by": "springs hardly wound",
    r"^no wire": "spring: no wire is strong enough",
    r"^no cam": "cam: {limit}",
    r"^no lever": "cam: no lever beside hub and axle",
    r"^no motor": "gears: no motor turns the cam",
    r"^main leg and front link come": "layout: main leg and front link meet",
    r"^the cam gear's tip radius": "layout: cam gear beside the leg's axle",
    r"^no room for the (?P<what>[\w ]+)": "layout: no room for the {what}",
    r"^part \w+ of .* does not fit the bed": "bed: a part is too large",
}
"""How a refusal begins, and the reason that it is counted under."""


@dataclass
class Tally:
    """What became of the designs of one kind in one workshop; `wrong` holds what must not happen."""

    kind: str
    workshop: str
    built: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    built_s: list[float] = field(default_factory=list)
    refused_s: list[float] = field(default_factory=list)

    @property
    def designs(self) -> int:
        """Designs looked at."""
        return self.built + self.refused.total() + len(self.wrong)


def random_designs(count: int) -> Iterator[Design]:
    """Yield designs spread evenly over the search bounds."""
    rng = np.random.default_rng(SEED)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    for _ in range(count):
        yield Design.from_vector(rng.uniform(lower, upper).tolist())


def designs_near_the_best(count: int) -> Iterator[Design]:
    """Yield the published best designs with each number changed by up to 5 %, as far as a design may go."""
    rng = np.random.default_rng(SEED + 1)
    best = [np.array(load_design(name).to_vector()) for name in BEST]
    made = 0
    while made < count:
        vector = best[made % len(best)] * rng.uniform(1 - NEAR, 1 + NEAR, 8)
        try:
            design = Design.from_vector(vector.tolist())
        except CannotBuildError:
            raise
        except Exception:
            continue
        made += 1
        yield design


def reason(refusal: str) -> str | None:
    """Return what a refusal is counted under, or None if it is none of the known ones."""
    for pattern, name in REASONS.items():
        if match := re.search(pattern, refusal):
            missed = re.search(r"misses: (.*?) \(", refusal)
            return name.format(limit=missed[1] if missed else "", **match.groupdict())
    return None


def faults_of(robot: Robot, workshop: Workshop) -> list[str]:
    """Return what is wrong with a built robot: files that are no parts, parts off the bed, pieces that meet."""
    found = [f"{part.name}: {fault}" for part in robot.parts for fault in faults(write_stl(part.mesh))]
    found += [f"{part.name} is not on the bed" for part in robot.parts if abs(part.mesh.bounds[0, 2]) > 1e-6]
    packed(robot.parts, workshop.printer.bed_mm, workshop.process.part_spacing_mm)
    found += [f"{a} and {b} share {volume:.2f} mm³, {when}" for a, b, when, volume in overlaps(robot)]
    return found


def tally(kind: str, designs: Iterable[Design], workshop_name: str) -> Tally:
    """Build designs and count what became of them."""
    result, workshop = Tally(kind, workshop_name), load_workshop(workshop_name)
    for design in designs:
        start = process_time()
        try:
            robot = build(design, workshop)
        except CannotBuildError as refusal:
            result.refused_s.append(process_time() - start)
            if (name := reason(str(refusal))) and ": " in str(refusal):
                result.refused[name] += 1
            else:
                result.wrong.append(f"unnamed refusal: {refusal} {design.to_vector()}")
            continue
        except Exception as error:
            result.wrong.append(f"{type(error).__name__}: {error} {design.to_vector()}")
            continue
        result.built_s.append(process_time() - start)
        try:
            found = faults_of(robot, workshop)
        except CannotBuildError as refusal:
            found = [f"refused too late: {refusal}"]
        if found:
            result.wrong.append(f"{'; '.join(found)} {design.to_vector()}")
        else:
            result.built += 1
    return result


def main(arguments: list[str] | None = None) -> int:
    """Run, print, and return 1 if anything happened that must not."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=700)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args(arguments)
    near = round(options.designs * SHARE_NEAR)
    kinds: dict[str, tuple[Callable[[int], Iterator[Design]], int]] = {
        "random": (random_designs, options.designs - near),
        "near the best": (designs_near_the_best, near),
    }
    tallies = [tally(kind, make(count), workshop) for kind, (make, count) in kinds.items() for workshop in WORKSHOPS]
    if options.json:
        print(json.dumps([asdict(one) for one in tallies], indent=2))
    else:
        for one in tallies:
            tell(one)
    return int(any(one.wrong for one in tallies))


def tell(one: Tally) -> None:
    """Print one tally as a table."""
    print(f"{one.kind}, workshop {one.workshop}: {one.designs} designs")
    lines = [("built", one.built), *one.refused.most_common(), ("WRONG", len(one.wrong))]
    for name, count in lines:
        print(f"  {count:5d}  {100.0 * count / one.designs:5.1f} %  {name}")
    for name, seconds in (("build", one.built_s), ("refusal", one.refused_s)):
        if seconds:
            print(f"  {name}: {1000.0 * float(np.median(seconds)):.0f} ms of CPU time (median)")
    for wrong in one.wrong:
        print(f"  {wrong}")


if __name__ == "__main__":
    sys.exit(main())
