"""The motion at any time: the report's moments, and between them a linkage that stays closed."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.poses import body_poses
from jumpcad.studio.playback import Playback, ShownMoment, playback

ROBOT = "kenan-2.0"


@pytest.fixture(scope="module")
def played() -> Playback:
    return playback(built(ROBOT))


def point(moment: ShownMoment, body: str, x_mm: float) -> np.ndarray:
    """Return a point on the x axis of a body's frame in the world (m)."""
    seven = moment.frames[body]
    return seven[:3] + Rotation.from_quat(seven[3:]).apply([x_mm / 1000.0, 0.0, 0.0])


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


def test_gears_turn_against_each_other_while_the_spring_is_wound(played: Playback) -> None:
    turned = played.at(2.0).turned_rad
    assert turned["cam"] == turned["cam_gear"] > 1.0
    assert turned["motor_pinion"] < -turned["cam_gear"]
    dropped = played.at(3.59).turned_rad
    assert dropped["cam"] > dropped["cam_gear"] + 0.01  # it runs ahead
