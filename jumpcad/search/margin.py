"""Designs that keep off the edge: proposed where not they alone but their neighbours too should be feasible.

The best designs of a search lie on a constraint, where every second neighbour is refused. What the search and the
robust pick saw there says where the constraint runs; this goes as near to it as a chosen confidence allows.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from jumpcad.search.acquisition import Proposal, propose
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.methods.bayesian import incumbent, unproposed
from jumpcad.search.space import Space
from jumpcad.search.store import Trial
from jumpcad.search.surrogate import Posterior
from jumpcad.transforms import Array

CONFIDENCES = (0.95, 0.99, 0.999)
"""Probabilities that a neighbour is feasible: one proposal for each."""
LEARNED = 400
"""How many rows are learned from: the nearest to the best ones."""
STEEPNESS = 100.0
"""How fast the acquisition falls where a confidence is missed: far faster than any gain in score can make good."""


def propose_robust(evaluator: Evaluator, rows: Sequence[Trial], step: int, seed: int, scatter: float) -> list[Trial]:
    """Evaluate designs that should score highest while their neighbours stay feasible; return their rows.

    Parameters
    ----------
    campaign, rows
        All that the campaign has seen is learned from; the best of these rows is where is looked most closely.
    step, seed
        Where the proposals stand in the ledger, and what chance draws from.
    scatter
        Standard deviation of a neighbour's parameters, relative to their value.
    """
    finished = evaluator.finished("margin", step, len(CONFIDENCES))
    if finished is not None:
        return finished
    space = evaluator.space
    _, elite = incumbent(space, rows)
    known = _nearest(space, evaluator.rows, elite[0])
    thetas: dict[str, Any] = next((row.proposal["theta"] for row in reversed(rows) if "theta" in row.proposal), {})
    generator = np.random.default_rng([seed, 7, step])
    proposals: list[Proposal] = []
    with threadpool_limits(1):
        posterior = Posterior.from_rows(space, known, thetas, fit=())
        for confidence in CONFIDENCES:
            admits, penalty = unproposed(evaluator, proposals), _missed(space, posterior, confidence, scatter)
            proposal = propose(space, posterior, 0.0, elite, admits, generator, penalty)
            if proposal is not None:
                proposals.append(proposal)
    notes = [proposal.note() | {"theta": posterior.thetas} for proposal in proposals]
    found = evaluator.evaluate([proposal.design for proposal in proposals], "margin", step, proposals=notes)
    return [row for row in found if row is not None]


def _missed(space: Space, posterior: Posterior, confidence: float, scatter: float) -> Callable[[Array], Array]:
    """Return a penalty that is 0 where a neighbour is feasible with enough confidence, and grows fast where not."""
    offset = np.array([parameter.lower / parameter.width for parameter in space.free])

    def penalty(points: Array) -> Array:
        values = points + offset  # of the parameters, in widths of their ranges
        return STEEPNESS * np.maximum(np.log(confidence) - posterior.log_feasible(points, scatter * values), 0.0)

    return penalty


def _nearest(space: Space, rows: Sequence[Trial], centre: Array) -> list[Trial]:
    """Return the `LEARNED` rows nearest to a point (d,), of those that have the space's fixed values."""
    fixed = [parameter for parameter in space.parameters if not parameter.free]
    known = [row for row in rows if all(getattr(row.design, one.name) == one.lower for one in fixed)]
    far = [float(np.abs(space.to_unit(row.design) - centre).max()) for row in known]
    return [known[index] for index in sorted(np.argsort(far, kind="stable")[:LEARNED])]
