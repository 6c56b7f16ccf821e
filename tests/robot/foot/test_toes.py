"""Separate toes, and holes that print lying."""

import math

import numpy as np
import pytest
from support.built import LONG_TOES, built, placed

from jumpcad.robot.foot.toes import lying_hole
from jumpcad.solids.outline import hole


@pytest.mark.parametrize("diameter", [2.9, 3.4])
def test_a_lying_hole_holds_its_shaft_under_a_roof_of_45_degrees(diameter: float) -> None:
    """Above the round no wall overhangs by more than 45°, up to a flat bridge of a quarter of the width."""
    region = lying_hole(diameter, (5.0, 7.0))
    points = np.concatenate(region.to_polygons()) - [5.0, 7.0]
    radius = diameter / 2.0
    assert np.hypot(*points.T).min() > 0.99 * radius
    assert (hole(diameter, (5.0, 7.0)) - region).area() < 1e-6
    assert points.min(axis=0) == pytest.approx([-radius, -radius], rel=2e-3)
    above = points[points[:, 1] > 0.75 * radius]
    flat = above[above[:, 1] > above[:, 1].max() - 1e-6]
    assert np.ptp(flat[:, 0]) == pytest.approx(0.264 * diameter, rel=0.01)
    assert above[:, 1].max() == pytest.approx(1.15 * radius)
    np.testing.assert_allclose(np.abs(above[:, 0]) + above[:, 1], math.sqrt(2.0) * radius, atol=0.02 * radius)


def test_toes_apart_are_mirror_images() -> None:
    robot = built(LONG_TOES)
    left, right = (placed(robot, name) for name in ("toe_left", "toe_right"))
    assert left.volume == pytest.approx(right.volume, rel=1e-5)
    np.testing.assert_allclose(left.center_mass * [1, -1, 1], right.center_mass, atol=2e-3)
    signs = np.array([[1, -1, 1], [-1, 1, -1], [1, -1, 1]])
    np.testing.assert_allclose(left.moment_inertia * signs, right.moment_inertia, rtol=1e-3, atol=100.0)
