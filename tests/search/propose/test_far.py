"""Candidates that are bred in the whole space."""

import numpy as np

from jumpcad.search.propose.far import APART, BEST, SPREAD, far_points
from jumpcad.search.space import Space

SPACE = Space.default()
PEAK = np.full(8, 0.23)


def height(point: np.ndarray) -> float:
    """Return a narrow peak: within a tenth of its height lies a hundred-millionth of the cube."""
    return float(np.exp(-0.5 * (((point - PEAK) / 0.15) ** 2).sum()))


def test_points_are_bred_towards_a_peak_that_spread_points_miss_and_are_apart() -> None:
    spread = max(map(height, SPACE.spread(SPREAD, np.random.default_rng(0))))
    calls = []

    def rough(variant) -> float:
        calls.append(variant)
        return height(SPACE.to_unit(variant))

    points = far_points(SPACE, rough, lambda at: np.zeros(len(at)), np.random.default_rng(0))
    assert height(points[0]) > 5.0 * spread
    assert len(calls) < SPREAD / 3
    assert 2 <= len(points) <= BEST
    for index, one in enumerate(points):
        assert all(np.abs(one - other).max() >= APART for other in points[:index])


def test_what_probably_breaks_a_limit_is_not_bred() -> None:
    def forbidden(at: np.ndarray) -> np.ndarray:
        return np.where(at[:, 0] < 0.3, -50.0, 0.0)

    generator = np.random.default_rng(1)
    points = far_points(SPACE, lambda one: height(SPACE.to_unit(one)), forbidden, generator)
    assert min(point[0] for point in points) >= 0.3
    nowhere = far_points(SPACE, lambda _one: 0.0, forbidden, generator)
    assert nowhere == []
