"""The motor's socket, measured on meshes: its seat, its ears, and what holds the motor in it."""

import math

import numpy as np
import pytest
import trimesh
from support.built import built, cut, hole_centres, inscribed_diameter, placed
from support.fits import SLIDING, TOLERANCE_MM

from jumpcad.robot.robot import Robot


def test_motor_seat(kenan: Robot) -> None:
    """The N20's gearbox is 10 by 12 mm; it slides into its socket, and M2 screws cut their thread beside it."""
    layout = kenan.layout
    segments = cut(placed(kenan, "body_plate_right"), layout.lateral.motor[1] - 2.0)
    assert inscribed_diameter(segments, layout.motor_mm) == pytest.approx(10.0 + 2 * SLIDING, abs=TOLERANCE_MM)
    across = np.array([-math.sin(layout.motor_angle_rad), math.cos(layout.motor_angle_rad)])
    inner = inscribed_diameter(segments, layout.motor_mm + 1.0 * across)
    assert inner == pytest.approx(10.0 + 2 * SLIDING, abs=TOLERANCE_MM)  # 1 mm along the long side: no corner yet
    ears = [centre for centre, width in hole_centres(segments).items() if width < 5.0]
    assert len(ears) == 2
    cap = cut(placed(kenan, "motor_cap"), layout.lateral.motor_cap[0] + 0.4)
    for ear in ears:
        assert inscribed_diameter(segments, np.array(ear)) == pytest.approx(1.6, abs=TOLERANCE_MM)
        assert inscribed_diameter(cap, np.array(ear)) == pytest.approx(2.4, abs=TOLERANCE_MM)


def pushed_mm3(robot: Robot, part: str, towards_left_mm: float) -> float:
    """Return what the motor's box, 1 um smaller on all sides, shares with a part when it is moved along its axis."""
    layout = robot.layout
    motor, (low, high) = layout.drive.train.motor, layout.lateral.motor
    box = trimesh.creation.box(np.array([motor.width_mm, high - low, motor.height_mm]) - 2e-3)
    box.apply_transform(trimesh.transformations.rotation_matrix(-layout.motor_angle_rad, (0.0, 1.0, 0.0)))
    x, z = layout.motor_mm
    box.apply_translation((x, (low + high) / 2.0 + towards_left_mm, z))
    both = box.intersection(placed(robot, part), engine="manifold")
    return 0.0 if both.is_empty else float(both.volume)


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo", "best-printable"])
def test_the_socket_s_floor_and_the_cap_hold_the_motor(name: str) -> None:
    """The N20's can is a circle of 12 mm with flats 10 mm apart: its end has 7.9 mm2 within 1 mm of either flat.

    In its place the motor is free, and pushed to either side it meets at least that.
    """
    robot = built(name)
    for part, away in (("body_plate_right", -0.5), ("motor_cap", 0.5)):
        assert pushed_mm3(robot, part, 0.0) == 0.0
        assert pushed_mm3(robot, part, away) / 0.5 > 2 * 7.9
    assert placed(robot, "motor_cap").bounds[0, 1] - rim_mm(robot) == pytest.approx(0.2, abs=1e-3)


def rim_mm(robot: Robot) -> float:
    """Return the y at which the wall beside the motor's wider side ends."""
    layout = robot.layout
    side = layout.motor_mm + 6.0 * np.array([math.cos(layout.motor_angle_rad), math.sin(layout.motor_angle_rad)])
    ends, _, _ = placed(robot, "body_plate_right").ray.intersects_location(
        [[side[0], layout.lateral.right_plate[0] - 1.0, side[1]]], [[0.0, 1.0, 0.0]]
    )
    return float(ends[:, 1].max())
