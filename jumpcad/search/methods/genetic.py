"""Genetic algorithm, by PyGAD, in the unit cube of a space.

PyGAD proposes, the campaign evaluates: every population goes to the pool as one batch, and finished designs come from
the ledger. That makes the ledger the checkpoint of every generation, written before PyGAD sees its fitness; a resumed
run repeats the generations in milliseconds and goes on, so no second file can disagree with the study.
"""

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.search.evaluator import Evaluator
from jumpcad.search.space import Space
from jumpcad.transforms import Array

PATIENCE = 50
"""Generations without a single new design after which the search has run dry."""


@dataclass(frozen=True)
class GeneticSettings:
    """Settings of PyGAD, by its own names."""

    population: int
    operators: Mapping[str, Any]


PRESETS: dict[str, GeneticSettings] = {
    # Small steps around good parents: SBX and polynomial mutation (Deb), and a tournament of three.
    "recommended": GeneticSettings(
        20,
        {
            "num_parents_mating": 20, "parent_selection_type": "tournament", "K_tournament": 3, "keep_elitism": 2,
            "crossover_type": "sbx", "sbx_crossover_eta": 10,
            "mutation_type": "polynomial", "polynomial_mutation_eta": 15, "mutation_probability": 0.15,
        },
    ),
    # The published study's: five of eight genes are replaced at random, so that it searches little better than chance.
    "published": GeneticSettings(
        10,
        {
            "num_parents_mating": 5, "parent_selection_type": "sss", "keep_elitism": 0, "keep_parents": 2,
            "crossover_type": "single_point", "mutation_type": "random", "mutation_num_genes": 5,
        },
    ),
}  # fmt: skip


def find_preset(name: str) -> GeneticSettings:
    """Return the settings of a preset."""
    if name not in PRESETS:
        raise JumpcadError(f"{name!r} is not one of the presets {', '.join(PRESETS)}{did_you_mean(name, PRESETS)}")
    return PRESETS[name]


def run_genetic(evaluator: Evaluator, evaluations: int, seed: int, preset: str = "recommended") -> None:
    """Search with `evaluations` new designs at most; the rows are the campaign's.

    A refused design has fitness 0. With a prior study, its best designs make half of the first population.
    """
    settings = find_preset(preset)
    operators = dict(settings.operators)
    if "mutation_num_genes" in operators:
        operators["mutation_num_genes"] = min(operators["mutation_num_genes"], evaluator.space.dimension)
    score = Fitness(evaluator, "ga", evaluations, refused=0.0)
    evolve(score, _first_population(evaluator, settings.population, seed), operators, seed)


class Fitness:
    """PyGAD's view of a campaign: fitness of a population, and when to stop."""

    def __init__(self, evaluator: Evaluator, phase: str, evaluations: int, refused: Any) -> None:
        self.evaluator = evaluator
        self.phase = phase
        self.left = evaluations
        self.refused = refused
        self._idle = 0

    def objectives(self, row: Any) -> Any:
        """Return the fitness of a feasible row."""
        return row.score

    def __call__(self, ga: Any, population: Any, _indices: Any) -> list[Any]:
        """Return the fitness of each solution (n, genes); what the budget no longer reaches counts as refused."""
        space = self.evaluator.space
        before = len(self.evaluator.rows)
        designs = [space.to_design(solution) for solution in np.atleast_2d(np.asarray(population, dtype=float))]
        rows = self.evaluator.evaluate(designs, self.phase, int(ga.generations_completed), limit=self.left)
        new = len(self.evaluator.rows) - before
        self.left -= new
        self._idle = 0 if new else self._idle + 1
        return [self.refused if row is None or row.score is None else self.objectives(row) for row in rows]

    def on_generation(self, _ga: Any) -> str | None:
        """Stop PyGAD when the budget is spent or nothing new comes any more."""
        return "stop" if self.left <= 0 or self._idle >= PATIENCE else None


def evolve(fitness: Fitness, population: Array, operators: Mapping[str, Any], seed: int) -> None:
    """Run PyGAD from a first population (n, dimension) of the unit cube until `fitness` says stop."""
    import pygad

    log = logging.getLogger("jumpcad.pygad")
    log.propagate = False
    log.addHandler(logging.NullHandler())

    def batch(ga: Any, solutions: Any, indices: Any) -> list[Any]:
        return fitness(ga, solutions, indices)

    def after_generation(ga: Any) -> str | None:
        return fitness.on_generation(ga)

    pygad.GA(
        num_generations=fitness.left * PATIENCE,
        fitness_func=batch,
        fitness_batch_size=len(population),
        initial_population=population.tolist(),
        gene_space=_gene_space(fitness.evaluator.space),
        on_generation=after_generation,
        random_seed=seed,
        suppress_warnings=True,
        logger=log,
        **operators,
    ).run()


def _gene_space(space: Space) -> list[Any]:
    return [list(parameter.levels) or {"low": 0.0, "high": 1.0} for parameter in space.free]


def _first_population(evaluator: Evaluator, count: int, seed: int) -> Array:
    space = evaluator.space
    spread = space.spread(count, np.random.default_rng([seed, 0]))
    best = sorted((row for row in evaluator.prior if row.score is not None), key=lambda row: -(row.score or 0.0))
    known = np.array([space.to_unit(row.design) for row in best[: count // 2]]).reshape(-1, space.dimension)
    return np.vstack([known, spread])[:count]
