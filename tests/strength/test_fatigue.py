"""Fatigue limits against the handbook's tables and worked relations."""

import math

import pytest

from jumpcad.strength.fatigue import pin_limit_mpa, spring_jumps, spring_share


def test_springs_bear_what_the_handbooks_table_says() -> None:
    """Music wire, not shot-peened: 53 % of the tensile strength for 1e5 jumps, 50 % for 1e6; yield is at 78 %."""
    assert [spring_share(jumps) for jumps in (1.0, 1e3, 1e5, 1e6, 1e9)] == pytest.approx([0.78, 0.78, 0.53, 0.50, 0.50])
    assert spring_share(1e4) == pytest.approx(math.sqrt(0.78 * 0.53))  # half way in logarithms


@pytest.mark.parametrize("jumps", [1e3, 4e3, 1e5, 3e5, 9e5])
def test_lives_and_limits_are_inverse(jumps: float) -> None:
    assert spring_jumps(spring_share(jumps)) == pytest.approx(jumps)
    assert spring_jumps(0.5) == math.inf


@pytest.mark.parametrize(("tensile_mpa", "turning_mpa"), [(1760.0, 700.0), (1400.0, 700.0), (800.0, 400.0)])
def test_pins_that_last_obey_goodman(tensile_mpa: float, turning_mpa: float) -> None:
    """Half mean and half amplitude: s/2/Se + s/2/Su = 1, with Se that of a turning bar, half of Su or 700 MPa at most,
    times the surface factor of drawn wire.
    """
    endless = turning_mpa * 4.51 * tensile_mpa**-0.265
    limit = pin_limit_mpa(tensile_mpa, 1e6)
    assert limit / 2.0 / endless + limit / 2.0 / tensile_mpa == pytest.approx(1.0)
    assert pin_limit_mpa(tensile_mpa, 1e8) == limit


def test_pins_for_a_few_jumps_yield_before_they_tire() -> None:
    assert pin_limit_mpa(1760.0, 1.0) == pytest.approx(0.78 * 1760.0)  # yields before it tires


def test_pins_for_fewer_jumps_are_on_a_straight_line_in_logarithms() -> None:
    """From 77 % of the tensile strength at 1e3 cycles (Shigley, figure 6-18) to the endurance limit at 1e6."""
    endless = 700.0 * 4.51 * 1760.0**-0.265
    for jumps, share in ((10.0**5.4, 0.8), (10.0**5.7, 0.9)):
        strength = (0.77 * 1760.0) ** (1.0 - share) * endless**share
        limit = pin_limit_mpa(1760.0, jumps)
        assert limit / 2.0 / strength + limit / 2.0 / 1760.0 == pytest.approx(1.0)
        assert limit < 0.78 * 1760.0
