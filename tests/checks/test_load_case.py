"""What strength checks share: the leg's axle as a simple beam."""

import math

import numpy as np
import pytest
from support.built import built

from jumpcad.checks.load_case import LoadCase, leg_axle_moment_nmm


def test_leg_axle_is_a_simple_beam() -> None:
    # without springs: M = F·L/4 (Shigley, table A-9); arms that pull in one line only shear the axle beside the leg
    none = np.zeros(2)
    assert leg_axle_moment_nmm((none, none), np.array([0.0, 80.0]), 40.0, 8.0) == pytest.approx(80.0 * 40.0 / 4.0)
    up = np.array([0.0, 50.0])
    assert leg_axle_moment_nmm((up, -up), none, 40.0, 8.0) == pytest.approx(50.0 * 40.0 / 4.0)
    # both arms push the coil the same way: the leg's half goes straight back into the axle, 8 mm beside it
    sideways = leg_axle_moment_nmm((up, none), none, 40.0, 8.0)
    assert sideways == pytest.approx(25.0 * 8.0)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_arms_forces_turn_leg_and_plates_with_the_springs_torque(name: str) -> None:
    """A pin is pushed away from the hub, square to its arm; winding is counter-clockwise seen from the right.

    So the leg is pushed back clockwise, and the plates the other way with the same torque.
    """
    robot = built(name)
    spring, case = robot.layout.drive.spring, LoadCase(robot)
    (on_leg, on_pin), _ = case.wound_forces_n
    loaded = spring.leg_pin_rad + robot.design.compression_rad
    for force, angle, sense in ((on_leg, loaded, -1.0), (on_pin, spring.plate_pin_rad, 1.0)):
        x, z = spring.pin_radius_mm * math.cos(angle), spring.pin_radius_mm * math.sin(angle)
        assert x * force[1] - z * force[0] == pytest.approx(sense * 1000.0 * robot.spring.peak_torque_nm)
        assert (x * force[0] + z * force[1]) / math.hypot(*force) > spring.arms.mean_mm / 2.0
