"""Bars of legs against the theory of elasticity; by handbook formulas in tests/parts/test_leg_bars.py."""

import math

import numpy as np
import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.robot.leg.strength import (
    Socket,
    bar_bending_mpa,
    bar_shear_mpa,
    bar_sideways_mpa,
    bent_energy_nmm,
    buckling_n,
)

STRIP = load_catalogue().bars["carbon-strip-3x6"]
TUBE = load_catalogue().bars["carbon-tube-6x4"]


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


def test_a_tube_is_bent_sheared_and_twisted_as_its_rings_are() -> None:
    """By integration over the radius: M·R/I + F/A, T·R/J. Across, V·Q/(I·b) in its middle is a little under 2·V/A."""
    r = np.linspace(2.0, 3.0, 100_001)
    area, polar = (float(np.trapezoid(2.0 * math.pi * r**power, r)) for power in (1, 3))
    assert bar_bending_mpa(TUBE, 500.0, 0.0) == pytest.approx(500.0 * 3.0 / (polar / 2.0), rel=1e-6)
    assert bar_bending_mpa(TUBE, 500.0, 90.0) == pytest.approx(500.0 * 3.0 / (polar / 2.0) + 90.0 / area, rel=1e-6)
    assert bar_sideways_mpa(TUBE, 500.0) == pytest.approx(bar_bending_mpa(TUBE, 500.0, 0.0))
    twisted = bar_shear_mpa(TUBE, 0.0, 70.0)
    assert twisted == pytest.approx(70.0 * 3.0 / polar, rel=1e-6)
    half = float(np.trapezoid(2.0 * r**2, r))  # first moment of the half ring
    across = 90.0 * half / (polar / 2.0 * 2.0 * (3.0 - 2.0))
    assert across < bar_shear_mpa(TUBE, 90.0, 0.0) == pytest.approx(2.0 * 90.0 / area, rel=1e-6)
    assert bar_shear_mpa(TUBE, 90.0, 0.0) < 1.05 * across
    assert bar_shear_mpa(TUBE, 90.0, 70.0) == pytest.approx(bar_shear_mpa(TUBE, 90.0, 0.0) + twisted)


def test_a_strip_is_bent_along_its_height_and_sheared_by_a_parabola() -> None:
    """6·M/(b·h²) + F/(b·h); in the middle 1.5 times the mean. It buckles across its thinner side."""
    assert bar_bending_mpa(STRIP, 450.0, -0.0) == pytest.approx(6.0 * 450.0 / (3.0 * 36.0))
    assert bar_bending_mpa(STRIP, 0.0, 90.0) == pytest.approx(90.0 / 18.0)
    assert bar_shear_mpa(STRIP, 90.0, 0.0) == pytest.approx(1.5 * 90.0 / 18.0)
    flat = STRIP.model_copy(update={"width_mm": 6.0, "height_mm": 3.0})
    by_hand = math.pi**2 * STRIP.modulus_mpa * (6.0 * 27.0 / 12.0) / 80.0**2
    assert buckling_n(STRIP, 80.0) == buckling_n(flat, 80.0) == pytest.approx(by_hand)


def test_a_cantilever_takes_the_energy_of_its_tips_way() -> None:
    """F²·l³/(6·E·I); of one that is stiff but for its outer half, an eighth of it."""
    even = np.full(2001, 3e5)
    whole = (450.0 / 90.0) ** 2 * 90.0**3 / (6.0 * 3e5)
    assert bent_energy_nmm(even, 450.0, 90.0) == pytest.approx(whole, rel=1e-5)
    stiff = np.where(np.linspace(0.0, 1.0, 2001) < 0.5, 1e15, even)
    assert bent_energy_nmm(stiff, 450.0, 90.0) == pytest.approx(whole / 8.0, rel=5e-3)
