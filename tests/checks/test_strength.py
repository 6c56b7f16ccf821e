"""Every strength check seen to fire, and silent where nothing breaks."""

import math
from dataclasses import replace

import numpy as np
import pytest

from jumpcad.checks.strength import leg_axle_moment_nmm, strength_findings
from jumpcad.findings import errors
from jumpcad.robot import Robot


def changed(robot: Robot, role: str, **figures: float) -> Robot:
    """Return a robot whose workshop has other figures, in a role's material or in a section."""
    workshop = robot.workshop
    assert workshop is not None
    if role in ("links", "body", "gears"):
        name = workshop.material_name(role)  # type: ignore[arg-type]
        material = workshop.materials[name].model_copy(update=figures)
        return replace(
            robot, workshop=workshop.model_copy(update={"materials": {**workshop.materials, name: material}})
        )
    section = getattr(workshop, role).model_copy(update=figures)
    return replace(robot, workshop=workshop.model_copy(update={role: section}))


def margins(robot: Robot) -> dict[str, float]:
    return {finding.name: finding.margin for finding in strength_findings(robot)}


def test_silent_on_what_was_sized_for_it(kenan: Robot, strongest: Robot) -> None:
    assert not errors(strength_findings(kenan))
    assert not errors(strength_findings(strongest))
    assert all(finding.severity == "info" for finding in strength_findings(kenan))


WEAK_LINKS = (
    "leg_strength", "hub_strength", "lever_strength", "front_link_strength", "eye_strength", "toe_strength",
    "toe_landing", "rail_strength",
)  # fmt: skip


@pytest.mark.parametrize(
    ("role", "figures", "names"),
    [
        ("links", {"strength_in_plane_mpa": 0.3}, WEAK_LINKS),
        ("links", {"strength_interlayer_mpa": 0.3}, ("foot_lug_strength",)),
        ("links", {"modulus_mpa": 100.0}, ("leg_flex", "front_link_buckling")),
        ("body", {"strength_in_plane_mpa": 5.0}, ("plate_seat",)),
        ("gears", {"strength_interlayer_mpa": 0.5}, ("cam_key_strength",)),
        ("safety", {"steel_yield_mpa": 5.0},
         ("leg_axle_strength", "cam_axle_strength", "spring_pin_strength", "foot_pin_strength")),
        ("safety", {"steel_factor": 20.0}, ("roller_screw_strength",)),
        ("safety", {"landing_stop_mm": 0.3}, ("front_link_buckling", "toe_landing")),
    ],
)  # fmt: skip
def test_each_fires_in_a_workshop_that_cannot_bear_it(
    kenan: Robot, role: str, figures: dict[str, float], names: tuple[str, ...]
) -> None:
    broken = {finding.name for finding in errors(strength_findings(changed(kenan, role, **figures)))}
    assert set(names) <= broken
    if "strength_interlayer_mpa" not in figures or role == "gears":
        assert len(broken) < len(margins(kenan))


def test_hub_bearings_warn_when_the_springs_overload_them(strongest: Robot) -> None:
    # 118 N from the springs' arms and 77 N from the cam, against two MR63 of 75 N each
    (finding,) = [found for found in strength_findings(strongest) if found.name == "hub_bearing_load"]
    assert (finding.severity, finding.unit) == ("warning", "N")
    assert -33.0 < finding.margin < 0.0


def test_leg_stress_by_hand(kenan: Robot) -> None:
    # at the hub: M·c/I of 8 x 6 mm with 1.35 mm walls, 0.9 mm layers and a fifth of the core, plus force over area
    assert kenan.plan is not None
    assert (kenan.plan.sections.leg_root_mm, kenan.plan.sections.thickness_mm) == (8.0, 6.0)
    core_width, core_height = 6.0 - 1.8, 8.0 - 2.7
    second = (6.0 * 8.0**3 - 0.8 * core_width * core_height**3) / 12.0
    bending = 1000.0 * kenan.design.peak_spring_torque_nm * 4.0 / second
    stress = 15.0 - margins(kenan)["leg_strength"]
    assert bending < stress < bending + 0.3


def test_leg_axle_is_a_simple_beam() -> None:
    # without springs: M = F·L/4 (Shigley, table A-9); arms that pull in one line only shear the axle beside the leg
    none = np.zeros(2)
    assert leg_axle_moment_nmm((none, none), np.array([0.0, 80.0]), 40.0, 8.0) == pytest.approx(80.0 * 40.0 / 4.0)
    up = np.array([0.0, 50.0])
    assert leg_axle_moment_nmm((up, -up), none, 40.0, 8.0) == pytest.approx(50.0 * 40.0 / 4.0)
    # both arms push the coil the same way: the leg's half goes straight back into the axle, 8 mm beside it
    sideways = leg_axle_moment_nmm((up, none), none, 40.0, 8.0)
    assert sideways == pytest.approx(25.0 * 8.0)


def test_twice_the_spring_torque_bends_twice_as_much(kenan: Robot) -> None:
    doubled = kenan.design.model_copy(update={"stiffness_nmm_per_deg": 2.0 * kenan.design.stiffness_nmm_per_deg})
    assert kenan.plan is not None
    robot = replace(kenan, design=doubled, plan=replace(kenan.plan, design=doubled))
    before, after = 15.0 - margins(kenan)["hub_strength"], 15.0 - margins(robot)["hub_strength"]
    assert after == pytest.approx(2.0 * before)
    assert math.isfinite(after)
