"""The genetic algorithm with and without a screen: where it ends, how many robots it builds, CPU time of a candidate.

The ratio is that of the published simulation's time to a candidate's.

The printed robot, default box; the published simulation is timed in the same run, before and after every search.
Run `python benchmarks/screen.py [--seeds N] [--candidates N] [--methods screen,plain] [--json]`.
"""

import argparse
import json
from dataclasses import replace
from time import process_time

import numpy as np

from jumpcad import published as study
from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.search.models import robot_model
from jumpcad.search.propose.genetic import run_genetic
from jumpcad.search.propose.task import Task
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import SCREENED, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import best_trial


def climb(seed: int, candidates: int, screen: bool) -> dict[str, float]:
    """Return the best score, the robots that were built, and the CPU time of a candidate (ms)."""
    model, space = replace(robot_model("printed"), stand_in=screen), Space.default()
    with StudyStore.write(None, {}) as store, local_pool(0) as pool:
        evaluator = Evaluator(space, find_objective(model.default_objective), model, store, pool)
        start = process_time()
        run_genetic(evaluator, Task(candidates, seed, screen=screen))
        spent = process_time() - start
        best = best_trial(evaluator.trials)
        # what was refused before it was built has no figures
        built = sum(
            trial.evaluation.verdict != SCREENED and bool(trial.evaluation.metrics) for trial in evaluator.trials
        )
        score = (best.score if best else None) or 0.0
        return {"best": score, "built": built, "ms": 1000.0 * spent / len(evaluator.trials)}


def published_ms() -> float:
    """Return the CPU time of the published simulation of one design (ms), the median of the templates'."""
    spent = []
    for name in template_names("robots"):
        start = process_time()
        study.simulate(load_design(name))
        spent.append(1000.0 * (process_time() - start))
    return float(np.median(spent))


def main() -> None:
    """Print one line a seed, and medians."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--candidates", type=int, default=400)
    parser.add_argument("--methods", default="plain,screen")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    rows = []
    for seed in range(arguments.seeds):
        row = {}
        for name in arguments.methods.split(","):
            before = published_ms()
            one = climb(seed, arguments.candidates, name == "screen")
            published = (before + published_ms()) / 2.0
            row[name] = one | {"published_ms": published, "ratio": published / one["ms"]}
        rows.append(row)
        if not arguments.json:
            cells = [
                f"{name}: {one['best']:.3f}, {one['built']} built, {one['ms']:.1f} ms, published "
                f"{one['published_ms']:.0f} ms, ratio {one['ratio']:.2f}"
                for name, one in row.items()
            ]
            print(f"seed {seed}  {'   '.join(cells)}", flush=True)
    if arguments.json:
        print(json.dumps(rows, indent=2))


if __name__ == "__main__":
    main()
