"""CPU time of one evaluation against the published simulation, its error of range, and where the time goes.

All models take turns on every design, so that a busy machine slows them alike. Only designs that pass the gate and jump
are timed: a rejected one costs the checks alone. Run `python benchmarks/evaluator.py [--json] [--rounds N]`.
"""

import argparse
import json
from collections.abc import Callable
from functools import partial
from time import process_time

import numpy as np

from jumpcad import published
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.files import template_names
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import Jump, Settings, load_settings, simulate
from jumpcad.simulation.bullet import BulletEngine
from jumpcad.simulation.run import Run

DESIGNS = 30
PRESETS = ("default", "screening")


def jumping_designs(count: int) -> list[Design]:
    """Return the templates and random designs within the search bounds, as many as asked for, that all jump."""
    rng = np.random.default_rng(20)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    designs = [load_design(name) for name in template_names("robots")]
    while len(designs) < count:
        design = Design.from_vector(rng.uniform(lower, upper).tolist())
        try:
            if simulate(capsule_robot(design)).verdict == "jump":
                designs.append(design)
        except CannotBuildError:
            continue
    return designs


def cpu_ms(call: Callable[[], object]) -> float:
    """Return the CPU time of a call."""
    start = process_time()
    call()
    return 1000.0 * (process_time() - start)


def speeds(designs: list[Design], rounds: int) -> dict[str, dict[str, float]]:
    """Return the CPU time of every model, each the median over designs of the median over rounds."""

    def simulated(settings: Settings, design: Design) -> Jump:
        return simulate(capsule_robot(design), settings)

    models: dict[str, Callable[[Design], object]] = {"published": published.simulate}
    models |= {preset: partial(simulated, load_settings(preset)) for preset in PRESETS}
    times = np.array(
        [
            [[cpu_ms(lambda: model(design)) for model in models.values()] for design in designs]  # noqa: B023
            for _ in range(rounds)
        ]
    )
    by_design = np.median(times, axis=0)
    ratios = by_design[:, :1] / by_design
    return {
        name: {
            "cpu_ms": float(np.median(by_design[:, index])),
            "times_faster": float(np.median(ratios[:, index])),
            "times_faster_in_total": float(by_design[:, 0].sum() / by_design[:, index].sum()),
        }
        for index, name in enumerate(models)
    }


def range_errors(designs: list[Design]) -> dict[str, dict[str, float]]:
    """Return the error of range (%) of each preset against `fine`: median, 90th percentile, greatest."""
    fine = [simulate(capsule_robot(design), load_settings("fine")).ballistic_range_m for design in designs]
    result = {}
    for preset in PRESETS:
        ranges = [simulate(capsule_robot(design), load_settings(preset)).ballistic_range_m for design in designs]
        errors = 100.0 * np.abs(np.array(ranges, dtype=float) / np.array(fine, dtype=float) - 1.0)
        result[preset] = {
            "median": float(np.median(errors)),
            "p90": float(np.quantile(errors, 0.9)),
            "max": float(errors.max()),
        }
    return result


def shares(designs: list[Design], rounds: int) -> dict[str, float]:
    """Return where the time of one evaluation with default settings goes (ms, median over designs and rounds)."""
    settings, engine = load_settings("default"), BulletEngine()
    rows = []
    for design in designs * rounds:
        marks = [process_time()]
        robot = capsule_robot(design)
        marks.append(process_time())
        geometry_findings(design)
        statics_findings(robot)
        marks.append(process_time())
        with engine.world(robot, settings) as world:
            run = Run(world, robot, settings)
            marks.append(process_time())
            run.go()
            marks.append(process_time())
        marks.append(process_time())
        rows.append(1000.0 * np.diff(marks))
    names = ("capsule robot", "gate", "build", "push-off", "removal")
    return dict(zip(names, np.median(rows, axis=0).tolist(), strict=True))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    designs = jumping_designs(DESIGNS)
    speed, off, spent = speeds(designs, arguments.rounds), range_errors(designs), shares(designs, arguments.rounds)
    if arguments.json:
        result = {"designs": len(designs), "speed": speed, "range_error_percent": off, "default_ms": spent}
        print(json.dumps(result, indent=2))
        return
    print(f"{len(designs)} designs that jump, {arguments.rounds} rounds, models in turn; medians of CPU time")
    print(f"{'model':<12}{'ms':>8}{'faster':>9}{'in total':>10}   error of range against fine, median / p90 / max")
    for name, one in speed.items():
        error = off.get(name)
        shown = " / ".join(f"{value:.2f}" for value in error.values()) + " %" if error else "does not converge"
        print(
            f"{name:<12}{one['cpu_ms']:>8.2f}{one['times_faster']:>8.1f}x{one['times_faster_in_total']:>9.1f}x"
            f"   {shown}"
        )
    print("default, ms: " + ", ".join(f"{name} {value:.2f}" for name, value in spent.items()))


if __name__ == "__main__":
    main()
