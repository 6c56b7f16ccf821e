"""The sensor against the cam gear's mesh: how deep its plunger is pressed over a turn, by rays of another program."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from support.built import built, geared, placed
from support.workshops import workshop_with

from jumpcad.building import build
from jumpcad.bundle.firmware import numbers
from jumpcad.design import load_design
from jumpcad.robot.robot import Robot
from jumpcad.robot.sensor.limits import sensor_findings

OPERATES_MM, TOLERANCE_MM, FREE_MM, TOTAL_MM = 10.4, 0.2, 11.2, 9.1
"""Omron D2HW data sheet, page 6: positions of the pin plunger without posts, from the base."""
MORE_PLAY_MM, LESS_PLAY_MM = 0.5, 0.1
"""How far the gear can go to the right and to the left: half a millimetre in two gaps of its axle, its hub's play."""


def plunger_mm(robot: Robot, cam_rad: np.ndarray) -> np.ndarray:
    """Return the distance (n,) from the switch's base to what is below its plunger, gear in the middle of its play."""
    mesh = placed(robot, "cam_gear")
    (sensor,) = [item for item in robot.hardware if item.name == "sensor"]
    base = sensor.T_body_part @ [0.0, 0.0, 0.0, 1.0]  # drawn from the base, its face on the bed
    axis = robot.layout.cam_axis_mm
    offset = np.array([base[0], base[2]]) - axis
    # the gear turns clockwise in x-z: the plunger goes around it counter-clockwise
    cos, sin = np.cos(cam_rad), np.sin(cam_rad)
    x = axis[0] + cos * offset[0] - sin * offset[1]
    z = axis[1] + sin * offset[0] + cos * offset[1]
    starts = np.column_stack([x, np.full(len(x), base[1]), z])
    hits, rays, _ = mesh.ray.intersects_location(starts, np.tile([0.0, -1.0, 0.0], (len(x), 1)), multiple_hits=False)
    distance = np.full(len(x), np.inf)
    distance[rays] = base[1] - hits[:, 1]
    return distance + (MORE_PLAY_MM - LESS_PLAY_MM) / 2.0


@pytest.mark.parametrize("make", [lambda: built("kenan-2.0"), lambda: built("best-bo"), geared])
def test_the_land_presses_the_plunger_before_the_drop_and_nowhere_else(make: Callable[[], Robot]) -> None:
    robot = make()
    sensor, lift = robot.layout.sensor, math.degrees(robot.layout.drive.cam.law.lift_rad)
    degrees = np.arange(0.0, 360.0, 0.25)
    below = plunger_mm(robot, np.radians(degrees))
    ready, opens = lift - math.degrees(sensor.ready_rad), lift + math.degrees(sensor.open_rad)
    pressed = degrees[below < OPERATES_MM]
    step = math.degrees(robot.workshop.process.layer_height_mm / sensor.radius_mm)
    assert pressed[0] == pytest.approx(ready, abs=step)
    assert pressed[-1] == pytest.approx(opens, abs=step)
    assert (np.diff(pressed) == 0.25).all()
    axial = 0.45
    assert below.min() + axial < OPERATES_MM - TOLERANCE_MM
    assert below.min() - axial > TOTAL_MM
    ramp = math.degrees(2.5 / sensor.radius_mm)
    outside = below[(degrees < ready - ramp) | (degrees > opens + ramp)]
    assert outside.min() - axial > FREE_MM
    found = {finding.name: finding for finding in sensor_findings(robot)}
    assert all(finding.severity == "info" for finding in found.values())
    assert found["sensor_overtravel"].margin == pytest.approx(below.min() - axial - TOTAL_MM, abs=0.01)
    assert found["sensor_free"].margin == pytest.approx(outside.min() - axial - FREE_MM, abs=0.01)
    assert found["sensor_ready"].margin == pytest.approx(robot.workshop.seats.sensor_reserve_deg)


@pytest.mark.parametrize("cam_rad_s", [0.5, 30.0, 40.0])
def test_the_motor_stands_before_the_next_lift_though_it_runs_on(cam_rad_s: float) -> None:
    """0.06 s at the cam's speed after the sensor has opened at the latest; the lift takes 310°."""
    robot = built("kenan-2.0")
    layout, sensor = robot.layout, robot.layout.sensor
    train = replace(layout.drive.train, cam_speed_rad_s=cam_rad_s)
    quick = replace(robot, layout=replace(layout, drive=replace(layout.drive, train=train)))
    (found,) = (one for one in sensor_findings(quick) if one.name == "sensor_open")
    opens, scatter = math.degrees(sensor.open_rad), math.degrees(sensor.scatter_rad)
    left = 50.0 - opens - scatter - math.degrees(0.06 * cam_rad_s)
    assert found.value == pytest.approx(min(opens - scatter, left))
    assert (left < opens - scatter) == (cam_rad_s > 1.0)


def test_the_firmware_waits_for_the_same_angle() -> None:
    robot = built("kenan-2.0")
    assert numbers(robot)["READY_DEG"] == pytest.approx(math.degrees(robot.layout.sensor.ready_rad), abs=0.05)


@pytest.mark.parametrize(
    ("seats", "name"),
    [({"sensor_axial_mm": 0.6}, "sensor_press"), ({"sensor_stop_s": 0.0}, ""),
     ({"sensor_along_mm": 3.0, "sensor_reserve_deg": 20.0}, "sensor_open")],
)  # fmt: skip
def test_scatter_beyond_the_switchs_travel_is_an_error(seats: dict[str, float], name: str) -> None:
    robot = build(load_design("best-bo"), workshop_with(seats=seats))
    wrong = [finding.name for finding in sensor_findings(robot) if finding.severity == "error"]
    assert (name in wrong) if name else not wrong
