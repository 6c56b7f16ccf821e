"""What stands and moves between the plates: each as wide as it is, and kept clear of by 0.8 mm."""

from dataclasses import replace

import numpy as np
import pytest
from support.built import body_in_plane, built

from jumpcad.layout.obstacles import LEVER_HEAD_MM, cam_obstacles, swept_obstacles
from jumpcad.layout.room import Obstacle
from jumpcad.mechanism.model import MAIN_LEG
from jumpcad.robot import Robot

APART_MM = 0.8
"""Between things that do not touch."""
SCREW_HEAD_MM = 1.65
"""Height of the head of an M3 screw (ISO 7380-1)."""


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


def swept(robot: Robot, *given: float, reach_rad: float = 0.1) -> dict[str, Obstacle]:
    """Return what a robot's links sweep, by name."""
    layout = robot.layout
    found = swept_obstacles(layout.linkage, layout.sections, layout.drive, layout.lateral, reach_rad, *given)
    return {one.name: one for one in found}


def test_the_lever_takes_its_screw_with_the_head_to_the_left(robot: Robot) -> None:
    """Its interval of y is that of the screw, and a head's height more towards the left, which is up along y."""
    right, left = swept(robot)["lever"].y_mm
    screw = robot.layout.lateral.roller_screw
    assert right == screw[0]
    assert SCREW_HEAD_MM <= left - screw[1] < SCREW_HEAD_MM + 0.1
    assert left - screw[1] == pytest.approx(LEVER_HEAD_MM)


@pytest.mark.parametrize("reach_rad", [0.0, 0.2])
def test_links_sweep_from_the_loaded_springs_to_as_far_past_rest_as_is_asked_for(
    robot: Robot, reach_rad: float
) -> None:
    """The ankle is on a circle about the hub, the roller's axis on another, ahead by the lever's angle."""
    found, cam, hub = swept(robot, reach_rad=reach_rad), robot.layout.drive.cam, robot.layout.hub_mm
    for wind in (robot.spring.wind_rad, -reach_rad):
        ankle = body_in_plane(robot, MAIN_LEG, wind) @ [robot.design.l2_mm, 0.0, 1.0]
        assert np.linalg.norm(found["main leg"].points_mm - ankle[:2], axis=1).min() < 1e-6
        turn = cam.lever_start_rad + wind
        roller = hub + cam.lever_length_mm * np.array([np.cos(turn), np.sin(turn)])
        assert np.linalg.norm(found["lever"].points_mm - roller, axis=1).min() < 1e-6
    reached = np.linalg.norm(found["lever"].points_mm - hub, axis=1).max()
    assert reached == pytest.approx(cam.lever_length_mm)
    ankles = found["main leg"].points_mm[np.linalg.norm(found["main leg"].points_mm - hub, axis=1) > 1.0] - hub
    turns = np.arctan2(-ankles[:, 1], ankles[:, 0])
    rest = np.radians(robot.design.rest_angle_deg)
    assert (turns.min(), turns.max()) == pytest.approx((rest - robot.spring.wind_rad, rest + reach_rad))


def test_cam_dog_and_gear_follow_each_other_on_their_axle(robot: Robot) -> None:
    """Without a gap between them along y: the dog is as long as cam and gear are apart; each is as wide as it is.

    Of two pairs of gears the cam's gear is the wheel of the last one.
    """
    layout, axis = robot.layout, np.array([7.0, 9.0])
    stage = layout.drive.train.stages[-1]
    wheel = replace(stage.wheel, teeth=stage.wheel.teeth + 20)
    train = replace(layout.drive.train, stages=(stage, replace(stage, wheel=wheel)))
    lateral = replace(layout.lateral, gears=(layout.lateral.gears[0], (50.0, 60.0)))
    drive = replace(layout.drive, train=train)
    found = cam_obstacles(axis, drive, lateral)
    cam, dog, gear, axle = found
    assert [one.name for one in found] == ["cam", "cam's dog", "cam gear", "cam axle"]
    assert cam.y_mm[1] == dog.y_mm[0]
    assert dog.y_mm[1] == gear.y_mm[0]
    assert (cam.y_mm, gear.y_mm, axle.y_mm) == (lateral.cam, lateral.gears[0], lateral.inside)
    assert wheel.tip_radius_mm > stage.wheel.tip_radius_mm + 1.0
    reach = {"cam": drive.cam.outer_radius_mm, "cam's dog": drive.dog.outer_mm / 2.0, "cam gear": wheel.tip_radius_mm,
             "cam axle": 3.2}  # fmt: skip
    assert {one.name: one.radius_mm for one in found} == pytest.approx(
        {name: radius + APART_MM for name, radius in reach.items()}
    )
    for one in found:
        assert one.points_mm.tolist() == [[7.0, 9.0]]
