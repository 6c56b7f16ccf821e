"""Bayesian optimisation: Gaussian processes, expected improvement, probability of feasibility, batches.

Each step depends on its number, the seed, the trials before it and the hyperparameters kept with the last of them. A
resumed search therefore skips the steps that are in the study file and goes on with the same proposals.
"""

import itertools
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from jumpcad.dimensions import counted
from jumpcad.process import one_thread
from jumpcad.search.models import PrintedModel
from jumpcad.search.propose.acquisition import Proposal, propose
from jumpcad.search.propose.dry_run import TRIED, DryRun
from jumpcad.search.propose.initial_designs import first_points
from jumpcad.search.propose.proposal_loop import ProposalLoop
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import SCREENED
from jumpcad.search.study.request import Stage
from jumpcad.search.study.trial import Trial, feasible_trials, is_flat, nearest_to_required
from jumpcad.search.study.variant import Variant
from jumpcad.transforms import Array

REFIT_AFTER, REFIT_EVERY = 80, 5
"""Trials up to which hyperparameters are fitted at every step, where nothing is tried; then at every fifth."""
ELITE = 4
LEARNED, LEARNED_BEST = 400, 100
"""Most trials that the processes are fitted to, and how many of them are the best ones; the others are the nearest to
the best. The time of a fit grows with the cube of their number: 0.65 s of 250, 4 s of 1,000 (measured)."""
RUN_SEED = 1_000_000
"""Above any number of steps: added to the seed of the steps of each further run."""
IDLE, IDLE_ALONE = 20, 25
"""The search ends after so many steps in a row that gain too little: where robots are estimated, and where not. After
ten, one of two searches of everything that can be built had ended at 25 designs."""
HOPELESS, STALLED = 1e-8, 4
"""Of the best score: what a proposal promises that promises nothing. Steps in a row without a gain after which
neighbours are evaluated, and other hills in turn; judgement."""

Proposer = Callable[[ProposalLoop, Sequence[Trial], int, np.random.Generator], list[Proposal]]
"""Makes the proposals of a step from what is learned from the trials, these, and their greatest number."""


def run_bayesian(evaluator: Evaluator, stage: Stage, polls: bool = True) -> bool:
    """Search for the highest score; return whether it ended because its last steps gained too little.

    Proposals of a batch are made without each other's results. If it `polls`, neighbours of the best printed robot are
    evaluated where proposals gain nothing.
    """
    start = len(evaluator.trials)

    def idle() -> int:
        known = max((trial.score or 0.0 for trial in [*evaluator.prior, *evaluator.trials[:start]]), default=0.0)
        return idle_steps(evaluator.trials[start:], known, stage.least_gain)

    def proposer(
        loop: ProposalLoop, trials: Sequence[Trial], count: int, generator: np.random.Generator
    ) -> list[Proposal]:
        best, elite = incumbent(evaluator.space, trials)
        stalled = polls and idle() >= STALLED
        proposals: list[Proposal] = []
        while len(proposals) < count:
            admits = unproposed(evaluator, proposals, loop.may_hold)
            ask = partial(propose, evaluator.space, best=best, elite=elite, generator=generator, admits=admits)
            beside = loop.beside(trials, admits, generator, far=idle() % 2 == 1) if stalled else None
            proposal = beside or loop.propose(ask, best)
            if proposal is None:
                break
            holds = beside is not None or loop.holds(proposal)
            if polls and beside is None and not (holds and proposal.promised_gain(best) >= HOPELESS):
                proposal = loop.beside(trials, admits, generator, far=True) or proposal
            proposals.append(proposal)
        return proposals

    def ended() -> bool:  # scores that are all alike have not converged
        enough = idle() >= (IDLE if evaluator.request.estimated else IDLE_ALONE)
        return stage.least_gain > 0.0 and enough and not is_flat(evaluator.trials)

    return run_steps(evaluator, "bo", stage, proposer, ended)


def idle_steps(trials: Sequence[Trial], best: float, least_gain: float) -> int:
    """Return how many steps of `bo` in a row, up to the last, gained less than a share of the best score before them.

    `best` is that before the first of the trials; while no score is above 0, no step counts.
    """
    idle = 0
    for (phase, _), step in itertools.groupby(trials, key=lambda trial: (trial.phase, trial.step)):
        together = list(step)
        found = max(trial.score or 0.0 for trial in together)
        if phase == "bo" and "theta" in together[0].proposal:
            idle = 0 if best <= 0.0 or found / best - 1.0 > least_gain else idle + 1
        best = max(best, found)
    return idle


def run_steps(
    evaluator: Evaluator, phase: str, stage: Stage, proposer: Proposer,
    ended: Callable[[], bool] = lambda: False, batch: int = 0,
) -> bool:  # fmt: skip
    """Evaluate the initial designs, then what `proposer` proposes, one `batch` per step (0: that of the request).

    Return whether the search has `ended` before its evaluations, time or proposals were spent.
    """
    space, start, seed = evaluator.space, len(evaluator.trials), stage.request.seed
    dry_run = DryRun(evaluator, phase, seed, stage.run) if isinstance(evaluator.model, PrintedModel) else None
    if stage.initial:
        tried = (dry_run.ranked, dry_run.starts_with) if dry_run else ()
        points = first_points(space, stage.initial, np.random.default_rng([seed, 1]), *tried)
        first = [space.to_variant(point) for point in points]
        evaluator.evaluate(first, phase, 0, limit=stage.evaluations, run=stage.run)
    left = stage.evaluations - (len(evaluator.trials) - start)
    thetas: Mapping[str, Any] = {}
    for step in itertools.count(1):
        if left <= 0 or evaluator.expired():
            return False
        if ended():
            return True
        count = min(batch or stage.request.batch, left)
        finished = evaluator.finished(phase, step, count, stage.run)
        if finished is not None:
            thetas = dict(finished[-1].proposal["theta"])
        else:
            ours = {trial.key: trial for trial in [*evaluator.prior, *evaluator.trials]}
            exact = (trial for trial in ours.values() if trial.evaluation.verdict != SCREENED)
            known = [trial for trial in exact if space.contains(trial.variant)]
            with one_thread():
                always = len(known) <= REFIT_AFTER and dry_run is None
                refit = always or step % REFIT_EVERY == 1
                if dry_run:
                    dry_run.learn(known)
                learned = learned_trials(space, known)
                loop = ProposalLoop(space, learned, dry_run, thetas, refit, evaluator.unrequired)
                proposals = proposer(loop, known, count, np.random.default_rng([seed, 2, RUN_SEED * stage.run + step]))
            thetas = loop.thetas
            notes: list[dict[str, Any]] = [
                {"log_improvement": one.log_improvement, "log_feasible": one.log_feasible, "theta": thetas}
                for one in proposals
            ]
            if notes and loop.tried:
                notes[0] |= {TRIED: [point.tolist() for point in loop.tried]}
            variants = [proposal.variant for proposal in proposals]
            evaluator.evaluate(variants, phase, step, proposals=notes, run=stage.run)
            count = len(proposals)
        if count == 0:
            found = len(evaluator.trials) - start
            if found < space.size:
                told = f"ended after {counted(found, 'design')}: no other was found that is new and has room"
                evaluator.store.note(told, once=True)
            return False
        left -= count
    raise AssertionError  # steps have no end


def unproposed(
    evaluator: Evaluator, proposals: Sequence[Proposal], may_hold: Callable[[Variant], bool] = lambda _variant: True
) -> Callable[[Variant], bool]:
    """Return a function that tells whether a variant may be proposed together with these."""
    taken = {proposal.variant.key for proposal in proposals}
    return lambda variant: variant.key not in taken and may_hold(variant) and evaluator.admits(variant)


def learned_trials(space: Space, trials: Sequence[Trial]) -> list[Trial]:
    """Return at most `LEARNED` of some trials, in their order: the best ones, and the nearest to the very best."""
    if len(trials) <= LEARNED:
        return list(trials)
    ranked = feasible_trials(trials) or nearest_to_required(trials)
    centre = space.to_unit(ranked[0].variant) if ranked else np.full(space.dimension, 0.5)
    chosen = {trial.key for trial in ranked[:LEARNED_BEST]}
    distances = [float(np.abs(space.to_unit(trial.variant) - centre).max()) for trial in trials]
    nearest = [trials[index] for index in np.argsort(distances, kind="stable") if trials[index].key not in chosen]
    chosen |= {trial.key for trial in nearest[: LEARNED - len(chosen)]}
    return [trial for trial in trials if trial.key in chosen]


def incumbent(space: Space, trials: Sequence[Trial]) -> tuple[float, Array]:
    """Return the best score so far (0 where there is none) and the points (k, d) of the best few designs."""
    feasible = feasible_trials(trials)
    near = feasible or nearest_to_required(trials)
    elite = np.array([space.to_unit(trial.variant) for trial in near[:ELITE]]).reshape(-1, space.dimension)
    return (feasible[0].score or 0.0) if feasible else 0.0, np.clip(elite, 0.0, 1.0)
