"""CPU time of `evaluate`, which builds the robot, against the published simulation alone, and where the time goes.

Both take turns on every design, so that a busy machine slows them alike. The designs are neighbours of the best ones
and random ones within the search bounds, as far as they can be built, and random ones that are refused for their
masses; the caches of gears and bought parts are filled, as in a search. The last line is the part of it that is spent
within manifold3d's plane regions and PyBullet's steps: asked the same, `evaluate` cannot be faster.
Run `python benchmarks/evaluate.py [--json] [--rounds N] [--each N]`.
"""

import argparse
import json
from collections import defaultdict
from collections.abc import Callable
from functools import wraps
from time import process_time
from types import ModuleType
from typing import Any

import numpy as np
import pybullet
from evaluator import cpu_ms
from manifold3d import CrossSection

from jumpcad import evaluation, published
from jumpcad.building import assembly, bearing_and_drive, bodies
from jumpcad.building import growth as building
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import evaluate
from jumpcad.process import collect_seldom
from jumpcad.workshop import load_workshop

BEST = ("best-printable", "best-bo")
BESIDE = 0.04
"""Standard deviation of neighbours, as a share of the search's range."""
EACH = 12
REFUSED = ("no_takeoff", "tips", "too_weak")
STAGES: dict[str, tuple[ModuleType, str]] = {
    "gate": (building, "geometry_findings"),
    "sections": (bearing_and_drive, "sections"),
    "drive": (bearing_and_drive, "synthesise"),
    "plan": (assembly, "make_layout"),
    "drawings": (assembly, "drawings"),
    "printed masses": (bodies, "mass_properties"),
    "checks": (building, "constraint_findings"),
    "simulation": (evaluation, "simulate"),
}
"""Stages of `evaluate`: module, and name of the function in it."""


def designs_of_each(count: int) -> dict[str, list[Design]]:
    """Return so many designs that can be built, near the best and random, and random ones that are refused."""
    workshop, rng = load_workshop("default"), np.random.default_rng(20)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    best = [np.array(load_design(name).to_vector()) for name in BEST]
    found: dict[str, list[Design]] = {"near the best": [], "random": [], "refused": []}

    def verdict(design: Design) -> str:
        try:
            return evaluate(design, workshop).verdict
        except CannotBuildError:
            return ""

    while min(map(len, found.values())) < count:
        middle = best[len(found["near the best"]) % 2]
        near = np.clip(rng.normal(middle, BESIDE * (upper - lower)), lower, upper)
        for kind, vector in (("near the best", near), ("random", rng.uniform(lower, upper))):
            design = Design.from_vector(vector.tolist())
            said = verdict(design)
            kinds = [kind] if said == "jump" else ["refused"] * (kind == "random" and said in REFUSED)
            for one in kinds:
                found[one] += [design] if len(found[one]) < count else []
    return found


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
    parser.add_argument("--each", type=int, default=EACH)
    arguments = parser.parse_args()
    collect_seldom()  # as workers of a search do
    designs = designs_of_each(arguments.each)
    speed = {kind: speeds(found, arguments.rounds) for kind, found in designs.items()}
    built = designs["near the best"] + designs["random"]
    stages, libraries = shares(built, arguments.rounds), in_libraries(built)
    if arguments.json:
        print(
            json.dumps(
                {"designs": arguments.each, "speed": speed, "stages_ms": stages, "libraries_ms": libraries}, indent=2
            )
        )
        return
    print(f"{arguments.each} designs each, {arguments.rounds} rounds, both in turn; medians of CPU time")
    for kind, times in speed.items():
        print(f"{kind}: published {times['published_ms']:.1f} ms, evaluate {times['evaluate_ms']:.1f} ms: "
              f"{times['times_faster']:.2f} times faster, at least {times['times_faster_least']:.2f}, "
              f"{times['times_faster_in_total']:.2f} in total")  # fmt: skip
    print("ms: " + ", ".join(f"{name} {value:.2f}" for name, value in stages.items()))
    print("of these within libraries: " + ", ".join(f"{name} {value:.2f}" for name, value in libraries.items()))


if __name__ == "__main__":
    main()
