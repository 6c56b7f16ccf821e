"""The limits of a cam as findings: formula, source and remedy of each, and what was found in figures."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from jumpcad.drive.cam_limits import FIRST_ROWS, NO_DROP_RAD, ROWS, CamLimits
from jumpcad.findings import SHOWN_AS, Basis, Finding, Ways, choose, limit, lower
from jumpcad.transforms import Array


@dataclass(frozen=True)
class Limit:
    """A checked limit: its finding's name, unit, ways out and basis, and the margin that scales to 1."""

    name: str
    unit: str
    scale: float
    ways: Ways
    basis: Basis


def _degrees(angle_rad: float) -> str:
    return f"{math.degrees(angle_rad):g}°"


_WEAKER = lower("stiffness_nmm_per_deg", "compression_ratio")
_WIND_LESS = lower("compression_ratio")
_SMALLER = choose("a smaller", "bought.roller") + lower("release.play_deg")
_PITCH = "closed-form pitch curve: jumpcad/drive/cam.py"
_GAP = f"{CamLimits.clearance_mm:g} mm + safety.gap_reserve_mm"
_UNDERCUT, _PRESSURE = f"{CamLimits.undercut_margin_mm:g} mm", f"{CamLimits.pressure_mpa:g} MPa"
_STEEPEST, _LIFT = _degrees(CamLimits.pressure_angle_rad), _degrees(CamLimits.lift_rad)
_RESERVE = _degrees(CamLimits.reserve_rad)
_LOW, _HIGH = _degrees(CamLimits.axis_min_rad), _degrees(CamLimits.axis_max_rad)
LIMITS = (
    Limit(
        "cam_pressure_angle", "rad", 0.1, _WIND_LESS + lower("safety.pressure_angle_reserve_deg"),
        Basis(
            f"largest α of the lift ≤ {_STEEPEST} - safety.pressure_angle_reserve_deg; cos α = a·sin ψ/|L·(1 + θ')·u "
            "- a|, L lever with direction u, ψ from u to the cam's axis at a, θ' leg's angle by cam's angle",
            f"{_PITCH}; {_STEEPEST}: judgement, handbooks advise 35° for followers that pivot, at speed",
        ),
    ),
    Limit(
        "cam_undercut", "mm", 1.0, choose("a smaller", "bought.roller"),
        Basis(
            f"1/κ - radius of the roller ≥ {_UNDERCUT} + safety.gap_reserve_mm; κ largest convex curvature of the "
            "pitch curve",
            f"a profile is the parallel curve of its pitch curve; {_PITCH}; {_UNDERCUT}: judgement, one printed line",
        ),
    ),
    Limit(
        "cam_contact", "MPa", 10.0, _WEAKER + choose("a wider", "bought.roller"),
        Basis(
            f"largest √(N·E/((1 - ν²)·π·b·ρ)) ≤ {_PRESSURE}/√r (MPa); N = K·(θ + p)/(L·cos α) force on the roller, b "
            f"its width, 1/ρ sum of both curvatures, E modulus of the gears' material, ν = {CamLimits.poisson:g}",
            "Hertz's line contact with a stiff roller; shakedown: Johnson, Contact Mechanics, 9.2, with the yield of "
            "PETG (judgement)",
        ),
    ),
    Limit(
        "cam_roller_load", "N", 10.0, _WEAKER + choose("a larger", "bought.roller"),
        Basis(
            "largest K·(θ + p)/(L·cos α) ≤ C0/r (N); torque of the springs over lever L, C0 static load rating",
            "statics; C0: makers' catalogues, templates/hardware/bearings.toml",
        ),
    ),
    Limit(
        "cam_core", "mm", 1.0, _WIND_LESS,
        Basis(
            "least distance of relief and drop face from the cam's axis ≥ half of the dog's diameter (mm)",
            f"{_PITCH}; dog: its strength, `cam_dog_strength`",
        ),
    ),
    Limit(
        "cam_hub", "mm", 1.0, _WIND_LESS + choose("a smaller", "bought.leg_bearing"),
        Basis(
            f"a - R - r_h ≥ {_GAP}; a from the hub to the cam's axis, R cam's outer radius, r_h larger of "
            f"{CamLimits.hub_radius_mm:g} mm for a bushing and the radius of the springs' coil",
            "geometry; gaps: judgement",
        ),
    ),
    Limit(
        "cam_drop", "rad", 0.1, _SMALLER,
        Basis(
            f"{_LIFT} + release.ease_deg/2 of lift + max(roll-over, the dog's play + 3°) + {_RESERVE} ≤ 360°; "
            "roll-over: cam angle from the end of the lift until the roller, on its arc about the hub, passes the "
            "corner with the clearance",
            f"{_PITCH}; {_LIFT}, 3° and {_RESERVE}: judgement",
        ),
    ),
    Limit(
        "cam_next_lift", "mm", 1.0, _SMALLER,
        Basis(
            "least distance of the edge where the next lift begins from the roller's surface ≥ "
            f"{_GAP}; cam as at the end of `cam_drop`, leg from rest to as far past it as it may swing",
            f"{_PITCH}; gaps: judgement",
        ),
    ),
    Limit(
        "cam_overshoot", "rad", 0.1, lower("body.stop_deg"),
        Basis(
            "min(λ - ω, γ - (λ - ω)) ≥ 0 (°); λ lever's lead over the cam's axis at rest, γ direction of the corner "
            "once the roller falls freely, both seen from the hub, ω = body.stop_deg + 3°",
            f"{_PITCH}; 3° for the pad's deflection: judgement",
        ),
    ),
    Limit(
        "cam_place", "rad", 0.1, _WIND_LESS,
        Basis(
            f"min({_HIGH}, 180° - δ - λ, 180° - e) - max({_LOW}, e) ≥ 0 (°); directions of the cam's axis from the "
            "hub, counter-clockwise from forward, sin e = R/a keeps the cam above the hub, λ lever's lead, δ "
            "compression",
            f"geometry; {_LOW} and {_HIGH}: judgement, above the hub and away from the moving links",
        ),
    ),
)  # fmt: skip
BASIS = {checked.name: checked.basis for checked in LIMITS}
SCALES = np.array([LIMITS[row].scale for row in ROWS])


def cam_findings(limits: CamLimits, margin: Array, numbers: Mapping[str, Array]) -> tuple[Finding, ...]:
    """Return the finding of every limit with its margin (limits,); those of places and gaps have no value and limit."""
    compared = {
        "cam_pressure_angle": (numbers["pressure_angle"][0], limits.pressure_angle_rad),
        "cam_contact": (numbers["pressure"][0], limits.pressure_mpa),
        "cam_roller_load": (numbers["force"][0], limits.roller_load_n),
    }
    found = []
    for checked, room in zip(LIMITS, margin, strict=True):
        value, allowed = compared.get(checked.name, (None, None))
        words = _found(checked.name, float(room), limits)
        found.append(limit(checked.name, room, checked.unit, words, checked.ways, value=value, allowed=allowed))
    return tuple(found)


def missed(limits: CamLimits, margin: Array) -> tuple[str, Ways]:
    """Return which limits the margins (limits,) of a cam miss most, and what to change."""
    missing = margin / SCALES[FIRST_ROWS]
    binding = [LIMITS[i] for i in np.argsort(missing) if missing[i] < 0.7 * missing.min()]
    short = {checked.name: float(margin[LIMITS.index(checked)]) for checked in binding}
    words = ", ".join(f"{_found(name, room, limits)} ({_short(name, room)} short)" for name, room in short.items())
    return words, tuple(dict.fromkeys(way for checked in binding for way in checked.ways))


def _short(name: str, room: float) -> str:
    unit = next(checked.unit for checked in LIMITS if checked.name == name)
    shown, factor = SHOWN_AS.get(unit, (unit, 1.0))
    short = -factor * room
    figure = f"{short:.0f}" if short >= 10.0 else f"{max(short, 0.01):.2g}"
    return f"{figure}{'' if shown == '°' else ' '}{shown}"


def _found(name: str, room: float, limits: CamLimits) -> str:
    """Return what was found and what is allowed or needed, in words, from a margin."""
    room = round(room, 6) + 0.0  # the search ends on its limits, within about 1e-9: no "-0.0"
    degrees, steepest, past = (math.degrees(angle) for angle in (room, limits.pressure_angle_rad, limits.overshoot_rad))
    gap = f"{limits.clearance_mm + room:.2f} mm, of {limits.clearance_mm:g} mm at least"
    core, undercut = limits.core_radius_mm, limits.undercut_margin_mm
    pressure, load = limits.pressure_mpa, limits.roller_load_n
    turn = f"lift, drop with the dog's play and a reserve take {360.0 - degrees:.0f}° of the cam's 360°"
    return {
        "cam_pressure_angle": f"largest pressure angle {steepest - degrees:.2f}° of {steepest:.2f}°",
        "cam_undercut": f"least convex radius of the profile {undercut + room:.2f} mm, of {undercut:g} mm at least",
        "cam_contact": f"contact pressure of the roller {pressure - room:.1f} of {pressure:.1f} MPa",
        "cam_roller_load": f"force on the roller {load - room:.1f} N of {load:.1f} N (static rating, reserves)",
        "cam_core": f"solid radius around the cam's axis {core + room:.2f} mm, of {core:.2f} mm at least for the dog",
        "cam_hub": f"gap between cam and hub {gap}",
        "cam_drop": "the roller's arc about the hub nowhere passes the corner" if room == NO_DROP_RAD else turn,
        "cam_next_lift": f"gap between the roller past rest and the next lift {gap}",
        "cam_overshoot": f"past a swing of {past:.1f}° lever and corner leave {degrees:.1f}°, of 0° at least",
        "cam_place": f"the cam's axis has room in {degrees:.0f}° of directions around the hub, of 0° at least",
    }[name]  # fmt: skip
