"""Is every design either a robot that can be printed and assembled, or rejected for a named reason?

Random designs within the search bounds, and designs near the best ones, each with two workshops. A robot counts as
built if the re-read STL file of every part is one closed part that fits the bed. Of every tenth design the whole bundle
is written, and no two of its pieces may collide while the springs are loaded and released.

Run `python benchmarks/buildable.py [--designs N] [--sample N] [--log FILE.jsonl] [--json]`. With a log, an interrupted
run continues where it stopped.
"""

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from time import process_time

import numpy as np

from jumpcad.building import build
from jumpcad.bundle.export import contents
from jumpcad.checks.interference import overlaps
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.printing.plates import packed
from jumpcad.robot import Robot
from jumpcad.solids.finish import faults
from jumpcad.solids.stl import write_stl
from jumpcad.workshop import Workshop, load_workshop

WORKSHOPS = ("default", "fine")
BEST = ("best-ga", "best-bo", "best-printable")
SHARE_NEAR = 2 / 7
"""Share of designs that are near the best ones."""
NEAR = 0.05
SEED = 3
REASONS = {
    r"^loop": "loop: foot and front link do not reach each other",
    r"^below_ground": "below_ground: the body would be below its feet with the springs loaded",
    r"^the springs are loaded by": "springs hardly loaded",
    r"^no wire": "spring: no wire is strong enough",
    r"^no cam": "cam: {limit}",
    r"^no lever": "cam: no lever beside hub and axle",
    r"^no motor": "gears: no motor turns the cam",
    r"^main leg and front link come": "layout: main leg and front link collide",
    r"^the cam gear's tip radius": "layout: cam gear beside the leg's axle",
    r"^no way for the leg's springs' pin": "layout: no way for the leg's pin through the left plate",
    r"^no room for the (?P<what>[\w ]+)": "layout: no room for the {what}",
    r"^part \w+ of .* does not fit the bed": "bed: a part is too large",
}
"""Beginning of an error's message, and the reason that it is counted under."""


@dataclass(frozen=True)
class Outcome:
    """The result for one design: `result` is `built`, a reason of rejection, or `WRONG`, which must not happen.

    `whole` says whether bundle and interference were checked too.
    """

    kind: str
    number: int
    workshop: str
    result: str
    detail: str
    build_s: float
    whole: bool = False


def random_designs(count: int) -> Iterator[Design]:
    """Yield designs spread evenly over the search bounds."""
    rng = np.random.default_rng(SEED)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    for _ in range(count):
        yield Design.from_vector(rng.uniform(lower, upper).tolist())


def designs_near_the_best(count: int) -> Iterator[Design]:
    """Yield the best designs with each number changed by up to 5 %, as far as a design may go."""
    rng = np.random.default_rng(SEED + 1)
    best = [np.array(load_design(name).to_vector()) for name in BEST]
    made = 0
    while made < count:
        vector = best[made % len(best)] * rng.uniform(1 - NEAR, 1 + NEAR, 8)
        try:
            design = Design.from_vector(vector.tolist())
        except JumpcadError:
            continue
        made += 1
        yield design


KINDS: dict[str, Callable[[int], Iterator[Design]]] = {"random": random_designs, "near the best": designs_near_the_best}


def reason(refusal: str) -> str | None:
    """Return the reason for an error's message, or None if it is unknown or the message proposes nothing."""
    for pattern, name in REASONS.items():
        if (match := re.search(pattern, refusal)) and ": " in refusal:
            missed = re.search(r"misses: (.*?) \(", refusal)
            return name.format(limit=missed[1] if missed else "", **match.groupdict())
    return None


def faults_of(robot: Robot, workshop: Workshop, whole: bool) -> list[str]:
    """Return what is wrong with a built robot: files that are not parts, parts off the bed, pieces that collide."""
    found = [f"{part.name}: {fault}" for part in robot.parts for fault in faults(write_stl(part.mesh))]
    found += [f"{part.name} is not on the bed" for part in robot.parts if abs(part.mesh.bounds[0, 2]) > 1e-6]
    packed(robot.parts, workshop.printer.bed_mm, workshop.process.part_spacing_mm)
    if whole:
        found += [f"{path} is empty" for path, data in contents(robot, pictures=False) if not data]
        found += [f"{a} and {b} share {volume:.2f} mm³, {when}" for a, b, when, volume in overlaps(robot)]
    return found


def look(design: Design, workshop: Workshop, whole: bool) -> tuple[str, str, float, bool]:
    """Build a design; return result, detail, the CPU time of building it (s), and whether all of it was checked.

    Any exception is a result here, since the question is whether any but `CannotBuildError` occurs.
    """
    start = process_time()
    try:
        robot = build(design, workshop)
    except CannotBuildError as refusal:
        return reason(str(refusal)) or "WRONG", str(refusal), process_time() - start, False
    except Exception as error:
        return "WRONG", f"{type(error).__name__}: {error}", process_time() - start, False
    seconds = process_time() - start
    try:
        found = faults_of(robot, workshop, whole)
    except Exception as error:
        found = [f"after it was built, {type(error).__name__}: {error}"]
    return ("WRONG" if found else "built"), "; ".join(found), seconds, whole


def outcomes(count: int, sample: int, log: Path | None) -> list[Outcome]:
    """Check designs of both kinds in every workshop; what the log holds is not checked again."""
    lines = log.read_text().splitlines() if log and log.exists() else []
    known = {(one.kind, one.number, one.workshop): one for one in (Outcome(**json.loads(line)) for line in lines)}
    near = round(count * SHARE_NEAR)
    found = []
    for kind, many in (("random", count - near), ("near the best", near)):
        for number, design in enumerate(KINDS[kind](many)):
            for offset, name in enumerate(WORKSHOPS):
                outcome = known.get((kind, number, name))
                if outcome is None:
                    looked = look(design, load_workshop(name), whole=number % sample == offset)
                    outcome = Outcome(kind, number, name, *looked)
                    if log:
                        with log.open("a") as file:
                            file.write(json.dumps(asdict(outcome)) + "\n")
                found.append(outcome)
    return found


def main(arguments: list[str] | None = None) -> int:
    """Run, print, and return 1 if any result is `WRONG`."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--designs", type=int, default=700)
    parser.add_argument("--sample", type=int, default=10, help="the whole bundle of every Nth design is checked")
    parser.add_argument("--log", type=Path)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args(arguments)
    found = outcomes(options.designs, options.sample, options.log)
    if options.json:
        print(json.dumps([asdict(outcome) for outcome in found], indent=2))
    else:
        tell(found)
    return int(any(outcome.result == "WRONG" for outcome in found))


def tell(found: list[Outcome]) -> None:
    """Print a table for every kind and workshop, and what went wrong."""
    for kind, name in sorted({(one.kind, one.workshop) for one in found}, reverse=True):
        here = [one for one in found if (one.kind, one.workshop) == (kind, name)]
        print(f"{kind}, workshop {name}: {len(here)} designs, {sum(one.whole for one in here)} whole bundles checked")
        for result, count in Counter(one.result for one in here).most_common():
            print(f"  {count:5d}  {100.0 * count / len(here):5.1f} %  {result}")
        if seconds := [one.build_s for one in here if one.result == "built"]:
            print(f"  build: {1000.0 * float(np.median(seconds)):.0f} ms of CPU time (median)")
    wrong = [one for one in found if one.result == "WRONG"]
    print(f"{len(wrong)} went wrong")
    for one in wrong:
        print(f"  {one.kind} {one.number}, workshop {one.workshop}: {one.detail}")


if __name__ == "__main__":
    sys.exit(main())
