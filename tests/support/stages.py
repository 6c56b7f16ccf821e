"""Stages of requests for methods that are called alone."""

from jumpcad.search.study.request import Request, Stage
from support.hills import SMALL, Hill


def stage(evaluations, seed=0, initial=0, *, run=0, least_gain=0.0, **options) -> Stage:
    """Return a stage of a search of a hill by a method that takes the options."""
    method = "pareto" if "against" in options else "bo" if "batch" in options else "ga"
    request = Request(SMALL, Hill(), method=method, evaluations=evaluations, seed=seed, **options)
    return Stage(request, method, evaluations, initial, run, least_gain)
