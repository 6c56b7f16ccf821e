"""Fronts of score against a cost.

For each of a few caps on the cost, the expected improvement over the best design below that cap proposes one design per
step (ε-constraint). The energy of the loaded springs is a closed form of the design, so that only the score is unknown;
any other cost is learned by a process of its own, and the improvement counts as often as the cap is probably kept.
"""

import itertools
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from scipy.special import log_ndtr

from jumpcad.design import PARAMETERS
from jumpcad.search.fronts import SPRING_ENERGY, Cost, energies_j, front
from jumpcad.search.propose.acquisition import Proposal, propose
from jumpcad.search.propose.bayesian import incumbent, learned_trials, run_steps, unproposed
from jumpcad.search.propose.genetic import SMALL_STEPS, Fitness, begun_with, evolve
from jumpcad.search.propose.initial_designs import begun
from jumpcad.search.propose.proposal_loop import ProposalLoop
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.own_objective import LARGEST
from jumpcad.search.study.request import Stage
from jumpcad.search.study.trial import Trial
from jumpcad.transforms import Array

CAPS = 8
"""Number of caps on the cost."""
LEAST_LEARNED = 4
"""Designs with a known cost before costs are learned; judgement."""
POPULATION = 40
"""Of NSGA-II."""


def energy_caps_j(space: Space) -> Array:
    """Return the caps (CAPS,) in equal steps up to the largest energy at the corners of the space (J).

    At those of the designs: values of the workshop do not change the energy.
    """
    ends = [(0.0, 0.0) if parameter in space.of_workshop else (0.0, 1.0) for parameter in space.free]
    corners = np.array(list(itertools.product(*map(dict.fromkeys, ends))))
    energies = energies_j(space.values(corners)[:, : len(PARAMETERS)])
    largest = float(energies[np.isfinite(energies)].max())
    return largest * np.arange(1, CAPS + 1) / CAPS


def run_pareto(evaluator: Evaluator, stage: Stage) -> None:
    """Search the front by constrained expected improvement; each step has one proposal per cap on the cost."""
    space, cost = evaluator.space, stage.request.cost

    def proposer(
        loop: ProposalLoop, trials: Sequence[Trial], count: int, generator: np.random.Generator
    ) -> list[Proposal]:
        proposals: list[Proposal] = []
        for cap, penalty in _caps(space, cost, trials)[:count]:
            best, elite = incumbent(space, [trial for trial in trials if cost.of(trial) <= cap])
            ask = partial(
                propose, space, best=best, elite=elite, generator=generator, penalty=penalty,
                admits=unproposed(evaluator, proposals, loop.may_hold),
            )  # fmt: skip
            proposal = loop.propose(ask, best)
            if proposal is not None:
                proposals.append(proposal)
        return proposals

    run_steps(evaluator, "pareto", stage, proposer, batch=CAPS)


Penalty = Callable[[Array], Array]


def _caps(space: Space, cost: Cost, trials: Sequence[Trial]) -> list[tuple[float, Penalty | None]]:
    """Return the caps on a cost, each with the penalty of the acquisition for what is above it.

    Of a cost that is learned they are equal steps from the least to the largest of the designs that jump so far, but
    for the last one, above which nothing is.
    """

    def excess(points: Array, cap_j: float) -> Array:  # 0 below a cap on the energy, 1 at 1 % above it
        over = energies_j(space.values(points)[:, : len(PARAMETERS)]) / cap_j - 1.0
        return np.asarray(1e4 * np.clip(over, 0.0, 1e3) ** 2)

    def above(points: Array, cap: float) -> Array:  # minus the logarithm of the probability that the cost is below it
        mean, deviation = learned.predict(points)
        return np.asarray(-log_ndtr((cap - mean) / deviation))

    if cost is SPRING_ENERGY:
        return [(float(cap), partial(excess, cap_j=float(cap))) for cap in energy_caps_j(space)]
    jumped = [cost.of(trial) for trial in trials if trial.score is not None]
    known = [(trial, cost.of(trial)) for trial in learned_trials(space, trials) if np.isfinite(cost.of(trial))]
    if not jumped or len(known) < LEAST_LEARNED:
        return [(np.inf, None)] * CAPS
    places, costs = (list(column) for column in zip(*known, strict=True))
    units = np.array([space.to_unit(trial.variant) for trial in places])
    learned = Surrogate(units, np.array(costs), None, True, space.categories)
    caps = np.linspace(min(jumped), max(jumped), CAPS)[:-1].tolist()
    return [*((cap, partial(above, cap=cap)) for cap in caps), (np.inf, None)]


class ParetoFitness(Fitness):
    """Score and negative cost, both to be maximised."""

    def __init__(self, evaluator: Evaluator, phase: str, evaluations: int, cost: Cost = SPRING_ENERGY) -> None:
        super().__init__(evaluator, phase, evaluations, rejected=[-2.0 * LARGEST, -cost.worst])
        self.cost = cost

    def objectives(self, trial: Trial) -> list[float]:
        return [trial.score or 0.0, -self.cost.of(trial)]


def run_nsga2(evaluator: Evaluator, stage: Stage) -> None:
    """Search the front by PyGAD's NSGA-II; a rejected design is dominated by every other one.

    Designs that lie evenly on the front of what is known make half of the first population.
    """
    half = POPULATION // 2
    parents = {"num_parents_mating": half, "parent_selection_type": "nsga2", "keep_elitism": 0, "keep_parents": -1}
    fitness = ParetoFitness(evaluator, "nsga2", stage.evaluations, stage.request.cost)
    space, best = evaluator.space, front(begun(evaluator), fitness.cost)
    best = [best[round(place)] for place in np.linspace(0, len(best) - 1, min(len(best), half)).tolist()]
    spread = space.spread(POPULATION, np.random.default_rng([stage.request.seed, 0]))
    evolve(fitness, begun_with(space, best, spread, POPULATION), SMALL_STEPS | parents, stage.request.seed)
