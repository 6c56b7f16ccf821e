"""Stresses against textbook values and independent computations."""

import math

import numpy as np
import pytest

from jumpcad.strength.stress import (
    SOLID,
    Beam,
    Shell,
    bar_shear_mpa,
    bored_stress_mpa,
    buckling_load_n,
    eye_stress_mpa,
    height_for_mm,
    jaw_stress_mpa,
    pin_limit_mpa,
    pin_stress_mpa,
    spring_jumps,
    spring_share,
    tapered_energy_nmm,
    tapered_stress_mpa,
    tip_stiffness_n_per_mm,
    tube_shear_mpa,
    twisted_height_mm,
)
from jumpcad.workshop import load_workshop

SHELL = Shell(1.35, 0.9, 0.2)


@pytest.mark.parametrize(("width", "height"), [(6.0, 1.7), (1.5, 9.0), (1.0, 1.0)])
@pytest.mark.parametrize("upright", [False, True])
def test_a_bar_that_is_all_shell_is_solid(width: float, height: float, upright: bool) -> None:
    """Walls of 1.35 mm on either side or layers of 0.9 mm fill what is thinner than both."""
    thin, solid = Beam(width, height, SHELL, upright), Beam(width, height)
    assert thin.area_mm2 == pytest.approx(solid.area_mm2) == pytest.approx(width * height)
    assert thin.second_moment_mm4 == pytest.approx(width * height**3 / 12.0)


def second_moment(width: np.ndarray, z: np.ndarray) -> float:
    return float(np.trapezoid(width * z**2, z))


def test_solid_bar_is_the_rectangle_of_every_table() -> None:
    # Roark, table A.1: I = b·h³/12, section modulus b·h²/6
    assert Beam(6.0, 10.0).second_moment_mm4 == pytest.approx(500.0)
    assert Beam(6.0, 10.0).stress_mpa(1560.0) == pytest.approx(15.6)
    assert Beam(6.0, 10.0).stress_mpa(1560.0, -60.0) == pytest.approx(16.6)


@pytest.mark.parametrize("upright", [False, True])
def test_hollow_bar_by_integration_over_its_height(upright: bool) -> None:
    bar = Beam(6.0, 10.0, SHELL, upright)
    side, end = (1.35, 0.9) if upright else (0.9, 1.35)
    z = np.linspace(-5.0, 5.0, 200_001)
    bearing = np.where(np.abs(z) < 5.0 - end, 6.0 - 0.8 * (6.0 - 2.0 * side), 6.0)
    assert bar.second_moment_mm4 == pytest.approx(second_moment(bearing, z), rel=1e-4)
    assert bar.area_mm2 == pytest.approx(float(np.trapezoid(bearing, z)), rel=1e-4)


def test_a_bar_thinner_than_its_shell_is_solid() -> None:
    assert Beam(1.7, 10.0, SHELL).second_moment_mm4 == pytest.approx(1.7 * 1000.0 / 12.0)


def test_shell_of_full_infill_bears_like_solid() -> None:
    process = load_workshop().process
    full = Shell.of(process.model_copy(update={"infill": 1.0}))
    assert Beam(6.0, 10.0, full).second_moment_mm4 == pytest.approx(500.0)
    assert Shell.of(process).core_share < process.infill
    printed = process.model_copy(
        update={"infill": 0.4, "perimeters": 3, "line_width_mm": 0.45, "top_layers": 5, "bottom_layers": 4,
                "layer_height_mm": 0.2}
    )  # fmt: skip
    shell = Shell.of(printed)
    assert (shell.walls_mm, shell.layers_mm) == pytest.approx((3 * 0.45, 0.2 * (5 + 4) / 2.0))
    assert shell.core_share == pytest.approx(0.4 / 2.0)  # of a grid, half of the lines run along a bar


@pytest.mark.parametrize("shell", [SOLID, SHELL])
def test_height_for_bears_exactly_what_was_asked(shell: Shell) -> None:
    for moment in (100.0, 1500.0, 6000.0):
        height = height_for_mm(moment, 8.0, 15.0, shell)
        assert Beam(8.0, height, shell).stress_mpa(moment) == pytest.approx(15.0, rel=1e-6)


def test_what_bears_nothing_needs_no_height() -> None:
    assert height_for_mm(0.0, 6.0, 20.0, SHELL) == 0.0


def test_uniform_cantilever_energy() -> None:
    # Castigliano: U = P²·l³/(6·E·I) for an end load P, with M = P·l
    force, length, modulus = 15.6, 100.0, 2000.0
    bar = Beam(6.0, np.full(401, 10.0))
    assert tapered_energy_nmm(modulus * np.asarray(bar.second_moment_mm4), force * length, length) == pytest.approx(
        force**2 * length**3 / (6.0 * modulus * 500.0), rel=1e-4
    )


def test_tapered_cantilever_bears_most_where_its_section_says() -> None:
    # b·h² falls as fast as the moment in a cantilever of parabolic height, which is equally stressed all along
    share = np.linspace(1.0, 0.0, 101)
    parabola = Beam(6.0, 10.0 * np.sqrt(np.maximum(share, 1e-9)))
    assert tapered_stress_mpa(parabola, 1000.0) == pytest.approx(10.0, rel=1e-9)
    assert tapered_stress_mpa(Beam(6.0, np.linspace(10.0, 2.0, 101)), 1000.0) > 10.0


def test_bored_bar_by_difference_of_two_bars() -> None:
    # the bore takes the middle of the bar away: I = b·(H³ - d³)/12
    second = Beam(8.0, 11.8).second_moment_mm4 - Beam(8.0, 6.2).second_moment_mm4
    assert bored_stress_mpa(1559.0, 8.0, 11.8, 6.2) == pytest.approx(1559.0 * 5.9 / second)


def test_eye_fails_by_the_worst_of_bearing_and_tear_out() -> None:
    # Shigley 8-12: bearing F/(t·d); shear-out over two ligaments, F/(2·a·t), times sqrt(3) by distortion energy
    assert eye_stress_mpa(100.0, 5.0, 20.0, 2.0) == pytest.approx(100.0 / (5.0 * 2.0))
    assert eye_stress_mpa(100.0, 5.0, 8.0, 4.0) == pytest.approx(math.sqrt(3.0) * 100.0 / (2.0 * 2.0 * 5.0))


def test_round_pin() -> None:
    z = np.linspace(-1.5, 1.5, 400_001)
    second = second_moment(2.0 * np.sqrt(1.5**2 - z**2), z)
    assert pin_stress_mpa(500.0, 3.0) == pytest.approx(500.0 * 1.5 / second, rel=1e-5)


def test_tube_in_torsion_by_integration_over_its_radius() -> None:
    r = np.linspace(1.7, 3.5, 100_001)
    polar = float(np.trapezoid(2.0 * math.pi * r**3, r))
    assert tube_shear_mpa(200.0, 7.0, 3.4) == pytest.approx(200.0 * 3.5 / polar, rel=1e-6)


def test_buckling_load_is_the_lowest_eigenvalue_of_the_bent_column() -> None:
    # -E·I·w'' = P·w with w = 0 at both ends, by finite differences
    count, length = 400, 100.0
    step = length / count
    matrix = (2.0 * np.eye(count - 1) - np.eye(count - 1, k=1) - np.eye(count - 1, k=-1)) / step**2
    load = 2000.0 * float(Beam(8.0, 6.0).second_moment_mm4) * float(np.linalg.eigvalsh(matrix)[0])
    assert buckling_load_n(Beam(8.0, 6.0).second_moment_mm4, length, 2000.0) == pytest.approx(load, rel=1e-4)


def test_jaws_are_short_cantilevers_of_their_share_of_the_torque() -> None:
    """10 to 18 mm, jaws of half a radian, 6 mm long, 700 N·mm on two: 50 N each at 7 mm, on 4 x 3.5 mm of root.

    6·50·3/(4·3.5²) = 18.37 MPa of bending, 1.5·50/(4·3.5) = 5.36 MPa of shear, joined by von Mises.
    """
    found = jaw_stress_mpa(700.0, 0.5, 2, 10.0, 18.0, 6.0)
    assert found == pytest.approx(math.sqrt(18.367**2 + 3.0 * 5.357**2), rel=1e-3)


def test_a_bar_in_torsion_by_the_handbook() -> None:
    """Shigley 3-40: T/(b·c²)·(3 + 1.8·c/b), whichever side is the longer."""
    assert bar_shear_mpa(100.0, 4.0, 8.0) == pytest.approx(100.0 / (8.0 * 16.0) * 3.9)
    assert bar_shear_mpa(100.0, 8.0, 4.0) == pytest.approx(100.0 / (8.0 * 16.0) * 3.9)


@pytest.mark.parametrize("torque_nmm", [1.0, 60.0, 230.0, 235.0, 300.0, 4000.0])
def test_a_bar_that_is_as_high_as_a_torque_asks_is_twisted_as_much_as_allowed(torque_nmm: float) -> None:
    """Lower than wide, about square (S·a³/4.8 = 231 N·mm) and higher; the stress is the handbook's."""
    height = twisted_height_mm(torque_nmm, 4.0, 17.33)
    assert (height > 4.0) == (torque_nmm > 231.1)
    assert bar_shear_mpa(torque_nmm, 4.0, height) == pytest.approx(17.33)
    assert twisted_height_mm(0.0, 4.0, 17.33) == 0.0


def test_the_tip_of_a_uniform_cantilever_gives_way_by_the_handbook() -> None:
    """F/f = 3·E·I/l³."""
    stiffness = tip_stiffness_n_per_mm(Beam(6.0, np.full(201, 10.0)), 80.0, 2000.0)
    assert stiffness == pytest.approx(3.0 * 2000.0 * 500.0 / 80.0**3, rel=1e-3)


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
