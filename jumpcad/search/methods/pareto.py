"""Fronts of score against spring energy.

The energy of the loaded springs is a closed form of the design, so only the score is unknown. For each of a few caps on
the energy, the expected improvement over the best design below that cap proposes one design per step (ε-constraint).
"""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from jumpcad.design import PARAMETERS
from jumpcad.search.acquisition import Proposal, propose
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.fronts import energies_j, energy_j
from jumpcad.search.learner import Learner
from jumpcad.search.methods import Task
from jumpcad.search.methods.bayesian import incumbent, run_steps, unproposed
from jumpcad.search.methods.genetic import Fitness, evolve
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial
from jumpcad.transforms import Array

CAPS = 8
"""Number of caps on the energy."""
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


def run_pareto(evaluator: Evaluator, task: Task) -> None:
    """Search the front by constrained expected improvement; each step has one proposal per cap on the energy."""
    space = evaluator.space
    caps = energy_caps_j(space)

    def proposer(
        learner: Learner, trials: Sequence[Trial], count: int, generator: np.random.Generator
    ) -> list[Proposal]:
        proposals: list[Proposal] = []
        for cap in caps[:count]:
            best, elite = incumbent(space, [trial for trial in trials if energy_j(trial.design) <= cap])
            ask = partial(
                propose, space, best=best, elite=elite, generator=generator, penalty=_excess(space, float(cap)),
                admits=unproposed(evaluator, proposals, learner.may_hold),
            )  # fmt: skip
            proposal = learner.propose(ask, best)
            if proposal is not None:
                proposals.append(proposal)
        return proposals

    run_steps(evaluator, "pareto", replace(task, batch=CAPS), proposer)


def _excess(space: Space, cap_j: float) -> Callable[[Array], Array]:
    """Return a penalty of the acquisition: 0 below a cap on the energy, 1 at 1 % above it, growing smoothly."""

    def penalty(points: Array) -> Array:
        over = energies_j(space.values(points)[:, : len(PARAMETERS)]) / cap_j - 1.0
        return 1e4 * np.clip(over, 0.0, 1e3) ** 2

    return penalty


class ParetoFitness(Fitness):
    """Score and negative energy, both to be maximised."""

    def objectives(self, trial: Trial) -> list[float]:
        """Return both objectives of a feasible trial."""
        return [trial.score or 0.0, -energy_j(trial.design)]


def run_nsga2(evaluator: Evaluator, task: Task) -> None:
    """Search the front by PyGAD's NSGA-II; a rejected design is dominated by every other one."""
    half = POPULATION // 2
    operators = {
        "num_parents_mating": half, "parent_selection_type": "nsga2", "keep_elitism": 0, "keep_parents": -1,
        "crossover_type": "sbx", "sbx_crossover_eta": 10,
        "mutation_type": "polynomial", "polynomial_mutation_eta": 15, "mutation_probability": 0.15,
    }  # fmt: skip
    fitness = ParetoFitness(evaluator, "nsga2", task.evaluations, rejected=[-1.0, -10.0])
    population = evaluator.space.spread(POPULATION, np.random.default_rng([task.seed, 0]))
    evolve(fitness, population, operators, task.seed)
