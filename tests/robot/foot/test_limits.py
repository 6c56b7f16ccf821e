"""Stresses of the foot by hand: cantilevers of solid plastic, and statics of two screws."""

import math
from dataclasses import replace

import numpy as np
import pytest
from manifold3d import Manifold
from support.built import LONG_TOES, body_in_plane, built
from support.said import ways, well_told
from support.strengths import changed, helped

from jumpcad.checks import springs_loaded
from jumpcad.checks.interference import Piece, Position, pieces_of, pose_of
from jumpcad.checks.springs_loaded import foot_findings
from jumpcad.findings import errors
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot.foot.limits import _toe_joint_mpa, ground_findings, toe_findings
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack


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


def lowest_above_ground_mm(robot: Robot, leg_rad: float, without: tuple[str, ...] = (FOOT,)) -> float:
    """Return the height of the lowest corner of any solid above the ground, except those of some bodies."""
    assert robot.layout is not None
    linkage = Linkage(robot.design)
    pose = linkage.pose([leg_rad])
    lowest = np.inf
    for piece in pieces_of(robot):
        if piece.body in without:
            continue
        placed: Manifold = piece.solid.transform(pose_of(piece, robot.layout, linkage, Position("", leg_rad, 0.0))[:3])
        corners = np.asarray(placed.to_mesh64().vert_properties)[:, [0, 2]]
        tilt = float(pose.foot_rad[0])  # of the foot below the body's x axis
        height = (corners - pose.ankle_mm[0]) @ np.array([np.sin(tilt), np.cos(tilt)])
        lowest = min(lowest, float(height.min()))
    return lowest + 1000.0 * robot.foot_depth_m


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_ground_clearance_is_below_every_solid(strongest: Robot, share: float) -> None:
    (finding,) = ground_findings(strongest)
    measured = lowest_above_ground_mm(strongest, -share * strongest.design.compression_rad)
    assert finding.severity == "info"
    assert finding.margin + 0.6 <= measured + 1e-3
    assert finding.margin + 0.6 == pytest.approx(measured, abs=0.05)  # the legs' ends, in every pose
    assert well_told(finding)
    assert "the legs' ends above the ground" in finding.message


def test_the_body_is_measured_where_it_is_lowest(strongest: Robot) -> None:
    assert strongest.layout is not None
    legless = replace(strongest.layout, sections=replace(strongest.layout.sections, eye_radius_mm=-1000.0))
    (finding,) = ground_findings(replace(strongest, layout=legless))
    measured = lowest_above_ground_mm(strongest, -strongest.design.compression_rad, (FOOT, MAIN_LEG, FRONT_LINK))
    assert "the body" in finding.message
    assert measured - 1.0 < finding.margin + 0.6 <= measured + 1e-3


def test_what_is_advised_to_lower_or_to_raise_lifts_the_body(strongest: Robot) -> None:
    """By 3 % of what lies between the springs' loaded pose and the ground."""
    legless = replace(strongest.layout, sections=replace(strongest.layout.sections, eye_radius_mm=-1000.0))
    (finding,) = ground_findings(replace(strongest, layout=legless))
    advised = ways(finding)
    assert {name for name, _ in advised} == {"compression_ratio", "rest_angle_deg"}
    for name, factor in advised:
        design = strongest.design.model_copy(update={name: factor * getattr(strongest.design, name)})
        layout = replace(legless, linkage=Linkage(design))
        (after,) = ground_findings(replace(strongest, design=design, layout=layout))
        assert after.margin > finding.margin, name


def test_ground_clearance_fires_on_a_shallow_foot(kenan: Robot) -> None:
    assert kenan.layout is not None
    shallow = replace(kenan.layout, sections=replace(kenan.layout.sections, foot_depth_mm=2.9))
    (finding,) = ground_findings(replace(kenan, layout=shallow))
    assert finding.severity == "error"
    assert finding.margin == pytest.approx(2.9 + 1.6 - 4.2 - 0.6)  # on pads of 1.6 mm; eyes of 4.2 mm radius


def test_ground_clearance_fires_on_a_body_that_hangs_down(kenan: Robot) -> None:
    assert kenan.layout is not None
    (finding,) = ground_findings(replace(kenan, layout=replace(kenan.layout, cam_axis_mm=np.array([-40.0, -90.0]))))
    assert finding.severity == "error"
    assert "the body" in finding.message


def test_foot_clearance_fires_on_a_battery_that_sinks(kenan: Robot) -> None:
    (silent,) = foot_findings(kenan)
    assert silent.severity == "info"
    hardware = []
    for item in kenan.hardware:
        pose = item.T_body_part.copy()
        if item.name == "battery":
            pose[2, 3] -= 80.0
        hardware.append(replace(item, T_body_part=pose))
    (finding,) = foot_findings(replace(kenan, hardware=tuple(hardware)))
    assert finding.severity == "error"
    assert "battery" in finding.message


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("gap_mm", [-2.9, 2.9, 3.1])
def test_gaps_of_up_to_3_mm_are_measured_on_all_sides_of_the_foot(
    kenan: Robot, monkeypatch: pytest.MonkeyPatch, axis: int, gap_mm: float
) -> None:
    """A cube of 10 mm of the body beside one of the foot."""
    cube, far, shift = Stack.of([(0.0, 10.0, rectangle((10.0, 10.0)))]), np.eye(4), abs(gap_mm) + 10.0
    far[axis, 3] = np.copysign(shift, gap_mm)
    cubes = [Piece("sole", FOOT, cube, np.eye(4)), Piece("cube", BODY, cube, far)]
    monkeypatch.setattr(springs_loaded, "pieces_of", lambda _: cubes)
    monkeypatch.setattr(springs_loaded, "pose_of", lambda piece, *_: piece.T_body_part)
    (finding,) = foot_findings(kenan)
    assert finding.value == (pytest.approx(2.9, abs=1e-4) if abs(gap_mm) < 3.0 else None)
    assert ("cube" in finding.message) == (abs(gap_mm) < 3.0)
    assert well_told(finding)
    assert finding.limit == 0.5


@pytest.mark.parametrize("name", ["front_eye_pin", "toe_right_pad"])
def test_whatever_is_on_the_foot_may_come_too_near(kenan: Robot, name: str) -> None:
    """A pin or pad of the foot, glued on where the battery is while the springs are loaded."""
    battery = next(item for item in kenan.hardware if item.name == "battery")
    x, y, z = battery.T_body_part[:3, :3] @ battery.shape.bounds_mm.mean(axis=0) + battery.T_body_part[:3, 3]
    there = np.linalg.solve(body_in_plane(kenan, FOOT, kenan.design.compression_rad), [x, z, 1.0])
    hardware = []
    for item in kenan.hardware:
        pose = item.T_body_part.copy()
        if item.name == name:
            pose[:3, 3] = [there[0], y, there[1]] - pose[:3, :3] @ item.shape.bounds_mm.mean(axis=0)
        hardware.append(replace(item, T_body_part=pose))
    (finding,) = foot_findings(replace(kenan, hardware=tuple(hardware)))
    assert (finding.severity, finding.value) == ("error", 0.0)
    assert "battery" in finding.message
