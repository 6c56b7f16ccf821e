"""Refusals before a robot is built: never of one that would have passed, and with the number that is missed."""

import pickle
import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built
from support.robots import FOLDED

from jumpcad import evaluation
from jumpcad.building import build
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.search.estimate import refusal
from jumpcad.search.estimate.estimated_masses import known
from jumpcad.search.estimate.refusal import AHEAD_MM, LIGHTER, layout_findings, room_findings, statics_refusal
from jumpcad.search.models import robot_model
from jumpcad.search.study.objective import Evaluation
from jumpcad.simulation import Settings, simulate
from jumpcad.workshop import Workshop, load_workshop, varied

SHOP = load_workshop("default")
WEAK = load_design("best-printable").model_copy(update={"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2})
ENOUGH = 1.02
"""Energy of the springs over what statics need, for robots near the limit."""


def near_limit(design: Design, workshop: Workshop) -> Design:
    """Return a design with springs that are hardly strong enough, by the masses of the built robot."""
    weak = statics_findings(build(design, workshop))[1]
    stiffness = design.stiffness_nmm_per_deg * ENOUGH * weak.limit / weak.value
    return design.model_copy(update={"stiffness_nmm_per_deg": stiffness})


@pytest.fixture(scope="module")
def standing():
    """Return designs with workshops whose robots pass: templates, and random ones near the limit of their energy."""
    found = [(load_design(name), load_workshop(shop)) for name, shop in
             (("best-printable", "default"), ("best-printable", "light"), ("best-bo", "fine"))]  # fmt: skip
    heavy = varied(SHOP, {"body.plate_mm": 4.0, "bought.kit": "strong-2s", "process.infill": 1.0})
    light = varied(load_workshop("light"), {"body.plate_mm": 1.2, "bought.axle": "steel-tube", "process.infill": 0.0})
    generator = np.random.default_rng(5)
    shops = [SHOP, load_workshop("fine"), load_workshop("light"), heavy, light] * 2
    while shops:
        drawn = {name: generator.uniform(one.lower, one.upper) for name, one in SEARCH_BOUNDS.items()}
        design = Design(**drawn | {"e_coef": 1.4, "ground_link_angle_deg": 20.0})  # on long toes it does not fall over
        try:
            if errors(geometry_findings(design)):
                continue
            weakened = near_limit(design, shops[-1])
            exact = statics_findings(build(weakened, shops[-1]))
        except CannotBuildError:
            continue
        if not errors(exact) and known(weakened, shops[-1]):
            found.append((weakened, shops.pop()))
    return found


@pytest.mark.thorough
def test_a_robot_that_stands_is_not_refused(standing, monkeypatch):
    """Robots near their limit would notice an error that is too small."""
    assert sum(known(*one) for one in standing) >= 12
    assert not any(statics_refusal(*one, Settings()) for one in standing)
    monkeypatch.setattr(refusal, "LIGHTER", 0.0)
    assert any(statics_refusal(*one, Settings()) for one in standing)


def test_an_absurdly_weak_robot_is_refused_before_anything_is_built(monkeypatch):
    exact = replace(robot_model(), stand_in=True)(WEAK)
    assert exact.reasons[0] == "too_weak"
    assert exact.metrics["mass_kg"] > 0.0  # others learn from it: it was built
    monkeypatch.setattr(evaluation, "evaluate_made", None)
    found = robot_model()(WEAK)
    assert (found.verdict, found.reasons, dict(found.metrics)) == ("too_weak", ("too_weak",), {})
    assert [one.name for one in found.findings] == ["loop", "below_ground", "too_weak"]
    estimate, true = found.findings[-1], next(one for one in exact.findings if one.name == "too_weak")
    assert estimate.value == pytest.approx(true.value, rel=1e-12)  # the springs are known
    assert estimate.limit == pytest.approx(true.limit, rel=LIGHTER)
    assert f"{1000.0 * estimate.limit:.1f} mJ" in estimate.message


def test_a_robot_whose_toes_are_far_too_short_falls_over():
    short = load_design("best-printable").model_copy(update={"e_coef": 0.5, "ground_link_angle_deg": 80.0})
    (tips,) = statics_refusal(short, SHOP, Settings())
    true = statics_findings(build(short, SHOP))[0]
    assert tips.name == true.name == "tips"
    assert true.margin < 0.0
    assert tips.margin == pytest.approx(true.margin, abs=AHEAD_MM)


def test_efficiency_and_gravity_are_those_of_the_simulation_and_values_of_a_search_decide():
    """On the Moon, springs of the same energy suffice for a sixth of the weight; with thin plates they may on Earth."""
    (earth,) = statics_refusal(WEAK, SHOP, Settings())
    assert statics_refusal(WEAK, SHOP, Settings(gravity_m_s2=9.81 / 6.0)) == ()
    (half,) = statics_refusal(WEAK, SHOP, Settings(spring_efficiency=0.5))
    assert half.value == pytest.approx(0.5 * earth.value)
    less_weak = WEAK.model_copy(update={"compression_ratio": 0.28})
    thick, thin = (varied(SHOP, {"body.plate_mm": plate}) for plate in (4.8, 1.2))
    assert [len(statics_refusal(less_weak, shop, Settings())) for shop in (thick, thin)] == [1, 0]


def test_what_the_estimate_was_never_compared_with_is_built():
    for shop in (varied(SHOP, {"safety.strength_factor": 20.0}), varied(SHOP, {"fits.wall_mm": 8.0})):
        assert statics_refusal(WEAK, shop, Settings()) == ()
    lengths = [WEAK.model_copy(update={"carrying_link_mm": mm}) for mm in (250.0, 300.0)]
    assert [bool(statics_refusal(one, SHOP, Settings())) for one in lengths] == [True, False]


def test_what_an_estimate_refuses_is_beyond_its_error():
    """Less energy may be needed by a share, the centre of mass may be farther ahead: no other error refuses wrongly."""
    for name, value, limit, certain in (
        ("tips", -17.0, 0.0, True), ("tips", -15.0, 0.0, False), ("tips", 40.0, 0.0, False),
        ("too_weak", 0.81, 1.0, True), ("too_weak", 0.83, 1.0, False),
    ):  # fmt: skip
        found = Finding(name, "error", value - limit, "mm", "it does", "change it", value, limit)
        assert refusal.is_certain(found) == certain, (name, value)


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
    assert layout_findings(CannotBuildError("no")) == ()
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
