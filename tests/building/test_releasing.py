"""What the release is computed from: inertias and masses of the finished parts, by trimesh and handbook formulas."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.built import built, part
from support.strengths import with_own
from support.workshops import workshop_with

from jumpcad.building import releasing
from jumpcad.building.releasing import release_of
from jumpcad.drive.release import MovingParts
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop
from jumpcad.workshop.workshop import Role


@pytest.fixture(scope="module")
def robot() -> Robot:
    """Its parts weigh as much as solid ones: their density is the material's."""
    return built("kenan-2.0", mass_model="solid")


@pytest.fixture(scope="module")
def moving(robot: Robot) -> MovingParts:
    return moving_in(robot, robot.workshop)


def moving_in(robot: Robot, workshop: Workshop) -> MovingParts:
    """Return what moves of a robot, its lever printed in a workshop."""
    seen: list[Any] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(releasing, "release", lambda *given: seen.append(given))
        release_of(robot.layout, workshop, robot.parts, robot.hardware, robot.bodies, robot.spring)
    ((drive, found, _),) = seen
    assert drive is robot.layout.drive
    assert isinstance(found, MovingParts)
    return found


@pytest.mark.parametrize(
    ("name", "field", "axle"),
    [("cam", "cam_kg_m2", "cam"), ("cam_gear", "cam_gear_kg_m2", "cam"), ("motor_pinion", "pinion_kg_m2", "motor")],
)
def test_wheels_have_their_inertia_about_their_own_axle(
    robot: Robot, moving: MovingParts, name: str, field: str, axle: str
) -> None:
    """The mesh's tensor about its centre, and Steiner's term to the axle, along y."""
    found = part(robot, name)
    mesh = found.mesh.copy().apply_transform(found.placements[0].T_body_part).apply_scale(0.001)
    mesh.density = found.mass_kg / mesh.volume
    at = {"cam": robot.layout.cam_axis_mm, "motor": robot.layout.motor_mm}[axle]
    off = mesh.center_mass[[0, 2]] - np.asarray(at) / 1000.0
    expected = mesh.moment_inertia[1, 1] + found.mass_kg * float(off @ off)
    assert getattr(moving, field) == pytest.approx(expected, rel=2e-3)


def test_the_roller_moves_with_a_quarter_of_its_lever(robot: Robot, moving: MovingParts) -> None:
    """Rayleigh: 33/140 of a uniform cantilever; of a printed lever of that length, thickness and mean height."""
    sections, material = robot.layout.sections, robot.workshop.material("links")
    length, height = robot.layout.drive.cam.lever_length_mm, (sections.lever_root_mm + 9.0) / 2.0
    bearing = sum(item.mass_kg for item in robot.hardware if item.name.startswith("roller"))
    solid = 33.0 / 140.0 * length * height * sections.thickness_mm * material.density_g_cm3 * 1e-6
    more = moving.roller_kg - bearing
    assert bearing > 0.001
    assert 0.4 * solid < more <= solid
    filled = moving_in(robot, workshop_with(robot.workshop, process={"infill": 1.0}))
    assert filled.roller_kg - bearing == pytest.approx(solid, rel=1e-3)


@pytest.mark.parametrize(("role", "share"), [("links", 0.5), ("gears", 1.0), ("body", 1.0)])
def test_the_lever_is_printed_as_links_are(robot: Robot, moving: MovingParts, role: Role, share: float) -> None:
    bearing = sum(item.mass_kg for item in robot.hardware if item.name.startswith("roller"))
    found = moving_in(robot, with_own(robot.workshop, role, 0.5))
    assert found.lever_n_per_m == pytest.approx(share * moving.lever_n_per_m)
    assert found.roller_kg - bearing == pytest.approx(share * (moving.roller_kg - bearing))


def test_the_lever_bends_as_a_cantilever_that_tapers(robot: Robot, moving: MovingParts) -> None:
    """F/f = 3·E·I/L³; between that of its root's section and that of its eye's, less what infill leaves out."""
    sections, material = robot.layout.sections, robot.workshop.material("links")
    length = robot.layout.drive.cam.lever_length_mm / 1000.0
    stiffness = [
        3.0 * material.modulus_mpa * 1e6 * sections.thickness_mm * height**3 / 12.0 * 1e-12 / length**3
        for height in (9.0, sections.lever_root_mm)
    ]
    assert 0.4 * min(stiffness) < moving.lever_n_per_m <= max(stiffness)


def test_the_cam_runs_on_its_axle_with_the_running_fit(robot: Robot, moving: MovingParts) -> None:
    assert moving.bore_mm == pytest.approx(3.4)  # 0.2 mm around an axle of 3 mm
    thin = replace(robot, layout=replace(robot.layout, axle_mm=2.0))
    assert moving_in(thin, robot.workshop).bore_mm == pytest.approx(2.4)
    assert moving.spring is robot.spring
    assert math.isfinite(moving.leg.push_off_s(robot.spring, 0.0))
