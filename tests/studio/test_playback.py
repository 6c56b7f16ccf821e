"""The motion at any time: the report's moments, and between them a linkage that stays closed."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.poses import body_poses
from jumpcad.settings import Settings
from jumpcad.studio import playback as module
from jumpcad.studio.playback import Playback, ShownMoment, playback

ROBOT = "kenan-2.0"


@pytest.fixture(scope="module")
def played() -> Playback:
    return playback(built(ROBOT))


def point(moment: ShownMoment, body: str, x_mm: float) -> np.ndarray:
    """Return a point on the x axis of a body's frame in the world (m)."""
    seven = moment.frames[body]
    return seven[:3] + Rotation.from_quat(seven[3:]).apply([x_mm / 1000.0, 0.0, 0.0])


def test_it_is_the_jump_of_the_first_engine_that_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    jump = SimpleNamespace(trajectory="path", takeoff_time_s=0.03)
    for name, made in (
        ("default_engine", lambda: "mujoco"), ("simulate", lambda *given: asked.append(given) or jump),
        ("motion", lambda *given: {"given": given}), ("turning_parts", lambda robot: [robot]),
    ):  # fmt: skip
        monkeypatch.setattr(module, name, made)
    assert playback("robot") == Playback({"given": ("robot", "path", 0.03)}, ["robot"])  # type: ignore[arg-type]
    assert asked == [("robot", Settings(flight="simulated", trajectory=True), "mujoco")]


def test_it_begins_at_rest_and_ends_in_the_air_beyond_the_start(played: Playback) -> None:
    for body, pose in body_poses(built(ROBOT)).items():
        assert played.at(0.0).frames[body][:3] == pytest.approx(pose[:3, 3], abs=1e-5)
    last = played.at(1e9)
    assert last.phase == "flight"
    assert last.frames[BODY][0] > played.at(0.0).frames[BODY][0] + 0.1
    assert played.at(1e9).real_s == played.at(played.end_s).real_s


def test_between_moments_the_linkage_stays_closed(played: Playback) -> None:
    """Ankle and front eye, each seen from both bodies that it joins, stay within 0.2 mm."""
    design = built(ROBOT).design
    for time_s in np.linspace(0.0, played.end_s, 97).tolist():
        moment = played.at(time_s)
        ankle = point(moment, MAIN_LEG, design.l2_mm) - point(moment, FOOT, 0.0)
        eye = point(moment, FRONT_LINK, design.l3_mm) - point(moment, FOOT, design.l4_mm)
        assert np.abs([ankle, eye]).max() < 2e-4


def test_phases_follow_one_another_and_say_how_slow_they_are(played: Playback) -> None:
    moments = [played.at(time_s) for time_s in np.arange(0.0, played.end_s, 0.05).tolist()]
    assert list(dict.fromkeys(one.phase for one in moments)) == ["winding", "drop", "push-off", "flight"]
    winding_s = built(ROBOT).layout.drive.train.winding_s
    first = moments[1]
    assert first.real_s == pytest.approx(0.05 / first.slower, rel=0.01)
    assert 3.0 / first.slower == pytest.approx(max(one.real_s for one in moments if one.phase == "winding"), rel=0.03)
    assert 3.0 / first.slower < winding_s * 1.01
    assert first.to_text(2.0).endswith(f"({2.0 * first.slower:.3g} times slower than real)")
    assert replace(first, slower=2.0).to_text().endswith("(2 times slower than real)")
    assert replace(first, slower=0.5).to_text().endswith("(2 times quicker than real)")
    for real_s, told in ((0.0314, "0.031"), (0.9994, "0.999"), (2.26, "2.3")):  # a push-off takes milliseconds
        assert replace(first, phase="flight", real_s=real_s).to_text().startswith(f"flight, {told} s (")


def test_gears_turn_against_each_other_while_the_spring_is_wound(played: Playback) -> None:
    turned = played.at(2.0).turned_rad
    assert turned["cam"] == turned["cam_gear"] > 1.0
    assert turned["motor_pinion"] < -turned["cam_gear"]
    dropped = played.at(3.59).turned_rad
    assert dropped["cam"] > dropped["cam_gear"] + 0.01  # it runs ahead


def test_a_turn_through_half_a_circle_takes_the_short_way() -> None:
    """From 179° to 181° it is 180° half way: the quaternions, each with w >= 0, point away from each other.

    The place goes straight on.
    """
    turns = [Rotation.from_euler("y", angle, degrees=True).as_quat(canonical=True).tolist() for angle in (179, 181)]
    columns = {key: [0.0, 1.0] for key in ("show_s", "time_s", "cam_rad", "gear_rad")}
    frames = {BODY: [[x, 0.0, z, *turn] for x, z, turn in zip((0.2, 0.6), (0.5, 0.3), turns, strict=True)]}
    motion = {**columns, "phase": ["flight"] * 2, "com_m": [[0.0, 0.0]] * 2, "frames": frames}
    seven = Playback(motion, []).at(0.5).frames[BODY]
    assert seven[:3] == pytest.approx([0.4, 0.0, 0.4])
    half = Rotation.from_quat(seven[3:])
    assert half.magnitude() == pytest.approx(np.pi, abs=1e-9)
    assert np.abs(half.apply([1.0, 0.0, 0.0]) - [-1.0, 0.0, 0.0]).max() < 1e-9


def test_a_moment_lies_between_those_beside_it() -> None:
    """A quarter of the way from 1 s to 3 s: places, turns and time; the cam may run ahead of its gear."""
    turn = Rotation.from_euler("y", 40.0, degrees=True).as_quat(canonical=True).tolist()
    motion = {
        "show_s": [0.0, 1.0, 3.0], "time_s": [0.0, 0.5, 0.9], "cam_rad": [0.0, 1.0, 3.0], "gear_rad": [0.0, 1.0, 1.4],
        "phase": ["winding", "drop", "flight"], "com_m": [[0.0, 0.1], [0.2, 0.3], [0.4, 0.5]],
        "frames": {BODY: [[0.0] * 6 + [1.0], [0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 1.0], [0.5, 0.2, 0.7, *turn]]},
    }  # fmt: skip
    turning = [{"node": "cam", "per_cam": 2.0}, {"node": "gear", "per_cam": -3.0}]
    found = Playback(motion, turning)
    quarter = found.at(1.5)
    assert quarter.frames[BODY][:3] == pytest.approx([0.2, 0.2, 0.4])
    assert Rotation.from_quat(quarter.frames[BODY][3:]).magnitude() == pytest.approx(np.radians(10.0), rel=0.02)
    assert quarter.turned_rad == pytest.approx({"cam": 2.0 * 1.5, "gear": -3.0 * 1.1})
    assert (quarter.phase, quarter.real_s, quarter.slower) == ("drop", pytest.approx(0.6), pytest.approx(2.0 / 0.4))
    assert (found.end_s, found.at(9.0).phase, found.at(9.0).real_s) == (3.0, "flight", pytest.approx(0.9))
    assert found.at(-1.0).frames[BODY][:3].tolist() == [0.0, 0.0, 0.0]
    assert found.com_m.tolist() == [[0.0, 0.0, 0.1], [0.2, 0.0, 0.3], [0.4, 0.0, 0.5]]
