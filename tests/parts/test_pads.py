"""Pads on the meshes: between stop and leg, around the nose, and as large as is cut."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built

from jumpcad.parts.foot import foot
from jumpcad.parts.pads import pads
from jumpcad.robot import Robot


def points(robot: Robot, name: str) -> np.ndarray:
    item = next(one for one in robot.hardware if one.name == name)
    return item.look.copy().apply_transform(item.T_body_part).vertices


def cut_mm(robot: Robot, name: str) -> tuple[float, float]:
    item = next(one for one in robot.hardware if one.name == name)
    return tuple(map(float, re.findall(r"cut ([\d.]+) x ([\d.]+) mm", item.article)[0]))  # type: ignore[return-value]


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_stops_pad_lies_between_its_seat_and_the_leg_at_the_stop(name: str) -> None:
    robot = built(name)
    stop, width = robot.layout.stop, robot.layout.sections.thickness_mm
    found = points(robot, "stop_pad")
    behind = found[:, ::2] @ stop.behind
    assert np.ptp(behind) == pytest.approx(stop.pad.thickness_mm, abs=1e-3)
    assert behind.min() == pytest.approx(float(np.dot(stop.face_mm, stop.behind)), abs=1e-3)
    along = (found[:, ::2] - stop.face_mm) @ np.array([-stop.behind[1], stop.behind[0]])
    assert (along.min(), along.max()) == pytest.approx((-4.0, 4.0), abs=1e-3)  # of 8 mm of strip
    assert (found[:, 1].min(), found[:, 1].max()) == pytest.approx((-width / 2.0, width / 2.0))
    assert cut_mm(robot, "stop_pad") == pytest.approx((width, 8.0), abs=0.051)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_toe_pads_are_glued_under_the_tips_from_8_mm_behind_their_middle_to_1_5_mm_before(name: str) -> None:
    """As wide as the tip, 5 mm; seen along each toe, whose direction and length are the design's."""
    robot = built(name)
    design, depth = robot.design, robot.layout.sections.foot_depth_mm
    angle = np.radians(design.ground_link_angle_deg)
    for side, sign in (("left", 1.0), ("right", -1.0)):
        (pad,) = (item for item in robot.hardware if item.name == f"toe_{side}_pad")
        corners = points(robot, pad.name)
        tip = design.l5_mm * np.array([-np.cos(angle), sign * np.sin(angle)])
        root = np.array([0.0, sign * (robot.layout.sections.thickness_mm / 2.0 + 0.5 + 3.5)])
        along = (tip - root) / np.hypot(*(tip - root))
        ahead = (corners[:, :2] - tip) @ along
        beside = (corners[:, :2] - tip) @ np.array([-along[1], along[0]])
        assert (ahead.min(), ahead.max()) == pytest.approx((-8.0, 1.5), abs=0.05)
        assert (beside.min(), beside.max()) == pytest.approx((-2.5, 2.5), abs=0.05)
        pad_mm = robot.workshop.foot_pad.thickness_mm
        assert (corners[:, 2].min(), corners[:, 2].max()) == pytest.approx((-depth - pad_mm, -depth), abs=1e-3)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_under_the_bars_of_wide_toes_pads_lie_from_tip_to_end(name: str) -> None:
    """Bars reach straight to the side: pads 5 mm wide on their soles, from the tip's middle to 1.5 mm before the end.

    The bars themselves are as wide as the tips, 5 mm, and have round ends about the half width that was asked for.
    """
    robot, half_mm = built(name), 62.0 + built(name).design.l5_mm
    layout, strip = replace(robot.layout, toe_half_width_mm=half_mm), robot.workshop.foot_pad
    angle, depth = np.radians(robot.design.ground_link_angle_deg), layout.sections.foot_depth_mm
    tip = robot.design.l5_mm * np.array([-np.cos(angle), np.sin(angle)])
    sole = foot(layout, robot.workshop).mesh.vertices
    found = {item.name: item for item in pads(layout, strip)}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        pad = found[f"toe_{side}_pad"]
        corners = pad.look.copy().apply_transform(pad.T_body_part).vertices
        assert (corners[:, 0].min(), corners[:, 0].max()) == pytest.approx((tip[0] - 2.5, tip[0] + 2.5), abs=1e-3)
        beside = np.sort(sign * np.array([corners[:, 1].min(), corners[:, 1].max()]))
        assert beside == pytest.approx([tip[1], half_mm + 1.5], abs=1e-3)
        assert (corners[:, 2].min(), corners[:, 2].max()) == pytest.approx(
            (-depth - strip.thickness_mm, -depth), abs=1e-3
        )
        assert f"cut 5.0 x {half_mm + 1.5 - tip[1]:.1f} mm" in pad.article
        volume = 5.0 * (half_mm + 1.5 - tip[1]) * strip.thickness_mm
        assert 1e6 * pad.mass_kg == pytest.approx(strip.density_g_cm3 * volume)
        bar = sole[sign * sole[:, 1] > tip[1] + 10.0]
        assert (bar[:, 0].min(), bar[:, 0].max()) == pytest.approx((tip[0] - 2.5, tip[0] + 2.5), abs=0.02)
        assert (sign * bar[:, 1]).max() == pytest.approx(half_mm + 2.5, abs=0.02)
        assert bar[:, 2].max() == pytest.approx(layout.sections.toe_tip_height_mm, abs=1e-3)
