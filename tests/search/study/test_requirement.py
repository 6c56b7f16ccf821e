"""Requirements: what they say, what keeps them, on which floors, and that a search's winner does."""

import math
import re

import pytest
from support.built import built
from support.studies import IDENTITY

import jumpcad
from jumpcad.collision.hulls import share_on_feet
from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.evaluation import FIGURES, JUMP_FIGURES
from jumpcad.findings import errors
from jumpcad.landing.landing import land
from jumpcad.search.models import COSTLY, robot_model
from jumpcad.search.space import Space
from jumpcad.search.study import summary
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.request import Request
from jumpcad.search.study.requirement import Requirement, requirements_of, violations
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial
from jumpcad.settings import Settings
from jumpcad.simulation.prior import floors
from jumpcad.workshop import load_workshop, varied


def test_texts_say_the_least_and_the_most_of_a_figure() -> None:
    for text, least, most in (
        ("-30<=turn_deg<=30", -30.0, 30.0), ("mass_kg <= 0.15", None, 0.15), ("com_rise_m>=1e-1", 0.1, None),
        ("0.2<=com_rise_m", 0.2, None), (" .5 <= body_lengths <= +2 ", 0.5, 2.0),
    ):  # fmt: skip
        found = Requirement.parse(text)
        assert (found.least, found.most) == (least, most), text
        assert Requirement.parse(str(found)) == found


def test_what_is_no_requirement_is_told_in_one_line() -> None:
    for text in ("turn_deg", "turn_deg<30", "turn_deg==3", "3<=turn_deg>=1", "<=3", "", "turn_deg<=x", "1<=2<=3"):
        with pytest.raises(JumpcadError, match=r"is no requirement: write LO<=FIGURE<=HI") as wrong:
            Requirement.parse(text)
        assert "\n" not in str(wrong.value)
    with pytest.raises(JumpcadError, match=r"turn_deg: at least 3 and at most 1 cannot both hold"):
        Requirement.parse("3<=turn_deg<=1")
    with pytest.raises(JumpcadError, match=r"rights_itself>=98: it is a share"):
        Requirement.parse("rights_itself>=98")
    for limits in (0.9, (1.0, 2.0, 3.0), (None, None), (math.nan, None), ("a", None)):
        with pytest.raises(JumpcadError):
            requirements_of({"turn_deg": limits}, FIGURES)
    with pytest.raises(JumpcadError, match=r"turn_degs: .* \(did you mean turn_deg\?\)"):
        requirements_of(["turn_degs<=3"], FIGURES)
    for wrong, hint in (("rangee_m<=1", "did you mean ballistic_range_m?"), ("cost_eur<=9", "printed robots alone")):
        with pytest.raises(JumpcadError, match=re.escape(hint)):
            robot_model("capsule").requiring([wrong])
    with pytest.raises(JumpcadError, match="does not apply to the published robot"):
        robot_model("published").requiring(["fitness>=1"])


def test_requirements_on_one_figure_are_their_intersection() -> None:
    texts = ["-30<=turn_deg<=30", "turn_deg<=40", "mass_kg<=0.2", "turn_deg>=-10"]
    assert requirements_of(texts, FIGURES) == requirements_of(["-10<=turn_deg<=30", "mass_kg<=0.2"], FIGURES)
    with pytest.raises(JumpcadError, match=r"turn_deg: at least 40 and at most 30 cannot both hold"):
        requirements_of(["turn_deg<=30", "turn_deg>=40"], FIGURES)


@pytest.mark.parametrize(
    ("asked", "thing", "key"),
    [("cage_ahead>=0.02", "cage", "cage.rod=glass-1.5"), ("turn_energy_j<=9", "steering", "steering.wheel=o-ring")],
)
def test_what_is_required_of_cage_or_wheel_needs_one(asked: str, thing: str, key: str) -> None:
    """Else it would count as kept by robots that have none."""
    model = robot_model("printed", load_workshop()).requiring([asked])
    told = f"^{asked.split('>')[0].split('<')[0]}: the workshop has no {thing}: fix {key.split('=')[0]} too, {key}$"
    with pytest.raises(JumpcadError, match=told):
        Request(Space.make(workshop=model.workshop), model)
    either = key.replace("=", "=none," if thing == "steering" else "=,")
    with pytest.raises(JumpcadError, match=told):
        Request(Space.parse(choose=[either], workshop=model.workshop), model)
    Request(Space.parse(fix=[key], workshop=model.workshop), model)
    assert Request(Space.make(workshop=model.workshop), model.requiring(["turn_deg<=90"])).model.requires("turn_deg")


def test_all_that_robots_with_cage_and_wheel_alone_have_needs_them() -> None:
    design, shop = load_design("best-steered"), load_workshop("best-steered")
    bare = varied(shop, {"cage.rod": "", "steering.wheel": "none"})
    found = [robot_model("printed", one)(design) for one in (shop, bare)]
    has, lacks = ({*one.metrics, *one.margins} for one in found)
    assert len(has - lacks) > 20
    for name in has - lacks:
        model = robot_model("printed", bare).requiring([f"{name}>=0"])
        with pytest.raises(JumpcadError, match=f"^{name}: the workshop has no (cage|steering): fix"):
            Request(Space.make(workshop=bare), model)


def test_margins_are_the_distance_to_each_limit() -> None:
    asked = requirements_of({"turn_deg": (-30.0, 30.0), "leg_strength": (5.0, None)}, [*FIGURES, "leg_*"])
    found = {one.name: one.margin for one in violations(asked, {"turn_deg": 40.0}, {"leg_strength": 7.0})}
    assert found == {"turn_deg>=-30": 70.0, "turn_deg<=30": -10.0, "leg_strength>=5": 2.0}
    assert list(violations(asked, {}, {})) == []


def test_figures_that_may_be_required_are_those_of_an_evaluation() -> None:
    given = robot_model("printed")(load_design("kenan-2.0")).metrics
    steered = {"turn_per_rev_deg", "steering_rate_deg_s", "steering_margin_mm", "turn_energy_j"}  # of a wheel alone
    assert set(FIGURES) - {*COSTLY} - steered == set(given)
    capsule = robot_model("capsule")(load_design("kenan-2.0")).metrics
    assert set(JUMP_FIGURES) == set(capsule)


def test_the_floor_is_two_deviations_slipperier_and_rougher_unless_it_is_given() -> None:
    robot = built("kenan-2.0")
    low, high = (one.ground_friction for one in floors(robot, Settings()))
    assert (low, high) == pytest.approx((0.8 * math.exp(-0.3), 0.8 * math.exp(0.3)))
    assert floors(robot, Settings(ground_friction=0.7)) == ()


def test_a_robot_that_lands_upright_on_one_floor_alone_is_rejected() -> None:
    """kenan-2.0 touches down within 30° on every floor, and best-printable, which turns over, on none."""
    model = robot_model("printed").requiring(["-30<=touchdown_pitch_deg<=30"])
    assert not errors(model(load_design("kenan-2.0")).findings)
    assert model(load_design("best-printable")).reasons
    assert model.digest != robot_model("printed").digest


def test_righting_is_a_figure_where_it_is_required() -> None:
    """The share of stable poses of the same robot."""
    design, share = load_design("best-bo"), share_on_feet(built("best-bo"))
    for least, kept in ((share - 0.02, True), (share + 0.02, False)):
        found = robot_model("printed").requiring({"rights_itself": (least, None)})(design)
        assert found.metrics["rights_itself"] == pytest.approx(share, abs=0.01)
        assert found.feasible == kept


@pytest.mark.thorough
def test_the_righting_of_a_winner_is_simulated_once(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("mujoco")
    monkeypatch.setattr(summary, "TRIES", 2)
    model = robot_model("printed").requiring(["rights_itself>=0.1"])
    winner = Trial("bo", 0, 0, load_design("best-bo"), Evaluation("jump"), 1.0, "", 0.0, {})
    with StudyStore.write(None, IDENTITY) as store:
        assert summary.simulated_righting(robot_model("printed"), store, winner) == {}
        shares = summary.simulated_righting(model, store, winner)
        own = land(built("best-bo"), 2)
        assert shares == {"tries": 2.0, "drops": own.drops_righted, "landings": own.share_righted}
        monkeypatch.setattr(summary, "land", None)
        assert summary.simulated_righting(model, store, winner) == shares


def test_the_winner_of_a_search_keeps_what_was_required() -> None:
    found = jumpcad.optimize(evaluations=30, model="capsule", seed=1, workers=0, require={"com_rise_m": (None, 0.03)})
    assert found.design is not None
    assert jumpcad.simulate(jumpcad.capsule_robot(found.design)).com_rise_m <= 0.03
    kept = [trial for trial in found.trials if trial.score is not None]
    assert kept
    assert all(trial.evaluation.metrics["com_rise_m"] <= 0.03 for trial in kept)
    assert any("com_rise_m<=0.03" in trial.evaluation.reasons for trial in found.trials)


def test_where_only_what_is_required_rejects_it_is_named_with_the_nearest_value() -> None:
    """A robot of 10 g is out of reach; the designs themselves say which of those that jump is the lightest."""
    found = jumpcad.optimize(
        "ga", evaluations=12, model="capsule", seed=1, workers=0, fixed={"stiffness_nmm_per_deg": 20},
        require={"mass_kg": (None, 0.01)},
    )  # fmt: skip
    jumping = [one.evaluation for one in found.trials if one.evaluation.reasons == ("mass_kg<=0.01",)]
    lightest = min(one.metrics["mass_kg"] for one in jumping)
    assert f"{len(jumping)} of 12 designs would jump" in found.why_none
    assert f"mass_kg = {lightest:.4g}: relax mass_kg<=0.01 to " in found.why_none
