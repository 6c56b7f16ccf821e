"""A model whose best design is known, and studies of it for pictures."""

from jumpcad.design import Design
from jumpcad.evaluation import FIGURES
from jumpcad.search.models import RobotModel
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore

REST = [
    "carrying_link_mm=100",
    "c_coef=1",
    "d_coef=0.8",
    "e_coef=0.9",
    "stiffness_nmm_per_deg=20",
    "ground_link_angle_deg=30",
]
"""All parameters are fixed but compression ratio and rest angle."""


class Bump(RobotModel):
    """A bump at a compression ratio of 0.5 and a rest angle of 50°, rejected beyond 0.7."""

    name, digest = "bump", "bump"
    figure_names = tuple(FIGURES)
    quick_score = None

    def __call__(self, design: Design) -> Evaluation:
        if design.compression_ratio > 0.7:
            return Evaluation("loop")
        height = 9.0 - 20.0 * (design.compression_ratio - 0.5) ** 2 - ((design.rest_angle_deg - 50.0) / 20.0) ** 2
        return Evaluation("jump", {"fitness": height})

    def admits(self, design):
        return True

    def describe(self):
        return {"name": "bump"}

    def versions(self):
        return {}


def studied(path, space, method="bo", evaluations=20):
    """Return the finished study of a bump."""
    with local_pool(0) as pool:
        run_study(Request(space, Bump(), "fitness", method, evaluations, until_percent=0.0), path, pool)
    return StudyStore.read(path)
