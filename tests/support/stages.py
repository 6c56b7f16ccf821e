"""Stages of requests for methods that are called alone."""

from typing import Any

import numpy as np

from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.request import Request, Stage
from jumpcad.search.study.trial import Trial
from support.hills import SMALL, Hill


def stage(evaluations, seed=0, initial=0, *, run=0, least_gain=0.0, **options) -> Stage:
    """Return a stage of a search of a hill by a method that takes the options."""
    method = "pareto" if "against" in options else "bo" if "batch" in options else "ga"
    request = Request(SMALL, Hill(), method=method, evaluations=evaluations, seed=seed, **options)
    return Stage(request, method, evaluations, initial, run, least_gain)


def scored(*scores: float | None, phase: str = "bo", step: int = 1, **note: Any) -> list[Trial]:
    """Return a step's trials of these scores, along a line, with a note of their proposal."""
    designs = [SMALL.to_design(np.full(3, 0.1 + 0.2 * place)) for place in range(len(scores))]
    return [
        Trial(phase, step, place, designs[place], Evaluation("jump" if score else "tips"), score, "m", 0.0, note)
        for place, score in enumerate(scores)
    ]
