"""`run_study`: runs the stages of a request, or continues them, and picks the winner.

The same request ends with the same trials, whether or not it was interrupted.
"""

import json
import math
import time
from dataclasses import asdict, replace
from pathlib import Path

from jumpcad.arguments import typed
from jumpcad.errors import JumpcadError
from jumpcad.search.evaluator import Evaluator, Watch, ignore
from jumpcad.search.methods import METHODS, Task
from jumpcad.search.pool import Pool
from jumpcad.search.request import Request, Stage, plan_stages
from jumpcad.search.result import Result
from jumpcad.search.robust import MOST_PICK, active_bounds, rank_candidates
from jumpcad.search.store import StudyStore
from jumpcad.search.trial import Trial, best_trial


@typed
def run_study(request: Request, path: str | Path | None, pool: Pool, watch: Watch = ignore) -> Result:
    """Run a study, or continue the one in a file; None keeps it in memory.

    Raises
    ------
    JumpcadError
        If the request is wrong, or the file holds another study, is damaged or in use.
    """
    prior, remark = _read_prior(request)
    with StudyStore.write(path, request.identity(prior)) as store:
        if remark:
            store.note_once(remark)
        stages = _stages(request, store, len(prior))
        end_s = time.monotonic() + 3600.0 * (request.hours or math.inf)
        evaluator = Evaluator(
            request.space, request.aim, request.model, store, pool, prior, watch, lambda: time.monotonic() >= end_s
        )
        for stage in stages:
            if not evaluator.trials or not evaluator.expired():
                task = Task(
                    stage.evaluations, request.seed, stage.initial, request.batch, request.preset,
                    request.until_percent / 100.0,
                )  # fmt: skip
                METHODS[stage.method].run(evaluator, task)
        trials = evaluator.trials
        best = best_trial(trials)
        candidates, bounds = [], []
        if request.pick and best is not None:
            share = request.pick - min(request.space.dimension, request.pick // 4)
            candidates = rank_candidates(evaluator, trials, request.seed, request.tolerance_mm, share)
        if candidates:
            left = request.pick - (len(evaluator.trials) - len(trials))
            bounds = active_bounds(evaluator, candidates[0].trial, _bounds_step(request, trials), left)
        return Result(request, trials, best, candidates, bounds, store.notes(), len(evaluator.trials))


def _bounds_step(request: Request, trials: list[Trial]) -> int:
    """Return a step of its own for every length of the search and of the pick."""
    return (MOST_PICK + 1) * len(trials) + request.pick


def _stages(request: Request, store: StudyStore, prior: int) -> list[Stage]:
    """Return the stages that the study has been planned with; a larger budget lengthens the last of them."""
    planned = store.recall("stages")
    if planned is None:
        stages = plan_stages(request, prior)
    else:
        stages = [Stage(**stage) for stage in planned]
        held = sum(stage.evaluations for stage in stages)
        more = request.searched - held
        if more < 0:
            raise JumpcadError(
                f"{store.path}: its search is planned for {held} evaluations, not {request.searched} of "
                f"{request.evaluations}; ask for more, or name another file"
            )
        stages[-1] = replace(stages[-1], evaluations=stages[-1].evaluations + more)
    store.remember("stages", [asdict(stage) for stage in stages])
    return stages


def _read_prior(request: Request) -> tuple[list[Trial], str]:
    """Return the trials of the prior study that lie in the space, scored by this request's objective, and a remark."""
    if request.prior is None:
        return [], ""
    with StudyStore.read(request.prior) as store:
        theirs, ours = store.identity["model"], json.loads(json.dumps(request.model.describe()))
        if theirs != ours:
            raise JumpcadError(
                f"{request.prior}: was made with another model ({theirs['name']}, or other settings) than this search"
            )
        objective = request.aim
        trials = [
            replace(trial, score=objective.score(trial.evaluation))
            for trial in store.trials()
            if request.space.contains(trial.variant)
        ]
        same = all(trial.model == request.model.digest for trial in trials)
        remark = f"{request.prior} was made by another program; the search learns from it nevertheless"
        return trials, "" if same else remark
