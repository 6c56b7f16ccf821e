"""Predictions beside measurements of the study's prototypes."""

import pytest

from jumpcad.bundle.page import Beside, Compared
from jumpcad.files.rendering import fill


def row(what: str, reading: str, measured: float, predicted: tuple[float, float, float], below: float = 0.4) -> Beside:
    return Beside.model_construct(what=what, reading=reading, measured=measured, predicted=predicted, below_share=below)


def verdict(*rows: Beside) -> str:
    found = Compared.model_construct(design="a", calibrated_on="b", rows=rows)
    return fill("report/compared.html.j2", {"beside": found})


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
