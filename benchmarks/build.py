"""CPU time of `jumpcad build`, from the start of Python to the last file, and where it goes.

Every round is a separate process, as a build is: nothing is cached from one to the next. The times are those of
Python's own processor clock (seconds), so a busy machine matters little. Run
`python benchmarks/build.py [DESIGN ...] [--json] [--rounds N]`.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from time import process_time
from typing import Any
from unittest.mock import patch

import numpy as np

DESIGNS = ("kenan-2.0", "best-printable")
STAGES = {
    "stl": "parts as solids and STL files",
    "3mf": "plates",
    "urdf": "URDF",
    "mjcf": "MJCF",
    "sdf": "SDF",
    "dxf": "outlines",
    "glb": "GLB",
}
"""Stages by exporter; pictures are one too, and all else are documents."""


def once(name: str) -> dict[str, float]:
    """Build a design in this process and return the CPU time (s) of every stage, and in total from Python's start."""
    clock = [("start of Python", process_time())]

    def passed(stage: str) -> None:
        clock.append((stage, process_time()))

    from jumpcad import simulation
    from jumpcad.building import growth as building
    from jumpcad.bundle import export as bundle
    from jumpcad.bundle.renders import all_pictures
    from jumpcad.design import load_design
    from jumpcad.exporters.registry import chosen
    from jumpcad.mechanism.variants import capsule_robot
    from jumpcad.search.study.pool import InProcess

    passed("imports")
    robot = building.build(load_design(name), name=name)
    passed("robot")

    def timed(stage: str, make: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            if stage == "pictures":
                passed("documents")
            made = dict(make(*arguments))
            passed(stage)
            return made.items() if stage in STAGES.values() else made

        return call

    exporters = [replace(one, files=timed(STAGES[one.name], one.files)) for one in chosen()]
    with (
        patch.object(bundle, chosen.__name__, lambda _names: exporters),
        patch.object(bundle, ThreadPoolExecutor.__name__, lambda _: InProcess()),  # one thing after the other
        patch.object(bundle, all_pictures.__name__, timed("pictures", all_pictures)),
        tempfile.TemporaryDirectory() as folder,
    ):
        bundle.export(robot, Path(folder) / name)
    passed("documents")
    for one in (robot, capsule_robot(robot.design)):
        simulation.simulate(one)
    passed("simulations")
    spent: dict[str, float] = defaultdict(float, {"start of Python": clock[0][1]})
    for (_, before), (stage, after) in pairwise(clock):
        spent[stage] += after - before
    return {"total": clock[-1][1], **spent}


def rounds(name: str, count: int) -> dict[str, float]:
    """Return the medians of some builds, each in a separate process."""
    command = [sys.executable, __file__, "--once", name]
    runs = [json.loads(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(count)]
    return {stage: float(np.median([run[stage] for run in runs])) for stage in runs[0]}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("designs", nargs="*", default=DESIGNS)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--once", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.once:
        print(json.dumps(once(arguments.designs[0])))
        return
    found = {name: rounds(name, arguments.rounds) for name in arguments.designs}
    if arguments.json:
        print(json.dumps(found, indent=2))
        return
    print(f"CPU time (s), medians of {arguments.rounds} builds")
    for name, stages in found.items():
        print(f"{name}: " + ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in stages.items()))


if __name__ == "__main__":
    main()
