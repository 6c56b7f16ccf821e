"""Bayesian optimisation: Gaussian processes, expected improvement, probability of feasibility, batches.

Each step depends on its number, the seed, the rows before it and the hyperparameters kept with the last of them, so a
resumed search skips the steps that the ledger holds and goes on with the same proposals.
"""

import itertools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from jumpcad.design import Design
from jumpcad.search.acquisition import Proposal, propose
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.space import Space
from jumpcad.search.store import Trial
from jumpcad.search.surrogate import Posterior
from jumpcad.transforms import Array

REFIT_AFTER, REFIT_EVERY = 80, 5
ELITE = 4

Proposer = Callable[[Posterior, Sequence[Trial], int, np.random.Generator], list[Proposal]]
"""Makes the proposals of a step: from what is believed, the rows behind it, and how many are wanted at most."""


def default_initial(space: Space, evaluations: int, prior: int = 0) -> int:
    """Return how many spread points come first: three a free parameter, at most half of all, less what is known."""
    return max(0, min(3 * space.dimension, evaluations // 2) - prior)


def run_bayesian(evaluator: Evaluator, evaluations: int, seed: int, initial: int, batch: int = 1) -> None:
    """Search with `evaluations` new designs, the first `initial` of them spread evenly; the rows are the campaign's.

    Parameters
    ----------
    campaign
        Its rows so far, and those of its prior study, are learned from.
    evaluations, initial
        How many, and how many of them before the first fit.
    seed
        Decides everything that chance decides.
    batch
        Proposals a step; they are evaluated together, and do not know of each other's results.
    """

    def proposer(
        posterior: Posterior, rows: Sequence[Trial], count: int, generator: np.random.Generator
    ) -> list[Proposal]:
        best, elite = incumbent(evaluator.space, rows)
        proposals: list[Proposal] = []
        while len(proposals) < count:
            proposal = propose(evaluator.space, posterior, best, elite, unproposed(evaluator, proposals), generator)
            if proposal is None:
                break
            proposals.append(proposal)
            if len(proposals) < count:
                posterior = posterior.condition_on(proposal.unit)
        return proposals

    run_steps(evaluator, "bo", evaluations, seed, initial, batch, proposer)


def run_steps(
    evaluator: Evaluator, phase: str, evaluations: int, seed: int, initial: int, batch: int, proposer: Proposer
) -> None:
    """Evaluate `initial` spread designs, then what `proposer` proposes in steps of at most `batch`."""
    space = evaluator.space
    if initial:
        points = space.spread(initial, np.random.default_rng([seed, 1]))
        evaluator.evaluate([space.to_design(point) for point in points], phase, 0, limit=evaluations)
    left = evaluations - sum(row.phase == phase for row in evaluator.rows)
    thetas: dict[str, Any] = {}
    for step in itertools.count(1):
        if left <= 0:
            return
        count = min(batch, left)
        finished = evaluator.finished(phase, step, count)
        if finished is not None:
            thetas = dict(finished[-1].proposal["theta"])
        else:
            known = known_rows(evaluator)
            fit = None if len(known) <= REFIT_AFTER or step % REFIT_EVERY == 0 else ()
            # One thread: sums in a fixed order give the same bits however many cores there are.
            with threadpool_limits(1):
                posterior = Posterior.from_rows(space, known, thetas, fit)
                proposals = proposer(posterior, known, count, np.random.default_rng([seed, 2, step]))
            thetas = thetas | posterior.thetas
            notes = [proposal.note() | {"theta": thetas} for proposal in proposals]
            evaluator.evaluate([proposal.design for proposal in proposals], phase, step, proposals=notes)
            count = len(proposals)
        if count == 0:
            return
        left -= count


def unproposed(evaluator: Evaluator, proposals: Sequence[Proposal]) -> Callable[[Design], bool]:
    """Return the test whether a design may be proposed beside these."""
    taken = {tuple(proposal.design.to_vector()) for proposal in proposals}

    def admits(design: Design) -> bool:
        return tuple(design.to_vector()) not in taken and evaluator.admits(design)

    return admits


def known_rows(evaluator: Evaluator) -> list[Trial]:
    """Return the rows to learn from: the prior study's and the campaign's, each design once."""
    return list({row.key: row for row in [*evaluator.prior, *evaluator.rows]}.values())


def incumbent(space: Space, rows: Sequence[Trial]) -> tuple[float, Array]:
    """Return the best score so far (0 where there is none) and the points (k, d) of the best few designs."""
    feasible = sorted((row for row in rows if row.score is not None), key=lambda row: -(row.score or 0.0))
    elite = np.array([space.to_unit(row.design) for row in feasible[:ELITE]]).reshape(-1, space.dimension)
    return (feasible[0].score or 0.0) if feasible else 0.0, np.clip(elite, 0.0, 1.0)
