"""Bars of legs against the theory of elasticity; by handbook formulas in tests/parts/test_leg_bars.py."""

import math

import numpy as np
import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.strength.leg_bar import Socket, bar_shear_mpa, bar_sideways_mpa

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


def test_a_socket_presses_evenly_with_the_shear_and_to_its_ends_with_the_moment() -> None:
    """6·M/(b·a²) at the ends and F/(a·b) all along: equilibrium of a linear pressure. The walls beside hold it."""
    socket = Socket(STRIP, 30.0, 7.0, 10.0, 0.1)
    width = STRIP.width_mm
    assert width == 3.0
    assert socket.pressure_mpa(0.0, 90.0) == pytest.approx(90.0 / (30.0 * 3.0))
    assert socket.pressure_mpa(450.0, 0.0) == pytest.approx(6.0 * 450.0 / (3.0 * 30.0**2))
    x = np.linspace(-15.0, 15.0, 3001)  # from the socket's middle
    pressure = 90.0 / 30.0 + 12.0 * 450.0 / 30.0**3 * x  # N/mm
    assert np.trapezoid(pressure, x) == pytest.approx(90.0)
    assert np.trapezoid(pressure * x, x) == pytest.approx(450.0, rel=1e-4)
    assert socket.pressure_mpa(450.0, 90.0) == pytest.approx(pressure.max() / 3.0)
    assert socket.wall_mpa(450.0, 90.0) == pytest.approx(pressure.max() / (7.0 - 3.0 - 2.0 * 0.1))


def test_a_sockets_floor_bears_the_moment_beside_the_bars_room_and_its_glue_the_pull_and_the_twist() -> None:
    """Bending of a hollow section, M·h/2 over the difference of two second moments; glue on a perimeter of 18 mm."""
    socket = Socket(STRIP, 30.0, 7.0, 10.0, 0.1)
    second_moment = (7.0 * 10.0**3 - 3.2 * 6.2**3) / 12.0
    assert socket.bending_mpa(450.0) == pytest.approx(450.0 * 5.0 / second_moment)
    pull, twist = 90.0 / (18.0 * 30.0), 60.0 / (18.0 * 30.0 * 1.5)
    assert socket.bond_mpa(90.0, 0.0) == pytest.approx(pull)
    assert socket.bond_mpa(90.0, 60.0) == pytest.approx(math.hypot(pull, twist))
