"""Remedies with numbers: the value that one names cures, few designs are built for it, slow checks get none."""

import re

import pytest

import jumpcad
from jumpcad import remedies
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import EvaluationResult, evaluate
from jumpcad.findings import limit, lower
from jumpcad.remedies import TRIES, Remedies
from jumpcad.workshop import load_workshop
from jumpcad.workshop.varied import varied

KENAN, SHOP = jumpcad.load_design("kenan-2.0"), load_workshop()


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[Design]:
    """Return the designs that are built for remedies."""
    designs: list[Design] = []

    def counted(design: Design, *more: object, **named: object) -> EvaluationResult:
        designs.append(design)
        return evaluate(design, *more, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(remedies, "evaluate", counted)
    return designs


def wrong(design: Design) -> list[str]:
    found = evaluate(design, SHOP, engine="planar").findings
    return [one.name for one in found if one.severity != "info"]


def test_the_value_that_is_named_cures_and_was_found_by_few_tries(tried: list[Design]) -> None:
    """Of limits, and of a design that cannot be built; the change is at most twice the least that cures."""
    for key, value, named in (("c_coef", 0.7, "raise (e_coef) to "), ("compression_ratio", 0.133, "raise (s.*?g) to "),
                              ("compression_ratio", 0.886, "lower (compression_ratio) to "),
                              ("stiffness_nmm_per_deg", 200.0, "lower (stiffness_nmm_per_deg) to "),
                              ("carrying_link_mm", 300.0, "lower (carrying_link_mm) to "),
                              ("rest_angle_deg", 20.0, "raise (rest_angle_deg) to ")):  # fmt: skip
        bad = KENAN.model_copy(update={key: value})
        tried.clear()
        asks = Remedies(bad, SHOP)
        try:
            found = evaluate(bad, SHOP, engine="planar").findings
            first = next(one for one in asks.of_findings(found) if one.severity != "info")
            said = first.remedy
        except CannotBuildError as refusal:
            said = str(asks.of_refusal(refusal))
        match = re.search(named + r"([\d.]+)", said)
        assert match, said
        assert 0 < len(tried) <= TRIES, said
        now, cured = getattr(bad, match[1]), float(match[2])
        assert wrong(bad.model_copy(update={match[1]: cured})) == [], said
        with pytest.raises((AssertionError, CannotBuildError)):
            assert wrong(bad.model_copy(update={match[1]: now + 0.5 * (cured - now)})) == []


def test_no_number_is_sought_where_a_check_takes_a_second(tried: list[Design]) -> None:
    overlap = limit("interference", -1.0, "mm³", "", lower("compression_ratio"))
    assert Remedies(KENAN, SHOP).of_findings([overlap]) == [overlap]
    assert tried == []


def test_springs_from_stock_fit_with_the_preload_that_is_named() -> None:
    stock = varied(SHOP, {"bought.spring": "9271K619"})
    with pytest.raises(CannotBuildError) as refused:
        evaluate(KENAN, stock)
    match = re.search(r"raise spring.preload_deg to ([\d.]+),", str(Remedies(KENAN, stock).of_refusal(refused.value)))
    assert match
    found = evaluate(KENAN, varied(stock, {"spring.preload_deg": float(match[1])})).findings
    assert [one.name for one in found if one.severity != "info"] == []
