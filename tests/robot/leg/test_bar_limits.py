"""Legs with a bought bar: bar, sockets and glue against handbook formulas, each under its own load."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.built import built
from support.said import well_told

from jumpcad.catalogue import load_catalogue
from jumpcad.checks import constraint_findings
from jumpcad.findings import Finding
from jumpcad.robot.leg import bar_limits as leg_bar
from jumpcad.robot.leg.bar_limits import (
    Socket,
    _bent_nmm,
    bar_bending_mpa,
    bar_shear_mpa,
    bar_sideways_mpa,
    leg_bar_findings,
)
from jumpcad.robot.leg.drawing import leg_bar_place
from jumpcad.robot.leg.place import BarPlace
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot
from jumpcad.strength.stress import buckling_load_n, tapered_energy_nmm

BARS = load_catalogue().bars


def robot(leg: str, name: str = "kenan-2.0") -> Robot:
    """Return a template's robot with a bar in its legs."""
    return built(name, leg=leg)


def under(leg: str, **loads: Any) -> LoadCase:
    """Return the load case of such a robot with some of its loads given."""
    case = LoadCase(robot(leg))
    vars(case).update(loads)  # where the properties keep what they found
    return case


def found_in(case: LoadCase) -> dict[str, Finding]:
    """Return the findings by their names."""
    return {finding.name: finding for finding in leg_bar_findings(case)}


def place_of(case: LoadCase) -> BarPlace:
    """Return where the main leg's bar is."""
    place = leg_bar_place(case.layout, case.holes)
    assert place is not None
    return place


def test_a_load_on_its_limit_is_borne_and_one_above_it_is_not() -> None:
    """Euler's load of a hinged column, π²·E·I/l², over the printed parts' factor; I about the weaker axis of 3 x 6."""
    found, usual, second = robot("carbon-strip-3x6"), LoadCase(robot("carbon-strip-3x6")), 6.0 * 3.0**3 / 12.0
    factor, other = usual.workshop.safety.printed_factor, found.design.model_copy(update={"c_coef": 1.1})
    assert other.l3_mm != pytest.approx(other.l2_mm, rel=0.01)
    euler = math.pi**2 * 127_000.0 * second / other.l3_mm**2
    for load, severity in ((0.999, "info"), (1.001, "error")):
        case = LoadCase(replace(found, design=other))
        loads = {name: getattr(usual, name) for name in ("forces", "front_n", "toe_blow_n")}
        vars(case).update(loads | {"landing_n": load * euler / factor})
        finding = found_in(case)["front_bar_buckling"]
        assert finding.severity == severity
        assert finding.limit == pytest.approx(euler / factor)
        assert finding.value == pytest.approx(load * euler / factor)


@pytest.mark.parametrize(
    ("axial", "front", "landing", "stress_n_mm"),
    [
        ([-60.0, 10.0], 1.0, 2.0, 60.0 / 5.0),  # the leg's, in 5 mm of glue
        ([-6.0, 60.0], 2.0, 1.0, 60.0 / 5.0),
        ([-1.0, 2.0], 80.0, 3.0, 80.0 / 9.0),  # the front link's, in 9 mm
        ([-1.0, 2.0], 3.0, 80.0, 80.0 / 9.0),
        ([0.0, 50.0], 80.0, 70.0, 50.0 / 5.0),
    ],
)
def test_the_glue_of_either_bar_bears_the_pull_of_its_own_leg(
    axial: list[float], front: float, landing: float, stress_n_mm: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Along a bar, in whatever direction, in the shorter sockets at the far ends."""
    case = under("carbon-tube-4x2", front_n=front, landing_n=landing, toe_blow_n=0.0)
    case.__dict__["forces"] = replace(case.forces, leg_axial_n=np.array(axial))
    bar = BARS["carbon-tube-4x2"]
    monkeypatch.setattr(leg_bar, "leg_bar_place", lambda *_: BarPlace(bar, 9.0, 30.0, 47.0, 52.0))
    monkeypatch.setattr(leg_bar, "front_bar_place", lambda *_: BarPlace(bar, 4.0, 12.0, 40.0, 49.0))
    assert found_in(case)["leg_bar_bond"].value == pytest.approx(stress_n_mm / (math.pi * 4.0))


def test_a_tapering_leg_bends_most_where_it_is_low() -> None:
    """A leg that is three times as high at the ankle as at the hub, and one the other way round, by their sections."""
    found, energies = robot("carbon-strip-3x6"), []
    for root, tip in ((6.0, 18.0), (18.0, 6.0)):
        sections = replace(found.layout.sections, leg_root_mm=root, leg_tip_mm=tip)
        case = LoadCase(replace(found, layout=replace(found.layout, sections=sections)))
        place, length = place_of(case), found.design.l2_mm
        rigid = replace(place, bar=place.bar.model_copy(update={"modulus_mpa": 1e12}))
        x = np.linspace(0.0, (place.floor_mm + place.mouth_mm) / 2.0, 4001)
        seconds = [
            float(np.max(replace(sections, leg_root_mm=height, leg_tip_mm=height).leg(case.shell).second_moment_mm4))
            for height in root + (tip - root) * x[::250] / length
        ]
        stiffness = case.workshop.material("links").modulus_mpa * np.interp(x, x[::250], seconds)
        expected = np.trapezoid((case.torque_nmm * (1.0 - x / length)) ** 2 / (2.0 * stiffness), x)
        energies.append(_bent_nmm(case, rigid))
        assert energies[-1] == pytest.approx(expected, rel=0.05)
    assert energies[0] > 5.0 * energies[1]


def test_the_socket_is_bent_by_what_is_left_of_the_torque_at_its_floor() -> None:
    """A cantilever from the hub with a force at the ankle; M·c/I of a rectangle less the hole, 3.2 x 6.2 mm."""
    found = robot("carbon-strip-3x6")
    case, design, sections = LoadCase(found), found.design, found.layout.sections
    place = place_of(case)
    torque = 1000.0 * design.peak_spring_torque_nm * (1.0 - place.floor_mm / design.l2_mm)
    slope = (sections.leg_tip_mm - sections.leg_root_mm) / design.l2_mm
    height = sections.leg_root_mm + slope * place.mouth_mm
    second = (sections.thickness_mm * height**3 - 3.2 * 6.2**3) / 12.0
    assert found_in(case)["leg_socket_strength"].value == pytest.approx(torque * height / 2.0 / second, rel=1e-6)


def test_a_bar_that_is_too_weak_is_found() -> None:
    """Half of best-printable's torque is more than a tube of 4 x 3 mm bears in shear at its socket."""
    (found,) = [
        one for one in constraint_findings(robot("carbon-tube-4x3", "best-printable")) if one.name == "leg_bar_strength"
    ]
    assert found.severity == "error"
    assert "bought.leg" in found.remedy


def test_a_soft_bar_takes_the_energy_beyond_its_sockets_middle() -> None:
    """The moment falls evenly to the ankle: T²·l/(6·E·I) of a whole bar, and the cube of what is beyond the middle."""
    found = robot("carbon-strip-3x6")
    case, length = LoadCase(found), found.design.l2_mm
    place = place_of(case)
    soft = replace(place, bar=place.bar.model_copy(update={"modulus_mpa": 1e-3}))
    beyond = 1.0 - (place.floor_mm + place.mouth_mm) / 2.0 / length
    second = place.bar.width_mm * place.bar.height_mm**3 / 12.0
    whole = case.torque_nmm**2 * length / (6.0 * 1e-3 * second)
    assert leg_bar._bent_nmm(case, soft) == pytest.approx(whole * beyond**3, rel=0.04)  # in steps


@pytest.mark.parametrize("leg", ["carbon-tube-4x2", "carbon-strip-3x6"])
def test_glue_bears_the_pull_along_a_bar_and_the_twist_of_a_landing_on_one_toe(leg: str) -> None:
    """Around the section over 8 mm of the end's socket; the twist, of an inclined leg, at half of the smaller side."""
    case = LoadCase(robot(leg))
    bar, design = BARS[leg], case.robot.design
    area = bar.around_mm * 8.0
    aside = case.toe_blow_n * case.layout.toe_half_width_mm
    twist = aside * math.cos(math.radians(design.rest_angle_deg))
    pulls = (float(np.abs(case.forces.leg_axial_n).max()), case.front_n, case.landing_n)
    stress = math.hypot(max(pulls) / area, twist / (area * min(bar.width_mm, bar.height_mm) / 2.0))
    found = found_in(case)
    assert found["leg_bar_bond"].value == pytest.approx(stress, rel=1e-6)
    factor = case.workshop.safety.printed_factor
    weaker = min(bar.second_moment_mm4, bar.sideways_mm4)
    limits = {"leg_bar_bond": bar.bond_mpa, "leg_bar_strength": bar.strength_mpa,
              "front_bar_buckling": buckling_load_n(weaker, design.l3_mm, bar.modulus_mpa)}  # fmt: skip
    assert {name: found[name].limit for name in limits} == pytest.approx(
        {name: strength / factor for name, strength in limits.items()}
    )
    assert found["front_bar_buckling"].value == case.landing_n
    assert all(map(well_told, found.values()))
    flex = found["leg_bar_flex"]
    assert flex.limit == pytest.approx(100.0 * case.workshop.safety.leg_flex_share)
    bent = leg_bar._bent_nmm(case, place_of(case)) / (1000.0 * case.robot.spring.energy_j)
    assert flex.value == pytest.approx(100.0 * bent)
    assert flex.margin == pytest.approx(flex.limit - flex.value)
    place = place_of(case)
    mouth = case.torque_nmm * (1.0 - place.mouth_mm / design.l2_mm)
    bent = bar_bending_mpa(bar, mouth, pulls[0])
    across = aside * math.sin(math.radians(design.rest_angle_deg)) * bar.width_mm / 2.0 / bar.sideways_mm4
    shear = bar_shear_mpa(bar, case.torque_nmm / design.l2_mm + 1.5 * mouth / (place.mouth_mm - place.floor_mm), twist)
    worst = max(bent, across, shear * bar.strength_mpa / bar.shear_mpa)
    assert found["leg_bar_strength"].value == pytest.approx(worst, rel=1e-6)


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
    """6·M/(b·h²) + F/(b·h); in the middle 1.5 times the mean. Across it b³ counts, and there it buckles."""
    assert bar_sideways_mpa(STRIP, 450.0) == pytest.approx(6.0 * 450.0 / (6.0 * 9.0))
    assert bar_bending_mpa(STRIP, 450.0, -0.0) == pytest.approx(6.0 * 450.0 / (3.0 * 36.0))
    assert bar_bending_mpa(STRIP, 0.0, 90.0) == pytest.approx(90.0 / 18.0)
    assert bar_shear_mpa(STRIP, 90.0, 0.0) == pytest.approx(1.5 * 90.0 / 18.0)
    flat = STRIP.model_copy(update={"width_mm": 6.0, "height_mm": 3.0})
    by_hand = math.pi**2 * STRIP.modulus_mpa * (6.0 * 27.0 / 12.0) / 80.0**2
    weaker = [min(one.second_moment_mm4, one.sideways_mm4) for one in (STRIP, flat)]
    loads = [buckling_load_n(second, 80.0, STRIP.modulus_mpa) for second in weaker]
    assert loads == pytest.approx([by_hand, by_hand])


def test_a_cantilever_takes_the_energy_of_its_tips_way() -> None:
    """F²·l³/(6·E·I); of one that is stiff but for its outer half, an eighth of it."""
    even = np.full(2001, 3e5)
    whole = (450.0 / 90.0) ** 2 * 90.0**3 / (6.0 * 3e5)
    assert tapered_energy_nmm(even, 450.0, 90.0) == pytest.approx(whole, rel=1e-5)
    stiff = np.where(np.linspace(0.0, 1.0, 2001) < 0.5, 1e15, even)
    assert tapered_energy_nmm(stiff, 450.0, 90.0) == pytest.approx(whole / 8.0, rel=5e-3)
