"""The first designs of a search: half are shipped ones and the best of many by a quick model, the others evenly spread.

Of evenly spread designs of the printed robot, six in seven are rejected. A quick robot is simulated in milliseconds;
designs with which it jumps far are probably good. The other half covers errors of the quick model.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from jumpcad.design import load_design, own_workshop
from jumpcad.files.templates import template_names
from jumpcad.search.methods import START
from jumpcad.search.models import PrintedModel, score_or_touchdown
from jumpcad.search.space import Space, apart
from jumpcad.search.study.evaluator import Evaluator
from jumpcad.search.study.request import Stage
from jumpcad.search.study.trial import Trial, searched
from jumpcad.search.study.variant import Variant
from jumpcad.simulation.prior import sobol
from jumpcad.transforms import Array
from jumpcad.workshop import load_workshop

SCREENED, BRED, GENERATIONS, CROSSED = 512, 48, 12, 0.8
"""Designs that the quick model ranks, how many of the best are bred, so many times, and the share of coordinates that
change (about a second with the extra `fast`)."""
SHIPPED = 3
"""Shipped designs to begin with, at most; a search of eight parameters has twelve first designs."""
DIGITS = 4
"""Of the coordinates of what is bred."""
APART = 0.1
"""Least difference between two of its best designs along some axis of the unit cube."""


def first_points(
    space: Space, count: int, generator: np.random.Generator, ranked: Sequence[Array] = (),
    admits: Callable[[Variant], bool] = lambda _variant: True,
) -> Array:  # fmt: skip
    """Return at most `count` points (count, dimension) of the unit cube to start with, evenly spread ones first.

    Half of them are the first `ranked` points (d,) that are apart. What `admits` does not admit is passed over.
    """
    spread = space.spread(2 * count, generator)
    places = apart(ranked, APART, count // 2, lambda index: admits(space.to_variant(ranked[index])))
    chosen = [ranked[index] for index in places]
    admitted = (point for point in spread if admits(space.to_variant(point)))
    even = list(itertools.islice(admitted, count - len(chosen)))
    return np.array([*even, *chosen]).reshape(-1, space.dimension)


def run_start(evaluator: Evaluator, stage: Stage) -> None:
    """Evaluate the designs that a search begins with; its methods learn from them."""
    evaluator.evaluate(stage.request.first, START, 0)


def begun(evaluator: Evaluator) -> list[Trial]:
    """Return the designs of a prior study, and those that the search began with."""
    return [*searched(evaluator.prior), *(trial for trial in evaluator.trials if trial.phase == START)]


def ranked_points(evaluator: Evaluator, generator: np.random.Generator) -> list[Array]:
    """Return points (dimension,) with which the quick robot jumps; none for other robots.

    First `shipped_points`; then, the best first, those that are `bred` of many that are evenly spread.
    """
    quick = getattr(evaluator.model, "quick_score", None)
    if quick is None:
        return []
    space, objective = evaluator.space, evaluator.objective
    points = space.drawn(sobol(space.dimension, SCREENED, generator))

    def scored(points: Array) -> Array:
        return np.array(evaluator.shared(lambda point: quick(space.to_design(point), objective), [*points]))

    scores = scored(points)
    order = np.argsort(-scores, kind="stable")
    points, scores = points[order], scores[order]
    count = min(BRED, int(np.isfinite(scores).sum()))
    if count >= 8:
        points[:count], scores[:count] = evolved(points[:count], scores[:count], GENERATIONS, space, scored, generator)
    order = np.argsort(-scores, kind="stable")
    return [*shipped_points(evaluator), *(points[index] for index in order if math.isfinite(scores[index]))]


def shipped_points(evaluator: Evaluator) -> list[Array]:
    """Return points (dimension,) of the best shipped designs of the space, at most `SHIPPED`; none in a cold search.

    They are built in the search's workshop, those with their own one only in that, and score by the planar engine,
    whatever is required.
    """
    space, model, objective = evaluator.space, evaluator.model, evaluator.objective
    if evaluator.request.cold or not isinstance(model, PrintedModel):
        return []
    ours = model.workshop or load_workshop()
    names = [name for name in template_names("robots") if load_workshop(own_workshop(name)) in (load_workshop(), ours)]
    variants = [space.begun(load_design(name), ours) for name in names]
    inside = [one for one in variants if not space.outside(one)]
    quick = replace(model, engine=model.estimate_engine, requirements=(), scored=())
    found = evaluator.shared(lambda one: score_or_touchdown(quick(one.design, one.workshop), objective), inside)
    order = np.argsort(-np.array([*found]), kind="stable")[:SHIPPED]
    return [space.to_unit(inside[index]) for index in order if math.isfinite(found[index])]


def evolved(
    points: Array, scores: Array, generations: int, space: Space, scored: Callable[[Array], Array],
    generator: np.random.Generator,
) -> tuple[Array, Array]:  # fmt: skip
    """Return points (n, d) and scores (n,) after some generations, in each of which a better child takes a place."""
    for _ in range(generations):
        order = np.argsort(-scores, kind="stable")
        points, scores = points[order], scores[order]
        children = space.snap(bred(points, generator).round(DIGITS))
        theirs = scored(children)
        better = theirs > scores
        points, scores = np.where(better[:, None], children, points), np.where(better, theirs, scores)
    return points, scores


def bred(parents: Array, generator: np.random.Generator) -> Array:
    """Return points (n, d), each from one of the parents (n, d), of which the first are the best.

    Differential evolution (Storn and Price, J. Global Optimization 1997), toward one of the best quarter (Zhang and
    Sanderson, IEEE Trans. Evolutionary Computation 2009).
    """
    count = len(parents)
    toward, one, other = (parents[generator.integers(most, size=count)] for most in (max(count // 4, 1), count, count))
    factors = generator.uniform(0.3, 0.9, (count, 1)) * (generator.random(parents.shape) < CROSSED)
    return np.clip(parents + factors * (toward - parents + one - other), 0.0, 1.0)
