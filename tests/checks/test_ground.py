"""Clearances against solids that are placed and measured; both checks fail where they must."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from manifold3d import Manifold
from support.built import body_in_plane, built, geared
from support.documented import documented_bases
from support.said import ways, well_told

from jumpcad.checks import ground
from jumpcad.checks.ground import BASIS, _body_discs, foot_findings, ground_findings
from jumpcad.checks.interference import Piece, Position, pieces_of, pose_of
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.parts.motor_socket import socket_outline
from jumpcad.robot import Robot
from jumpcad.solids.outline import rectangle
from jumpcad.solids.stack import Stack
from jumpcad.transforms import pose_about_y


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
    monkeypatch.setattr(ground, "pieces_of", lambda _: cubes)
    monkeypatch.setattr(ground, "pose_of", lambda piece, *_: piece.T_body_part)
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


@pytest.mark.parametrize(("width_mm", "height_mm"), [(10.0, 12.0), (5.0, 12.0), (16.0, 8.0)])
def test_the_motor_counts_with_its_corners(strongest: Robot, width_mm: float, height_mm: float) -> None:
    """A motor 80 mm further down is the lowest thing on the body: its socket holds its box, however it turns."""
    layout, lower = strongest.layout, np.array([0.0, -80.0])
    drive = layout.drive
    motor = drive.train.motor.model_copy(update={"width_mm": width_mm, "height_mm": height_mm})
    flat = replace(drive, train=replace(drive.train, motor=motor))
    sunk = replace(strongest, layout=replace(layout, drive=flat, motor_mm=layout.motor_mm + lower))
    (finding,) = ground_findings(sunk)
    assert "the body" in finding.message
    leg = np.linspace(-strongest.design.compression_rad, 0.0, 91)
    pose = strongest.linkage.pose(leg)
    up = np.stack([np.sin(pose.foot_rad), np.cos(pose.foot_rad)], axis=-1)
    middle = ((layout.motor_mm + lower - pose.ankle_mm) * up).sum(axis=1).min() + 1000.0 * strongest.foot_depth_m
    corner = middle - np.hypot(motor.width_mm, motor.height_mm) / 2.0
    around = np.hypot(motor.width_mm + 3.8, motor.height_mm + 3.8) / 2.0  # socket: 0.3 mm of play, walls of 1.6 mm
    ears = motor.height_mm / 2.0 + 1.6 + layout.cap_ear_mm
    assert middle - max(around, ears) - 0.1 <= finding.margin + 0.6 <= corner + 1e-6


def test_the_roller_counts_with_its_radius(strongest: Robot) -> None:
    """A lever of 150 mm that points 1 rad below the body at rest has its roller lowest; it turns with the leg."""
    layout = strongest.layout
    roller_mm = strongest.workshop.catalogue.bearings[strongest.workshop.bought.roller].outer_mm
    geometry = layout.drive.cam.geometry
    down = replace(geometry, lever_mm=150.0, lead_rad=-1.0 - geometry.axis_rad)
    cam = replace(layout.drive.cam, geometry=down)
    long = replace(strongest, layout=replace(layout, drive=replace(layout.drive, cam=cam)))
    (finding,) = ground_findings(long)
    assert "the roller" in finding.message
    lowest = np.inf
    for leg in np.linspace(-strongest.design.compression_rad, 0.0, 9):
        pose = strongest.linkage.pose([leg])
        foot = pose_about_y(float(pose.foot_rad[0]), pose.ankle_mm[0])
        lever = pose_about_y(1.0 + leg, layout.hub_mm)
        tip = np.linalg.inv(foot) @ lever @ np.array([150.0, 0.0, 0.0, 1.0])
        lowest = min(lowest, float(tip[2]))
    assert finding.margin + 0.6 == pytest.approx(lowest - roller_mm / 2.0 + 1000.0 * strongest.foot_depth_m, abs=1e-6)


@pytest.mark.parametrize("name", ["best-bo", "best-printable"])
def test_the_trays_count_with_their_ends(name: str) -> None:
    """The lower tray 100 mm further down: the lower of its two ends in the pose where it is lowest."""
    strongest = built(name)
    layout = strongest.layout
    tray = layout.tray_mm + np.array([0.0, -100.0])
    (finding,) = ground_findings(replace(strongest, layout=replace(layout, tray_mm=tray)))
    assert "the body" in finding.message
    pose = strongest.linkage.pose(np.linspace(-strongest.design.compression_rad, 0.0, 91))
    up = np.stack([np.sin(pose.foot_rad), np.cos(pose.foot_rad)], axis=-1)
    half = layout.electronics.length_mm / 2.0
    ends = [((tray + np.array([x, 0.0]) - pose.ankle_mm) * up).sum(axis=1).min() for x in (-half, half)]
    assert finding.margin + 0.6 == pytest.approx(min(ends) + 1000.0 * strongest.foot_depth_m, abs=0.02)


def lowest_mm(robot: Robot, middle: np.ndarray, reach: Callable[[np.ndarray], float]) -> float:
    """Return the least height above the ground of what `reach`es so far down from a middle, the foot flat."""
    found = np.inf
    for leg in np.linspace(-robot.design.compression_rad, 0.0, 9):
        pose = robot.linkage.pose([leg])
        up = np.array([np.sin(pose.foot_rad[0]), np.cos(pose.foot_rad[0])])
        found = min(found, float((middle - pose.ankle_mm[0]) @ up) - reach(up))
    return found + 1000.0 * robot.foot_depth_m


@pytest.mark.parametrize("depth_mm", [1.0, 9.0])
def test_the_stops_ears_count_with_their_corners(strongest: Robot, depth_mm: float) -> None:
    """A stop 80 mm further down: 2.5 mm of plate around a tab of 5 x 4 mm, or the bar of the pad's 8 mm between."""
    layout, stop = strongest.layout, strongest.layout.stop
    sunk = replace(stop, depth_mm=depth_mm, face_mm=stop.face_mm - np.array([0.0, 80.0]))
    (finding,) = ground_findings(replace(strongest, layout=replace(layout, stop=sunk)))
    assert "the body" in finding.message

    def box(along_mm: float, behind_mm: float) -> Callable[[np.ndarray], float]:
        return lambda up: abs(along_mm / 2.0 * stop.along @ up) + abs(behind_mm / 2.0 * stop.behind @ up)

    ear = lowest_mm(strongest, sunk.tab_mm, box(5.0 + 5.0, 4.0 + 5.0))
    bar = lowest_mm(strongest, sunk.middle_mm, box(8.0, depth_mm))
    assert finding.margin + 0.6 == pytest.approx(min(ear, bar), abs=1e-6)
    middles, _ = _body_discs(replace(strongest, layout=replace(layout, stop=sunk)))
    for middle, along, behind in ((sunk.tab_mm, 5.0, 4.5), (sunk.middle_mm, 4.0, depth_mm / 2.0)):
        for a, b in ((-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)):
            corner = middle + a * along * stop.along + b * behind * stop.behind
            assert np.linalg.norm(middles - corner, axis=1).min() < 1e-9


@pytest.mark.parametrize("what", ["axle", "standoff", "cam", "wheel", "idler", "coil"])
def test_round_things_count_with_their_radius(what: str) -> None:
    """Each of them 100 mm further down, in a robot with two pairs of gears; a cam of 60 mm is larger than its gear.

    The springs' coil, around the hub, is 150 mm wide instead.
    """
    robot = geared()
    layout, lower = robot.layout, np.array([0.0, -100.0])
    drive, axis = layout.drive, layout.cam_axis_mm + lower
    first, last = (stage.wheel.tip_radius_mm for stage in drive.train.stages)
    large = replace(drive, cam=replace(drive.cam, outer_radius_mm=60.0))
    idler, standoff = layout.idler_mm + lower, layout.standoffs_mm[0] + lower
    front, arms = layout.front_mm + lower, replace(drive.spring.arms, mean_mm=150.0 - drive.spring.wire_mm)
    wide = replace(drive, spring=replace(drive.spring, arms=arms))
    sunk, middle, radius = {
        "axle": (replace(layout, front_mm=front), front, layout.axle_mm / 2.0 + 3.0),
        "standoff": (replace(layout, standoffs_mm=(standoff, *layout.standoffs_mm[1:])), standoff, 4.5),
        "cam": (replace(layout, cam_axis_mm=axis, drive=large), axis, 60.0),
        "wheel": (replace(layout, cam_axis_mm=axis), axis, max(last, drive.cam.outer_radius_mm)),
        "idler": (replace(layout, idler_mm=idler), idler, first),
        "coil": (replace(layout, drive=wide), layout.hub_mm, 75.0),
    }[what]
    (finding,) = ground_findings(replace(robot, layout=sunk))
    assert "the body" in finding.message
    assert finding.margin + 0.6 == pytest.approx(lowest_mm(robot, middle, lambda up: radius), abs=1e-6)


def test_the_motor_s_socket_reaches_as_far_as_it_is_drawn() -> None:
    """In every direction, its cap's ears included: those of a motor of 12 mm reach 13.2 mm from its axis."""
    robot = built("kenan-2.0")
    layout = robot.layout
    alone = replace(layout, motor_mm=layout.motor_mm + np.array([0.0, -500.0]))  # nothing else is so low
    middles, radii = _body_discs(replace(robot, layout=alone))
    near = middles[:, 1] < -300.0
    drawn = np.vstack(socket_outline(alone).to_polygons())
    reach = np.linalg.norm(drawn - alone.motor_mm, axis=1).max()
    assert reach == pytest.approx(12.0 / 2.0 + 1.6 + 5.6, abs=0.01)
    for turn in np.radians(np.arange(0.0, 360.0, 5.0)):
        way = np.array([np.cos(turn), np.sin(turn)])
        assert (middles[near] @ way + radii[near]).max() == pytest.approx((drawn @ way).max(), abs=0.4)
        assert (middles[near] @ way + radii[near]).max() >= (drawn @ way).max() - 1e-3


@pytest.mark.parametrize(("axle_mm", "radius_mm"), [(2.0, 4.0), (4.0, 5.0), (1.0, 3.6)])
def test_plates_are_round_about_their_axles_by_three_millimetres(axle_mm: float, radius_mm: float) -> None:
    """And as wide as a clip of 6.3 mm (DIN 6799) with the plate's play, where a thin axle's seat is smaller."""
    robot = built("kenan-2.0")
    thin = replace(robot, layout=replace(robot.layout, axle_mm=axle_mm))
    middles, radii = _body_discs(thin)
    for place in robot.layout.axles.values():
        assert radius_mm in [
            pytest.approx(radius) for middle, radius in zip(middles, radii, strict=True) if np.allclose(middle, place)
        ]


def test_formulas_and_limits_are_those_of_the_reference() -> None:
    assert documented_bases(BASIS) == BASIS
