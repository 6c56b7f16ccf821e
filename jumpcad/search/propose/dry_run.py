"""What a proposal is tried on before a robot is built: its layout, exactly, and a stand-in, about.

Near the best designs of the printed robot half of the proposals have no room for some part, and the score of a robot
follows from its masses, which robots that were built tell about. Both are known in a fifth of the time of an evaluation
and count as none. What the rehearsals showed is learned like trials, and the next proposal is better.

All of it follows from the trials and from the points that are kept with them, so that a resumed search goes on alike.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Self

import numpy as np

from jumpcad.findings import bare
from jumpcad.search.estimate.estimate import Fit, Guess, Guesser
from jumpcad.search.estimate.fitting import MARK, STATICS, Table, learned_rows
from jumpcad.search.models import RobotModel
from jumpcad.search.propose.initial_designs import ranked_points
from jumpcad.search.propose.task import Task
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.trial import Trial, best_trial
from jumpcad.search.study.variant import Key, Variant
from jumpcad.transforms import Array

TRIED = "tried"
"""What the note of a trial calls the points that were rehearsed for its step."""
SPREAD = 32
"""Designs that are guessed first: the best by the capsule robot."""
GUESSED, FAILED = 160, 160
"""Most guesses that are learned from besides those of trials, and most failures: the last ones. Guesses are made anew
with every fit, and the time of a step grows with both."""
LEAST, GROWTH = 8, 1.3
"""Trials from which on figures are fitted; they are fitted anew when there are so many times more."""


class Rehearsal:
    """Tries variants of one search; see `of`.

    Parameters
    ----------
    evaluator
        Of the search; its model is a `RobotModel` of printed robots.
    phase, task
        Of the search too: what other searches tried is not looked at.
    """

    def __init__(self, evaluator: Evaluator, phase: str, task: Task) -> None:
        assert isinstance(evaluator.model, RobotModel)
        self._evaluator, self._model, self._phase, self._task = evaluator, evaluator.model, phase, task
        self._space: Space = evaluator.space
        self._laid: dict[Key, Mapping[str, float] | Trial] = {}
        self._fit: Fit | None = None
        self._guesser: Guesser | None = None
        self._guesses: dict[Key, Guess | None] = {}
        self._first: list[Variant] = []
        self._variants: dict[tuple[float, ...], Variant] = {}
        self._prior = {trial.key for trial in evaluator.prior}
        self._passed_over: dict[Key, Trial] = {}

    @classmethod
    def of(cls, evaluator: Evaluator, phase: str, task: Task) -> Self | None:
        """Return the rehearsal of a search of printed robots; None of others, which are simulated as quickly."""
        model = evaluator.model
        return cls(evaluator, phase, task) if isinstance(model, RobotModel) and model.name == "printed" else None

    @cached_property
    def ranked(self) -> list[Array]:
        """Points (d,) with which the capsule robot jumps, the farthest first."""
        return ranked_points(self._evaluator, np.random.default_rng([self._task.seed, 5]))

    def starts_with(self, variant: Variant) -> bool:
        """Whether a search may start with a variant: its parts have room. If not, that is learned."""
        refusal = self._refusal(variant)
        if refusal is not None:
            self._passed_over[variant.key] = refusal
        return refusal is None

    def learn(self, trials: Sequence[Trial]) -> None:
        """Fit the figures of the robots that were built, if there are enough new ones.

        What was tried for any of the trials, which may be more than the processes learn from, is tried no more.
        """
        for variant in self._tried(trials, ()):
            self._refusal(variant)
        rows = learned_rows(len(trials), LEAST, GROWTH)
        if rows == 0 or self._space.varies_workshop or (self._fit is not None and self._fit.rows == rows):
            return
        known = trials[:rows]
        first = next((trial for trial in known if MARK in trial.evaluation.metrics), None)
        if first is None:
            return
        if self._guesser is None:
            self._guesser = Guesser.quick(self._space, self._model, self._evaluator.objective, first)
            self._first = [self._variant(point) for point in self.ranked[:SPREAD]]
        centre = self._space.to_unit((best_trial(known) or first).variant)
        self._fit = Fit(rows, Table(self._space, known, centre, laid=True).coefficients(), {})
        self._guesses.clear()

    @property
    def guessing(self) -> bool:
        """Whether enough robots were built to guess the jump of others."""
        return self._fit is not None

    def known(self, trials: Sequence[Trial], tried: Sequence[Array]) -> set[Key]:
        """Return the keys of what was tried for `trials` and since then."""
        return {variant.key for variant in self._tried(trials, tried)}

    def guess(self, variant: Variant) -> float | None:
        """Return the guessed score of a variant; None where it has no room or does not jump."""
        guess = self._guess(variant)
        return None if guess is None else guess.score

    def is_refused(self, variant: Variant) -> bool:
        """Whether a variant was tried and has no room."""
        return isinstance(self._laid.get(variant.key), Trial)

    def holds(self, variant: Variant) -> bool:
        """Whether a variant jumps, as far as can be guessed, and has room."""
        return self._failure(variant) is None

    def failures(self, trials: Sequence[Trial], tried: Sequence[Array]) -> list[Trial]:
        """Return the last that were tried for `trials` and since then and did not hold, as if they were trials."""
        found = list(self._passed_over.values())
        found += [one for one in map(self._failure, self._tried(trials, tried)) if one is not None]
        return found[-FAILED:]

    def guesses(self, trials: Sequence[Trial], tried: Sequence[Array]) -> Mapping[Key, tuple[Array, float]]:
        """Return points (d,) and guessed scores, by key, of what was tried and of the trials that jumped."""
        if self._fit is None:
            return {}
        before = [*self._first, *filter(self.holds, self._tried(trials, tried))][-GUESSED:]
        jumped = [trial.variant for trial in trials if trial.score is not None]
        found = {}
        for variant in (*before, *jumped):
            guess = self._guess(variant)
            if guess is not None and guess.score is not None:
                found[variant.key] = self._space.to_unit(variant), guess.score
        return found

    def _tried(self, trials: Sequence[Trial], tried: Sequence[Array]) -> Iterator[Variant]:
        ours = (
            trial
            for trial in trials
            if trial.position[:2] == (self._phase, self._task.run) and trial.step and trial.key not in self._prior
        )
        kept = (point for trial in ours for point in trial.proposal.get(TRIED, ()))
        points = (point for point in (*kept, *tried) if len(point) == self._space.dimension)
        yield from (self._variant(point) for point in points)

    def _variant(self, point: Sequence[float] | Array) -> Variant:
        key = tuple(point)
        if key not in self._variants:
            self._variants[key] = self._space.to_variant(point)
        return self._variants[key]

    def _failure(self, variant: Variant) -> Trial | None:
        """Return what a variant that does not hold is learned as; of one with room, with the margins of its statics."""
        refusal, guess = self._refusal(variant), self._guess(variant)
        if guess is None or guess.score is not None:
            return refusal
        statics = {name: guess.margins[name] for name in STATICS if name in guess.margins}
        findings = [bare(name, "error" if margin < 0.0 else "info", margin, "") for name, margin in statics.items()]
        return _stayed(variant, Evaluation("no_takeoff", findings=tuple(findings)))

    def _refusal(self, variant: Variant) -> Trial | None:
        laid = self._layout(variant)
        return laid if isinstance(laid, Trial) else None

    def _layout(self, variant: Variant) -> Mapping[str, float] | Trial:
        """Return figures of a variant's layout, or what is learned of one that has no room."""
        if variant.key not in self._laid:
            found = self._model.laid_out(variant)
            self._laid[variant.key] = _stayed(variant, found) if isinstance(found, Evaluation) else found
        return self._laid[variant.key]

    def _guess(self, variant: Variant) -> Guess | None:
        """Return what a variant would do; None where it has no room, or its jump cannot be guessed."""
        if self._guesser is None or self._fit is None:
            return None
        if variant.key not in self._guesses:
            laid = self._layout(variant)
            self._guesses[variant.key] = None if isinstance(laid, Trial) else self._guesser(variant, self._fit, laid)
        return self._guesses[variant.key]


def _stayed(variant: Variant, outcome: Evaluation) -> Trial:
    return Trial("", 0, 0, variant.design, outcome.bare, None, "", 0.0, {}, variant.workshop)
