"""Refusals before a robot is built: never of one that would have passed, and with the number that is missed."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.robots import FOLDED

from jumpcad import evaluation
from jumpcad.building import build
from jumpcad.building.growth import statics_refusal
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.search.estimate.refusal import room_findings
from jumpcad.search.models import robot_model
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import load_workshop, varied

SHOP = load_workshop("default")
WEAK = load_design("best-printable").model_copy(update={"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2})


def test_an_absurdly_weak_robot_is_refused_before_anything_is_built(monkeypatch):
    exact = replace(robot_model(), stand_in=True)(WEAK)
    assert exact.reasons[0] == "too_weak"
    assert exact.metrics["mass_kg"] > 0.0  # others learn from it: it was built
    monkeypatch.setattr(evaluation, "evaluate_made", None)
    found = robot_model()(WEAK)
    assert (found.verdict, found.reasons, dict(found.metrics)) == ("too_weak", ("too_weak",), {})
    assert [one.name for one in found.findings] == ["loop", "below_ground", "too_weak"]
    bound, true = found.findings[-1], next(one for one in exact.findings if one.name == "too_weak")
    assert bound.value == pytest.approx(true.value, rel=1e-12)  # the springs are known
    assert bound.limit < true.limit


@pytest.mark.thorough
def test_a_robot_that_stands_is_not_refused():
    """The lightest robots with springs that are hardly strong enough."""
    light = varied(load_workshop("light"), {"body.plate_mm": 1.2, "bought.axle": "steel-tube", "process.infill": 0.0})
    generator, stood = np.random.default_rng(5), 0
    while stood < 6:
        design = Design(**{name: generator.uniform(one.lower, one.upper) for name, one in SEARCH_BOUNDS.items()})
        try:
            weak = statics_findings(build(design, light))[1]
            stiffness = 1.02 * design.stiffness_nmm_per_deg * weak.limit / weak.value
            weakened = design.model_copy(update={"stiffness_nmm_per_deg": stiffness})
            stands = not errors([*geometry_findings(design), statics_findings(build(weakened, light))[1]])
        except CannotBuildError:
            continue
        assert not (stands and statics_refusal(weakened, light, Settings())), weakened
        stood += stands


def test_efficiency_and_gravity_are_those_of_the_simulation_and_springs_those_of_the_workshop():
    """On the Moon, springs of the same energy suffice for a sixth of the weight; bought ones have their own rate."""
    (earth,) = statics_refusal(WEAK, SHOP, Settings())
    assert statics_refusal(WEAK, SHOP, Settings(gravity_m_s2=9.81 / 6.0)) == ()
    (half,) = statics_refusal(WEAK, SHOP, Settings(spring_efficiency=0.5))
    assert half.value == pytest.approx(0.5 * earth.value)
    assert statics_refusal(WEAK, varied(SHOP, {"bought.spring": "9271K619"}), Settings()) == ()


@pytest.mark.thorough
def test_the_margin_is_the_message_s_millimetres_and_changes_its_sign_where_a_robot_is_built():
    """Compressed further, the legs come nearer to each other, until they touch."""
    model, margins = robot_model(), []
    for ratio in (0.6, 0.7, 0.8, 0.82, 0.85):
        found = model(FOLDED.model_copy(update={"compression_ratio": ratio}))
        rooms = {one.name: one.margin for one in found.findings if one.name in ("stop_room", "legs_apart", "pin_way")}
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
    apart, *_ = room_findings(layout, 1.5)
    gap, needed = re.findall(r"([\d.]+) mm", apart.message)
    assert float(gap) - float(needed) == pytest.approx(apart.margin, abs=0.0051)


def test_a_robot_that_stays_on_the_ground_says_how_much_speed_is_missing():
    lower = {name: bound.lower for name, bound in SEARCH_BOUNDS.items()}
    heavy = Design(**{**lower, "compression_ratio": 0.35, "rest_angle_deg": 60.0, "stiffness_nmm_per_deg": 7.0})
    found = simulate(capsule_robot(heavy), Settings(max_time_s=0.01))
    assert found.verdict == "no_takeoff"
    (missing,) = [one for one in found.findings if one.name == "no_takeoff"]
    assert missing.severity == "error"
    assert missing.margin == pytest.approx(missing.value - missing.limit)
    assert missing.margin < 0.0
