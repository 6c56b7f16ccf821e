"""The planar engine against converged PyBullet and MuJoCo (step 1/16000 s), and its CPU time.

Errors of range on the table of reference flights, on capsule and printed robots of random designs that pass the gate,
and on slipping ones; CPU time of everything in turn, so that a busy machine slows all alike.
Run `python benchmarks/planar.py [--json] [--rounds N] [--capsule N] [--printed N] [--slipping N]`.
"""

import argparse
import csv
import json
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from evaluator import cpu_ms

from jumpcad import published
from jumpcad.building import build
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.files import template_names
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.simulation import load_settings, simulate
from jumpcad.simulation.planar import PlanarWorld

TESTS = Path(__file__).parents[1] / "tests"
FINE, DEFAULT = load_settings("fine"), load_settings("default")
RIVALS = ("pybullet", "mujoco")
FRICTIONS = (0.3, 0.6)
SLIDES = 0.005
"""Share of the springs' energy lost at the ground from which on a foot has slid."""
SLIDING_OF = 5
"""Robots that are tried for every one that slides and jumps."""


def of_table() -> Iterator[tuple[Mechanism, str, float | None]]:
    """Yield the robots of the table of reference flights, with verdict and range."""
    with (TESTS / "data" / "reference_flights.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            robot = capsule_robot(Design(**{key: float(row[key]) for key in SEARCH_BOUNDS}))
            yield robot, row["verdict"], float(row["ballistic_range_m"]) if row["ballistic_range_m"] else None


def robots_of(make: Callable[[Design], Mechanism], count: int) -> list[Mechanism]:
    """Return the templates and random designs as robots that pass the gate."""
    rng = np.random.default_rng(12)
    lower, upper = np.transpose([(bound.lower, bound.upper) for bound in SEARCH_BOUNDS.values()])
    designs = [load_design(name) for name in template_names("robots")][:count]
    robots: list[Mechanism] = []
    while len(robots) < count:
        design = designs.pop(0) if designs else Design.from_vector(rng.uniform(lower, upper).tolist())
        try:
            robot = make(design)
            robots += [robot] if not errors(statics_findings(robot)) else []
        except CannotBuildError:
            continue
    return robots


def errors_of(values: list[float | None], truths: list[float | None]) -> dict[str, float]:
    """Return how many jump here and not there, and the error of range (%) of those that jump in both.

    A range under 10 mm, that of a jump straight up, counts as 10 mm.
    """
    wrong = sum((value is None) != (truth is None) for value, truth in zip(values, truths, strict=True))
    pairs = np.array([pair for pair in zip(values, truths, strict=True) if None not in pair], dtype=float)
    off = 100.0 * np.abs(pairs[:, 0] - pairs[:, 1]) / np.maximum(pairs[:, 1], 0.01)
    quantiles = {"median": float(np.median(off)), "p90": float(np.quantile(off, 0.9)), "max": float(off.max())}
    return {"robots": len(values), "jumps": len(pairs), "wrong_verdicts": wrong} | quantiles


def table_errors() -> dict[str, dict[str, float]]:
    """Return the errors on the table of reference flights."""
    robots, _, ranges = zip(*of_table(), strict=True)
    return {
        name: errors_of([simulate(robot, settings, "planar").ballistic_range_m for robot in robots], list(ranges))
        for name, settings in (("default", DEFAULT), ("fine", FINE))
    }


def random_errors(robots: Sequence[Mechanism]) -> dict[str, dict[str, float]]:
    """Return the errors on robots at the default step, against each rival and of one against the other."""
    ranges = {rival: [simulate(robot, FINE, rival).ballistic_range_m for robot in robots] for rival in RIVALS}
    planar = [simulate(robot, DEFAULT, "planar").ballistic_range_m for robot in robots]
    result = {rival: errors_of(planar, found) for rival, found in ranges.items()}
    return result | {"mujoco against pybullet": errors_of(ranges["mujoco"], ranges["pybullet"])}


def slipping_errors(robots: Sequence[Mechanism], count: int) -> dict[str, dict[str, float]]:
    """Return the errors of the first robots that slide, each on a floor of other friction.

    Of every engine at the default step against PyBullet and MuJoCo at the fine one, and of these against each other.
    """
    frictions = np.random.default_rng(3).uniform(*FRICTIONS, len(robots))
    sliding = []
    for robot, friction in zip(robots, frictions.tolist(), strict=True):
        floor = {"ground_friction": friction}
        jump = simulate(robot, DEFAULT.model_copy(update=floor), "planar")
        if jump.energy is not None and jump.energy.slip_j > SLIDES * jump.spring_energy_j:
            sliding.append((robot, floor))
    ranges = {
        (engine, step): [
            simulate(robot, settings.model_copy(update=floor), engine).ballistic_range_m
            for robot, floor in sliding[:count]
        ]
        for step, settings in (("default", DEFAULT), ("fine", FINE))
        for engine in (*RIVALS, "planar")
    }
    fine = {engine: ranges[engine, "fine"] for engine in RIVALS}
    compared = {
        f"{engine} at the default step against {rival}": errors_of(ranges[engine, "default"], found)
        for rival, found in fine.items()
        for engine in (*RIVALS, "planar")
    }
    return compared | {"mujoco against pybullet": errors_of(fine["mujoco"], fine["pybullet"])}


def speeds(rounds: int) -> dict[str, dict[str, float]]:
    """Return CPU times on the table's jumps, medians over designs and rounds, and how much faster than the study's."""
    robots = [robot for robot, known, _ in of_table() if known == "jump"]
    fine, default = ({robot.design: PlanarWorld(robot, settings) for robot in robots} for settings in (FINE, DEFAULT))
    calls: dict[str, Callable[[Mechanism], object]] = {
        "published": lambda robot: published.simulate(robot.design),
        "pybullet": lambda robot: simulate(robot, DEFAULT),
        "planar": lambda robot: simulate(robot, DEFAULT, "planar"),
        "push-off": lambda robot: default[robot.design].push_off(),
        "push-off, 1/16000": lambda robot: fine[robot.design].push_off(),
    }
    for call in calls.values():
        call(robots[0])
    times = np.median(
        [[[cpu_ms(partial(call, robot)) for call in calls.values()] for robot in robots] for _ in range(rounds)], axis=0
    )
    return {
        name: {"cpu_ms": float(np.median(times[:, k])), "times_faster": float(np.median(times[:, 0] / times[:, k]))}
        for k, name in enumerate(calls)
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--capsule", type=int, default=40)
    parser.add_argument("--printed", type=int, default=40)
    parser.add_argument("--slipping", type=int, default=20)
    arguments = parser.parse_args()
    result: dict[str, dict[str, dict[str, float]]] = {"speed": speeds(arguments.rounds), "table": table_errors()}
    if arguments.capsule:
        result["capsule"] = random_errors(robots_of(capsule_robot, arguments.capsule))
    robots = robots_of(build, max(arguments.printed, SLIDING_OF * arguments.slipping))
    if arguments.printed:
        result["printed"] = random_errors(robots[: arguments.printed])
    if arguments.slipping:
        result["slipping"] = slipping_errors(robots, arguments.slipping)
    if arguments.json:
        print(json.dumps(result, indent=2))
        return
    for topic, rows in result.items():
        print(topic)
        for name, row in rows.items():
            print(f"  {name}: " + ", ".join(f"{key} {value:.3g}" for key, value in row.items()))


if __name__ == "__main__":
    main()
