"""Strength of legs with a bought bar between printed ends: the bar, its sockets and its glue (N, N·mm, mm, MPa).

A bar that enters a socket with a moment M presses on its walls over a length a as a rigid bar on an elastic bed: the
pressure changes evenly from end to end, 6·M/(b·a²) at the ends, and the shear force in the bar reaches 1.5·M/a. The
printed ends themselves are checked as those of printed legs are (`jumpcad.robot.leg.thing`).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import LegBar
from jumpcad.findings import Basis, Finding, at_most, choose, limit
from jumpcad.robot.leg.drawing import front_bar_place, leg_bar_place
from jumpcad.robot.leg.place import BarPlace
from jumpcad.robot.load_case import IN_PLANE, LANDING, ONE_TOE, LoadCase, stress_finding
from jumpcad.strength import stress
from jumpcad.strength.stress import buckling_load_n, tapered_energy_nmm, tube_shear_mpa

STATIONS = 65
"""Sections along a leg at which its bending energy is summed."""


@dataclass(frozen=True)
class Socket:
    """A printed socket of a length around a bar; `thickness_mm` and `height_mm` are the leg's outside there."""

    bar: LegBar
    length_mm: float
    thickness_mm: float
    height_mm: float
    gap_mm: float

    def pressure_mpa(self, moment_nmm: float, shear_n: float) -> float:
        """Return the largest pressure of the bar on a wall; glue that also holds its sides is neglected."""
        return (6.0 * moment_nmm / self.length_mm**2 + shear_n / self.length_mm) / self.bar.width_mm

    def wall_mpa(self, moment_nmm: float, shear_n: float) -> float:
        """Return the tensile stress in the side walls, which hold the wall that the bar presses on."""
        skins = self.thickness_mm - self.bar.width_mm - 2.0 * self.gap_mm
        return self.pressure_mpa(moment_nmm, shear_n) * self.bar.width_mm / skins

    def bending_mpa(self, moment_nmm: float) -> float:
        """Return the stress of the hollow section at the socket's floor, which carries the whole moment."""
        gap = 2.0 * self.gap_mm
        hollow = (self.bar.width_mm + gap) * (self.bar.height_mm + gap) ** 3
        return moment_nmm * self.height_mm / 2.0 / ((self.thickness_mm * self.height_mm**3 - hollow) / 12.0)

    def bond_mpa(self, axial_n: float, twist_nmm: float) -> float:
        """Return the shear stress of the glue under a force along the bar and a moment about it."""
        area = self.bar.around_mm * self.length_mm
        radius = min(self.bar.width_mm, self.bar.height_mm) / 2.0
        return math.hypot(axial_n / area, twist_nmm / (area * radius))


def bar_bending_mpa(bar: LegBar, moment_nmm: float, axial_n: float) -> float:
    """Return the largest stress of a bar under bending in the plane of motion and a force along it."""
    return moment_nmm * bar.height_mm / 2.0 / bar.second_moment_mm4 + axial_n / bar.area_mm2


def bar_sideways_mpa(bar: LegBar, moment_nmm: float) -> float:
    """Return the largest stress of a bar bent across the plane of motion."""
    return moment_nmm * bar.width_mm / 2.0 / bar.sideways_mm4


def bar_shear_mpa(bar: LegBar, force_n: float, twist_nmm: float) -> float:
    """Return the shear stress of a bar: 2·F/A of a force across a tube, 1.5·F/A of a strip, and that of its torsion."""
    if bar.round:
        torsion = tube_shear_mpa(twist_nmm, bar.width_mm, bar.bore_mm)
    else:
        torsion = float(stress.bar_shear_mpa(twist_nmm, bar.width_mm, bar.height_mm))
    return (2.0 if bar.round else 1.5) * force_n / bar.area_mm2 + torsion


OTHER = (*choose("a stronger", "bought.leg"), 'bought.leg = ""')
BED = "a rigid bar on an elastic bed: judgement, jumpcad/robot/leg/bar_limits.py"
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
    load = buckling_load_n(min(bar.second_moment_mm4, bar.sideways_mm4), design.l3_mm, bar.modulus_mpa) / factor
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
    return tapered_energy_nmm(np.where(x < middle, plastic, carbon), case.torque_nmm, length)
