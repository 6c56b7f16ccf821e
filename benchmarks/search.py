"""How fast each method improves a robot: best score after numbers of evaluations, over several seeds.

The capsule robot's fitness, or with `--model printed` the printed robot's body lengths (0.1 to 0.3 s an evaluation).
The usual bounds of the robot; a rejected design scores 0; the best known of the capsule robot is 11.87. Random search
and the published settings of the genetic algorithm are run too, and CMA-ES (pycma) and TPE (Optuna) as references from
other projects. "GP-EI, spread start" has no designs ranked by a quick robot first; on the capsule robot it is "GP-EI".
Run `python benchmarks/search.py [--seeds N] [--methods a,b] [--model printed] [--evaluations N] [--json]`; in a
method's name, write `;` for a comma. All of it takes about a quarter of an hour on the capsule robot.
`--required --study --seeds 8 --evaluations 60` shows what requirements cost within the study's bounds; `--machine
--seeds 8`, with `--cold` too, how near searches come to the best known within the machine's (an hour on two cores).

Searches of the printed robot in docs/speed.md and docs/decisions/default-search.md have seeds 0 to 7, the extra `fast`
and a machine with nothing else to do, on which a published simulation takes 35 to 43 ms.
"""

import argparse
import json
import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from itertools import accumulate

import numpy as np
import numpy.typing as npt

from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.search.models import PrintedModel, RobotModel, robot_model
from jumpcad.search.propose.bayesian import run_bayesian
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request, Stage, default_initial
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.variant import NOTHING

MARKS = (40, 60, 100, 200, 250, 500, 1000)

Scores = list[float]


def random_search(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Evaluate uniformly random designs."""
    space = evaluator.space
    points = np.random.default_rng(seed).random((evaluations, space.dimension))
    evaluator.evaluate([space.to_design(point) for point in points], "sample", 0)


def stage(
    evaluator: Evaluator, method: str, seed: int, evaluations: int, initial: int = 0, preset: str = "recommended"
) -> Stage:
    """Return what a method is asked for."""
    asked = Request(evaluator.space, evaluator.model, evaluator.objective.name, method, evaluations, seed, preset)
    return Stage(asked, method, evaluations, initial)


def genetic(evaluator: Evaluator, seed: int, evaluations: int, preset: str = "recommended") -> None:
    """Run PyGAD."""
    run_genetic(evaluator, stage(evaluator, "ga", seed, evaluations, preset=preset))


def bayesian(evaluator: Evaluator, seed: int, evaluations: int, least_gain: float = 0.0) -> None:
    """Run GP-EI."""
    initial = default_initial(evaluator.space, evaluations, estimated=isinstance(evaluator.model, PrintedModel))
    run_bayesian(evaluator, replace(stage(evaluator, "bo", seed, evaluations, initial), least_gain=least_gain))


class Spread(PrintedModel):
    """A model that ranks no designs to start with."""

    def quick_score(self, _design: Design, _objective: Objective) -> float:
        """Rank nothing."""
        return -math.inf


def genetic_then_bayesian(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Run PyGAD, then GP-EI on all that it saw for the last fifth."""
    run_genetic(evaluator, stage(evaluator, "ga", seed, evaluations - evaluations // 5))
    run_bayesian(evaluator, stage(evaluator, "bo", seed, evaluations // 5))


def score_of(evaluator: Evaluator, step: int, point: npt.ArrayLike) -> float:
    """Evaluate one point of the unit cube for an outside optimiser."""
    (trial,) = evaluator.evaluate([evaluator.space.to_design(np.asarray(point, dtype=float))], "sample", step)
    return trial.score or 0.0 if trial is not None else 0.0


def cma_es(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Run pycma from the middle of the box."""
    import cma

    options = {"bounds": [0, 1], "seed": seed + 1, "maxfevals": evaluations, "verbose": -9}
    search = cma.CMAEvolutionStrategy([0.5] * evaluator.space.dimension, 0.3, options)
    step = 0
    while len(evaluator.trials) < evaluations and step < 2 * evaluations:
        points = search.ask()
        search.tell(points, [-score_of(evaluator, step + index, point) for index, point in enumerate(points)])
        step += len(points)


def tpe(evaluator: Evaluator, seed: int, evaluations: int) -> None:
    """Run Optuna's tree-structured Parzen estimator."""
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(direction="maximize", sampler=optuna.samplers.TPESampler(seed=seed))

    def objective(trial: optuna.Trial) -> float:
        point = [trial.suggest_float(parameter.name, 0.0, 1.0) for parameter in evaluator.space.free]
        return score_of(evaluator, trial.number, point)

    study.optimize(objective, n_trials=evaluations)


METHODS: dict[str, tuple[Callable[..., None], int]] = {
    "random": (random_search, 1000),
    "PyGAD, published settings": (partial(genetic, preset="published"), 1000),
    "Optuna TPE": (tpe, 500),
    "pycma": (cma_es, 1000),
    "PyGAD, recommended settings": (genetic, 1000),
    "GP-EI, spread start": (bayesian, 200),
    "GP-EI": (bayesian, 200),
    "GA 200, then BO 50": (genetic_then_bayesian, 250),
}


PITCH = "-30<=touchdown_pitch_deg<=30"
REQUIRED = {
    "nothing required": (),
    "one": (PITCH,),
    "two": (PITCH, "com_rise_m>=0.2"),
    "three": (PITCH, "com_rise_m>=0.1", "spring_energy_j<=0.4"),
    "five, four of them idle": (PITCH, "com_rise_m>=0.2", "mass_kg<=0.17", "cost_eur<=200", "takeoff_time_s<=0.06"),
    "five": (PITCH, "com_rise_m>=0.1", "spring_energy_j<=0.4", "leg_strength>=2", "electrical_energy_j<=5"),
}
"""Sets of requirements on the printed robot, on figures of very different size: what `two` and `five, four of them
idle` add to `one` its best designs keep."""


MACHINE = {
    "default, when it ended": ("", (), 250, 0.0005),
    "touchdown, upright, at 90": ("touchdown", (PITCH,), 90, 0.0),
}
"""Searches within the machine's bounds: objective, requirements, evaluations, and the gain below which they end."""


def climb(
    method: Callable[..., None], seed: int, evaluations: int, model: RobotModel,
    bounds: Mapping[str, tuple[float, float]] = NOTHING, objective: str = "", cold: bool = False,
) -> Scores:  # fmt: skip
    """Return the best score so far after each evaluation."""
    space = Space.make(bounds=bounds, workshop=model.workshop)
    request = Request(space, model, objective or model.default_objective, cold=cold)
    with StudyStore.write(None, request.identity([])) as store, local_pool(0) as pool:
        evaluator = Evaluator(request, store, pool)
        method(evaluator, seed, evaluations)
        return [*accumulate((trial.score or 0.0 for trial in evaluator.trials[:evaluations]), max)]


def main() -> None:
    """Print one line per method: median [least, greatest] at each mark."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--methods", default=",".join(METHODS).replace(", ", "; "))
    parser.add_argument("--model", default="capsule")
    parser.add_argument("--evaluations", type=int, default=1000, help="at most, of every method")
    parser.add_argument("--required", action="store_true", help="GP-EI on the printed robot with requirements instead")
    parser.add_argument("--study", action="store_true", help="within the study's bounds")
    parser.add_argument(
        "--machine", action="store_true", help="GP-EI on the printed robot, as it can be built, instead"
    )
    parser.add_argument("--cold", action="store_true", help="without shipped designs among the first")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    for name, (objective, required, evaluations, least_gain) in MACHINE.items() if arguments.machine else ():
        printed = robot_model("printed").requiring(required)
        assert isinstance(printed, PrintedModel)
        search = partial(bayesian, least_gain=least_gain)
        found = [
            climb(search, seed, evaluations, replace(printed, stand_in=True), objective=objective, cold=arguments.cold)
            for seed in range(arguments.seeds)
        ]
        best, designs = [one[-1] for one in found], sorted(map(len, found))
        told = f"{np.median(best):.3f} [{min(best):.3f}, {max(best):.3f}]"
        print(
            f"{name:28s}{told} after {designs[0]} to {designs[-1]}: {', '.join(f'{one:.3f}' for one in best)}",
            flush=True,
        )
    if arguments.machine:
        return
    chosen = [name.replace(";", ",") for name in arguments.methods.split(",")]
    table = {}
    for name in REQUIRED if arguments.required else chosen:
        method, evaluations = METHODS["GP-EI" if arguments.required else name]
        evaluations = min(evaluations, arguments.evaluations)
        model = robot_model("printed" if arguments.required else arguments.model).requiring(REQUIRED.get(name, ()))
        if isinstance(model, PrintedModel):  # as a search by `bo` asks for
            model = replace(model, stand_in=True)
        if "spread" in name:
            model = Spread(workshop=model.workshop, settings=model.settings, engine=model.engine)
        bounds = SEARCH_BOUNDS if arguments.study else NOTHING
        climbs = [climb(method, seed, evaluations, model, bounds) for seed in range(arguments.seeds)]
        marks = [mark for mark in MARKS if mark <= evaluations]
        table[name] = {mark: [one[min(mark, len(one)) - 1] for one in climbs] for mark in marks}
        if not arguments.json:
            cells = [
                f"{mark}: {np.median(scores):.2f} [{min(scores):.2f}, {max(scores):.2f}]"
                for mark, scores in table[name].items()
            ]
            print(f"{name:28s}" + "   ".join(cells), flush=True)
    if arguments.json:
        print(json.dumps(table, indent=2))


if __name__ == "__main__":
    main()
