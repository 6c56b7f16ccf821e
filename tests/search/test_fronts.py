"""Fronts against brute force and against PyGAD's own hypervolume."""

import numpy as np
import pytest
from pygad.utils.quality_indicators import hypervolume as reference_hypervolume

from jumpcad.design import Design
from jumpcad.search.fronts import REFERENCE_ENERGY_J, energy_j, front, hypervolume
from jumpcad.search.objective import Evaluation
from jumpcad.search.space import Space
from jumpcad.search.trial import Trial


@pytest.fixture
def trials():
    generator = np.random.default_rng(0)
    found = []
    for place, point in enumerate(Space.default().spread(200, generator)):
        design = Space.default().to_design(point)
        score = float(generator.random()) if place % 5 else None
        if np.isfinite(energy_j(design)):
            found.append(Trial("pareto", 0, place, design, Evaluation("jump"), score, "m", 0.0))
    return found


def test_front_is_what_nothing_dominates(trials):
    points = [(trial.score, energy_j(trial.design)) for trial in trials if trial.score is not None]
    brute = {
        (score, energy)
        for score, energy in points
        if not any((s >= score and e <= energy) and (s, e) != (score, energy) for s, e in points)
    }
    assert {(trial.score, energy_j(trial.design)) for trial in front(trials)} == brute


def test_hypervolume_is_pygads(trials):
    points = np.array([[trial.score, -energy_j(trial.design)] for trial in trials if trial.score is not None])
    assert hypervolume(trials) == pytest.approx(reference_hypervolume(points, [0.0, -REFERENCE_ENERGY_J]), rel=1e-12)
    assert hypervolume([]) == 0.0


def test_a_design_without_a_pose_has_no_energy():
    design = Design.from_vector([100, 3.0, 0.1, 1, 0.5, 80, 10, 40])
    assert energy_j(design) == np.inf
