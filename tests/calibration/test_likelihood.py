"""Scatter of measurements: what more jumps reduce, and what they do not."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from jumpcad.calibration.likelihood import Datum, Predicted, predict
from jumpcad.calibration.surface import JumpAt

ONE = np.ones(1)
STILL = Predicted(JumpAt(ONE, ONE, ONE, ONE), 0.0 * ONE, ONE, (0.0, 0.0), 0.1)


def deviation(what: str, of: str, count: int, scatter: float, error: float) -> float:
    """Return the standard deviation of a mean of some jumps of 0.2 m."""
    datum = Datum("robot", what, of, 0.2, count, scatter, error)
    return float(STILL.deviation(datum, of, 0.2 * ONE)[0])


@pytest.mark.parametrize(("what", "of"), [("height", "rise"), ("distance", "centre-of-mass")])
def test_the_mean_of_nine_jumps_has_a_third_of_the_deviation(what: str, of: str) -> None:
    """Errors of a mean fall with the root of the number, those of reading a height too; the model's stay."""
    one, nine = (deviation(what, of, count, 0.08, 0.0) for count in (1, 9))
    assert nine == pytest.approx(one / 3.0)
    assert deviation(what, of, 10**8, 0.08, 0.03) == pytest.approx(0.03 * 0.2, rel=1e-3)


def test_a_height_is_read_to_15_mm() -> None:
    assert deviation("height", "rise", 1, 0.0, 0.0) == pytest.approx(0.015)
    assert deviation("height", "rise", 1, 0.08, 0.03) == pytest.approx(math.hypot(0.015, 0.016, 0.006))


def test_a_better_drive_takes_less_from_the_battery() -> None:
    """Of 2 J by the model: a fifth more efficient, and springs that are a tenth stiffer."""
    surface = SimpleNamespace(at=lambda *_: None)
    measured = SimpleNamespace(release="dog")
    subject = SimpleNamespace(
        name="a", pair="a", measured=measured, surface=surface, electrical_j=2.0, beyond_m=(0.0, 0.0), standing_m=0.1
    )
    values = {
        "rate:a": 1.1 * ONE, "mass:a": ONE, "floor:a": ONE, "pin_friction": ONE, "spring_efficiency": ONE,
        "drive_efficiency": 1.2 * ONE,
    }  # fmt: skip
    assert predict(subject, values).battery_j == pytest.approx([2.0 * 1.1 / 1.2])  # type: ignore[arg-type]
