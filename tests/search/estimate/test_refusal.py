"""Refusals with a number: searches learn by how much a limit was missed."""

import pickle
import re

import pytest
from support.built import built
from support.robots import FOLDED

from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.search.estimate.refusal import refusal_findings, room_findings
from jumpcad.search.models import robot_model
from jumpcad.search.study.objective import Evaluation
from jumpcad.simulation import Settings, simulate


@pytest.mark.thorough
def test_the_margin_is_the_message_s_millimetres_and_changes_its_sign_where_a_robot_is_built():
    """Compressed further, the legs come nearer to each other, until they touch."""
    model, margins = robot_model(), []
    for ratio in (0.6, 0.7, 0.8, 0.82, 0.85):
        found = model(FOLDED.model_copy(update={"compression_ratio": ratio}))
        rooms = {one.name: one.margin for one in found.findings if one.name in ("stop_room", "legs_apart")}
        assert (found.verdict == "cannot_build") == (min(rooms.values()) < 0.0)
        if found.verdict == "cannot_build":
            assert f"{-min(rooms.values()):.1f} mm" in found.detail
            assert found.reasons == (min(rooms, key=lambda name: rooms[name]),)
        margins.append(min(rooms.values()))
    assert margins[0] > 0.0 > margins[-1]
    assert margins[1:] == sorted(margins[1:], reverse=True)  # before that, the stop's room is as large as is looked


def test_a_reserve_is_taken_from_the_room_between_the_legs():
    layout = built("kenan-2.0").layout
    rooms = [{one.name: one.margin for one in room_findings(layout, reserve)} for reserve in (0.0, 1.5)]
    assert rooms[0]["legs_apart"] - rooms[1]["legs_apart"] == pytest.approx(1.5)
    assert rooms[0]["stop_room"] == rooms[1]["stop_room"]  # has its reserve already
    apart, _ = room_findings(layout, 1.5)
    gap, needed = re.findall(r"([\d.]+) mm", apart.message)
    assert float(gap) - float(needed) == pytest.approx(apart.margin, abs=0.0051)


def test_a_refusal_without_a_number_has_no_finding():
    assert refusal_findings(CannotBuildError("no")) == ()
    assert Evaluation("cannot_build").reasons == ("cannot_build",)


def test_a_refusal_survives_the_way_from_a_worker():
    error = pickle.loads(pickle.dumps(CannotBuildError("no room", "stop_room", -2.5)))
    assert (str(error), error.limit, error.margin, error.unit) == ("no room", "stop_room", -2.5, "mm")


def test_a_robot_that_stays_on_the_ground_says_how_much_speed_is_missing():
    lower = {name: bound.lower for name, bound in SEARCH_BOUNDS.items()}
    heavy = Design(**{**lower, "compression_ratio": 0.35, "rest_angle_deg": 60.0, "stiffness_nmm_per_deg": 7.0})
    found = simulate(capsule_robot(heavy), Settings(max_time_s=0.01))
    assert found.verdict == "no_takeoff"
    (missing,) = [one for one in found.findings if one.name == "no_takeoff"]
    assert missing.severity == "error"
    assert missing.margin == pytest.approx(missing.value - missing.limit)
    assert missing.margin < 0.0
