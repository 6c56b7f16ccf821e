"""Limits of the cage against the ring and the beam of handbooks, and the robots that they refuse."""

import math

import numpy as np
import pytest
from robot.cage.test_place import FLAT, caged
from support.each import each

import jumpcad
from jumpcad.catalogue import load_catalogue
from jumpcad.checks import check, quick_findings
from jumpcad.checks.springs_loaded import righting_findings
from jumpcad.findings import Finding
from jumpcad.remedy_numbers import Remedies
from jumpcad.robot.cage.limits import bar_mpa, bent_strain, landing_n, landing_strain, ring_n_per_mm, two_horns
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop, varied

GLASS = load_catalogue().cage_rods["glass-1.5"]


def found(robot: Robot) -> dict[str, Finding]:
    """Return the quick findings of the cage by name."""
    return {one.name: one for one in quick_findings(robot) if one.name.startswith("cage")}


@pytest.mark.thorough
def test_what_bears_a_fall_on_the_tail_grows_with_the_fourth_power_of_the_width_beside_the_notch() -> None:
    """It holds F = σ·p·w²/(3·l), a beam's end; horns are springs, which take F². The tip is 10.6 mm wide, the bar 3."""
    shops = [varied(load_workshop("best-jumper"), {"cage.rear_tip_mm": wider}) for wider in (0.0, 1.0)]
    plain, wide = (found(jumpcad.build("best-jumper", workshop=shop))["cage_behind"].limit for shop in shops)
    beside = (10.6 - 3.0) / 2.0 - shops[0].fits.drawn.press_mm
    assert wide / plain == pytest.approx(((beside + 1.0) / beside) ** 4, rel=1e-3)


def test_a_hoop_is_a_ring_between_two_forces() -> None:
    """Half of a ring summed up: M = F·R·(1/π - cos(t)/2) from the load, and the work of F is the energy of bending."""
    radius, force = 95.0, 3.0
    t = np.linspace(0.0, 2.0 * math.pi, 20001)
    moment = force * radius * (1.0 / math.pi - np.abs(np.sin(t)) / 2.0)
    energy_nmm = float(np.trapezoid(moment**2, t)) * radius / (2.0 * GLASS.bending_nmm2)
    deflection = 2.0 * energy_nmm / force
    assert force / deflection == pytest.approx(ring_n_per_mm(GLASS, radius), rel=0.002)
    at_the_sides = 1.0 / radius - moment.min() / GLASS.bending_nmm2
    strain = GLASS.diameter_mm / 2.0 * at_the_sides
    assert landing_strain(GLASS, radius, energy_nmm / 1000.0) == pytest.approx(strain, rel=0.002)
    assert landing_n(GLASS, radius, energy_nmm / 1000.0) == pytest.approx(force, rel=0.002)


def test_a_rod_bent_round_95_mm() -> None:
    """1.5 mm of 40 GPa: E·I = 9,940 N·mm², 105 N·mm, 0.79 %; on 3 x 5 mm 8.4 MPa."""
    assert GLASS.bending_nmm2 / 95.0 == pytest.approx(104.6, abs=0.1)
    assert 100.0 * bent_strain(GLASS, 95.0) == pytest.approx(0.789, abs=0.001)
    assert bar_mpa(GLASS, 95.0, 3.0, 5.0) == pytest.approx(104.6 / 12.5, abs=0.01)


def test_even_horns_are_cantilevers_and_a_triangle_bears_three_times_as_much_by_its_mass() -> None:
    """Two of 6 x 2.4 x 60 mm of PLA: σ²·V/(18·E) = 112 mJ either way, σ²·V/(6·E) where each section is at its strength.

    Pressed from ahead so that a twentieth bends them, they buckle at 2.05·π²·E·I/L² = 97 N each.
    """
    pla = load_workshop("default").material("body")
    each_n, sideways, upwards = two_horns(pla, (60.0, 60.0), (6.0, 6.0), (2.4, 2.4), 1.0)
    assert each_n == pytest.approx(60.0 / 2.0 / (2.4 * 6.0**2 / 6.0), rel=0.01)
    whole_j = 54.0**2 * 2.0 * 60.0 * 6.0 * 2.4 / 2500.0 / 1000.0
    assert [sideways, upwards] == pytest.approx([whole_j / 18.0] * 2, rel=0.02)
    _, sideways, _ = two_horns(pla, (60.0, 60.0), (1e-6, 6.0), (2.4, 2.4), 1.0)
    assert sideways == pytest.approx(whole_j / 2.0 / 6.0, rel=0.02)
    assert two_horns(pla, (30.0, 60.0), (6.0, 6.0), (2.4, 2.4), 1.0) == pytest.approx(
        (each_n, whole_j / 18.0, whole_j / 18.0), rel=0.02
    )
    _, _, upwards = two_horns(pla, (60.0, 60.0), (6.0, 6.0), (2.4, 2.4), 0.05)
    force = 54.0 * 2.4 * 6.0**2 / 6.0 / 60.0
    shortens = 60.0 / (6.0 * 2.4) / 2500.0 / 1000.0  # of two, for each newton squared: F²·L/(E·A)
    assert upwards == pytest.approx(0.112 * (97.1 * 0.05 / force) ** 2 + 97.1**2 * shortens, rel=0.03)
    _, _, upwards = two_horns(pla, (60.0, 60.0), (6.0, 6.0), (2.4, 2.4), 0.05, 50.0)  # the ends hold less
    assert upwards == pytest.approx(0.112 * (50.0 * 0.05 / force) ** 2 + 50.0**2 * shortens, rel=0.03)


@pytest.mark.thorough
@each("kit", ("light-1s", "strong-2s"))
def test_best_jumper_bears_its_own_falls(kit: str) -> None:
    shop = varied(load_workshop("best-jumper"), {"bought.kit": kit})
    kept = found(jumpcad.build(jumpcad.load_design("best-jumper"), shop))
    assert all(
        kept[name].severity == "info" and kept[name].margin > 0.0 for name in ("cage_side", "cage_ahead", "cage_behind")
    )


def test_glass_passes_and_other_rods_fail_where_they_must() -> None:
    assert all(one.severity == "info" for one in found(caged()).values())
    for rod, name in (("carbon-1.5", "cage_landing"), ("steel-1", "cage_landing"), ("glass-2", "cage_bar")):
        assert found(caged(rod=rod))[name].severity == "error", rod
    assert found(caged(rod="glass-2", bar_mm=9.0))["cage_bar"].severity == "info"
    assert found(caged(rear_radius_mm=65.0))["cage_bend"].severity == "error"


def test_the_cage_is_free_of_everything_in_every_position() -> None:
    found = check(caged(bow=True, bar_mm=10.0))
    assert not [one for one in found if one.severity == "error" and one.name in ("interference", "walls")]


def test_a_robot_that_crouches_too_little_is_warned_of() -> None:
    design, shop = jumpcad.load_design("kenan-2.0"), varied(load_workshop("default"), {"cage.rod": "glass-1.5"})
    (told,) = righting_findings(jumpcad.build(design, shop))
    assert told.severity == "warning"
    assert "compression_ratio" in told.remedy
    assert Remedies(design, shop).of_findings([told]) == [told], "no number cures it: 15 % are far from 90 %"
    assert next(iter(righting_findings(jumpcad.build(FLAT))), None) is None
