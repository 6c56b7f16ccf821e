"""Genetic algorithm, by PyGAD, in the unit cube of a space.

PyGAD proposes, the evaluator evaluates: every population goes to the pool as one batch, and finished designs come from
the study file. The study file is thus the checkpoint of every generation, written before PyGAD sees its fitness; a
resumed run repeats the finished generations in milliseconds and goes on. No second file can disagree with the study.
"""

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from jumpcad.search.models import PrintedModel
from jumpcad.search.propose.initial_designs import begun, first_points, ranked_points
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import GUESSED, SCREENED, Evaluation
from jumpcad.search.study.own_objective import LARGEST
from jumpcad.search.study.request import Stage
from jumpcad.search.study.trial import Trial, best_trial, feasible_trials, lacking, required_sizes
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

PATIENCE = 50
"""The search ends after so many generations without a new design."""
SMALL_STEPS: dict[str, Any] = {
    "crossover_type": "sbx", "sbx_crossover_eta": 10,
    "mutation_type": "polynomial", "polynomial_mutation_eta": 15, "mutation_probability": 0.15,
}  # fmt: skip
"""Around good parents: SBX and polynomial mutation (Deb)."""
SETTINGS: dict[str, tuple[int, dict[str, Any]]] = {
    "recommended": (20, SMALL_STEPS | {
        "num_parents_mating": 20, "parent_selection_type": "tournament", "K_tournament": 3, "keep_elitism": 2,
    }),
    # The published study's. Five of eight genes are replaced at random: little better than random search.
    "published": (10, {
        "num_parents_mating": 5, "parent_selection_type": "sss", "keep_elitism": 0, "keep_parents": 2,
        "crossover_type": "single_point", "mutation_type": "random", "mutation_num_genes": 5,
    }),
}  # fmt: skip
"""Population, and settings of PyGAD by its own names."""


def run_genetic(evaluator: Evaluator, stage: Stage) -> None:
    """Search for the highest score; a rejected design has less than any other.

    The best designs of a prior study, and of those to begin with, make half of the first population.
    """
    request = stage.request
    population, operators = SETTINGS[request.preset]
    if "mutation_num_genes" in operators:
        fewer = min(operators["mutation_num_genes"], evaluator.space.dimension)
        operators = {**operators, "mutation_num_genes": fewer}
    score = Fitness(evaluator, "ga", stage.evaluations, rejected=-2.0 * LARGEST, run=stage.run)
    if request.screen:
        score = ScreenedFitness(evaluator, "ga", stage.evaluations, score.rejected, stage.run)
    generator = np.random.default_rng([request.seed, 0])
    spread = first_points(evaluator.space, population, generator, ranked_points(evaluator, generator))
    first = begun_with(evaluator.space, feasible_trials(begun(evaluator)), spread, population)
    evolve(score, first, operators, request.seed)


class Fitness:
    """What PyGAD asks for: the fitness of a population, and whether to stop.

    Designs of a prior study have the score that it found, and are not evaluated again.
    """

    def __init__(self, evaluator: Evaluator, phase: str, evaluations: int, rejected: Any, run: int = 0) -> None:
        self.evaluator, self.phase, self.left, self.rejected, self.run = evaluator, phase, evaluations, rejected, run
        self._idle = 0
        self._sizes: Mapping[str, float] = {}
        self._prior = {one.key: one for one in evaluator.prior if one.evaluation.verdict != SCREENED}

    def objectives(self, trial: Any) -> Any:
        return trial.score

    def of_population(self, ga: Any, population: Any, _indices: Any) -> list[Any]:
        """Return the fitness of each solution (n, genes); designs beyond the budget count as rejected."""
        space = self.evaluator.space
        before = len(self.evaluator.trials)
        variants = [space.to_variant(solution) for solution in np.atleast_2d(np.asarray(population, dtype=float))]
        step = int(ga.generations_completed)
        others = [one for one in variants if one.key not in self._prior]
        left_out = self.left_out(others)
        found = self.evaluator.evaluate(others, self.phase, step, limit=self.left, left_out=left_out, run=self.run)
        known = {**self._prior, **{one.key: trial for one, trial in zip(others, found, strict=True)}}
        trials = [known[one.key] for one in variants]
        new = len(self.evaluator.trials) - before
        self.left -= new
        self._idle = 0 if new else self._idle + 1
        self._sizes = required_sizes(self.evaluator.trials) if self.evaluator.model.requirements else {}
        return [self.rejected if trial is None else self.fitness(trial) for trial in trials]

    def fitness(self, trial: Trial) -> Any:
        """Return the fitness of a trial; what only misses requirements is between all rejected and all others."""
        if trial.score is None and trial.evaluation.only_misses_required:
            lack = lacking(trial, self._sizes)
            return np.multiply(self.rejected, 0.5 + 0.5 * lack / (1.0 + lack)).tolist()
        return self.rejected if trial.score is None else self.objectives(trial)

    def left_out(self, _variants: Sequence[Variant]) -> Mapping[Key, Evaluation]:
        """Return the outcome of variants that need no evaluation."""
        return {}

    def on_generation(self, _ga: Any) -> str | None:
        """Stop PyGAD when budget or time is spent, or no new designs come."""
        return "stop" if self.left <= 0 or self._idle >= PATIENCE or self.evaluator.expired() else None


class ScreenedFitness(Fitness):
    """Fitness with a screen; a candidate that it leaves out has the estimated score, which the study keeps."""

    def __init__(self, *arguments: Any) -> None:
        from jumpcad.search.estimate.corrected_estimate import Screen

        super().__init__(*arguments)
        evaluator = self.evaluator
        assert isinstance(evaluator.model, PrintedModel)
        self._screen = Screen(evaluator.space, evaluator.model, evaluator.objective)
        self._seen: set[Key] = set()

    def fitness(self, trial: Trial) -> Any:
        if trial.evaluation.verdict != SCREENED:
            return super().fitness(trial)
        return trial.evaluation.metrics.get(GUESSED, self.rejected)

    def left_out(self, variants: Sequence[Variant]) -> Mapping[Key, Evaluation]:
        """Return the outcomes of variants that the screen leaves out.

        Of all that are new to this run, also where the study file holds some: a resumed run decides alike.
        """
        evaluator, screen = self.evaluator, self._screen
        fresh = {variant.key: variant for variant in variants if variant.key not in self._seen}
        self._seen.update(fresh)
        if all(evaluator.holds(variant) for variant in fresh.values()):
            return {}
        screen.learn(evaluator.trials)
        best = best_trial(evaluator.trials)
        return screen.outcomes(fresh.values(), (best and best.score) or 0.0)


def evolve(fitness: Fitness, population: Array, operators: Mapping[str, Any], seed: int) -> None:
    """Run PyGAD from a first population (n, dimension) of the unit cube until `fitness` says stop."""
    import pygad

    log = logging.getLogger("jumpcad.pygad")
    log.propagate = False
    log.addHandler(logging.NullHandler())
    pygad.GA(
        num_generations=fitness.left * PATIENCE,
        fitness_func=fitness.of_population,
        fitness_batch_size=len(population),
        initial_population=population.tolist(),
        gene_space=[list(one.levels) or {"low": 0.0, "high": 1.0} for one in fitness.evaluator.space.free],
        gene_categorical=[names > 0 for names in fitness.evaluator.space.categories],
        on_generation=fitness.on_generation,
        random_seed=seed,
        suppress_warnings=True,
        logger=log,
        **operators,
    ).run()


def begun_with(space: Space, best: Sequence[Trial], spread: Array, count: int) -> Array:
    """Return a first population (count, dimension): at most half of it the first of some trials, the rest spread."""
    known = np.array([space.to_unit(trial.variant) for trial in best[: count // 2]]).reshape(-1, space.dimension)
    return np.vstack([known, spread])[:count]
