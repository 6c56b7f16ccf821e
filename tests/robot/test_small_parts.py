"""Small printed parts, measured on their meshes."""

import math

import numpy as np
import pytest
from support.built import built, cut, inscribed_diameter, placed
from support.fits import RUNNING, TOLERANCE_MM

from jumpcad.robot.robot import Robot


@pytest.mark.parametrize("side", ["left", "right"])
def test_bushings_turn_on_the_axle_and_fill_the_wound_spring(kenan: Robot, side: str) -> None:
    lateral, spring = kenan.layout.lateral, kenan.layout.drive.spring
    coil = lateral.spring_left if side == "left" else lateral.spring_right
    segments = cut(placed(kenan, f"spring_bushing_{side}"), sum(coil) / 2.0)
    centred = segments.reshape(-1, 2) - kenan.layout.hub_mm
    assert inscribed_diameter(segments, kenan.layout.hub_mm) == pytest.approx(RUNNING, abs=TOLERANCE_MM)
    outside = 2.0 * np.hypot(*centred.T).max()
    mean = spring.outer_diameter_mm - spring.wire_mm
    turns_wound = kenan.design.compression_rad / (2 * math.pi)
    inside_wound = mean * spring.turns / (spring.turns + turns_wound) - spring.wire_mm  # Shigley 10-12
    assert outside < inside_wound
    assert outside == pytest.approx(inside_wound - 0.3, abs=0.01)


def at_hub(robot: Robot, name: str) -> np.ndarray:
    """Return the y at which a printed part of the body has points within 5 mm of the leg's axle."""
    points = placed(robot, name).vertices
    return points[np.hypot(*(points[:, ::2] - robot.layout.hub_mm).T) < 5.0, 1]


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_rollers_screw_clears_the_cam_gear_with_all_play_against_it(name: str) -> None:
    """The leg goes left until a bushing meets the plate; the gear right, until cam and gear meet the cam's spacer."""
    robot = built(name)
    bushing, plate = (at_hub(robot, name) for name in ("spring_bushing_left", "body_plate_left"))
    leg_play = plate.min() - bushing.max() + bushing.min() - placed(robot, "main_leg").bounds[1, 1]
    assert 2.0 * leg_play == pytest.approx(0.6, abs=1e-3)  # as much to the right
    gear, cam, spacer = (placed(robot, one).bounds[:, 1] for one in ("cam_gear", "cam", "cam_spacer_right"))
    levels = np.unique(placed(robot, "cam").vertices[:, 1].round(6))
    shoulder = levels[levels < gear[0]].max()
    gear_play = gear[0] - shoulder + cam[0] - spacer[1]
    screw = next(item for item in robot.hardware if item.name == "roller_screw")
    head = screw.shown_mesh.copy().apply_transform(screw.T_body_part).bounds[1, 1]
    assert head + leg_play < gear[0] - gear_play - 0.1


def test_front_link_and_cam_gear_have_half_a_millimetre_beside_what_is_pushed_away(kenan: Robot) -> None:
    """The axial gap between parts that move past each other, shared by both ends of a spacer, and by cam and gear."""
    low, high = kenan.layout.lateral.inside
    right, link, left = (
        placed(kenan, one).bounds[:, 1] for one in ("front_spacer_right", "front_link", "front_spacer_left")
    )
    assert high - np.ptp(left) - link[1] == pytest.approx(0.5, abs=1e-3)
    assert link[0] - np.ptp(right) - low == pytest.approx(0.5, abs=1e-3)
    gear, cam, spacer = (placed(kenan, one) for one in ("cam_gear", "cam", "cam_spacer_right"))
    levels = np.unique(cam.vertices[:, 1].round(6))
    shoulder = levels[levels < gear.bounds[0, 1]].max()
    assert gear.bounds[0, 1] - shoulder == pytest.approx(0.25, abs=1e-3)
    assert cam.bounds[0, 1] - spacer.bounds[1, 1] == pytest.approx(0.25, abs=1e-3)
