"""Bars of legs against the theory of elasticity; by handbook formulas in tests/parts/test_leg_bars.py."""

import math

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.strength.leg_bar import bar_shear_mpa, bar_sideways_mpa

STRIP = load_catalogue().bars["carbon-strip-3x6"]


@pytest.mark.parametrize("times", [1.0, 1.5, 2.0, 4.0, 10.0])
def test_a_twisted_strip_is_sheared_as_saint_venant_says(times: float) -> None:
    """His series for a rectangle of sides b and c: the largest stress is in the middle of the longer side."""
    short, odd = 2.0, range(1, 40, 2)
    series = sum(1.0 / n**2 / math.cosh(n * math.pi * times / 2.0) for n in odd)
    twist = sum(math.tanh(n * math.pi * times / 2.0) / n**5 for n in odd)
    share = (1.0 - 8.0 / math.pi**2 * series) / (1.0 / 3.0 - 64.0 / math.pi**5 / times * twist)
    stress = 500.0 * share / (times * short * short**2)
    for width, height in ((short, times * short), (times * short, short)):
        strip = STRIP.model_copy(update={"width_mm": width, "height_mm": height})
        assert bar_shear_mpa(strip, 0.0, 500.0) == pytest.approx(stress, rel=0.05)


def test_a_strip_is_bent_sideways_by_its_section_modulus() -> None:
    """6·M/(h·b²) of 3 x 6 mm, b across the robot."""
    assert bar_sideways_mpa(STRIP, 450.0) == pytest.approx(6.0 * 450.0 / (6.0 * 9.0))
