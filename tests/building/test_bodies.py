"""Bodies are the sum of their parts' meshes and touch the ground where the design says; pins rub at their radius."""

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.built import LONG_TOES, built
from support.each import each
from support.workshops import workshop_with

from jumpcad.building.bodies import _contacts, friction_of
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Friction
from jumpcad.robot.robot import Robot
from jumpcad.solids.stl import to_trimesh


def pieces(robot: Robot, body: str) -> list[tuple[trimesh.Trimesh, float]]:
    """Return mesh (m, in the body's frame) and mass of everything on a body."""
    found = [
        (part.mesh.copy().apply_transform(place.T_body_part), part.mass_kg)
        for part in robot.parts
        for place in part.placements
        if place.body == body
    ]
    found += [
        (to_trimesh(item.solid).apply_transform(item.T_body_part), item.mass_kg)
        for item in robot.hardware
        if item.body == body
    ]
    return [(mesh.apply_scale(0.001), mass) for mesh, mass in found]


@each("name", ["kenan-2.0", LONG_TOES])
@each("body", BODY_NAMES)
def test_bodies_are_the_sum_of_their_meshes(name: str, body: str) -> None:
    """Mass, centre and tensor of every mesh by trimesh, and Steiner's theorem."""
    robot = built(name, mass_model="solid")
    assert {part.mass_source for part in robot.parts} == {"solid"}
    masses, centres, tensors = [], [], []
    for mesh, mass in pieces(robot, body):
        mesh.density = mass / mesh.volume
        masses.append(mass)
        centres.append(mesh.center_mass)
        tensors.append(mesh.moment_inertia)
    total = sum(masses)
    centre = np.average(centres, axis=0, weights=masses)
    inertia = np.zeros((3, 3))
    for mass, at, tensor in zip(masses, centres, tensors, strict=True):
        arm = at - centre
        inertia += tensor + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    found = robot.bodies[body]
    assert found.mass_kg == pytest.approx(total, rel=1e-9)
    np.testing.assert_allclose(found.com_m, centre, atol=1e-6)
    # Meshes leave out what is below 0.05 mm: kenan-2.0's main leg alone has its centre 0.9 µm off, on an arm of 30 mm.
    np.testing.assert_allclose(found.inertia_kg_m2, inertia, atol=4e-5 * np.abs(inertia).max())


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_body_tensors_belong_to_bodies(name: str) -> None:
    for body in built(name).bodies.values():
        low, middle, high = np.linalg.eigvalsh(body.inertia_kg_m2)
        assert 0 < low <= middle <= high < low + middle
        np.testing.assert_allclose(body.inertia_kg_m2, body.inertia_kg_m2.T, atol=1e-18)


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
def test_what_touches_the_ground_is_where_the_design_says(name: str) -> None:
    """Foot: nose at the front eye, tips at the toes' length and angle; body: both ends of its strut."""
    robot = built(name)
    design = robot.design
    angle = math.radians(design.ground_link_angle_deg)
    x, y = -design.l5_mm * math.cos(angle), design.l5_mm * math.sin(angle)
    feet = {one.name: 1000.0 * one.centre_m for one in robot.bodies[FOOT].contacts}
    assert feet["front_eye"] == pytest.approx([design.l4_mm, 0.0, 0.0])
    assert feet["left_toe"][:2] == pytest.approx([x, y])
    assert feet["right_toe"][:2] == pytest.approx([x, -y])
    for one in robot.bodies[FOOT].contacts:
        assert one.centre_m[2] - one.radius_m == pytest.approx(-robot.foot_depth_m)
    sections, (_, *toes) = robot.layout.sections, robot.bodies[FOOT].contacts
    for toe in toes:  # from the pad's lower face to its upper one, around the printed tip
        assert 2000.0 * toe.radius_m == pytest.approx(sections.toe_tip_height_mm + 2.0 * sections.pad_mm)
    ends = {one.name: (1000.0 * one.centre_m, 1000.0 * one.radius_m) for one in robot.bodies[BODY].contacts}
    for end, sign in (("back", -1.0), ("front", 1.0)):
        assert ends[end][0] == pytest.approx([sign * design.l1_mm / 2.0, 0.0, 0.0])
        assert ends[end][1] == pytest.approx(1.5 + 3.0)  # a seat of 3 mm around an axle of 3 mm


@pytest.mark.parametrize("axle_mm", [2.0, 4.0])
def test_the_bodys_ends_are_as_thick_as_their_seats_around_the_axles(axle_mm: float) -> None:
    """A seat of 3 mm around an axle; the ground is that far from its middle."""
    ends = _contacts(replace(built("kenan-2.0").layout, axle_mm=axle_mm))[BODY]
    assert [1000.0 * one.radius_m for one in ends] == pytest.approx([axle_mm / 2.0 + 3.0] * 2)


def test_pins_rub_at_their_radius_and_a_ball_bearing_does_not() -> None:
    robot = built("kenan-2.0")
    assert robot.layout.hub_bearing is not None
    assert robot.friction.pin_radius_m == (0.0, 0.0015, 0.0015, 0.0015)
    assert built("kenan-2.0", leg_bearing="").friction.pin_radius_m == (0.0015,) * 4
    rough = workshop_with(pins={"friction": 0.4}, ground={"friction": 0.7, "bare_friction": 0.5})
    rubbing = Friction(foot=0.7, body=0.5, pin=0.4, pin_radius_m=(0.0, 0.002, 0.002, 0.002))
    assert friction_of(replace(robot.layout, axle_mm=4.0), rough) == rubbing
