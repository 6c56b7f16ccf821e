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
from jumpcad.robot.leg.bar_limits import _bent_nmm, leg_bar_findings
from jumpcad.robot.leg.bars import BarPlace
from jumpcad.robot.leg.drawing import leg_bar_place
from jumpcad.robot.leg.strength import bar_bending_mpa, bar_shear_mpa, buckling_n
from jumpcad.robot.load_case import LoadCase
from jumpcad.robot.robot import Robot

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


def test_a_rigid_bar_leaves_the_bending_to_the_printed_leg_before_its_middle() -> None:
    """T²·l/(6·E·I) of a whole even leg, less the cube of what is beyond the middle; E of the links' material."""
    found = robot("carbon-strip-3x6")
    sections = replace(found.layout.sections, leg_root_mm=9.0, leg_tip_mm=9.0)
    case = LoadCase(replace(found, layout=replace(found.layout, sections=sections)))
    length, place = found.design.l2_mm, place_of(case)
    rigid = replace(place, bar=place.bar.model_copy(update={"modulus_mpa": 1e12}))
    beyond = 1.0 - (place.floor_mm + place.mouth_mm) / 2.0 / length
    second = float(np.max(sections.leg(case.shell).second_moment_mm4))
    whole = case.torque_nmm**2 * length / (6.0 * case.workshop.material("links").modulus_mpa * second)
    assert _bent_nmm(case, rigid) == pytest.approx(whole * (1.0 - beyond**3), rel=0.04)  # in steps


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
    place = leg_bar_place(found.layout, case.holes)
    assert place is not None
    torque = 1000.0 * design.peak_spring_torque_nm * (1.0 - place.floor_mm / design.l2_mm)
    slope = (sections.leg_tip_mm - sections.leg_root_mm) / design.l2_mm
    height = sections.leg_root_mm + slope * place.mouth_mm
    second = (sections.thickness_mm * height**3 - 3.2 * 6.2**3) / 12.0
    (socket,) = (finding for finding in leg_bar_findings(case) if finding.name == "leg_socket_strength")
    assert socket.value == pytest.approx(torque * height / 2.0 / second, rel=1e-6)


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
    place = leg_bar_place(found.layout, case.holes)
    assert place is not None
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
    found = {finding.name: finding for finding in leg_bar_findings(case)}
    assert found["leg_bar_bond"].value == pytest.approx(stress, rel=1e-6)
    factor = case.workshop.safety.printed_factor
    limits = {"leg_bar_bond": bar.bond_mpa, "leg_bar_strength": bar.strength_mpa,
              "front_bar_buckling": buckling_n(bar, design.l3_mm)}  # fmt: skip
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
    place = leg_bar_place(case.layout, case.holes)
    assert place is not None
    mouth = case.torque_nmm * (1.0 - place.mouth_mm / design.l2_mm)
    bent = bar_bending_mpa(bar, mouth, pulls[0])
    across = aside * math.sin(math.radians(design.rest_angle_deg)) * bar.width_mm / 2.0 / bar.sideways_mm4
    shear = bar_shear_mpa(bar, case.torque_nmm / design.l2_mm + 1.5 * mouth / (place.mouth_mm - place.floor_mm), twist)
    worst = max(bent, across, shear * bar.strength_mpa / bar.shear_mpa)
    assert found["leg_bar_strength"].value == pytest.approx(worst, rel=1e-6)
