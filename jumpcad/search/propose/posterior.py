"""What trials tell of designs not yet evaluated: their score, and the margin of each limit.

One process for the score, fitted to feasible designs only (a rejected design has no score, and a zero in its place
would put a step into a smooth function), and one for the margin of each constraint, fitted wherever it is known.
"""

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from scipy.special import erfcx, log_ndtr

from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space
from jumpcad.search.study.objective import EQUALS, SCREENED, Evaluation
from jumpcad.search.study.trial import Trial, typical_size
from jumpcad.search.study.variant import NOTHING, Key
from jumpcad.transforms import Array

GUESS, MORE = "guess", "more"
"""Names of the processes of guessed scores, and of what true scores are more."""
LEAST_GUESSED = 3
"""Least trials whose score was guessed too, before guesses are learned from."""
VERDICT = "verdict"
"""A constraint for all rejections together, also those without a margin: +1 for a jump, else -1.

But for those by requirements, whose margins all jumps have: where none keeps them yet, it would tell nothing apart.
"""
MAX_CONSTRAINTS = 8
"""Requirements not counted."""
THETA_DIGITS = 3
"""Decimals of the logarithms with which the next fit starts: a row of a study is half as long."""


@dataclass(frozen=True)
class SearchPosterior:
    """Processes fitted to trials: of the score, once two designs are feasible, and of each constraint's margin.

    They are fitted in scales of the space. Where scores were guessed, `guess` is fitted to the guesses, and `score` to
    what the true scores are more (Kennedy and O'Hagan, Biometrika 2000, with a factor of 1).
    """

    score: Surrogate | None
    constraints: Mapping[str, Surrogate]
    guess: Surrogate | None = None
    scale: Array | float = 1.0

    @classmethod
    def from_trials(
        cls, space: Space, trials: Sequence[Trial], thetas: Mapping[str, Any], fit: bool,
        guesses: Mapping[Key, tuple[Array, float]] = NOTHING,
        score_of: Callable[[Trial], float | None] = lambda trial: trial.score,
    ) -> Self:  # fmt: skip
        """Learn from trials in a space, starting from the hyperparameters `thetas` of an earlier posterior.

        They are fitted anew if `fit`; what has none yet always is. `guesses` are points (d,) and guessed scores by the
        keys of variants; `score_of` returns the score that is learned of a trial.
        """
        scale = space.scale
        x = np.array([space.to_unit(trial.variant) for trial in trials]).reshape(-1, space.dimension) / scale

        def learn(name: str, points: Array, values: Array) -> Surrogate:
            return Surrogate(points, values, thetas.get(name), fit, space.categories)

        constraints = {}
        for name, margins in constraint_margins(trials).items():
            known = np.isfinite(margins)
            scaled = np.arcsinh(margins[known] / typical_size(margins[known]))  # large ones compressed, with their sign
            constraints[name] = learn(name, x[known], scaled)
        found = [(point, trial, score_of(trial)) for point, trial in zip(x, trials, strict=True)]
        jumps = [(point, trial) for point, trial, score in found if score is not None]
        points = np.array([point for point, _ in jumps]).reshape(-1, space.dimension)
        scores = np.array([score for _, _, score in found if score is not None])
        if sum(trial.key in guesses for _, trial in jumps) >= LEAST_GUESSED:
            places = np.array([place for place, _ in guesses.values()]) / scale
            values = warped(forwards(np.array([value for _, value in guesses.values()]), scores))
            guess = learn(GUESS, places, values)
            of_keys = dict(zip(guesses, values.tolist(), strict=True))
            pairs = zip(jumps, guess.predict(points)[0].tolist(), strict=True)
            their = np.array([of_keys.get(trial.key, mean) for (_, trial), mean in pairs])
            return cls(learn(MORE, points, warped(forwards(scores, scores)) - their), constraints, guess, scale)
        if len(jumps) < 2:
            return cls(None, constraints, None, scale)
        return cls(learn("score", points, warped(forwards(scores, scores))), constraints, None, scale)

    @property
    def thetas(self) -> dict[str, list[float]]:
        """Hyperparameters of every process, by name, rounded as a study keeps them; `score` for the score."""
        found = {name: surrogate.theta for name, surrogate in self.constraints.items()}
        if self.score is not None:
            of_score = {"score": self.score} if self.guess is None else {GUESS: self.guess, MORE: self.score}
            found = {name: surrogate.theta for name, surrogate in of_score.items()} | found
        return {name: [round(value, THETA_DIGITS) for value in theta] for name, theta in found.items()}

    def log_feasible(self, points: Array) -> Array:
        """Return the logarithm of the probability (m,) that designs (m, d) meet every constraint."""
        total = np.zeros(len(points))
        for surrogate in self.constraints.values():
            mean, deviation = surrogate.predict(points / self.scale)
            total += log_ndtr(mean / deviation)
        return total

    def log_improvement(self, points: Array, best: float) -> Array:
        """Return the logarithm of the expected improvement (m,) of the warped score over `best` at points (m, d)."""
        if self.score is None:
            return np.zeros(len(points))
        points = points / self.scale
        mean, deviation = self.score.predict(points)
        if self.guess is not None:
            guessed, unsure = self.guess.predict(points)
            # what scores scatter by: their steps, which no smooth function has, may be gained too
            mean, deviation = mean + guessed, np.hypot(np.hypot(deviation, unsure), self.score.scatter)
        return np.log(deviation) + _log_h((mean - warped(best)) / deviation)

    def condition_on(self, point: Array) -> "SearchPosterior":
        """Return the posterior with its own means at a point (d,) added as measurements (kriging believer)."""
        point = point / self.scale
        constraints = {name: surrogate.condition_on(point) for name, surrogate in self.constraints.items()}
        score = None if self.score is None else self.score.condition_on(point)
        guess = None if self.guess is None else self.guess.condition_on(point)
        return SearchPosterior(score, constraints, guess, self.scale)


def forwards(scores: Array, measured: Array) -> Array:
    """Return scores (n,) in which a jump backwards counts as no jump, if any of those that were measured goes forwards.

    Large negative scores would shorten the lengths of the process and say nothing of the best designs: with them, one
    seed in eight had not converged at 100 evaluations.
    """
    return np.maximum(scores, 0.0) if measured.max() > 0.0 else scores


def warped(score: npt.ArrayLike) -> Array:
    """Return the square root of scores, with their sign.

    The range grows with the square of the take-off speed, and the speed about linearly with the parameters.
    """
    score = np.asarray(score, dtype=float)
    return np.asarray(np.sign(score) * np.sqrt(np.abs(score)))


def unwarped(values: Array) -> Array:
    """Return the scores of warped values; the inverse of `warped`."""
    return np.sign(values) * values**2


def constraint_margins(trials: Sequence[Trial]) -> dict[str, Array]:
    """Return the margins (n,) of each constraint that rejected a design; NaN where a trial lacks it.

    At most `MAX_CONSTRAINTS`: `VERDICT`, and those that reject most. A limit that refuses a design while it is laid out
    is one too where built robots have a margin of it (`stop_room`): the verdict alone, +1 or -1, is smooth, and
    promises a jump a tenth of a millimetre beyond such a limit again and again. No robot meets the limit of those that
    stay on the ground: they are left to `VERDICT`.
    """
    rejections = Counter(reason for trial in trials for reason in trial.evaluation.reasons)
    met = set[str]().union(*(trial.evaluation.met for trial in trials))
    missed = sorted(set[str]().union(*(trial.evaluation.missed for trial in trials)))
    ranked = sorted((name for name in missed if name in met and EQUALS not in name), key=lambda name: -rejections[name])
    names = [*ranked[: MAX_CONSTRAINTS - 1], *(name for name in missed if EQUALS in name)]
    margins = {name: np.array([trial.evaluation.margins.get(name, np.nan) for trial in trials]) for name in names}
    if rejections:
        margins[VERDICT] = np.array([_verdict(trial.evaluation) for trial in trials])
    return margins


def _verdict(evaluation: Evaluation) -> float:
    if evaluation.verdict == SCREENED:
        return math.nan
    return 1.0 if evaluation.feasible or evaluation.only_misses_required else -1.0


def _log_h(z: Array) -> Array:
    """Return log(φ(z) + z·Φ(z)), exact far below the mean too (Ament et al., NeurIPS 2023, eq. 9)."""
    z = np.asarray(z, dtype=float)
    near = np.maximum(z, -1.0)
    plain = np.exp(-0.5 * near**2) / np.sqrt(2 * np.pi) + near * np.exp(log_ndtr(near))
    far = np.minimum(z, -1.0)
    ratio = np.maximum(1.0 + far * np.sqrt(np.pi / 2) * erfcx(-far / np.sqrt(2)), 1e-300)
    tail = np.log(ratio) - 0.5 * far**2 - 0.5 * np.log(2 * np.pi)
    # 1 + z·Φ/φ loses its digits below -1e3; there it is 1/z² to first order.
    tail = np.where(far < -1e3, -2.0 * np.log(-far) - 0.5 * far**2 - 0.5 * np.log(2 * np.pi), tail)
    return np.asarray(np.where(z > -1.0, np.log(plain), tail))
