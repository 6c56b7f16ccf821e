"""Predictions beside measurements of the study's prototypes."""

import re

import pytest

from jumpcad.bundle.compared import READINGS, Beside, Compared
from jumpcad.files.rendering import fill


def row(what: str, reading: str, measured: float, predicted: tuple[float, float, float], below: float = 0.4) -> Beside:
    return Beside.model_construct(what=what, reading=reading, measured=measured, predicted=predicted, below_share=below)


def verdict(*rows: Beside) -> str:
    found = Compared.model_construct(design="a", calibrated_on="b", rows=rows)
    return fill("report/compared.html.j2", {"beside": found, "readings": READINGS})


@pytest.mark.parametrize(("measured", "holds"), [(0.19, False), (0.2, True), (0.3, True), (0.4, True), (0.41, False)])
def test_a_measurement_is_predicted_where_eight_in_ten_draws_hold_it(measured: float, holds: bool) -> None:
    said = verdict(row("distance", "first-touchdown", measured, (0.2, 0.3, 0.4)))
    assert ("Every measurement lies within" in said) == holds
    assert ("does not predict the measured distance" in said) == (not holds)


def test_one_reading_that_holds_is_enough_and_each_quantity_is_named_once() -> None:
    far = row("distance", "first-touchdown", 0.5, (0.2, 0.3, 0.4))
    assert "Every measurement" in verdict(far, row("distance", "resting-place", 0.5, (0.4, 0.5, 0.6)))
    said = verdict(far, far, row("battery", "battery", 3.0, (1.0, 1.5, 2.0)))
    assert "the measured distance and battery energy: no interval" in said


def test_values_are_in_millimetres_or_joules() -> None:
    assert ">314 mm<" in verdict(row("distance", "first-touchdown", 0.314, (0.2, 0.3, 0.4)))
    for share, shown in ((0.0, "1 %"), (0.404, "40 %"), (1.0, "99 %")):
        assert f">{shown}<" in verdict(row("height", "rise", 0.1, (0.1, 0.2, 0.3), share))
    cells = re.findall(r'number">([^<]*)</td>', verdict(row("battery", "battery", 1.5, (1.0, 1.6, 2.0), 0.25)))
    assert cells == ["1.50 J", "1.00…1.60…2.00 J", "25 %"]


def test_a_draw_without_a_jump_is_told() -> None:
    assert "counts as 0" in verdict(row("distance", "first-touchdown", 0.3, (0.0, 0.3, 0.4)))
    jumps = row("height", "rise", 0.1, (0.05, 0.1, 0.2))
    assert "counts as 0" in verdict(jumps, row("distance", "first-touchdown", 0.3, (0.0, 0.3, 0.4)), jumps)
    assert "counts as 0" not in verdict(row("distance", "first-touchdown", 0.3, (0.1, 0.3, 0.4)))
