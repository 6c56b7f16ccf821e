"""How far the neighbours of a proposal lie from it."""

import numpy as np
import pytest

from jumpcad.design import SEARCH_BOUNDS
from jumpcad.search.margin import STEEPNESS, _missed
from jumpcad.search.space import Space
from jumpcad.transforms import Array


class Level:
    """A surrogate that finds everything feasible with the same probability, and keeps what it was asked."""

    def __init__(self, probability: float) -> None:
        self.probability = probability

    def log_feasible(self, points: Array, spread: Array) -> Array:
        self.spread = spread
        return np.full(len(points), np.log(self.probability))


def test_neighbours_scatter_by_a_share_of_each_parameter() -> None:
    """1 % of 150 mm is 1.5 mm, of 0.4 it is 0.004: each over the width of its range."""
    space, level = Space.default(), Level(0.9)
    points = np.random.default_rng(0).random((5, 8))
    _missed(space, level, 0.95, 0.01)(points)  # type: ignore[arg-type]
    for point, spread in zip(points, level.spread, strict=True):
        values = space.to_design(point).to_vector()
        widths = [bounds.upper - bounds.lower for bounds in SEARCH_BOUNDS.values()]
        assert spread == pytest.approx([0.01 * value / width for value, width in zip(values, widths, strict=True)])


def test_only_what_misses_its_confidence_costs() -> None:
    point = np.full((1, 8), 0.5)
    sure = _missed(Space.default(), Level(0.96), 0.95, 0.01)  # type: ignore[arg-type]
    unsure = _missed(Space.default(), Level(0.90), 0.95, 0.01)  # type: ignore[arg-type]
    assert sure(point) == pytest.approx([0.0])
    assert unsure(point) == pytest.approx([STEEPNESS * np.log(0.95 / 0.90)])
