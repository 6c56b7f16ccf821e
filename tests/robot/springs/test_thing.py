"""The wire of the springs as it is seen, and what to order: turns of the coil, ends of the arms, figures."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad.drive import TorsionSpring
from jumpcad.robot.springs.thing import coil_with_arm, leg_arm_wire

HUB, ENDS = np.array([-40.0, 3.0]), (16.0, 6.0)


@pytest.fixture(params=[0.0, math.radians(7.0)], ids=["relaxed at rest", "preloaded"])
def spring(request: pytest.FixtureRequest) -> TorsionSpring:
    return replace(built("kenan-2.0").layout.drive.spring, preload_rad=request.param)


def turned_rad(points: np.ndarray) -> float:
    """The angle by which points (n, 2) go around the origin, counter-clockwise."""
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    return float(angle[-1] - angle[0])


def test_a_coil_has_the_springs_turns_from_the_outer_y_to_the_inner(spring: TorsionSpring) -> None:
    """Closed further by the preload; no chord is more than 0.9 % inside the circle, and none longer than another."""
    wire = coil_with_arm(HUB, spring, ENDS)
    assert wire.diameter_mm == spring.wire_mm
    coil = wire.points_mm[1:] - [HUB[0], 0.0, HUB[1]]
    mean = (spring.inside_diameter_mm + spring.wire_mm) / 2.0
    assert np.hypot(coil[:, 0], coil[:, 2]) == pytest.approx(mean)
    assert turned_rad(coil[:, ::2]) == pytest.approx(2.0 * math.pi * spring.turns + spring.preload_rad)
    middles = (coil[1:] + coil[:-1]) / 2.0
    assert np.hypot(middles[:, 0], middles[:, 2]).min() > (1.0 - 0.009) * mean
    assert (coil[0, 1], coil[-1, 1]) == ENDS
    rise = np.diff(coil[:, 1])
    assert rise == pytest.approx(-10.0 / (len(coil) - 1))
    assert len(coil) == 1 + math.ceil(24.0 * (spring.turns + spring.preload_rad / (2.0 * math.pi)))


def test_the_legs_arm_has_the_end_of_the_coil_that_winding_adds(spring: TorsionSpring) -> None:
    """As steep as the coil, up to where the arm leaves it in the inner plane, as a tangent of its length."""
    points = leg_arm_wire(spring, ENDS).points_mm
    coil, end = points[:-1], points[-1]
    mean = (spring.inside_diameter_mm + spring.wire_mm) / 2.0
    assert np.hypot(coil[:, 0], coil[:, 2]) == pytest.approx(mean)
    middles = (coil[1:] + coil[:-1]) / 2.0
    assert np.hypot(middles[:, 0], middles[:, 2]).min() > (1.0 - 0.009) * mean  # by chords as short as the body's
    wound = spring.wound_rad - spring.preload_rad
    assert turned_rad(coil[:, ::2]) == pytest.approx(wound)
    whole = 2.0 * math.pi * spring.turns + spring.preload_rad
    assert coil[0, 1] - coil[-1, 1] == pytest.approx(10.0 * wound / whole)
    assert coil[-1, 1] == end[1] == ENDS[1]
    assert math.dist(coil[-1], end) == pytest.approx(spring.arm_length_mm, abs=1e-4)
    assert (end - coil[-1])[::2] @ coil[-1][::2] == pytest.approx(0.0, abs=1e-3)
