"""Proposals whose neighbours are probably feasible too.

The best designs of a search lie on a constraint, where every second neighbour may be rejected. From the trials of the
search the constraint is known; the proposals go as near to it as a chosen confidence allows.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from jumpcad.blas_threads import one_thread
from jumpcad.search.propose.acquisition import Proposal, propose
from jumpcad.search.propose.bayesian import incumbent, learned_trials, unproposed
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.trial import Trial
from jumpcad.transforms import Array

CONFIDENCES = (0.95, 0.99, 0.999)
"""Probabilities that a neighbour is feasible: one proposal for each."""
STEEPNESS = 100.0
"""Fall of the acquisition where the confidence is missed: far more than any gain in score."""


def propose_robust(
    evaluator: Evaluator, trials: Sequence[Trial], run: int, seed: Sequence[int], scatter: float
) -> list[Trial]:
    """Evaluate designs that should score highest while their neighbours stay feasible; return their trials.

    Parameters
    ----------
    evaluator, trials
        All trials of the evaluator are learned from; near the best of `trials` it looks most closely.
    run, seed
        The run of the pick in the study file; the random seed.
    scatter
        Standard deviation of a neighbour's parameters, relative to their value.
    """
    finished = evaluator.finished("margin", 0, len(CONFIDENCES), run)
    if finished is not None:
        return finished
    space = evaluator.space
    _, elite = incumbent(space, trials)
    fixed = [parameter for parameter in space.parameters if not parameter.free]
    known = [
        one
        for one in evaluator.trials
        if list(one.workshop) == [parameter.name for parameter in space.of_workshop]  # not made otherwise than designed
        and all(fix.number(one.variant.value(fix.name)) == fix.lower for fix in fixed)
    ]
    axes = sum(max(count, 1) for count in space.categories)
    thetas: dict[str, Any] = next(
        (
            trial.proposal["theta"]
            for trial in reversed(trials)
            if all(len(theta) == axes + 2 for theta in trial.proposal.get("theta", {"": ()}).values())
        ),
        {},
    )
    generator = np.random.default_rng(seed)
    proposals: list[Proposal] = []
    with one_thread():
        posterior = SearchPosterior.from_trials(space, learned_trials(space, known, best=0), thetas, fit=())
        for confidence in CONFIDENCES:
            admits, penalty = unproposed(evaluator, proposals), _missed(space, posterior, confidence, scatter)
            proposal = propose(space, posterior, 0.0, elite, admits, generator, penalty)
            if proposal is not None:
                proposals.append(proposal)
    notes = [proposal.note() | {"theta": posterior.thetas} for proposal in proposals]
    found = evaluator.evaluate([proposal.variant for proposal in proposals], "margin", 0, proposals=notes, run=run)
    return [trial for trial in found if trial is not None]


def _missed(space: Space, posterior: SearchPosterior, confidence: float, scatter: float) -> Callable[[Array], Array]:
    """Return a penalty: 0 where a neighbour is feasible with enough confidence, and growing fast elsewhere."""
    offset = np.array([parameter.lower / parameter.width for parameter in space.free])

    def penalty(points: Array) -> Array:
        values = points + offset  # of the parameters, in widths of their ranges
        missed: Array = np.maximum(np.log(confidence) - posterior.log_feasible(points, scatter * values), 0.0)
        return STEEPNESS * missed

    return penalty
