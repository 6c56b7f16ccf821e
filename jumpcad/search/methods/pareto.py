"""Range against spring energy: how far for how many joules.

The energy of the wound springs is a closed form of the design, so only the score is unknown. For each of a few caps on
the energy, the expected improvement over the best design below that cap proposes one design a step (ε-constraint).
"""

import itertools
from collections.abc import Callable, Sequence

import numpy as np

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.search.acquisition import Proposal, propose
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.methods.bayesian import incumbent, run_steps, unproposed
from jumpcad.search.methods.genetic import Fitness, evolve
from jumpcad.search.space import Space
from jumpcad.search.store import Trial
from jumpcad.search.surrogate import Posterior
from jumpcad.transforms import Array

CAPS = 8
REFERENCE_ENERGY_J = 1.5
"""Energy of the reference point of the hypervolume; its score is 0."""
POPULATION = 40


def energy_j(design: Design) -> float:
    """Return the energy of a design's wound springs (J); infinite where it has no assembled pose."""
    try:
        return design.spring_energy_j
    except CannotBuildError:
        return np.inf


def front(rows: Sequence[Trial]) -> list[Trial]:
    """Return the rows that jump forward and of which none jumps farther with less energy, by energy."""
    best, chosen = 0.0, []
    for row in sorted(
        (row for row in rows if row.score is not None), key=lambda r: (energy_j(r.design), -(r.score or 0))
    ):
        if row.score is not None and row.score > best:
            best = row.score
            chosen.append(row)
    return chosen


def hypervolume(rows: Sequence[Trial], reference_energy_j: float = REFERENCE_ENERGY_J) -> float:
    """Return the area that a front dominates, from score 0 and the reference energy (score units times J)."""
    chosen = [row for row in front(rows) if energy_j(row.design) < reference_energy_j]
    ends = [energy_j(row.design) for row in chosen[1:]] + [reference_energy_j]
    return sum((row.score or 0.0) * (end - energy_j(row.design)) for row, end in zip(chosen, ends, strict=False))


def energy_caps_j(space: Space) -> Array:
    """Return the caps (CAPS,): even steps up to the largest energy at the corners of the space (J)."""
    corners = itertools.product((0.0, 1.0), repeat=space.dimension)
    energies = [energy_j(space.to_design(corner)) for corner in corners]
    return max(energy for energy in energies if np.isfinite(energy)) * np.arange(1, CAPS + 1) / CAPS


def run_pareto(evaluator: Evaluator, evaluations: int, seed: int, initial: int) -> None:
    """Search the front with `evaluations` new designs, `initial` of them spread evenly; rows are the campaign's."""
    space = evaluator.space
    caps = energy_caps_j(space)

    def proposer(
        posterior: Posterior, rows: Sequence[Trial], count: int, generator: np.random.Generator
    ) -> list[Proposal]:
        proposals: list[Proposal] = []
        for cap in caps[:count]:
            best, elite = incumbent(space, [row for row in rows if energy_j(row.design) <= cap])
            admits, penalty = unproposed(evaluator, proposals), _excess(space, float(cap))
            proposal = propose(space, posterior, best, elite, admits, generator, penalty)
            if proposal is not None:
                proposals.append(proposal)
                posterior = posterior.condition_on(proposal.unit)
        return proposals

    run_steps(evaluator, "pareto", evaluations, seed, initial, CAPS, proposer)


def _excess(space: Space, cap_j: float) -> Callable[[Array], Array]:
    """Return a penalty that is 0 below a cap on the energy and 1 at a hundredth above it, growing smoothly."""

    def penalty(points: Array) -> Array:
        over = np.array([energy_j(space.to_design(point)) for point in points]) / cap_j - 1.0
        return 1e4 * np.clip(over, 0.0, 1e3) ** 2

    return penalty


class ParetoFitness(Fitness):
    """Score and negative energy, both to be maximised."""

    def objectives(self, row: Trial) -> list[float]:
        """Return both objectives of a feasible row."""
        return [row.score or 0.0, -energy_j(row.design)]


def run_nsga2(evaluator: Evaluator, evaluations: int, seed: int) -> None:
    """Search the front with PyGAD's NSGA-II; a refused design is dominated by every other one."""
    half = POPULATION // 2
    operators = {
        "num_parents_mating": half, "parent_selection_type": "nsga2", "keep_elitism": 0, "keep_parents": -1,
        "crossover_type": "sbx", "sbx_crossover_eta": 10,
        "mutation_type": "polynomial", "polynomial_mutation_eta": 15, "mutation_probability": 0.15,
    }  # fmt: skip
    fitness = ParetoFitness(evaluator, "nsga2", evaluations, refused=[-1.0, -10.0])
    population = evaluator.space.spread(POPULATION, np.random.default_rng([seed, 0]))
    evolve(fitness, population, operators, seed)
