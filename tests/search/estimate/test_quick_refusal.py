"""Robots refused by an estimate of their masses: never one that would have passed, and nothing of them is built."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.built import LONG_TOES, built
from support.built import design as named

from jumpcad import evaluation
from jumpcad.building import build
from jumpcad.design import SEARCH_BOUNDS, Design, load_design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search.estimate import quick_refusal as quick
from jumpcad.search.estimate.quick_mass import known, quick_robot
from jumpcad.search.estimate.quick_refusal import EstimateErrors, quick_refusal
from jumpcad.search.estimate.sized_robot import sized_robot
from jumpcad.search.models import robot_model
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.workshop import Workshop, load_workshop, varied

DEFAULT = load_workshop("default")
WEAK = {"stiffness_nmm_per_deg": 5.0, "compression_ratio": 0.2}
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
    heavy = varied(DEFAULT, {"body.plate_mm": 4.0, "bought.kit": "strong-2s", "process.infill": 1.0})
    light = varied(load_workshop("light"), {"body.plate_mm": 1.2, "bought.axle": "steel-tube", "process.infill": 0.0})
    generator = np.random.default_rng(5)
    shops = [DEFAULT, load_workshop("fine"), load_workshop("light"), heavy, light] * 2
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


def wrongly_refused(robots):
    """Return the designs that are refused by statics; whether they take off is another question."""
    found = [(design, quick_refusal(design, workshop, Settings())) for design, workshop in robots]
    return [design for design, refused in found if {one.name for one in refused} & {"tips", "too_weak"}]


@pytest.mark.thorough
def test_a_robot_that_stands_is_not_refused(standing):
    assert sum(known(*one) for one in standing) >= 12
    assert wrongly_refused(standing) == []


@pytest.mark.parametrize("kind", ["KNOWN", "NEAR"])
def test_robots_near_their_limit_would_notice_an_error_that_is_too_small(standing, monkeypatch, kind):
    monkeypatch.setattr(quick, kind, EstimateErrors(0.0, getattr(quick, kind).ahead_mm))
    assert wrongly_refused(standing)


@pytest.mark.parametrize("shop", ["default", "light"])
def test_an_absurdly_weak_robot_is_refused_before_anything_is_built(shop, monkeypatch):
    weak = load_design("best-printable").model_copy(update=WEAK)
    exact = replace(robot_model(workshop=shop), stand_in=True)(weak)
    assert exact.reasons[0] == "too_weak"
    assert exact.metrics["mass_kg"] > 0.0  # others learn from it: it was built
    monkeypatch.setattr(evaluation, "evaluate_made", None)
    found = robot_model(workshop=shop)(weak)
    assert (found.verdict, found.reasons, dict(found.metrics)) == ("too_weak", ("too_weak",), {})
    assert [one.name for one in found.findings] == ["loop", "below_ground", "too_weak"]
    estimate = found.findings[-1]
    true = next(one for one in exact.findings if one.name == "too_weak")
    assert estimate.value == pytest.approx(true.value, rel=1e-12)  # the springs are known
    assert estimate.limit == pytest.approx(true.limit, rel=quick.KNOWN.lighter)
    assert estimate.margin == estimate.value - estimate.limit < 0.0
    assert f"{1000.0 * estimate.limit:.1f} mJ" in estimate.message
    assert "by an estimate of the masses" in estimate.message


def test_a_robot_whose_toes_are_far_too_short_falls_over():
    short = load_design("best-printable").model_copy(update={"e_coef": 0.5, "ground_link_angle_deg": 80.0})
    (tips,) = quick_refusal(short, DEFAULT, Settings())
    true = statics_findings(build(short, DEFAULT))[0]
    assert tips.name == true.name == "tips"
    assert true.margin < 0.0
    assert tips.margin == pytest.approx(true.margin, abs=quick.KNOWN.ahead_mm)


def just_jumps(robot):
    """Return the settings in which a built robot just takes off: with less of its springs' energy it would not."""
    low, high = 0.1, 1.0
    while high - low > 0.001:
        middle = (low + high) / 2.0
        jumps = simulate(robot, Settings(spring_efficiency=middle), "planar").verdict == "jump"
        low, high = (low, middle) if jumps else (middle, high)
    return Settings(spring_efficiency=high)


@pytest.fixture(scope="module", params=[("best-ga", "light"), ("best-printable", "default"), ("best-bo", "light")])
def barely_jumping(request):
    robot = built(*request.param)
    return robot, just_jumps(robot)


def test_a_robot_that_just_takes_off_is_not_refused(barely_jumping, monkeypatch):
    """An estimate that errs by more than is allowed for would be noticed."""
    robot, settings = barely_jumping
    assert quick_refusal(robot.design, robot.workshop, settings) == ()
    monkeypatch.setattr(quick, "sized_robot", lambda *one: with_spring_factor(sized_robot(*one), 0.85))
    monkeypatch.setattr(quick, "NEAR", EstimateErrors(1.0, 1e3))
    (standing,) = quick_refusal(robot.design, robot.workshop, settings)
    assert standing.name == "no_takeoff"


def test_stronger_springs_press_harder_on_their_pins(monkeypatch):
    """A push-off is tried with springs and friction of pins stronger alike, the strongest first."""
    tried, robot = [], built("kenan-2.0")
    own = quick.PlanarWorld(with_spring_factor(robot, Settings().spring_efficiency), Settings()).model

    def flown(world):
        tried.append((world.model.stiffness_nm_per_rad, world.model.pins_nm))
        return SimpleNamespace(flown=len(tried) == 3)

    monkeypatch.setattr(quick.PlanarWorld, "push_off", flown)
    assert quick._by_push_off(robot, Settings()) == ()
    assert own.pins_nm > 0.0
    assert np.array(tried) == pytest.approx(np.outer([1.06, 1.04, 1.02], [own.stiffness_nm_per_rad, own.pins_nm]))


def test_an_estimate_that_is_near_its_take_off_refuses_nothing(monkeypatch):
    """It stays on the ground by itself, but not with the springs that its error asks for."""
    near = Design.from_vector([187.16, 1.02, 0.86, 0.98, 0.4, 59.45, 29.6, 35.88])
    weaker = near.model_copy(update={"stiffness_nmm_per_deg": 0.9 * near.stiffness_nmm_per_deg})
    stronger = near.model_copy(update={"carrying_link_mm": 0.9 * near.carrying_link_mm})
    verdicts = [simulate(sized_robot(one, DEFAULT), Settings(), "planar").verdict for one in (near, weaker, stronger)]
    assert verdicts == ["no_takeoff", "no_takeoff", "jump"]
    assert quick_refusal(near, DEFAULT, Settings()) == ()
    assert [one.name for one in quick_refusal(weaker, DEFAULT, Settings())] == ["no_takeoff"]
    monkeypatch.setattr(quick, "STRENGTHS", (0.5,))
    assert [one.name for one in quick_refusal(near, DEFAULT, Settings())] == ["no_takeoff"]
    assert quick_refusal(stronger, DEFAULT, Settings()) == ()


def test_a_robot_that_stays_on_the_ground_is_not_built(monkeypatch):
    robot = built(LONG_TOES)
    assert simulate(robot).verdict == "no_takeoff"
    assert not errors(statics_findings(robot))
    monkeypatch.setattr(evaluation, "evaluate_made", None)
    found = robot_model()(named(LONG_TOES))
    assert (found.verdict, found.reasons, dict(found.metrics)) == ("no_takeoff", ("no_takeoff",), {})
    standing = found.findings[-1]
    assert standing.margin == pytest.approx(standing.value - standing.limit)
    assert standing.margin < 0.0
    assert "by an estimate of the masses, with springs of up to 6 % more energy too" in standing.message
    alone = simulate(sized_robot(named(LONG_TOES), DEFAULT), robot_model().guess_settings, "planar").findings
    (missing,) = (one for one in alone if one.name == "no_takeoff")
    assert standing.margin == pytest.approx(missing.margin)  # with its own springs


@pytest.mark.parametrize(
    "settings",
    [{"restitution": 0.3}, {"drag_per_s": 1.0}, {"gravity_m_s2": 9.0}, {"spring_efficiency": 1.05}],
)
def test_where_the_push_off_is_not_that_of_the_measured_error_the_robot_is_built(settings):
    """What the planar engine lacks, and springs that do more than in the robots that were compared."""
    design = named(LONG_TOES)
    assert [one.name for one in quick_refusal(design, DEFAULT, Settings())] == ["no_takeoff"]
    assert quick_refusal(design, DEFAULT, Settings(**settings)) == ()
    assert quick_refusal(design, varied(DEFAULT, {"body.stop_deg": 4.0}), Settings()) == ()


def test_efficiency_and_gravity_are_those_of_the_simulation():
    """On the Moon, springs of the same energy suffice for a sixth of the weight."""
    weak = load_design("best-printable").model_copy(update=WEAK)
    (earth,) = quick_refusal(weak, DEFAULT, Settings())
    assert quick_refusal(weak, DEFAULT, Settings(gravity_m_s2=9.81 / 6.0)) == ()
    (half,) = quick_refusal(weak, DEFAULT, Settings(spring_efficiency=0.5))
    assert half.value == pytest.approx(0.5 * earth.value)


def with_battery(mass_g: float) -> Workshop:
    data = DEFAULT.model_dump(exclude_none=True)
    battery = DEFAULT.catalogue.batteries[DEFAULT.bought.battery].model_dump(exclude_none=True)
    held = battery["capacity_mah"] * mass_g / battery["mass_g"]
    data["batteries"] = {"own": battery | {"mass_g": mass_g, "capacity_mah": held}}
    return Workshop(**data | {"bought": data["bought"] | {"battery": "own"}})


def test_a_heavier_battery_of_one_s_own_weighs_as_much_more():
    design = load_design("best-printable")
    light, heavy = (quick_robot(design, with_battery(mass)) for mass in (8.0, 28.0))
    assert heavy.mass_kg - light.mass_kg == pytest.approx(0.02)


def test_values_that_a_search_varies_decide():
    """With thin plates the springs may be strong enough, which only the built robot tells; with thick ones never."""
    design = load_design("best-printable").model_copy(update=WEAK | {"compression_ratio": 0.28})
    model = robot_model()
    assert model(design, {"body.plate_mm": 1.2}).metrics["mass_kg"] > 0.0
    assert (model(design, {"body.plate_mm": 4.8}).verdict, model(design, {"body.plate_mm": 4.8}).metrics) == (
        "too_weak",
        {},
    )


@pytest.mark.parametrize(
    "shop",
    [
        varied(DEFAULT, {"safety.strength_factor": 20.0}),
        varied(DEFAULT, {"fits.wall_mm": 8.0}),
        with_battery(300.0),
        DEFAULT.model_copy(update={"mass": DEFAULT.mass.model_copy(update={"weighed_g": {"main_leg": 9.0}})}),
    ],
)
def test_what_the_estimate_was_never_compared_with_is_built(shop):
    weak = load_design("best-printable").model_copy(update=WEAK)
    assert quick_refusal(weak, DEFAULT, Settings())
    assert quick_refusal(weak, shop, Settings()) == ()


def test_a_design_far_beyond_the_default_bounds_is_built():
    weak = load_design("best-printable").model_copy(update=WEAK)
    lengths = (250.0, 300.0)
    refused = [quick_refusal(weak.model_copy(update={"carrying_link_mm": mm}), DEFAULT, Settings()) for mm in lengths]
    assert [bool(one) for one in refused] == [True, False]


@pytest.mark.parametrize(
    ("name", "value", "limit", "certain", "said"),
    [
        ("tips", -17.0, 0.0, True, "16 mm"), ("tips", -15.0, 0.0, False, "16 mm"), ("tips", 40.0, 0.0, False, "16 mm"),
        ("too_weak", 0.81, 1.0, True, "18 % of what is needed"),
        ("too_weak", 0.83, 1.0, False, "18 % of what is needed"),
    ],
)  # fmt: skip
def test_what_an_estimate_refuses_is_beyond_its_error_and_says_by_how_much(name, value, limit, certain, said):
    """Less energy may be needed by a share, the centre of mass may be farther ahead: no other error refuses wrongly."""
    bounds = EstimateErrors(0.18, 16.0)
    found = Finding(name, "error", value - limit, "mm", "it does", "change it", value, limit)
    assert quick.is_certain(found, bounds) == certain
    told = quick._estimated(found, bounds)
    assert told.message == f"it does; by an estimate of the masses, at most {said} too strict"
    assert replace(told, message="it does") == found
