"""`run_study`: runs the stages of a request, or continues them, and picks the winner.

The same request ends with the same trials, whether or not it was interrupted.
"""

import json
import math
import pkgutil
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.search.fronts import front
from jumpcad.search.methods import METHODS, SEARCH_PHASES, STAGES
from jumpcad.search.robust_pick import ActiveBound, Candidate, active_bounds, rank_candidates
from jumpcad.search.study.code_hash import versions
from jumpcad.search.study.evaluator import Evaluator, Watch
from jumpcad.search.study.pool import Pool
from jumpcad.search.study.request import LEARNING_VERSIONS, Request, Stage, plan_stages
from jumpcad.search.study.result import Result
from jumpcad.search.study.store import ENDED, StudyStore, difference
from jumpcad.search.study.summary import keep_pick, pick_run, simulated_righting
from jumpcad.search.study.trial import Trial, best_trial, is_flat
from jumpcad.search.study.why_none import FIRST, why_hopeless, why_rejected, why_required

PICK_SHARE = 0.25
"""Share of a limited time that is kept for the robust pick, at most: that of its evaluations."""


class Clock:
    """The time limit of a search; it counts only what is computed: trials in the study file are all read before."""

    def __init__(self, hours: float) -> None:
        self._limit_s = 3600.0 * (hours or math.inf)
        self._start_s = time.monotonic()
        self._computed = 0

    def see(self, computed: bool) -> None:
        """Look at a trial; the time starts after the last one that was read before any was computed."""
        self._computed += computed
        if not self._computed:
            self._start_s = time.monotonic()

    def is_over(self, following: int = 0) -> bool:
        """Whether the time is over, or has come for as many evaluations as follow.

        These take as long as those before; at most `PICK_SHARE` of the time is kept for them.
        """
        if not self._computed:
            return False
        passed_s = time.monotonic() - self._start_s
        kept_s = min(following * passed_s / self._computed, PICK_SHARE * self._limit_s)
        return passed_s >= self._limit_s - kept_s


@check_arguments
def run_study(
    request: Request, path: str | Path | None, pool: Pool, watch: Watch = lambda trial, computed: None,
    tell: Callable[[str], object] = str,
) -> Result:  # fmt: skip
    """Run a study, or continue the one in a file; None keeps it in memory.

    `tell` is called with the reasons, a line each, where none of the first designs jumps.
    """
    prior, remark = _read_prior(request)
    with StudyStore.write(path, request.identity(prior)) as store:
        for one in filter(None, (remark, request.left_out)):
            store.note(one, once=True)
        stages = _stages(request, store, len(prior))
        if store.recall(ENDED) is not None:
            store.remember(ENDED, None)  # until this run ends
        clock, allowance, picking, cut = Clock(request.hours), 0, False, False
        first: list[Trial] = []

        def watched(trial: Trial, computed: bool) -> None:
            clock.see(computed)
            watch(trial, computed)
            if trial.phase in SEARCH_PHASES and len(first) < FIRST:
                first.append(trial)
                if len(first) == FIRST and computed and best_trial(first) is None:
                    for line in why_hopeless(first, request.space, request.model):
                        tell(line)

        def expired() -> bool:
            nonlocal cut
            if picking:
                cut = cut or clock.is_over()
                return cut
            return clock.is_over(request.pick) or len(evaluator.trials) >= allowance

        evaluator = Evaluator(request, store, pool, prior, watched, expired)
        converged = False
        for stage in stages:
            allowance += stage.evaluations
            if not expired():
                converged = run_stage(evaluator, stage)
        trials = evaluator.trials
        timed = clock.is_over(request.pick) and not converged and len(trials) < request.searched
        picking, best = True, best_trial(trials)
        worth = request.pick and best is not None and (request.is_front or not is_flat(trials))
        candidates, bounds = _picked(request, evaluator) if worth else ([], [])
        result = Result(request, trials, best, candidates, bounds, [], len(evaluator.trials), converged)
        righting = simulated_righting(request.model, store, result.winner)
        notes = store.notes()
        if best is None and not why_required(trials):
            notes += why_rejected(trials, request.space, request.model)
        if timed or cut:
            where = f"before {counted(request.searched, 'design')}" if timed else "during the robust pick"
            notes.append(f"ended after {request.hours:g} h, {where}: the same command goes on")
        store.remember(ENDED, _end(request, len(trials), converged, timed or cut))
        return replace(result, notes=notes, righting=righting)


def run_stage(evaluator: Evaluator, stage: Stage) -> bool:
    """Search; the trials are the evaluator's. Return whether it ended early, as little was left to gain."""
    return bool(pkgutil.resolve_name(f"jumpcad.search.propose.{STAGES[stage.method].function}")(evaluator, stage))


def _picked(request: Request, evaluator: Evaluator) -> tuple[list[Candidate], list[ActiveBound]]:
    """Evaluate neighbours of the best designs, then what lies beyond the winner's bounds; keep and return both."""
    trials, store, share = evaluator.trials, evaluator.store, request.pick
    among = front(trials, request.cost) if request.is_front else trials
    bounds: list[ActiveBound] = []
    if not request.is_front:
        share -= min(request.space.dimension, request.pick // 4)
    run = pick_run(store, len(trials), request.pick)
    candidates = rank_candidates(evaluator, among, request.seed, share, run)
    if candidates and not request.is_front:
        left = request.pick - (len(evaluator.trials) - len(trials))
        bounds = active_bounds(evaluator, candidates[0].trial, left, run)
    keep_pick(store, run, candidates, bounds)
    return candidates, bounds


def _end(request: Request, designs: int, converged: bool, timed: bool) -> dict[str, Any]:
    """Return what ended a search, as a study remembers it."""
    if timed:
        return {"by": "hours", "hours": request.hours}
    if converged:
        return {"by": "until", "until_percent": request.until_percent}
    if designs >= request.space.size:
        return {"by": "space"}
    return {"by": "evaluations" if designs >= request.searched else "proposals"}


def _stages(request: Request, store: StudyStore, prior: int) -> list[Stage]:
    """Return the stages that the study has been planned with; a larger budget lengthens the last of them."""
    stages, planned = plan_stages(request, prior), store.recall("stages")
    if planned is not None:
        least_gain = stages[-1].least_gain
        stages = [Stage(request, **stage) for stage in planned]
        held = sum(stage.evaluations for stage in stages)
        more = request.searched - held
        if more < 0:
            raise JumpcadError(
                f"{store.path}: evaluations = {request.evaluations} leave {request.searched} for its search, which is "
                f"planned for {held}: ask for more, or name another file"
            )
        if more > 0 and METHODS[stages[-1].method].shares:
            raise JumpcadError(
                f"{store.path}: its search by {request.method} is planned for {counted(held, 'evaluation')} and does "
                f"not go on with {request.searched}: name another file"
            )
        stages[-1] = replace(stages[-1], evaluations=stages[-1].evaluations + more, least_gain=least_gain)
    shares = [{name: getattr(stage, name) for name in ("method", "evaluations", "initial")} for stage in stages]
    store.remember("stages", shares)
    return stages


def _read_prior(request: Request) -> tuple[list[Trial], str]:
    """Return the trials of the prior study that lie in the space, scored by this request's objective, and a remark."""
    if request.prior is None:
        return [], ""
    with StudyStore.read(request.prior) as store:
        theirs, ours = (
            {key: value for key, value in model.items() if key != "stand_in"}  # rows without its figures serve too
            for model in (store.identity["model"], json.loads(json.dumps(request.model.describe())))
        )
        if theirs != ours:
            program = store.identity.get("versions") != request.model.versions() | versions(*LEARNING_VERSIONS)
            by = " by another program" if program else ""
            where = difference(theirs, ours, "model")
            raise JumpcadError(f"{request.prior}: was made{by} with another model than this search ({where})")
        held = store.trials()
        inside = (trial for trial in held if request.space.contains(trial.variant))
        trials = [replace(trial, score=request.aim.score(trial.evaluation)) for trial in inside]
        if held and not trials:
            return [], f"{request.prior}: none of its designs lies in this space, so nothing is learned from it"
        same = all(trial.model == request.model.digest for trial in trials)
        remark = f"{request.prior} was made by another program; the search learns from it nevertheless"
        return trials, "" if same else remark
