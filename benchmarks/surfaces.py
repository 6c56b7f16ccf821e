"""Surfaces of stacks: `jumpcad.solids.skin` against manifold3d's extrusions, united and finished.

Every different stack, printed and bought, of random designs in several workshops is written as STL and read again. A
file is faulty if it is not one closed part, or if its volume differs from the exact one of the polygons. Times are of
one processor; the ways take turns on every stack. The tests' random stacks with nearly shared and crossing outlines
are added. Run `PYTHONPATH=tests python benchmarks/surfaces.py [--designs N] [--random N]`; it prints JSON.
"""

import argparse
import io
import json
from collections import Counter
from collections.abc import Callable, Iterator
from time import process_time

import numpy as np
import trimesh
from manifold3d import Manifold, OpType
from support.stacks import random_stack

from jumpcad.building import build
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import CannotBuildError
from jumpcad.robot import Robot
from jumpcad.solids.finish import faults, finished, to_trimesh
from jumpcad.solids.outline import Region, without_slivers
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import write_stl
from jumpcad.workshop import load_workshop

WORKSHOPS = ("default", "fine", "light")
SEED = 9
VOLUME_SHARE = 1e-3
"""A larger error of a file's volume is a fault; slivers and snapping take less from the smallest part."""


def extruded(stack: Stack, clean: Callable[[Region], Region] = lambda region: region) -> Manifold:
    """Return a stack's slabs, each extruded, united in space and finished as other solids are."""
    slabs = [clean(slab.region).extrude(slab.height_mm).translate((0.0, 0.0, slab.z0_mm)) for slab in stack.slabs]
    return finished(Manifold.batch_boolean(slabs, OpType.Add))


WAYS: dict[str, Callable[[Stack], Manifold]] = {
    "skin": Stack.solid,
    "extruded": extruded,
    "extruded without slivers": lambda stack: extruded(stack, without_slivers),
}


def robots(wanted: int) -> Iterator[tuple[str, Robot]]:
    """Yield robots of so many random designs that can be built, in turn in each workshop."""
    rng = np.random.default_rng(SEED)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    workshops = [(name, load_workshop(name)) for name in WORKSHOPS]
    made = 0
    while made < wanted:
        name, workshop = workshops[made % len(workshops)]
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        try:
            robot = build(design, workshop)
        except CannotBuildError:
            continue
        made += 1
        yield name, robot


def stacks(robot: Robot) -> Iterator[tuple[str, Stack]]:
    """Yield the stacks of a robot's printed and bought parts."""
    for part in robot.parts:
        if isinstance(part.drawing.shape, Stack):
            yield part.name, part.drawing.shape
    for item in robot.hardware:
        yield item.name, item.shape


class Tally:
    """Results of the stacks of one kind, made in each way."""

    def __init__(self) -> None:
        self.seen: set[Stack] = set()
        self.seconds: Counter[str] = Counter()
        self.facets: Counter[str] = Counter()
        self.faulty: dict[str, list[str]] = {way: [] for way in WAYS}
        self.off: dict[str, float] = dict.fromkeys(WAYS, 0.0)

    def add(self, name: str, stack: Stack) -> None:
        """Make, write, read and check a stack, unless the same was seen before."""
        if stack in self.seen:
            return
        self.seen.add(stack)
        for way, make in WAYS.items():
            start = process_time()
            solid = make(stack)
            self.seconds[way] += process_time() - start
            stl = write_stl(to_trimesh(solid))
            read = trimesh.load_mesh(io.BytesIO(stl), file_type="stl")
            off = abs(float(read.volume) / stack.volume_mm3 - 1.0)
            found = faults(stl) + ([f"its volume is off by {off:.1e}"] if off > VOLUME_SHARE else [])
            self.facets[way] += len(read.faces)
            self.off[way] = max(self.off[way], off)
            if found:
                self.faulty[way].append(f"{name}: {'; '.join(found)}")

    def summary(self) -> dict[str, object]:
        """Return the figures."""
        return {
            "stacks": len(self.seen),
            **{
                way: {
                    "faulty": len(self.faulty[way]),
                    "cpu_s": round(self.seconds[way], 3),
                    "facets": self.facets[way],
                    "volume_off": float(f"{self.off[way]:.2g}"),
                    "faults": self.faulty[way],
                }
                for way in WAYS
            },
        }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=150)
    parser.add_argument("--random", type=int, default=300)
    arguments = parser.parse_args()
    of_robots, of_chance = Tally(), Tally()
    for workshop, robot in robots(arguments.designs):
        for name, stack in stacks(robot):
            of_robots.add(f"{workshop}, {name}", stack)
    rng = np.random.default_rng(SEED)
    for number in range(arguments.random):
        of_chance.add(f"random {number}", random_stack(rng))
    found = {f"{arguments.designs} robots": of_robots.summary(), "random stacks": of_chance.summary()}
    print(json.dumps(found, indent=2, ensure_ascii=False))


if __name__ == "__main__":
    main()
