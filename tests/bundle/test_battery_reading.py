"""What a multimeter reads at the divider, and how far `state` may be off: every corner of the tolerances."""

import itertools

import pytest

from jumpcad.bundle.battery_reading import pin_share, state_off_v
from jumpcad.electronics.nets import Wiring

LOWER, CORNERS = 200e3, tuple(itertools.product((0.99, 1.0, 1.01), repeat=2))
"""The lower resistor (ohm); both resistors are of 1 %."""


def wiring(upper_ohm: int | None) -> Wiring:
    return Wiring((), {}, upper_ohm)


@pytest.mark.parametrize("upper", [200_000, 470_000, 680_000, 1_000_000])
def test_a_multimeter_reads_the_divider_with_itself_beside_the_lower_resistor(upper: int) -> None:
    """10 MΩ in parallel, by Ohm's law, and 1 % of the reading."""
    read = []
    for one, other in CORNERS:
        lower = 1.0 / (1.0 / (LOWER * one) + 1.0 / 10e6)
        read += [lower / (lower + upper * other) * meter for meter in (0.99, 1.01)]
    assert pin_share(wiring(upper)) == pytest.approx((min(read), max(read)), rel=5e-4)


@pytest.mark.parametrize(("upper", "volts"), [(200_000, 3.7), (680_000, 7.4)])
def test_state_is_off_by_resistors_and_converter(upper: int, volts: float) -> None:
    """The pin's voltage, 35 mV off, times the divider that the firmware believes."""
    believed = (upper + LOWER) / LOWER
    off = [
        abs(believed * (volts * LOWER * one / (LOWER * one + upper * other) + converter) - volts)
        for one, other in CORNERS
        for converter in (-0.035, 0.035)
    ]
    assert state_off_v(wiring(upper), volts) == pytest.approx(max(off), rel=0.02)


def test_without_a_divider_only_the_converter_is_off() -> None:
    assert state_off_v(wiring(None), 3.7) == pytest.approx(0.035)
    assert pin_share(wiring(None)) == pytest.approx((0.99, 1.01))
