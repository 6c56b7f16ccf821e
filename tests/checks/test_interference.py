"""Interference: none in the templates, and exact for parts that are pushed into one another."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from support.built import checked, in_body
from support.said import well_told

from jumpcad.checks import interference
from jumpcad.checks.interference import (
    Piece,
    Position,
    interference_findings,
    overlaps,
    pieces_of,
    pose_of,
    positions,
    shared_volume_mm3,
)
from jumpcad.findings import errors
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.parts.part import lying_on_left
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import disc, rectangle
from jumpcad.solids.stack import Stack


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_silent_on_kenan_and_on_the_strongest(name: str) -> None:
    (found,) = (one for one in checked(name) if one.name == "interference")
    assert (found.severity, found.limit) == ("info", 0.05)


def test_fires_on_a_lever_that_meets_a_misplaced_motor(kenan: Robot) -> None:
    assert kenan.layout is not None
    shift = kenan.layout.hub_mm - kenan.layout.motor_mm
    hardware = []
    for item in kenan.hardware:
        pose = item.T_body_part.copy()
        if item.name == "motor":
            pose[[0, 2], 3] += shift
        hardware.append(replace(item, T_body_part=pose))
    found = errors(interference_findings(replace(kenan, hardware=tuple(hardware))))
    assert any("motor" in finding.message and "main_leg" in finding.message for finding in found)
    assert all(finding.margin == 0.05 - finding.value < 0.0 for finding in found)
    assert {finding.limit for finding in found} == {0.05}
    assert all(map(well_told, found))


@pytest.mark.parametrize("side", ["left", "right"])
def test_fires_on_a_plates_pin_in_the_way_of_the_legs_arm(kenan: Robot, side: str) -> None:
    """The pin that holds the springs' other arms stands in the middle of a leg's arm as it is at rest."""
    arm = next(one for one in pieces_of(kenan) if one.name == f"spring_{side}_leg_arm")
    pin = next(item for item in kenan.hardware if item.name == "spring_pin")
    middle = pose_of(arm, kenan.layout, kenan.linkage, Position("at rest", 0.0, 0.0)) @ arm.corners.mean(axis=0)
    pose = pin.T_body_part.copy()
    pose[[0, 2], 3] += middle[[0, 2]] - kenan.layout.spring_pin_mm
    hardware = tuple(replace(item, T_body_part=pose) if item is pin else item for item in kenan.hardware)
    found = errors(interference_findings(replace(kenan, hardware=hardware)))
    assert any("spring_pin" in finding.message and arm.name in finding.message for finding in found)


@pytest.mark.parametrize("name", ["eye", "cam"])
def test_what_meets_in_one_position_only_is_found_there_with_all_that_it_shares(
    kenan: Robot, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """A disc on the leg's ankle, or 12 mm beside the cam's axis, comes nearer to a post of its size and covers it."""
    cam_axis, at = kenan.layout.cam_axis_mm, positions(kenan)[7]
    if name == "eye":
        body, start = MAIN_LEG, np.array([kenan.design.l2_mm, 0.0])
        met = in_body(kenan, MAIN_LEG, -at.leg_rad, start)
    else:
        body, start = BODY, cam_axis + np.array([12.0, 0.0])
        met = cam_axis + 12.0 * np.array([np.cos(at.cam_rad), -np.sin(at.cam_rad)])  # about +y, which carries z to x
    slab = Stack.of([(0.0, 4.0, disc(8.0))])
    mover = Piece(name, body, slab, lying_on_left(2.0, *start))
    post = Piece("post", BODY, slab, lying_on_left(2.0, *met))
    monkeypatch.setattr(interference, "pieces_of", lambda _: [mover, post])
    ((*pair, label, volume),) = overlaps(kenan)
    assert pair == [name, "post"]
    assert label.endswith(f" {-np.degrees(at.leg_rad):.1f}°")
    assert volume == pytest.approx(np.pi * 16.0 * 4.0, rel=5e-3)


@pytest.mark.parametrize("turned", [False, True])
def test_volume_of_two_boxes(turned: bool) -> None:
    box = Stack.of([(0.0, 4.0, rectangle((10.0, 6.0)))])
    piece = Piece("box", BODY, box, np.eye(4))
    pose = np.eye(4)
    pose[:3, 3] = 8.0, 1.0, 1.5
    if turned:  # about x by a quarter turn: y becomes z, z becomes -y
        pose[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
        # y from -3 to 1 + 0, z from -1.5 to 4.5: shares 2 x 4 x 4 mm of the first box
        assert shared_volume_mm3(piece, np.eye(4), piece, pose) == pytest.approx(2.0 * 4.0 * 4.0, rel=1e-5)
    else:
        assert shared_volume_mm3(piece, np.eye(4), piece, pose) == pytest.approx(2.0 * 5.0 * 2.5, rel=1e-5)


@pytest.mark.parametrize("across", [1.0, -1.0])
def test_plates_that_lie_on_each_other_share_areas_times_heights(
    monkeypatch: pytest.MonkeyPatch, across: float
) -> None:
    """Discs of 12 mm, 1.5 mm of their heights in each other, one of them upside down or not: no mesh is cut."""
    monkeypatch.setattr(Piece, "solid", property(lambda _: pytest.fail("a mesh")))
    plate, pose = Piece("plate", BODY, Stack.of([(0.0, 4.0, disc(12.0))]), np.eye(4)), np.eye(4)
    pose[1, 1], pose[2, 2], pose[2, 3] = across, across, 2.5 if across > 0.0 else 6.5
    assert shared_volume_mm3(plate, np.eye(4), plate, pose) == pytest.approx(1.5 * np.pi * 36.0, rel=5e-3)


def in_plane(pose: np.ndarray) -> np.ndarray:
    """The motion (3, 3) of the x-z plane that a pose (4, 4) is; nothing moves along y."""
    np.testing.assert_allclose(pose[1], [0.0, 1.0, 0.0, 0.0], atol=1e-12)
    return pose[np.ix_([0, 2, 3], [0, 2, 3])]


@pytest.mark.parametrize("pairs", [1, 2])
def test_teeth_that_mesh_go_the_same_way_equally_far(kenan: Robot, pairs: int) -> None:
    """Where two pitch circles touch, both wheels have the same velocity; the cam alone runs ahead of its gear."""
    layout = kenan.layout
    (stage,) = layout.drive.train.stages
    axes = {"cam_gear": layout.cam_axis_mm, "motor_pinion": layout.motor_mm}
    stages = [stage]
    if pairs == 2:
        stages = [replace(stage, wheel=replace(stage.wheel, teeth=stage.wheel.teeth + 9)), stage]
        axes = {"cam_gear": layout.cam_axis_mm, "idler": np.array([30.0, 20.0]), "motor_pinion": layout.motor_mm}
        train = replace(layout.drive.train, stages=tuple(stages))
        layout = replace(layout, drive=replace(layout.drive, train=train), idler_mm=axes["idler"])

    def turn(name: str, position: Position) -> float:
        pose = pose_of(Piece(name, BODY, stage, np.eye(4)), layout, kenan.linkage, position)
        centre = np.array([*axes[name], 1.0])
        plane = in_plane(pose)
        np.testing.assert_allclose(plane @ centre, centre, atol=1e-9)  # it turns about its own axis
        return float(np.arctan2(plane[0, 1], plane[0, 0]))  # about +y, which carries z to x

    position = Position("", 0.0, 0.01, 0.2)
    turns = [turn(name, position) for name in axes]
    axes |= {"cam": layout.cam_axis_mm, "motor_shaft": layout.motor_mm}
    assert turns[0] == pytest.approx(0.01)
    for (driven, driver), pair in zip(itertools.pairwise(turns), reversed(stages), strict=True):
        assert driver * pair.pinion.teeth == pytest.approx(-driven * pair.wheel.teeth)
    assert turn("motor_shaft", position) == turns[-1]
    assert turn("cam", position) == pytest.approx(0.21)
