"""Views of the design space: sweeps, principal components, importance, and where designs are rejected."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.process import one_thread
from jumpcad.search.parameter import SearchParameter
from jumpcad.search.propose.posterior import warped
from jumpcad.search.propose.surrogate import Surrogate
from jumpcad.search.space import Space
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.trial import Trial, feasible_trials
from jumpcad.search.study.variant import Variant
from jumpcad.transforms import Array, ByValue
from jumpcad.workshop import load_workshop, workshop_value

ELITE_SHARE = 0.1
"""Share of the feasible designs whose components are compared with those of all."""
ELITE_LEAST = 20
FOLDS = 5
"""Of the cross-validation."""
REPEATS = 10
"""Permutations of each parameter."""
LEAST_R_SQUARED = 0.5
"""Least R² at which importances are meaningful; judgement."""

UNIFORM_NOTE = (
    "Components of evenly sampled parameters are equal apart from chance: they say nothing about the robot. "
    "Look at the components of the elite, the best designs that jump, and at the importance."
)


@dataclass(frozen=True, eq=False)
class Sweep(ByValue):
    """One parameter varied alone, with one trial for each of its values; for names, ``values`` are their indices."""

    parameter: str
    values: Array
    trials: list[Trial]
    names: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Components(ByValue):
    """Principal components of standardised parameters.

    ``shares`` (k,) of the variance, largest first; ``directions`` (k, k), one component per row, over ``names``.
    """

    names: tuple[str, ...]
    shares: Array
    directions: Array
    designs: int


@dataclass(frozen=True, eq=False)
class Importance(ByValue):
    """Decrease of R² on held-out designs when a parameter is permuted: mean and standard deviation.

    ``r_squared`` is the R² before; ``designs`` the number of designs that jump.
    """

    names: tuple[str, ...]
    mean: Array
    deviation: Array
    r_squared: float
    designs: int


@dataclass(frozen=True, eq=False)
class FeasibilityMap(ByValue):
    """Trials over a grid of two parameters, the others as in a design: trials[j][i] is at ``y[j]``, ``x[i]``."""

    x_name: str
    y_name: str
    x: Array
    y: Array
    trials: list[list[Trial]]
    x_names: tuple[str, ...] = ()
    y_names: tuple[str, ...] = ()


@check_arguments
def sweep(evaluator: Evaluator, around: Design, points: int) -> list[Sweep]:
    """Vary each free parameter alone, over `points` values of its range (or over its choices).

    The others have the values of `around` and of the model's workshop, or those that the space fixes.
    """
    if points < 2:
        raise JumpcadError(f"points = {points} must be at least 2")
    sweeps, start = [], _start(evaluator, around)
    for step, parameter in enumerate(evaluator.space.free):
        values = _grid(parameter, points)
        varied = [start.changed({parameter.name: parameter.value(value)}) for value in values]
        trials = _all(evaluator, varied, "sweep", step)
        sweeps.append(Sweep(parameter.name, values, trials, parameter.names))
    return sweeps


@check_arguments
def sample(evaluator: Evaluator, count: int, seed: int) -> list[Trial]:
    """Evaluate `count` designs spread evenly over the space."""
    if count < 20:
        raise JumpcadError(f"samples = {count} must be at least 20")
    points = evaluator.space.spread(count, np.random.default_rng([seed, 5]))
    return _all(evaluator, [evaluator.space.to_variant(point) for point in points], "sample", 0)


@check_arguments
def components(evaluator: Evaluator, trials: Sequence[Trial]) -> Components:
    """Return the principal components of the free parameters of some trials."""
    from sklearn.decomposition import PCA

    if len(trials) < 3:
        raise JumpcadError(f"{counted(len(trials), 'design')}: too few for principal components; raise --samples")
    units = np.array([evaluator.space.to_unit(trial.variant) for trial in trials])
    deviation = units.std(axis=0)
    found = PCA(svd_solver="full").fit(units / np.where(deviation > 0, deviation, 1.0))
    names = tuple(parameter.name for parameter in evaluator.space.free)
    return Components(names, found.explained_variance_ratio_, found.components_, len(trials))


def elite(trials: Sequence[Trial]) -> list[Trial]:
    """Return the best tenth of the feasible trials, at least `ELITE_LEAST` if that many exist, best first."""
    feasible = feasible_trials(trials)
    return feasible[: max(ELITE_LEAST, round(ELITE_SHARE * len(feasible)))]


@check_arguments
def importance(searched: Evaluator | Space, trials: Sequence[Trial], seed: int) -> Importance:
    """Return the permutation importance of the free parameters for the score of designs that jump.

    A Gaussian process predicts each fifth of them from the other four; then one parameter at a time is permuted there.
    A fifth whose scores are equal says nothing.
    """
    space = searched.space if isinstance(searched, Evaluator) else searched
    feasible = [trial for trial in trials if trial.score is not None]
    if len(feasible) < 2 * FOLDS:
        raise JumpcadError(
            f"{len(feasible)} of {len(trials)} designs jump, which is too few to say what is important; raise --samples"
        )
    x = np.array([space.to_unit(trial.variant) for trial in feasible])
    y = warped(np.array([trial.score for trial in feasible]))
    generator = np.random.default_rng([seed, 6])
    fold = generator.permutation(len(y)) % FOLDS
    theta, scores, falls = None, [], []
    with one_thread():
        for part in range(FOLDS):
            known = fold != part
            if np.ptp(y[~known]) == 0.0:
                continue  # there is no variance to be explained
            surrogate = Surrogate(x[known], y[known], theta, categories=space.categories)
            theta = surrogate.theta
            plain = _r_squared(surrogate, x[~known], y[~known])
            scores.append(plain)
            for _ in range(REPEATS):
                shuffled = np.repeat(x[None, ~known], x.shape[1], axis=0)
                for column, points in enumerate(shuffled):
                    points[:, column] = generator.permutation(points[:, column])
                falls.append([plain - _r_squared(surrogate, points, y[~known]) for points in shuffled])
    if not scores:
        raise JumpcadError(
            f"{len(feasible)} of {len(trials)} designs jump, and score alike: nothing says what is important; raise "
            "--samples, or choose another --objective"
        )
    names = tuple(parameter.name for parameter in space.free)
    return Importance(names, np.mean(falls, axis=0), np.std(falls, axis=0), float(np.mean(scores)), len(feasible))


@check_arguments
def feasibility_map(evaluator: Evaluator, around: Design, x_name: str, y_name: str, points: int) -> FeasibilityMap:
    """Evaluate a grid over two free parameters; the others are as in a `sweep`."""
    parameters = {parameter.name: parameter for parameter in evaluator.space.free}
    for name in (x_name, y_name):
        if name not in parameters:
            raise JumpcadError(f"{name!r} is not a free parameter; these are {', '.join(parameters)}")
    if x_name == y_name:
        raise JumpcadError(f"a map needs two different parameters, not {x_name} twice")
    along, up, start = parameters[x_name], parameters[y_name], _start(evaluator, around)
    x, y = _grid(along, points), _grid(up, points)
    variants = [start.changed({x_name: along.value(u), y_name: up.value(v)}) for v in y for u in x]
    trials = _all(evaluator, variants, "sweep", evaluator.space.dimension)
    lines = [trials[j * len(x) : (j + 1) * len(x)] for j in range(len(y))]
    return FeasibilityMap(x_name, y_name, x, y, lines, along.names, up.names)


def _grid(parameter: SearchParameter, points: int) -> Array:
    return np.array(parameter.choices) if parameter.choices else np.linspace(parameter.lower, parameter.upper, points)


def _start(evaluator: Evaluator, around: Design) -> Variant:
    """Return a design in the model's workshop, with the values that the space varies or fixes."""
    space, model = evaluator.space, evaluator.model
    held = {one.name: workshop_value(model.workshop or load_workshop(), one.name) for one in space.of_workshop}
    return Variant(around, held).changed({one.name: one.value(one.lower) for one in space.parameters if not one.free})


def _all(evaluator: Evaluator, designs: Sequence[Variant], phase: str, step: int) -> list[Trial]:
    return [trial for trial in evaluator.evaluate(designs, phase, step) if trial is not None]


def _r_squared(surrogate: Surrogate, x: Array, y: Array) -> float:
    """Return the share of the variance of y (n,) that predictions at x (n, d) explain."""
    error = y - surrogate.predict(x)[0]
    return 1.0 - float(np.sum(error**2) / np.sum((y - y.mean()) ** 2))
