"""Stresses of the foot by hand: cantilevers of solid plastic, and statics of two screws."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.built import LONG_TOES, built
from support.strengths import changed, helped

from jumpcad.findings import errors
from jumpcad.robot.foot.toe_limits import _toe_joint_mpa, toe_findings
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot


def found(case: LoadCase) -> dict[str, float | None]:
    return {finding.name: finding.value for finding in toe_findings(case.robot)}


def tapered_mpa(force_n: float, length_mm: float, widths_mm: tuple[float, float], heights_mm: tuple[float, float]):
    """Return the largest 6·M/(b·h²) of a cantilever from root to tip with a force at its tip."""
    share = np.linspace(0.0, 1.0, 2001)
    width, height = (low + share * (high - low) for low, high in (widths_mm, heights_mm))
    return float((6.0 * force_n * length_mm * (1.0 - share) / (width * height**2)).max())


@pytest.fixture
def solid(kenan: Robot) -> LoadCase:
    """Kenan 2.0 of solid plastic, with bars of 20 mm across its toes."""
    apart = float(kenan.layout.toe_half_width_mm) + 20.0
    wide = replace(kenan, layout=replace(kenan.layout, toe_half_width_mm=apart))
    return LoadCase(changed(wide, "process", infill=1.0))


def test_toes_and_rails_are_cantilevers(solid: LoadCase) -> None:
    """Both tips share the push-off's force; at a landing one of them may be alone. A rail ends where its toe does."""
    design, sections, both = solid.robot.design, solid.layout.sections, solid.toes_n
    toe = (sections.toe_width_mm, 5.0), (sections.toe_root_mm, sections.toe_tip_height_mm)
    stresses = found(solid)
    assert stresses["toe_strength"] == pytest.approx(tapered_mpa(both / 2.0, design.l5_mm, *toe), rel=5e-3)
    assert stresses["toe_landing"] == pytest.approx(tapered_mpa(solid.toe_blow_n, design.l5_mm, *toe), rel=5e-3)
    behind = design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg))
    rail = (sections.lug_thickness_mm, sections.lug_thickness_mm), (sections.rail_root_mm, sections.rail_tip_mm)
    assert stresses["rail_strength"] == pytest.approx(tapered_mpa(both / 2.0, behind, *rail), rel=5e-3)


def test_a_rail_is_twisted_by_what_its_toes_tip_is_beside_it(solid: LoadCase) -> None:
    """A lug of 4 mm, half a gap of 1 mm beside the leg; √3·T/(b·c²)·(3 + 1.8·c/b), to half the strength of PETG."""
    design, sections = solid.robot.design, solid.layout.sections
    beside = design.l5_mm * math.sin(math.radians(design.ground_link_angle_deg)) - sections.thickness_mm / 2.0 - 2.5
    short, long = sorted((4.0, sections.rail_root_mm))
    twisted = math.sqrt(3.0) * solid.toes_n / 2.0 * beside / (long * short**2) * (3.0 + 1.8 * short / long)
    (twist,) = (finding for finding in toe_findings(solid.robot) if finding.name == "rail_twist")
    assert twist.value == pytest.approx(twisted)
    assert twist.margin == pytest.approx(45.0 / 2.0 - twisted)
    assert twist.grows == "rail"


def test_a_bar_across_a_toe_is_bent_and_twists_the_toes_tip(solid: LoadCase) -> None:
    """5 mm wide and as high as the tip: 6·M/(b·h²), or √3·M/(b·c²)·(3 + 1.8·c/b) with b the longer side."""
    height, moment = solid.layout.sections.toe_tip_height_mm, 20.0 * solid.toe_blow_n
    short, long = sorted((5.0, height))
    twisted = math.sqrt(3.0) * moment / (long * short**2) * (3.0 + 1.8 * short / long)
    assert found(solid)["toe_bar_strength"] == pytest.approx(max(6.0 * moment / (5.0 * height**2), twisted))


def test_the_outer_screw_of_a_separate_toe_bears_the_moment_about_the_inner_one() -> None:
    """16 and 30 mm from the root; the tapped hole is pressed more, the one that the screw passes has less around it."""
    case = LoadCase(built(LONG_TOES))
    fits, sections = case.workshop.fits, case.layout.sections
    tip = max(case.toes_n / 2.0, case.toe_blow_n)
    force = tip * (case.robot.design.l5_mm - 16.0) / 14.0
    height = max(sections.toe_root_mm, fits.m3_clearance_mm + 4.0 * fits.wall_mm)
    pressed = force / (fits.m3_tap_mm * sections.toe_width_mm)
    torn = math.sqrt(3.0) * force / ((height - fits.m3_clearance_mm) * sections.toe_width_mm)
    assert found(case)["toe_joint_strength"] == pytest.approx(max(pressed, torn))
    assert "toe_joint_strength" not in found(LoadCase(built("kenan-2.0")))


def test_a_landing_on_one_toe_bends_and_twists_the_inclined_leg(solid: LoadCase) -> None:
    """The moment's part across the leg 6·M/(h·b²), along it √3 times the shear of torsion; worst where it is lowest."""
    sections, angle = solid.layout.sections, math.radians(solid.robot.design.rest_angle_deg)
    thick, height = sections.thickness_mm, sections.leg_tip_mm
    moment = solid.toe_blow_n * solid.layout.toe_half_width_mm
    short, long = sorted((thick, height))
    bent = 6.0 * moment * math.sin(angle) / (height * thick**2)
    twisted = math.sqrt(3.0) * moment * math.cos(angle) / (long * short**2) * (3.0 + 1.8 * short / long)
    assert found(solid)["leg_sideways"] == pytest.approx(math.hypot(bent, twisted))


def test_a_hollow_leg_is_bent_sideways_between_its_layers(kenan: Robot) -> None:
    """It prints lying: its layers bear most, farthest from the middle of its thickness, its walls are at its edges."""
    case = LoadCase(kenan)
    shell, thick, angle = case.shell, case.layout.sections.thickness_mm, math.radians(case.robot.design.rest_angle_deg)
    height = case.layout.sections.leg_tip_mm
    moment = case.toe_blow_n * case.layout.toe_half_width_mm
    core = (height - 2.0 * shell.walls_mm) * (thick - 2.0 * shell.layers_mm) ** 3
    second = (height * thick**3 - (1.0 - shell.core_share) * core) / 12.0
    short, long = sorted((thick, height))
    twisted = math.sqrt(3.0) * moment * math.cos(angle) / (long * short**2) * (3.0 + 1.8 * short / long)
    bent = moment * math.sin(angle) * thick / 2.0 / second
    assert found(case)["leg_sideways"] == pytest.approx(math.hypot(bent, twisted))


@pytest.mark.parametrize("hole_mm", [2.0, 3.4, 8.0])
def test_toes_that_are_screwed_on_bear_beside_the_workshops_own_holes(kenan: Robot, hole_mm: float) -> None:
    """The tap in the stub, half as wide as the hole in the toe: bearing or tear-out, whichever is worst."""
    case = LoadCase(changed(kenan, "fits", m3_clearance_mm=hole_mm, m3_tap_mm=hole_mm / 2.0))
    sections, wall = case.layout.sections, case.workshop.fits.wall_mm
    width, height = sections.toe_width_mm, max(sections.toe_root_mm, hole_mm + 4.0 * wall)
    force = 10.0 * (case.layout.design.l5_mm - 16.0) / 14.0  # lever about the inner of two screws 14 mm apart
    pressed = [force / (bore * width) for bore in (hole_mm / 2.0, hole_mm)]
    torn = [math.sqrt(3.0) * force / ((height - bore) * width) for bore in (hole_mm / 2.0, hole_mm)]
    assert _toe_joint_mpa(case, 10.0) == pytest.approx(max(*pressed, *torn))


def test_what_is_advised_to_lower_or_to_raise_helps_the_foot(strongest: Robot) -> None:
    found = helped(strongest, toe_findings)
    assert {"toe_strength", "rail_strength", "rail_twist", "toe_landing", "leg_sideways"} <= found


def test_weak_plastic_does_not_hold_toes_that_are_screwed_on() -> None:
    weak = changed(built(LONG_TOES), "links", strength_in_plane_mpa=0.3)
    assert "toe_joint_strength" in {one.name for one in errors(toe_findings(weak))}
