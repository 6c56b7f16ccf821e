"""Remedies with numbers: the value that one names cures, few designs are built for it, slow checks get none."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.built import built

import jumpcad
from jumpcad import remedy_numbers
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import EvaluationResult, evaluate
from jumpcad.findings import Finding, at_most, limit, lower
from jumpcad.remedy_numbers import ALL, TRIES, Remedies, next_steps
from jumpcad.simulation import simulate
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

    monkeypatch.setattr(remedy_numbers, "evaluate", counted)
    return designs


def wrong(design: Design) -> list[str]:
    found = evaluate(design, SHOP, engine="planar").findings
    return [one.name for one in found if one.severity != "info"]


@pytest.mark.thorough
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


def test_shadow_prices_of_a_linear_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    """Way = 0.4 m·(use of a) + 0.1 m·(use of b): 5 % more of a is worth 20 mm, of b 5 mm, of both 25 mm, of c nothing.

    Within its limits it gains the 4 and 2 mm that are left of both. d goes with a: alone neither is worth anything.
    """
    robot = built("kenan-2.0")
    start, here = np.array(robot.design.to_vector()), remedy_numbers._way_m(robot)
    slopes = np.zeros((4, 8))
    slopes[0, 4], slopes[1, 6], slopes[2, 0], slopes[3, 4] = 2.0, 2.0, 1.0, 2.0
    uses = np.array([0.99, 0.98, 0.97, 0.91])

    def figures(vector: np.ndarray, *_: object) -> np.ndarray:
        more = slopes @ (vector / start - 1.0)
        return np.array([here + 0.4 * more[0] + 0.1 * more[1], *(uses + more)])

    def near(*used: float) -> list[Finding]:
        return [at_most(name, use, 1.0, "", "", "") for name, use in zip("dcba", used[::-1], strict=True)]

    monkeypatch.setattr(remedy_numbers, "_figures", figures)
    (both, first, second, gram), within_mm = next_steps(robot, near(*uses))
    assert (both.limit, first.limit, first.number, second.limit) == (ALL, "a", "compression_ratio", "b")
    assert (both.gain_mm, first.gain_mm, second.gain_mm, within_mm) == pytest.approx((25.0, 20.0, 5.0, 6.0), rel=1e-6)
    assert first.change == pytest.approx(0.025)
    uses[3] = 0.99
    assert [one.limit for one in next_steps(robot, near(*uses))[0]] == [ALL, "b", ""]
    lighter = replace(robot.bodies["body"], mass_kg=robot.bodies["body"].mass_kg - 0.001)
    jumps = [
        simulate(one, engine="planar") for one in (robot, replace(robot, bodies={**robot.bodies, "body": lighter}))
    ]
    gained_mm = 1000.0 * (jumps[1].touchdown_distance_m - jumps[0].touchdown_distance_m)
    assert gram.gain_mm == pytest.approx(gained_mm, abs=0.2)
