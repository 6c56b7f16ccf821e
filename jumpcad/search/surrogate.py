"""Gaussian processes that predict score and constraints of designs not yet evaluated.

One process for the score, fitted to feasible designs only (a rejected design has no score, and a zero in its place
would put a step into a smooth function), and one for the margin of each constraint, fitted wherever it is known.
"""

import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_triangular
from scipy.optimize import minimize
from scipy.special import erfcx, log_ndtr

from jumpcad.search.space import Space
from jumpcad.search.trial import Trial
from jumpcad.search.variant import Key
from jumpcad.transforms import Array

GUESS, MORE = "guess", "more"
"""Names of the processes of guessed scores, and of what true scores are more."""
LEAST_GUESSED = 3
"""Least trials whose score was guessed too, before guesses are learned from."""
NO_GUESSES: Mapping[Key, tuple[Array, float]] = MappingProxyType({})
VERDICT = "verdict"
"""A constraint for all rejections together, also those without a margin: +1 for a jump, else -1."""
NO_TAKEOFF = "no_takeoff"
MAX_CONSTRAINTS = 8
THETA_DIGITS = 3
"""Decimals of the logarithms with which the next fit starts: a row of a study is half as long."""
AT_ONCE = 100_000
"""Most differences of coordinates that are held at once."""
_FIT_STEPS = 30


class Axes:
    """Axes of the process for axes of the unit cube: an axis of names becomes one per name, with 0 or 1/√2 (one-hot).

    The distance between two different names is then 1 (Hamming distance), with one length scale for all of them.

    Parameters
    ----------
    categories
        Number of names of each axis of the cube; 0 for an axis of numbers.
    """

    def __init__(self, categories: Sequence[int]) -> None:
        self._categories = categories
        self.origin = np.repeat(np.arange(len(categories)), [max(count, 1) for count in categories])
        """Index of the axis of the cube for each axis of the process (k,)."""

    def expand(self, points: Array) -> Array:
        """Return points (m, d) of the cube in the axes of the process (m, k)."""
        if not any(self._categories):
            return points
        columns = []
        for column, count in zip(points.T, self._categories, strict=True):
            if count:
                chosen = np.round(column * max(count - 1, 1))
                columns += [(chosen == number) * np.sqrt(0.5) for number in range(count)]
            else:
                columns.append(column)
        return np.column_stack(columns)

    def unfold(self, theta: Array) -> Array:
        """Return hyperparameters (d + 2,) with the length scale of an axis of names repeated for each name (k + 2,)."""
        return np.concatenate([theta[:1], theta[1:-1][self.origin], theta[-1:]])

    def fold(self, slopes: Array) -> Array:
        """Return derivatives (k + 2,) with respect to the process's hyperparameters for those of the cube (d + 2,)."""
        return np.concatenate([slopes[:1], np.bincount(self.origin, slopes[1:-1]), slopes[-1:]])

    def folded(self, theta: Array) -> Array:
        """Return the hyperparameters (d + 2,) that `unfold` repeated."""
        first = np.searchsorted(self.origin, np.arange(len(self._categories)))
        return np.concatenate([theta[:1], theta[1:-1][first], theta[-1:]])


class Surrogate:
    """A Gaussian process over the unit cube: constant times Matérn 5/2 with one length scale per axis, plus noise.

    Parameters
    ----------
    x, y
        Points (n, d) and values (n,).
    theta
        Logarithms of the hyperparameters to start from, (d + 2,).
    fit
        Whether to improve them by maximum likelihood.
    categories
        Number of names of each axis; 0 for an axis of numbers. Empty: all are numbers.
    """

    def __init__(
        self,
        x: Array,
        y: Array,
        theta: Sequence[float] | None = None,
        fit: bool = True,
        categories: Sequence[int] = (),
    ) -> None:
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor

        self.categories = tuple(categories) or (0,) * x.shape[1]
        self._axes = Axes(self.categories)
        seen = self._axes.expand(x)
        known = None if theta is None else self._axes.unfold(np.array(theta))
        regressor = GaussianProcessRegressor(
            _kernel(seen.shape[1], known),
            alpha=1e-8,
            normalize_y=True,
            optimizer=partial(_improve, axes=self._axes) if fit else None,
        )
        with warnings.catch_warnings():
            # a length scale at its upper bound: the axis has no effect
            warnings.simplefilter("ignore", ConvergenceWarning)
            regressor.fit(seen, y)
        self.x, self.y, self._seen = x, y, seen
        self.theta: list[float] = self._axes.folded(regressor.kernel_.theta).tolist()
        scale, self._lengths = regressor.kernel_.k1.k1.constant_value, regressor.kernel_.k1.k2.length_scale
        self._variance = float(scale)
        self._scaled = np.ascontiguousarray((seen / self._lengths).T)
        self._chol, self._alpha = regressor.L_, regressor.alpha_.reshape(-1)
        self._centre, self._spread = float(regressor._y_train_mean), float(regressor._y_train_std)

    def predict(self, points: Array) -> tuple[Array, Array]:
        """Return mean (m,) and standard deviation (m,) of the noise-free function at points (m, d)."""
        covariance = self._covariance(points)
        half = solve_triangular(self._chol, covariance.T, lower=True, check_finite=False)
        variance = np.maximum(self._variance - np.einsum("ij,ij->j", half, half), 1e-12)
        return self._centre + self._spread * (covariance @ self._alpha), self._spread * np.sqrt(variance)

    def slope(self, points: Array) -> Array:
        """Return the gradient (m, d) of the mean at points (m, d); 0 along axes of names."""
        points = self._axes.expand(points)
        distance = self._distance(points)
        weights = (1.0 + distance) * np.exp(-distance) * self._alpha
        pull = weights @ self._seen - weights.sum(axis=1, keepdims=True) * points
        slope = self._spread * self._variance * (5.0 / 3.0) * pull / self._lengths**2
        first = np.searchsorted(self._axes.origin, np.arange(len(self.categories)))
        along: Array = np.where(self.categories, 0.0, slope[:, first])
        return along

    def condition_on(self, point: Array) -> Self:
        """Return the process with its own mean at a point (d,) added as a measurement (kriging believer)."""
        mean, _ = self.predict(point[None])
        return type(self)(np.vstack([self.x, point]), np.append(self.y, mean), self.theta, False, self.categories)

    def _covariance(self, points: Array) -> Array:
        """Return the covariance (m, n) of points with the data."""
        distance = self._distance(self._axes.expand(points))
        return self._variance * (1.0 + distance + distance**2 / 3.0) * np.exp(-distance)

    def _distance(self, points: Array) -> Array:
        """Return the distances (m, n) of points (m, k) from the data: √5·r, in length scales of the kernel."""
        columns = np.ascontiguousarray((points / self._lengths).T)
        if columns.size * len(self._seen) < AT_ONCE:
            differences = columns[:, :, None] - self._scaled[:, None, :]
            squares = np.add.reduce(differences * differences, axis=0)
        else:  # one axis at a time: all at once would take 40 MB
            squares = np.zeros((len(points), len(self._seen)))
            for column, seen in zip(columns, self._scaled, strict=True):
                squares += (column[:, None] - seen) ** 2
        distance: Array = np.sqrt(5.0 * squares)
        return distance


@dataclass(frozen=True)
class SearchPosterior:
    """Processes fitted to trials: of the score, once two designs are feasible, and of each constraint's margin.

    Where scores were guessed, `guess` is fitted to the guesses, and `score` to what the true scores are more (Kennedy
    and O'Hagan, Biometrika 2000, with a factor of 1).
    """

    score: Surrogate | None
    constraints: Mapping[str, Surrogate]
    guess: Surrogate | None = None

    @classmethod
    def from_trials(
        cls,
        space: Space,
        trials: Sequence[Trial],
        thetas: Mapping[str, Any],
        fit: Sequence[str] | None,
        guesses: Mapping[Key, tuple[Array, float]] = NO_GUESSES,
    ) -> Self:
        """Learn from trials, starting from the hyperparameters `thetas` of an earlier posterior.

        Parameters
        ----------
        space, trials
            The space, and evaluated designs in it.
        thetas
            Hyperparameters by name, as `thetas` gives them.
        fit
            Names of the processes to fit; None for all. What has no hyperparameters yet is always fitted.
        guesses
            Points (d,) and guessed scores of variants, by their keys; of trials too.
        """
        x = np.array([space.to_unit(trial.variant) for trial in trials]).reshape(-1, space.dimension)

        def learn(name: str, points: Array, values: Array) -> Surrogate:
            known = thetas.get(name)
            fitted = known is None or fit is None or name in fit
            return Surrogate(points, values, known, fitted, space.categories)

        constraints = {}
        for name, margins in constraint_margins(trials).items():
            known = np.isfinite(margins)
            constraints[name] = learn(name, x[known], _scaled(margins[known]))
        jumps = [(point, trial) for point, trial in zip(x, trials, strict=True) if trial.score is not None]
        guessed = [(point, trial.score, guesses[trial.key][1]) for point, trial in jumps if trial.key in guesses]
        if len(guessed) >= LEAST_GUESSED:
            points, scores, their = (np.array(column) for column in zip(*guessed, strict=True))
            more = warped(forwards(scores)) - warped(forwards(their))
            of_guesses = np.array([value for _, value in guesses.values()])
            guess = learn(GUESS, np.array([point for point, _ in guesses.values()]), warped(forwards(of_guesses)))
            return cls(learn(MORE, points, more), constraints, guess)
        if len(jumps) < 2:
            return cls(None, constraints)
        scores = np.array([trial.score for _, trial in jumps])
        return cls(learn("score", np.array([point for point, _ in jumps]), warped(forwards(scores))), constraints)

    @property
    def thetas(self) -> dict[str, list[float]]:
        """Hyperparameters of every process, by name, rounded as a study keeps them; `score` for the score."""
        found = {name: surrogate.theta for name, surrogate in self.constraints.items()}
        if self.score is not None:
            of_score = {"score": self.score} if self.guess is None else {GUESS: self.guess, MORE: self.score}
            found = {name: surrogate.theta for name, surrogate in of_score.items()} | found
        return {name: [round(value, THETA_DIGITS) for value in theta] for name, theta in found.items()}

    def log_feasible(self, points: Array, scatter: Array | None = None) -> Array:
        """Return the logarithm of the probability (m,) that designs (m, d) meet every constraint.

        With `scatter`, standard deviations (m, d) of what is made of each design, that such a neighbour meets them: to
        first order, the variance of a margin grows by that of its slope (Girard et al., NIPS 2002).
        """
        total = np.zeros(len(points))
        for surrogate in self.constraints.values():
            mean, deviation = surrogate.predict(points)
            if scatter is not None:
                deviation = np.hypot(deviation, np.linalg.norm(scatter * surrogate.slope(points), axis=1))
            total += log_ndtr(mean / deviation)
        return total

    def log_improvement(self, points: Array, best: float) -> Array:
        """Return the logarithm of the expected improvement (m,) of the warped score over `best` at points (m, d)."""
        if self.score is None:
            return np.zeros(len(points))
        mean, deviation = self.score.predict(points)
        if self.guess is not None:
            guessed, unsure = self.guess.predict(points)
            mean, deviation = mean + guessed, np.hypot(deviation, unsure)
        return np.log(deviation) + _log_h((mean - warped(best)) / deviation)

    def condition_on(self, point: Array) -> "SearchPosterior":
        """Return the posterior with its own means at a point (d,) added as measurements (kriging believer)."""
        constraints = {name: surrogate.condition_on(point) for name, surrogate in self.constraints.items()}
        score = None if self.score is None else self.score.condition_on(point)
        return SearchPosterior(score, constraints, None if self.guess is None else self.guess.condition_on(point))


def forwards(scores: Array) -> Array:
    """Return scores (n,) in which a jump backwards counts as no jump, if any goes forwards.

    Large negative scores would shorten the lengths of the process and say nothing of the best designs: with them, one
    seed in eight had not converged at 100 evaluations.
    """
    return np.maximum(scores, 0.0) if scores.max() > 0.0 else scores


def warped(score: npt.ArrayLike) -> Array:
    """Return the square root of scores, with their sign.

    The range grows with the square of the take-off speed, and the speed about linearly with the parameters.
    """
    score = np.asarray(score, dtype=float)
    root: Array = np.sign(score) * np.sqrt(np.abs(score))
    return root


def unwarped(values: Array) -> Array:
    """Return the scores of warped values; the inverse of `warped`."""
    return np.sign(values) * values**2


def constraint_margins(trials: Sequence[Trial]) -> dict[str, Array]:
    """Return the margins (n,) of each constraint that rejected a design; NaN where a trial lacks it.

    At most `MAX_CONSTRAINTS`: `VERDICT`, and those that reject most. A limit that refuses a design while it is laid out
    is one too where built robots have a margin of it (`stop_room`): the verdict alone, +1 or -1, is smooth, and
    promises a jump a tenth of a millimetre beyond such a limit again and again. Robots that stay on the ground are
    left to `VERDICT`.
    """
    rejections = Counter(reason for trial in trials for reason in trial.evaluation.reasons)
    findings = [finding for trial in trials for finding in trial.evaluation.findings if finding.name != NO_TAKEOFF]
    met = {finding.name for finding in findings if finding.severity != "error"}
    errors = {finding.name for finding in findings if finding.severity == "error"} & met
    ranked = sorted(errors & set(rejections), key=lambda name: (-rejections[name], name))[: MAX_CONSTRAINTS - 1]
    margins = {name: np.array([_margin(trial, name) for trial in trials]) for name in ranked}
    if rejections:
        margins[VERDICT] = np.array([1.0 if trial.evaluation.feasible else -1.0 for trial in trials])
    return margins


def _margin(trial: Trial, name: str) -> float:
    return min((f.margin for f in trial.evaluation.findings if f.name == name), default=np.nan)


def _scaled(margins: Array) -> Array:
    """Return margins in units of their typical size, large ones compressed; the sign is kept."""
    size = float(np.median(np.abs(margins)))
    return np.arcsinh(margins / (size if size > 0 else 1.0))


def _kernel(dimension: int, theta: Array | None) -> Any:
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    kernel = ConstantKernel(1.0, (1e-2, 1e3)) * Matern([0.5] * dimension, (0.05, 10.0), nu=2.5) + WhiteKernel(
        1e-4, (1e-6, 1e-1)
    )
    return kernel if theta is None else kernel.clone_with_theta(theta)


def _improve(objective: Callable[..., Any], start: Array, bounds: Array, axes: Axes) -> tuple[Array, float]:
    """Maximise the likelihood with few steps; the next fit starts where this one ends."""

    def of_axes(theta: Array) -> tuple[float, Array]:
        value, slopes = objective(axes.unfold(theta))
        return value, axes.fold(slopes)

    limits = np.column_stack([axes.folded(side) for side in np.asarray(bounds).T])
    found = minimize(
        of_axes, axes.folded(start), method="L-BFGS-B", jac=True, bounds=list(map(tuple, limits)),
        options={"maxiter": _FIT_STEPS},
    )  # fmt: skip
    return axes.unfold(found.x), found.fun


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
    value: Array = np.where(z > -1.0, np.log(plain), tail)
    return value
