"""A study of a hill: what it is about, and trials to keep in it."""

import numpy as np

from jumpcad.search.space import Space
from jumpcad.search.study.trial import Trial
from support.hills import Hill

IDENTITY = {
    "model": {"name": "hill"},
    "objective": "fitness",
    "method": "ga",
    "seed": 1,
    "space": Space.parse(fix=["c_coef=1"]).describe(),
}


def trials(count, phase="ga", step=0):
    """Return trials of a hill at points spread over the default space."""
    points = Space.default().spread(count, np.random.default_rng(step))
    designs = [Space.default().to_design(point) for point in points]
    evaluations = [Hill()(design).bare for design in designs]  # as a study keeps them
    return [
        Trial(
            phase,
            step,
            place,
            design,
            evaluation,
            evaluation.metrics.get("fitness"),
            "m",
            0.1,
            {"theta": {"a": [0.1] * 9}},
        )
        for place, (design, evaluation) in enumerate(zip(designs, evaluations, strict=True))
    ]
