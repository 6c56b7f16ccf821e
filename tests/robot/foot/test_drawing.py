"""The foot with its toes, measured on meshes: where pins and toe tips are, flat on the ground."""

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.built import LONG_TOES, built, cut, hole_centres, placed
from support.each import each
from support.fits import with_fits_apart

from jumpcad.building import layout_of
from jumpcad.design import load_design
from jumpcad.mechanism.model import FOOT
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.foot import drawing as foot_part
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop

ONE_PIECE = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"]
TIP_RADIUS_MM = 2.5


def toes_of(robot: Robot, sign: float) -> trimesh.Trimesh:
    if robot.layout.toes_apart:
        return placed(robot, "toe_left" if sign > 0 else "toe_right")
    return placed(robot, "foot").slice_plane([0, sign * 0.5, 0], [0, sign, 0])


@pytest.mark.parametrize("name", [*ONE_PIECE, LONG_TOES])
def test_pins_are_one_link_apart(name: str) -> None:
    robot = built(name)
    y = robot.layout.lateral.lug_left[0] + 1.0
    holes = hole_centres(cut(placed(robot, "foot"), y))
    # the roof above a lying hole makes its box higher than wide, but leaves its middle where it is along x
    assert sorted(x for x, _ in holes)[0] == pytest.approx(0.0, abs=2e-3)
    assert sorted(x for x, _ in holes)[-1] == pytest.approx(robot.design.l4_mm, abs=2e-3)


@each("sign", [1.0, -1.0])
@each("name", [*ONE_PIECE, LONG_TOES])
def test_toe_tips_are_where_the_design_says(name: str, sign: float) -> None:
    """A tip's disc is the farthest that the foot reaches in several directions; together they give its middle."""
    robot = built(name)
    angle = math.radians(robot.design.ground_link_angle_deg)
    tip = robot.design.l5_mm * np.array([-math.cos(angle), sign * math.sin(angle)])
    flat = toes_of(robot, sign).vertices[:, :2]
    directions = np.array([[math.cos(a), math.sin(a)] for a in math.atan2(tip[1], tip[0]) + np.radians([-25, 0, 25])])
    reach = (flat @ directions.T).max(axis=0) - TIP_RADIUS_MM
    middle, *_ = np.linalg.lstsq(directions, reach, rcond=None)
    np.testing.assert_allclose(middle, tip, atol=0.02)


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
def test_contact_spheres_touch_the_ground_inside_the_parts(name: str) -> None:
    robot = built(name)
    meshes = {sign: toes_of(robot, sign) for sign in (1.0, -1.0)}
    for sphere in robot.bodies[FOOT].contacts:
        x, y, z = 1000.0 * sphere.centre_m
        assert z - 1000.0 * sphere.radius_m == pytest.approx(-1000.0 * robot.foot_depth_m, abs=1e-9)
        if "toe" in sphere.name:
            mesh = meshes[float(np.sign(y))]
            assert np.abs(mesh.vertices[:, :2] - [x, y]).sum(axis=1).min() < 2.0 * TIP_RADIUS_MM


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_ankles_pin_fits_its_lugs_and_its_ends_have_room_outside(name: str, side: float) -> None:
    """In the lugs a hole as wide as a lying pin needs; beyond the faces that keep the pin, room for head and clip."""
    robot = built(name)
    fits, (inner, _) = robot.workshop.fits, robot.layout.lateral.lug_left
    mesh = placed(robot, "foot")
    in_lug = hole_centres(cut(mesh, side * (inner + 1.0)))
    widths = [width for (x, _), width in in_lug.items() if abs(x) < 0.01]
    assert widths == [pytest.approx(robot.layout.axle_mm + 2.0 * fits.lying_mm, abs=0.05)]
    face = robot.layout.ankle_face_mm
    assert not mesh.contains([[2.2, side * (face + 0.3), 0.0]])[0]
    assert mesh.contains([[2.2, side * (face - 0.3), 0.0]])[0]


@pytest.mark.parametrize("angle_deg", [55.0, 80.0])
def test_the_ankles_pin_goes_in_past_the_toes(angle_deg: float) -> None:
    """Its head, or its clip, has 7 mm of room about the pin's axis from the boss's face outwards, past both toes."""
    design = load_design("best-bo").model_copy(update={"ground_link_angle_deg": angle_deg})
    layout = layout_of(design, load_workshop())
    mesh, depth = foot_part.foot(layout, load_workshop()).mesh, layout.sections.foot_depth_mm
    face = layout.ankle_face_mm
    turns = np.radians(np.arange(0.0, 360.0, 30.0))
    rim = [[3.4 * np.cos(turn), 3.4 * np.sin(turn)] for turn in turns]
    for y in np.arange(face + 0.1, face + 12.0, 0.2):
        assert not mesh.contains([[x, side * y, depth + z] for side in (-1.0, 1.0) for x, z in [(0, 0), *rim]]).any(), y


@pytest.mark.parametrize("axle_mm", [2.0, 3.0, 5.0])
def test_the_ankles_boss_has_two_walls_around_its_pin_and_more_than_its_ends_have_room(axle_mm: float) -> None:
    """Round about the ankle, and as wide down to the sole; the ends of a pin have 7 mm of room outside it."""
    robot = built("kenan-2.0")
    layout = replace(robot.layout, axle_mm=axle_mm)
    holes = replace(HoleSizes.of(with_fits_apart(robot.workshop), layout.hub_bearing), axle_mm=axle_mm)
    fits = holes.fits
    low_x, low_z, high_x, high_z = foot_part._ankle_boss(layout, holes).bounds()
    outer = max(8.0, axle_mm + 2.0 * fits.lying_mm + 4.0 * fits.wall_mm)
    assert (-low_x, high_x, high_z) == pytest.approx([outer / 2.0] * 3, abs=1e-6)
    assert low_z == pytest.approx(-layout.sections.foot_depth_mm)
