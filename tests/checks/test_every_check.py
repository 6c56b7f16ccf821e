"""Every limit that `check` knows is violated in a test: here those that no other file violates.

Limits of the drive are those of its synthesis, which keeps them; a finished drive violates a tighter limit.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.built import LONG_TOES, built, checked
from support.each import each
from support.limits import default_limits
from support.places import TESTS

from jumpcad.building import build
from jumpcad.building.releasing import release_of
from jumpcad.catalogue import load_catalogue
from jumpcad.checks.printability import bed_findings
from jumpcad.checks.strength import strength_findings
from jumpcad.design import load_design
from jumpcad.drive import CamLimits, synthesise
from jumpcad.drive.cam_findings import LIMITS
from jumpcad.drive.cam_limits import ROWS, measure
from jumpcad.drive.gear_pair import gear_pair
from jumpcad.drive.spring_choice import synthesise_spring
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.drive.train import finished_train
from jumpcad.findings import errors
from jumpcad.robot import Robot

USUAL = default_limits()
DRIVE = synthesise(built("kenan-2.0").design, USUAL)


def test_every_name_stands_in_a_test() -> None:
    names = {finding.name for name in ("kenan-2.0", LONG_TOES) for finding in checked(name)}
    tests = TESTS
    texts = "\n".join(path.read_text() for path in (*tests.glob("*.py"), *tests.glob("checks/*.py")))
    assert len(names) > 45
    assert {name for name in names if name not in texts} == set()


@each(
    ("name", "tighter"),
    [
        ("cam_pressure_angle", {"pressure_angle_rad": 0.01}),
        ("cam_undercut", {"undercut_margin_mm": 200.0}),
        ("cam_contact", {"pressure_mpa": 1.0}),
        ("cam_roller_load", {"roller_load_n": 1.0}),
        ("cam_core", {"core_radius_mm": 100.0}),
        ("cam_hub", {"hub_radius_mm": 100.0}),
        ("cam_drop", {"reserve_rad": 6.0}),
        ("cam_next_lift", {"clearance_mm": 100.0}),
        ("cam_overshoot", {"overshoot_rad": 3.0}),
        ("cam_place", {"axis_min_rad": 3.0}),
    ],
)
def test_cam(name: str, tighter: dict[str, float]) -> None:
    cam = DRIVE.cam
    axis = math.hypot(*cam.cam_axis_mm)
    lead = cam.lever_start_rad - math.atan2(cam.cam_axis_mm[1], cam.cam_axis_mm[0])
    shape = np.array([[cam.lever_length_mm, axis - cam.lever_length_mm, lead]])

    def margin(limits: CamLimits) -> float:
        _, rows, _ = measure(cam.law, limits, shape, 400)
        return min(float(row[0]) for row, limit in zip(rows, ROWS, strict=True) if LIMITS[limit].name == name)

    usual = replace(USUAL.cam, hub_radius_mm=max(USUAL.cam.hub_radius_mm, DRIVE.spring.outer_diameter_mm / 2.0))
    assert margin(usual) >= -1e-6
    assert margin(replace(usual, **tighter)) < 0.0


@pytest.mark.parametrize(
    ("name", "tighter"),
    [
        ("gear_strength_1", {"stress_mpa": 0.01}),
        ("gear_strength_2", {"stress_mpa": 0.01}),
        ("cam_gear_room", {"cam_gear_tip_max_mm": 3.0}),
        ("motor_torque", {"stall_share": 1e-3}),
        ("cam_speed", {"cam_speed_max_rad_s": 0.01}),
        ("gear_mesh_1", {}),
        ("gear_mesh_2", {}),
    ],
)
def test_gears_and_motor(name: str, tighter: dict[str, Any]) -> None:
    good, law = gear_pair(15, 30, 1.25, 5.0, 0.15), DRIVE.cam.law
    # pulled apart by two thirds of a tooth's height: the next teeth meet after these part
    poor = replace(good, centre_distance_mm=good.centre_distance_mm + 1.8)
    stages = (poor, poor) if name.startswith("gear_mesh") else (good, good)
    train = finished_train(law, DRIVE.train.motor, stages, replace(USUAL.train, **tighter))
    (finding,) = [finding for finding in train.findings if finding.name == name]
    assert finding.margin < 0.0
    usual = finished_train(law, DRIVE.train.motor, (good, good), replace(USUAL.train, cam_speed_max_rad_s=50.0))
    assert all(finding.margin > 0.0 for finding in usual.findings if finding.name == name)


def test_release(kenan: Robot) -> None:
    """A rigid key loses energy and hits the motor; a motor as quick as a fan brings the next lift under the roller."""
    shop = kenan.workshop
    rigid = shop.model_copy(update={"release": shop.release.model_copy(update={"play_deg": 0.0})})
    broken = {finding.name for finding in errors(build(load_design("best-bo"), rigid).release.findings)}
    assert {"release_energy", "release_kick"} <= broken
    train = kenan.layout.drive.train
    quick = replace(train, cam_speed_rad_s=10.0 * train.cam_speed_rad_s)
    layout = replace(kenan.layout, drive=replace(kenan.layout.drive, train=quick))
    found = release_of(layout, shop, kenan.parts, kenan.hardware, kenan.bodies, kenan.spring)
    assert [finding.name for finding in errors(found.findings)] == ["release_window"]


def test_spring_stress() -> None:
    """The margin is what a tighter limit than the spring's own stress takes away."""
    design, wire = built("kenan-2.0").design, load_catalogue().wire
    spring = synthesise_spring(springs_on_leg(design), -1.5, wire, USUAL.spring)
    (finding,) = spring.findings
    assert finding.name == "spring_stress"
    assert finding.margin == pytest.approx(USUAL.spring.stress_share * spring.tensile_mpa - spring.stress_mpa)


def test_toe_joint() -> None:
    robot = built(LONG_TOES)
    assert robot.workshop is not None
    name = robot.workshop.material_name("links")
    weak = robot.workshop.materials[name].model_copy(update={"strength_in_plane_mpa": 0.3})
    workshop = robot.workshop.model_copy(update={"materials": {**robot.workshop.materials, name: weak}})
    broken = errors(strength_findings(replace(robot, workshop=workshop)))
    assert "toe_joint_strength" in {finding.name for finding in broken}


def test_bed(kenan: Robot) -> None:
    assert kenan.workshop is not None
    bed = kenan.workshop.printer.model_copy(update={"bed_mm": (100.0, 90.0, 50.0)})
    tiny = replace(kenan, workshop=kenan.workshop.model_copy(update={"printer": bed}))
    (finding,) = errors(bed_findings(tiny))
    assert finding.name == "bed_fit"
    assert finding.message.startswith("foot")
