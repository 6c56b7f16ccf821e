"""CPU time of `evaluate`, which builds the robot, against the published simulation alone, and where the time goes.

Both take turns on every design, so that a busy machine slows them alike. The designs are those of the table of
reference flights and random ones within the search bounds, as far as they can be built; the caches of gears
and bought parts are filled, as in a search. The last line is the part of it that is spent within manifold3d's plane
regions and PyBullet's steps: asked the same, `evaluate` cannot be faster.
Run `python benchmarks/evaluate.py [--json] [--rounds N] [--random N]`.
"""

import argparse
import csv
import json
from collections import defaultdict
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from time import process_time
from types import ModuleType
from typing import Any

import numpy as np
import pybullet
from manifold3d import CrossSection

from jumpcad import evaluation, published
from jumpcad.building import assembly, bearing_and_drive, weighing
from jumpcad.building import growth as building
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import evaluate
from jumpcad.parts import shopping
from jumpcad.workshop import load_workshop

REFERENCE = Path(__file__).parents[1] / "tests" / "data" / "reference_flights.csv"
RANDOM = 12
STAGES: dict[str, tuple[ModuleType, str]] = {
    "gate": (building, "geometry_findings"),
    "sections": (bearing_and_drive, "sections"),
    "drive": (bearing_and_drive, "synthesise"),
    "plan": (assembly, "make_layout"),
    "drawings": (assembly, "drawings"),
    "printed masses": (weighing, "mass_properties"),
    "checks": (building, "constraint_findings"),
    "bought parts": (shopping, "bought_parts"),
    "simulation": (evaluation, "simulate"),
}
"""Stages of `evaluate`: module, and name of the function in it."""


def buildable(rows: int) -> list[Design]:
    """Return the reference designs that can be built, and as many random ones."""
    workshop = load_workshop("default")
    with REFERENCE.open() as file:
        known = [Design(**{key: float(row[key]) for key in SEARCH_BOUNDS}) for row in csv.DictReader(file)]
    rng = np.random.default_rng(20)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])

    def built(design: Design) -> bool:
        try:
            evaluate(design, workshop)
        except CannotBuildError:
            return False
        return True

    designs = [design for design in known if built(design)]
    wanted = len(designs) + rows
    while len(designs) < wanted:
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        if built(design):
            designs.append(design)
    return designs


def cpu_ms(call: Callable[[], object]) -> float:
    """Return the CPU time of a call."""
    start = process_time()
    call()
    return 1000.0 * (process_time() - start)


def speeds(designs: list[Design], rounds: int) -> dict[str, float]:
    """Return both CPU times (medians over designs of medians over rounds) and their ratio."""
    workshop = load_workshop("default")
    models = (published.simulate, lambda design: evaluate(design, workshop))
    times = np.median(
        [[[cpu_ms(lambda: model(design)) for model in models] for design in designs] for _ in range(rounds)],  # noqa: B023
        axis=0,
    )
    ratios = times[:, 0] / times[:, 1]
    return {
        "published_ms": float(np.median(times[:, 0])),
        "evaluate_ms": float(np.median(times[:, 1])),
        "times_faster": float(np.median(ratios)),
        "times_faster_least": float(ratios.min()),
        "times_faster_in_total": float(times[:, 0].sum() / times[:, 1].sum()),
    }


def shares(designs: list[Design], rounds: int) -> dict[str, float]:
    """Return the CPU time of every stage of `evaluate` (ms, median over designs and rounds), and that of the rest."""
    spent: dict[str, float] = defaultdict(float)

    def timed(name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(call)
        def wrapper(*args: Any, **kwargs: Any) -> Any:
            start = process_time()
            try:
                return call(*args, **kwargs)
            finally:
                spent[name] += 1000.0 * (process_time() - start)

        return wrapper

    originals = {name: getattr(module, function) for name, (module, function) in STAGES.items()}
    for name, (module, function) in STAGES.items():
        setattr(module, function, timed(name, originals[name]))
    workshop, rows = load_workshop("default"), []
    try:
        for design in designs * rounds:
            spent.clear()
            total = cpu_ms(lambda: evaluate(design, workshop))  # noqa: B023
            rows.append([*(spent[name] for name in STAGES), total - sum(spent.values())])
    finally:
        for name, (module, function) in STAGES.items():
            setattr(module, function, originals[name])
    return dict(zip([*STAGES, "rest"], np.median(rows, axis=0).tolist(), strict=True))


def in_libraries(designs: list[Design]) -> dict[str, float]:
    """Return the CPU time of `evaluate` within compiled libraries (ms, medians over designs), by library."""
    spent: dict[str, float] = defaultdict(float)

    def timed(library: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def wrapper(*args: Any, **kwargs: Any) -> Any:
            start = process_time()
            result = call(*args, **kwargs)
            spent[library] += 1000.0 * (process_time() - start)
            return result

        return wrapper

    # what takes a region first is a method, the others are static; making one of points is not counted
    of_regions = {name: call for name, call in vars(CrossSection).items() if name != "__init__"}
    methods = {name: call for name, call in of_regions.items() if type(call).__name__ == "nb_method"}
    functions = {name: call for name, call in of_regions.items() if type(call).__name__ == "nb_func"}
    step, workshop, rows = pybullet.stepSimulation, load_workshop("default"), []
    for name, call in methods.items():
        setattr(CrossSection, name, timed("manifold3d", call))
    for name, call in functions.items():
        setattr(CrossSection, name, staticmethod(timed("manifold3d", call)))
    pybullet.stepSimulation = timed("pybullet", step)
    try:
        for design in designs:
            spent.clear()
            evaluate(design, workshop)
            rows.append([spent["manifold3d"], spent["pybullet"]])
    finally:
        for name, call in (methods | functions).items():
            setattr(CrossSection, name, call)
        pybullet.stepSimulation = step
    return dict(zip(("manifold3d", "pybullet"), np.median(rows, axis=0).tolist(), strict=True))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--random", type=int, default=RANDOM)
    arguments = parser.parse_args()
    designs = buildable(arguments.random)
    speed, stages = speeds(designs, arguments.rounds), shares(designs, arguments.rounds)
    libraries = in_libraries(designs)
    if arguments.json:
        times = {"speed": speed, "stages_ms": stages, "libraries_ms": libraries}
        print(json.dumps({"designs": len(designs), **times}, indent=2))
        return
    print(f"{len(designs)} designs that can be built, {arguments.rounds} rounds, both in turn; medians of CPU time")
    print(f"published {speed['published_ms']:.1f} ms, evaluate {speed['evaluate_ms']:.1f} ms: "
          f"{speed['times_faster']:.2f} times faster, at least {speed['times_faster_least']:.2f}, "
          f"{speed['times_faster_in_total']:.2f} in total")  # fmt: skip
    print("ms: " + ", ".join(f"{name} {value:.2f}" for name, value in stages.items()))
    print("of these within libraries: " + ", ".join(f"{name} {value:.2f}" for name, value in libraries.items()))


if __name__ == "__main__":
    main()
