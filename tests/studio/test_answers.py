"""Figures as the studio shows them: units, differences from the robot before, the tightest limits."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built

from jumpcad.findings import Finding
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, body_poses
from jumpcad.studio.answers import Playback, Printed, ShownMoment, playback

NAME = "kenan-2.0"


def printed(reach_m: float | None = 0.2, findings: list[Finding] | None = None) -> Printed:
    jump: Any = SimpleNamespace(verdict="jump", touchdown_distance_m=reach_m, com_rise_m=0.08)
    found = Printed(built(NAME).design, built(NAME), jump)
    vars(found)["findings"] = findings or []
    return found


def test_figures_are_in_millimetres_grams_and_millijoules() -> None:
    """Kenan 2.0's springs hold 133 mJ, as the study says."""
    found = printed().figures()
    assert found["touchdown"] == (pytest.approx(200.0), "mm")
    assert found["rise"] == (pytest.approx(80.0), "mm")
    assert found["mass"] == (pytest.approx(1000.0 * built(NAME).mass_kg), "g")
    assert found["spring energy"] == (pytest.approx(133.0, abs=1.0), "mJ")
    assert found["winding"] == (built(NAME).layout.drive.train.winding_s, "s")
    assert printed(None).figures()["touchdown"] == (0.0, "mm")
    assert replace(printed(), robot=None).figures() == {}


def test_what_cannot_be_built_says_why() -> None:
    found = Printed(built(NAME).design, reason="no room")
    assert found.to_markdown().startswith("**cannot be built**: no room (")
    assert found.findings == []


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
