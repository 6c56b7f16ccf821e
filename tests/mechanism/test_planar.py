"""Bodies in a plane: momenta of a dumb-bell, and places by the law of cosines."""

import math

import numpy as np
import pytest
from support.built import body_in_plane, built

from jumpcad.mechanism.model import BODY_NAMES, FOOT, MAIN_LEG
from jumpcad.mechanism.planar import about_common_centre, dot, points, seen_from_foot


def test_a_dumb_bell_turns_about_its_middle() -> None:
    """Masses of 1 and 3 kg, 4 m apart: 3 m and 1 m from their centre; turning at 2 rad/s clockwise (below x)."""
    mass, inertia, rate = np.array([1.0, 3.0]), np.array([0.1, 0.2]), np.array([2.0, 2.0])
    place = np.array([5.0 + 1.0j, 9.0 + 1.0j])
    drift = 7.0 - 2.0j  # of the centre, which has no momentum about itself
    velocity = drift - 1j * 2.0 * (place - (8.0 + 1.0j))
    momentum, double, whole = about_common_centre(mass, inertia, place, velocity, rate)
    about = 1.0 * 9.0 + 3.0 * 1.0 + 0.3
    assert whole == pytest.approx(about)
    assert momentum == pytest.approx(2.0 * about)
    assert double == pytest.approx(4.0 * about)


def test_vectors_are_complex_numbers() -> None:
    assert points(np.array([[3.0, 4.0], [-1.0, 2.0]])).tolist() == [3.0 + 4.0j, -1.0 + 2.0j]
    assert dot(np.array(3.0 + 4.0j), np.array(-1.0 + 2.0j)) == 5.0


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0"])
@pytest.mark.parametrize("share", [0.0, 0.6, 1.0])
def test_bodies_are_where_the_law_of_cosines_puts_them(share: float, name: str) -> None:
    """Centres of mass, seen from the ankle along the foot: distances and angles of an independent solution.

    The foot of kenan-2.0 never turns; that of kenan-1.0 does.
    """
    robot = built(name)
    wind = share * robot.design.compression_rad
    place, turn = (row[0] for row in seen_from_foot(robot.bodies, robot.linkage, np.array([-wind])))
    foot = body_in_plane(robot, FOOT, wind)
    for name, found, angle in zip(BODY_NAMES, place, turn, strict=True):
        pose = np.linalg.inv(foot) @ body_in_plane(robot, name, wind)
        com = pose @ [*(1000.0 * robot.bodies[name].com_m[[0, 2]]), 1.0]
        assert (1000.0 * found.real, 1000.0 * found.imag) == pytest.approx((com[0], com[1]), abs=1e-6)
        assert math.remainder(angle + math.atan2(pose[1, 0], pose[0, 0]), 2.0 * math.pi) == pytest.approx(0, abs=1e-9)
    (alone,), _ = seen_from_foot(robot.bodies, robot.linkage, np.array([-wind]), (MAIN_LEG,))
    assert alone == pytest.approx(place[BODY_NAMES.index(MAIN_LEG)])
