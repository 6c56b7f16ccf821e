"""What a study's page says was learned: bars, bounds and reasons in words, of made-up studies."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from support.hills import SMALL

from jumpcad.design import load_design
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.files.templates import fill
from jumpcad.findings import Finding
from jumpcad.search.explore import Importance
from jumpcad.search.report import page as study_page
from jumpcad.search.report.figures import reason_words, with_unit
from jumpcad.search.report.page import importances, reason_rows, rising
from jumpcad.search.robust_pick import NOT_EXAMINED, ActiveBound
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import Trial

DESIGN = load_design("best-ga")
LEARNED = Importance(
    ("c_coef", "d_coef", "e_coef", "rest_angle_deg", "carrying_link_mm"),
    np.array([0.1, 0.4, 0.05, 0.6, 0.2]), np.array([0.02, 0.1, 0.06, 0.1, 0.19]), 0.9, 40,
)  # fmt: skip


def failed(*names: str) -> Trial:
    """Return a trial that these limits reject."""
    findings = tuple(Finding(name, "error", -1.0, "mm", "", "") for name in names)
    return Trial("ga", 0, 0, DESIGN, Evaluation("jump", {}, findings), None, "m", 0.0)


def known(*trials: Trial, bounds: tuple[ActiveBound, ...] = ()) -> StudySummary:
    """Return what is known of a study of these trials, the first of which won."""
    winner = trials[0] if trials and trials[0].score is not None else None
    return StudySummary(SMALL, find_objective("range"), list(trials), winner, [], list(bounds), {})


WON = replace(failed(), evaluation=Evaluation("jump"), score=2.0)


def page(found: StudySummary) -> str:
    """Return this part of the page."""
    values = {
        "importance": importances(SimpleNamespace(identity={"seed": 7}), found), "found": found,
        "rising": rising(found),
        "with_unit": with_unit, "reason_words": reason_words,
        "reasons": reason_rows(found), "designs": counted(len(found.trials), "design"),
        "rejected": sum(trial.score is None for trial in found.trials),
    }  # fmt: skip
    return fill("report/study/lessons.html.j2", values)


def text(found: StudySummary) -> str:
    """Return its words."""
    return " ".join(re.sub(r"<[^>]*>", " ", re.sub("<wbr />", "", page(found))).split())


def test_three_that_are_clear_matter_most_the_largest_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """A bar is clear where it is longer than its error; the others perhaps do nothing, the longest first."""
    alone = Importance(("c_coef",), np.array([0.1]), np.array([0.05]), 0.9, 40)
    none = "No more than their error, so perhaps nothing: "
    for learned, said in (
        (LEARNED, "Of those beyond their error, rest_angle_deg, then d_coef, then carrying_link_mm matter most. "
         f"{none}e_coef. Learned"),
        (alone, "by the length of the bar. c_coef matters most. Learned"),
        (replace(alone, deviation=np.array([0.1])), f"by the length of the bar. {none}c_coef. Learned"),
    ):  # fmt: skip
        monkeypatch.setattr(study_page, "importance", lambda *_, known=learned: known)
        assert said in text(known(WON, replace(WON, score=3.0)))


def test_what_predicts_less_than_half_of_the_variance_does_not_say_what_is_important(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nor do designs that are too few, or that all score alike."""
    two, alike = known(WON, replace(WON, score=3.0), failed("tips")), known(WON, WON)
    told = ((0.5, "fall of R²"), (0.494, "(R² 0.49, at least 0.5 is asked for)"), (np.nan, "(R² nan, "))
    for r_squared, said in told:
        monkeypatch.setattr(study_page, "importance", lambda *_, known=r_squared: replace(LEARNED, r_squared=known))
        assert said in text(two)
        assert ("From 40 designs the score of others cannot be predicted" in text(two)) == (r_squared != 0.5)
        assert ("c_coef" in text(two)) == (r_squared == 0.5)
    assert "Importance" not in text(alike)

    def refused(*_: object) -> None:
        raise JumpcadError("too few")

    monkeypatch.setattr(study_page, "importance", refused)
    assert text(two).startswith("Importance 2 designs that jumped: too few to say what is important.")


def test_a_score_rises_where_it_gains_more_than_a_twentieth_of_a_per_cent() -> None:
    """Of a score of 2, or of -2: 0.001."""
    bound = ActiveBound("c_coef", "upper", 1.2, 1.25, None, NOT_EXAMINED)
    for worth, rises in ((0.00101, True), (0.00099, False), (-1.0, False)):
        for score in (2.0, -2.0):
            said = text(known(replace(WON, score=score), bounds=(replace(bound, worth=worth, reason=""),)))
            assert ("rises beyond that of c_coef." in said, "none that was examined" in said) == (rises, not rises)
    assert "did not examine them" in text(known(WON, bounds=(bound,)))
    assert "none that was examined" in text(known(WON, bounds=(bound, replace(bound, worth=-1.0))))


def test_a_bound_stands_in_its_row_with_units() -> None:
    bounds = (
        ActiveBound("rest_angle_deg", "upper", 70.0, 72.5, 0.5),
        ActiveBound("body.plate_mm", "lower", 1.6, 1.5, None, "x"),
    )  # fmt: skip
    said = text(known(WON, bounds=bounds))
    assert "rest_angle_deg upper 70° 72.5° +0.5 m (+25.0 %)" in said
    assert "body.plate_mm lower 1.6 mm 1.5 mm rejected, x" in said
    assert "lies on no bound" in text(known(WON))
    assert "Active bounds" not in text(known(failed("tips")))


def test_reasons_are_counted_the_most_frequent_first() -> None:
    """Two of four designs are rejected, one of them for two reasons; bars are shares of the largest count."""
    found = known(WON, failed("tips"), failed("leg_flex", "tips"), WON)
    assert "Rejected: 2 of 4 designs of the search" in text(found)
    assert "The most frequent reason is tips, of 2 designs: with loaded springs" in text(found)
    assert [(name, share, count) for name, _, share, count in reason_rows(found)] == [
        ("tips", 1.0, "2"), ("leg_flex", 0.5, "1")
    ]  # fmt: skip
    assert re.findall(r"width: (\d+)%", page(found)) == ["100", "50"]
    assert "Rejected: 0 of 1 design of the search" in text(known(WON))
    assert "most frequent" not in text(known(WON))
