"""Scores and verdicts."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.study.objective import OBJECTIVES, Evaluation, described_objective, find_objective

JUMP = {
    "body_lengths": 6.0, "fitness": 9.0, "ballistic_range_m": 0.9, "com_rise_m": 0.3, "spring_energy_j": 0.6,
    "electrical_energy_j": 2.0, "jumps_per_charge": 400.0,
    "touchdown_distance_m": 0.8, "rest_distance_m": 1.2, "robust_touchdown_m": 0.7,
}  # fmt: skip


def finding(name, severity, margin):
    return Finding(name, severity, margin, "mm", "", "")


def test_scores_of_a_jump():
    assert {name: one.score(Evaluation("jump", JUMP)) for name, one in OBJECTIVES.items()} == pytest.approx({
        "body_lengths": 6.0, "touchdown": 0.8, "rest": 1.2, "robust": 0.7, "fitness": 9.0, "range": 0.9, "rise": 0.3,
        "range-per-joule": 0.45, "range-per-spring-joule": 1.5, "jumps-per-joule": 0.5, "metres-per-charge": 360.0,
    })  # fmt: skip


def test_a_refused_design_has_no_score():
    assert find_objective("fitness").score(Evaluation("tips")) is None
    broken = Evaluation("jump", JUMP, (finding("leg_stress", "error", -3.0), finding("bed", "warning", -1.0)))
    assert find_objective("fitness").score(broken) is None
    assert broken.reasons == ("leg_stress",)
    assert Evaluation("no_takeoff").reasons == ("no_takeoff",)


def test_warnings_do_not_forbid():
    assert Evaluation("jump", JUMP, (finding("bed", "warning", -1.0),)).feasible


def test_an_objective_that_the_model_cannot_give_is_named():
    with pytest.raises(JumpcadError, match="jumps-per-joule of an evaluation lacks electrical_energy_j"):
        find_objective("jumps-per-joule").score(Evaluation("jump", {"fitness": 1.0}))


def test_unknown_objective():
    with pytest.raises(JumpcadError, match=r"^'fitnes' is not one of the objectives .*did you mean fitness") as caught:
        find_objective("fitnes")
    assert all(name in str(caught.value) for name in OBJECTIVES)


def test_of_a_limit_of_several_parts_the_least_margin_counts():
    """One axle holds and one does not: the limit is both met and missed, and rejects."""
    findings = (finding("axle", "info", 2.0), finding("axle", "error", -1.0), finding("room", "warning", 0.5))
    found = Evaluation("jump", findings=findings)
    assert found.margins == {"axle": -1.0, "room": 0.5}
    assert (found.met, found.missed, found.reasons) == ({"axle", "room"}, {"axle"}, ("axle",))


def test_the_published_robot_s_range_is_its_base_s_distance():
    figures = {"base_distance_m": 0.4, "spring_energy_j": 0.5}
    assert find_objective("range").score(Evaluation("jump", figures)) == 0.4
    assert find_objective("range-per-spring-joule").score(Evaluation("jump", figures)) == 0.8


def test_an_objective_divides_by_no_zero():
    with pytest.raises(JumpcadError, match="jumps-per-joule of an evaluation divides by 0"):
        find_objective("jumps-per-joule").score(Evaluation("jump", JUMP | {"electrical_energy_j": 0.0}))


def test_what_a_study_keeps_of_findings_are_names_severities_units_and_six_digits():
    told = Finding("walls", "warning", 1.23456789, "mm", "found", "change", 3.0, 4.0)
    found = Evaluation("jump", JUMP, (told,), "a detail").bare
    assert found == Evaluation("jump", JUMP, (finding("walls", "warning", 1.23457),), "a detail")


def test_the_objective_of_a_study_is_told_and_an_own_one_does_not_score():
    assert described_objective({"objective": "rise"}) == find_objective("rise")
    own = described_objective({"objective": "mine", "objective_code": "abc"})
    assert (own.name, own.meaning, own.unit, own.code) == ("mine", "own objective", "own units", "abc")
    assert own.describe() == {"objective": "mine", "objective_code": "abc"}

    def per_euro(figures):
        return 0.00531234

    assert find_objective(per_euro).shown(per_euro({})) == "0.00531234"
    per_euro.unit, per_euro.name = "mm/EUR", "reach of a coin"
    told = find_objective(per_euro)
    assert (told.name, told.unit, told.shown(1234.5678)) == ("reach of a coin", "mm/EUR", "1234.57 mm/EUR")
    assert described_objective(told.describe()).shown(2.0) == "2 mm/EUR"
    for wrong in ("a\nb", 3, "<b>"):
        per_euro.unit = wrong
        with pytest.raises(JumpcadError, match="the objective per_euro has as unit "):
            find_objective(per_euro)
    with pytest.raises(JumpcadError, match="keeps the scores"):
        own.score(Evaluation("jump", JUMP))
