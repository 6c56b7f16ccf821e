"""Every figure of a workshop reaches its own limit of the drive."""

import math
from dataclasses import fields, replace
from typing import Any

import pytest
from support.built import built
from support.each import each
from support.strengths import with_motor_of, with_own

from jumpcad.building.limits import drive_limits
from jumpcad.catalogue import load_catalogue
from jumpcad.design import load_design
from jumpcad.drive import DriveLimits
from jumpcad.drive.release import _kick_limit_nm
from jumpcad.mechanism.linkage import Linkage
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.sizing import sections
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.workshop import Role

SECTIONS = sections(Linkage(load_design("kenan-2.0")), load_workshop())
ROLLER = load_catalogue().bearings["623"]


def limits(workshop: Workshop) -> DriveLimits:
    return drive_limits(workshop, ROLLER, SECTIONS, HoleSizes.of(workshop, None))


def changed(table: str, **values: Any) -> Workshop:
    workshop = load_workshop()
    return workshop.model_copy(update={table: getattr(workshop, table).model_copy(update=values)})


@each(
    ("table", "key", "value", "of", "names"),
    [
        ("safety", "spring_stress_share", 0.3, "spring", {"stress_share"}),
        ("safety", "motor_stall_share", 0.2, "train", {"stall_share"}),
        ("safety", "motor_torque_max_nm", 0.1, "train", {"torque_max_nm", "blocked_nm"}),
        ("safety", "gear_efficiency", 0.8, "train", {"pair_efficiency"}),
        ("safety", "strength_factor", 5.0, "train", {"stress_mpa"}),
        ("fits", "backlash_circumferential_mm", 0.3, "train", {"backlash_circumferential_mm"}),
        ("fits", "press_mm", 0.15, "train", {"shaft_wall_mm"}),
        ("fits", "wall_mm", 1.4, "train", {"pinion_root_min_mm", "shaft_wall_mm"}),
        ("release", "play_deg", 30.0, "cam", {"play_rad"}),
        ("fits", "sliding_mm", 0.4, "spring", {"mandrel_min_mm", "pin_radius_min_mm"}),
        ("process", "line_width_mm", 0.6, "train", {"tip_min_mm"}),
    ],
)
def test_a_figure_of_the_workshop_is_a_limit(table: str, key: str, value: float, of: str, names: set[str]) -> None:
    before, after = limits(load_workshop()), limits(changed(table, **{key: value}))
    one, other = getattr(before, of), getattr(after, of)
    assert {field.name for field in fields(one) if getattr(one, field.name) != getattr(other, field.name)} == names


@pytest.mark.parametrize(
    ("role", "names"), [("gears", {"stress_mpa", "modulus_mpa", "shakedown_mpa"}), ("links", set()), ("body", set())]
)
def test_teeth_and_cam_are_as_strong_and_stiff_as_what_gears_are_printed_in(role: Role, names: set[str]) -> None:
    """The stress of their teeth, also at the release, and the modulus under the roller; nothing of the drive else."""
    usual, weak = load_workshop(), with_own(load_workshop(), role, 0.5)
    before, after = limits(usual), limits(weak)
    found = {
        field.name: getattr(getattr(after, of), field.name) / getattr(getattr(before, of), field.name)
        for of in ("cam", "train", "spring")
        for field in fields(getattr(before, of))
        if getattr(getattr(before, of), field.name) != getattr(getattr(after, of), field.name)
    }
    assert found == dict.fromkeys(names, pytest.approx(0.5))
    drive = built("kenan-2.0").layout.drive
    kick = _kick_limit_nm(drive, with_motor_of(weak, 1e6)) / _kick_limit_nm(drive, with_motor_of(usual, 1e6))
    assert kick == pytest.approx(0.5 if role == "gears" else 1.0)


def test_springs_that_last_longer_are_stressed_less() -> None:
    """Shigley, table 10-10: 50 % of the tensile strength for a million jumps."""
    assert limits(changed("safety", jumps=1e6)).spring.stress_share == pytest.approx(0.5 / 1.05)


def test_a_thick_lever_or_dog_pushes_the_cam_away() -> None:
    workshop, holes = load_workshop(), HoleSizes.of(load_workshop(), None)
    thick = drive_limits(workshop, ROLLER, replace(SECTIONS, lever_root_mm=20.0, dog_mm=20.0), holes)
    assert thick.dog_mm == 20.0
    usual = limits(workshop)
    assert thick.cam.gap_min_mm == pytest.approx(usual.cam.gap_min_mm + 10.0 - 4.5)
    corner = (20.0 - SECTIONS.dog_mm) / 2.0
    assert thick.cam.core_radius_mm == pytest.approx(usual.cam.core_radius_mm + corner)
    assert thick.train.cam_gear_root_min_mm == pytest.approx(usual.train.cam_gear_root_min_mm + corner)


def test_a_cam_lets_the_leg_swing_to_its_stop_and_into_the_pad() -> None:
    """With a stop two degrees farther past rest, two degrees more."""
    far = changed("body", stop_deg=load_workshop().body.stop_deg + 2.0)
    more = limits(far).cam.overshoot_rad - limits(load_workshop()).cam.overshoot_rad
    assert math.degrees(more) == pytest.approx(2.0)
