"""Clearances against solids that are placed and measured; both checks fail where they must."""

from dataclasses import replace

import numpy as np
import pytest
from manifold3d import Manifold
from support.built import body_in_plane
from support.said import ways, well_told

from jumpcad.checks import foot_clearance
from jumpcad.checks.foot_clearance import foot_findings
from jumpcad.checks.interference import Piece, Position, pieces_of, pose_of
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.robot.foot.limits import ground_findings
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack


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
    monkeypatch.setattr(foot_clearance, "pieces_of", lambda _: cubes)
    monkeypatch.setattr(foot_clearance, "pose_of", lambda piece, *_: piece.T_body_part)
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
