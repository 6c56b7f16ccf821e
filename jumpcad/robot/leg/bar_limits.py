"""Strength of legs with a bought bar between printed ends: the bar, its sockets and its glue (N, N·mm, mm, MPa).

The printed ends themselves are checked as those of printed legs are (`jumpcad.robot.leg.limits`).
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.findings import Basis, Finding, at_most, choose, limit
from jumpcad.robot.leg.bars import BarPlace
from jumpcad.robot.leg.drawing import front_bar_place, leg_bar_place
from jumpcad.robot.leg.strength import (
    STATIONS,
    Socket,
    bar_bending_mpa,
    bar_shear_mpa,
    bar_sideways_mpa,
    bent_energy_nmm,
    buckling_n,
)
from jumpcad.robot.load_case import IN_PLANE, LANDING, ONE_TOE, LoadCase, stress_finding

OTHER = (*choose("a stronger", "bought.leg"), 'bought.leg = ""')
BED = "a rigid bar on an elastic bed: judgement, jumpcad/robot/leg/strength.py"
GOODWINDS = "strengths of the bar: Goodwinds, technical material specifications"
BASIS = {
    "leg_bar_strength": Basis(
        f"max(σ, τ·R/R_shear) ≤ R/s (MPa), R the bar's bending strength; σ = M·h/(2·I) + F/A at the "
        "socket's mouth, or M_s·sin(rest_angle_deg)·b/(2·I_s) sideways; τ = c·(T/l2 + 1.5·M/a)/A + that of the "
        "torsion M_s·cos(rest_angle_deg), c = 2 for a tube, 1.5 for a strip; M = T·(1 - x/l2) of the springs' torque "
        f"T, a the socket's length, M_s = F·toe_half_width_mm, {ONE_TOE}",
        f"Shigley 3-10 to 3-12; {BED}; {GOODWINDS}",
    ),
    "leg_socket_strength": Basis(
        f"max(P/b, P/(t - b - gaps), M_f·h/(2·I) of the hollow section at its floor) ≤ {IN_PLANE}; P = 6·M/a² + "
        "T/(l2·a) per length of the socket, M at its mouth, M_f at its floor, a its length, b the bar's and t the "
        "leg's thickness",
        BED,
    ),
    "leg_bar_bond": Basis(
        "√((F/A)² + (M/(A·h/2))²) ≤ the glue's strength/s (MPa); A = circumference·length, F along the "
        "bar in the push-off or at landing, M twist by a landing on one toe, h the bar's smaller side",
        "shear of a lap joint; the glue's strength: judgement",
    ),
    "leg_bar_flex": Basis(
        "∫M²/(2·E·I)dx over the leg/U ≤ safety.leg_flex_share (%); E·I printed up to the socket's "
        "middle, the bar's from there on; M falls evenly from the springs' torque at the hub to 0 at the ankle",
        f"strain energy in bending (Shigley, ch. 4); limit: judgement; {GOODWINDS}",
    ),
    "front_bar_buckling": Basis(
        f"F ≤ π²·E·I/(l3²·s) (N), I about the weaker axis; {LANDING}",
        f"Euler, a hinge at either end (Shigley 4-12); {GOODWINDS}",
    ),
}


def leg_bar_findings(case: LoadCase) -> Iterator[Finding]:
    """Yield `leg_bar_strength`, `leg_socket_strength`, `leg_bar_bond`, `leg_bar_flex` and `front_bar_buckling`."""
    leg, front = leg_bar_place(case.layout, case.holes), front_bar_place(case.layout, case.holes)
    if leg is None or front is None:
        return
    design, bar, factor = case.robot.design, leg.bar, case.workshop.safety.printed_factor
    first, across = _socket(case, leg), case.torque_nmm / design.l2_mm
    at_mouth = case.torque_nmm * (1.0 - leg.mouth_mm / design.l2_mm)
    at_floor = case.torque_nmm * (1.0 - leg.floor_mm / design.l2_mm)
    axial = float(np.abs(case.forces.leg_axial_n).max())
    aside, angle = case.toe_blow_n * case.layout.toe_half_width_mm, math.radians(design.rest_angle_deg)
    bending = max(bar_bending_mpa(bar, at_mouth, axial), bar_sideways_mpa(bar, aside * math.sin(angle)))
    shear = bar_shear_mpa(bar, across + 1.5 * at_mouth / first.length_mm, aside * math.cos(angle))
    # the one nearer to its limit, expressed as a bending stress
    worst = max(bending, shear * bar.strength_mpa / bar.shear_mpa)
    yield stress_finding(
        "leg_bar_strength", f"{bar.name} of the main leg at its socket", worst, bar.strength_mpa / factor, OTHER
    )
    stress = max(first.pressure_mpa(at_mouth, across), first.wall_mpa(at_mouth, across), first.bending_mpa(at_floor))
    yield stress_finding(
        "leg_socket_strength", "the main leg's socket around its bar", stress, case.allowable_mpa,
        (*OTHER, "a stronger material for the links"),
    )  # fmt: skip
    ends = [Socket(bar, place.far_floor_mm - place.far_mouth_mm, 0.0, 0.0, 0.0) for place in (leg, front)]
    pulls = (axial, max(case.front_n, case.landing_n))
    bond = max(end.bond_mpa(pull, aside * math.cos(angle)) for end, pull in zip(ends, pulls, strict=True))
    yield stress_finding("leg_bar_bond", "the glue of the legs' bars", bond, bar.bond_mpa / factor, OTHER)
    energy = 1000.0 * case.robot.spring.energy_j
    share, allowed = _bent_nmm(case, leg) / energy, case.workshop.safety.leg_flex_share
    yield limit(
        "leg_bar_flex", 100.0 * (allowed - share), "%",
        f"{100 * share:.1f} % of the springs' energy bends the main leg and its bar at release; {100 * allowed:g} % "
        "are allowed", OTHER, value=100.0 * share, allowed=100.0 * allowed,
    )  # fmt: skip
    load = buckling_n(bar, design.l3_mm) / factor
    yield at_most(
        "front_bar_buckling", case.landing_n, load, "N",
        f"the front link's bar under the whole landing force: {case.landing_n:.1f} of {load:.1f} N (Euler)", OTHER,
    )  # fmt: skip


def _socket(case: LoadCase, place: BarPlace) -> Socket:
    """Return the socket at the hub's end; the leg's height there is that at its mouth."""
    sections, length = case.layout.sections, case.robot.design.l2_mm
    height = sections.leg_root_mm + place.mouth_mm / length * (sections.leg_tip_mm - sections.leg_root_mm)
    return Socket(
        place.bar, place.mouth_mm - place.floor_mm, sections.thickness_mm, height, case.workshop.fits.lying_mm
    )


def _bent_nmm(case: LoadCase, place: BarPlace) -> float:
    """Return the energy that bends the leg at release: printed up to its socket's middle, and the bar from there on."""
    length = case.robot.design.l2_mm
    x = np.linspace(0.0, length, STATIONS)
    printed = case.layout.sections.leg(case.shell)
    plastic = case.workshop.material("links").modulus_mpa * np.interp(
        x, np.linspace(0.0, length, len(np.atleast_1d(printed.height_mm))), printed.second_moment_mm4
    )
    carbon = place.bar.modulus_mpa * place.bar.second_moment_mm4
    middle = (place.floor_mm + place.mouth_mm) / 2.0
    return bent_energy_nmm(np.where(x < middle, plastic, carbon), case.torque_nmm, length)
