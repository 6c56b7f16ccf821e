"""The limits of a cam, and the margins of many shapes at once. Notation as in `cam`.

Turning a cam about the hub does not change its shape, which has three numbers: the lever, the distance from the circle
of the lever's end to the cam's axis (the gap), and the lever's lead over the direction of that axis.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from jumpcad.dimensions import GAP_MM
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.dog import PLAY_MORE_RAD, free_play_rad
from jumpcad.transforms import Array

OVERSHOOT_RAD = math.radians(5)
"""How far the leg may swing past rest; judgement."""
NO_DROP_RAD = -1.0
"""Margin of `cam_drop` where the roller's arc about the hub nowhere passes the corner."""

WORN_MAX_MM = 4.0
"""Radius of a corner beyond which none is computed: no release bears it."""


@dataclass(frozen=True)
class CamLimits:
    """The limits of a cam; lengths in mm, angles in rad. Values that a workshop gives have no default here.

    - `roller_radius_mm`, `roller_load_n`, `cam_width_mm`: Radius of the roller, its static load rating, and the width
      on which it runs.
    - `gap_min_mm`: Least distance from the circle of the lever's end to the cam's axis, for the axle that crosses the
      lever's plane.
    - `core_radius_mm`: Radius around the cam's axis that must stay solid: it carries the dog's boss.
    - `modulus_mpa`, `poisson`, `pressure_mpa`: Of the cam's material, against a steel roller. Rolling line contact
      shakes down to an elastic state up to 4k, k the yield strength in shear (Johnson, Contact Mechanics, 9.2): 104 MPa
      for a printed PETG that yields at 45 MPa in tension (judgement), less 15 %.
    - `shakedown_mpa`: The same 4k without reserve, at which a worn corner stays as it is.
    - `lift_rad`, `ramp_rad`, `ease_rad`: Cam angle of the lift, of its ramp and of its end, at which the torque falls;
      what is left of the turn is for release and drop.
      Judgement: a longer ramp costs torque, a shorter one a larger cam.
    - `hub_radius_mm`, `clearance_mm`: Radius of what is around the leg's pivot in the cam's plane, and its gap to the
      cam. Leg and lever lie beside that plane; a spring's coil that is larger replaces the default, a bushing on a 3 mm
      axle (judgement).
    - `pressure_angle_rad`, `undercut_margin_mm`: Largest pressure angle (judgement: more than the 35° that handbooks
      advise for followers that pivot, since this cam turns slowly), and least profile radius where the pitch curve is
      convex (judgement: one printed line).
    - `overshoot_rad`: How far the leg may swing past rest before the roller meets the cam; judgement.
    - `reserve_rad`: Cam angle that the motor may turn while the leg swings back, with that room still free; judgement.
    - `play_rad`: Free play of the cam's dog where it is given, instead of the rule in `dog`.
    - `axis_max_rad`, `axis_min_rad`: Direction of the cam's axis from the hub, counter-clockwise from forward: farthest
      back, and farthest forward; judgement: above the hub, away from the moving links.
    - `lever_loaded_max_rad`: Largest direction of the lever with the springs loaded (pi: level with the pivots).
    - `lowest_mm`: The cam stays above this height over the hub.
    - `lever_max_mm`, `gap_max_mm`, `lead_max_rad`: Upper bounds of the search: lever, distance from its circle to the
      cam's axis, lead of the lever over it. Judgement: there is no room for larger ones in a body.
    """

    roller_radius_mm: float
    roller_load_n: float
    cam_width_mm: float
    gap_min_mm: float
    core_radius_mm: float
    modulus_mpa: float
    poisson: float = 0.38
    pressure_mpa: float = 90.0
    shakedown_mpa: float = 104.0
    lift_rad: float = math.radians(310)
    ramp_rad: float = math.radians(30)
    ease_rad: float = 0.0
    hub_radius_mm: float = 4.5
    clearance_mm: float = GAP_MM
    pressure_angle_rad: float = math.radians(45)
    undercut_margin_mm: float = 0.5
    overshoot_rad: float = OVERSHOOT_RAD
    reserve_rad: float = math.radians(8)
    play_rad: float | None = None
    axis_max_rad: float = math.radians(115)
    axis_min_rad: float = math.radians(60)
    lever_loaded_max_rad: float = math.pi
    lowest_mm: float = 0.0
    lever_max_mm: float = 45.0
    gap_max_mm: float = 50.0
    lead_max_rad: float = math.radians(45)

    def worn_mm(self, force_n: float) -> float:
        """Return the radius to which a corner under a force wears: where its line contact shakes down (Hertz)."""
        modulus = self.modulus_mpa / (1.0 - self.poisson**2)
        flatness = force_n * modulus / (math.pi * self.cam_width_mm * self.shakedown_mpa**2)
        curvature = 1.0 / max(flatness, 1e-6) - 1.0 / self.roller_radius_mm
        return 1.0 / max(curvature, 1.0 / WORN_MAX_MM)


ROWS = np.array([0, 0, 1, 1, 2, 2, 3, 4, 4, 5, 6, 7, 7, 7, 8, 8, 9])
"""The limit of every row of margins, by its number in `cam_findings.LIMITS`.

A limit with several causes has a row for each, so that all rows are smooth.
"""
FIRST_ROWS = np.flatnonzero(np.diff(ROWS, prepend=-1))


def measure(law: CamLaw, limits: CamLimits, shapes: Array, samples: int) -> tuple[Array, Array, dict[str, Array]]:
    """Return outer radii (n,), margins (rows, n) and key figures of shapes (n, 3) at some samples of the lift.

    Points are complex numbers, with the hub at 0 and the cam's axis at the real number `axis`. The pitch curve's
    tangent is i·W with W = L(1 + theta')u - axis, as in `CamGeometry.normal`; the pressure angle a has
    cos a = axis·sin(psi)/|W|; the curvature is (|W|² + W x W')/|W|³.
    """
    roller, clearance = limits.roller_radius_mm, limits.clearance_mm
    wind, first, second = _sampled(law, samples)
    lever, axis, lead = shapes[:, 0, None], shapes[:, :2].sum(axis=1)[:, None], shapes[:, 2, None]
    psi = lead + wind
    direction = np.exp(1j * psi)
    arm = lever * (1 + first)
    normal = arm * direction - axis
    length = np.abs(normal)
    cos_pressure = axis * direction.imag / length
    turning = arm**2 * first - axis * (lever * second * direction.imag + arm * first * direction.real)
    curvature = 1 / length + turning / length**3
    force = 1000 * law.stiffness_nm_per_rad * (wind + law.preload_rad) / (lever * np.maximum(cos_pressure, 1e-3))
    # Hertz, line contact of a steel roller (stiff) on a profile of radius 1/curvature - roller.
    flatness = roller * np.maximum(1 - roller * curvature, 1e-3)
    modulus = limits.modulus_mpa / (1 - limits.poisson**2)
    pressure = np.sqrt(force * modulus / (math.pi * limits.cam_width_mm * flatness))
    touched = lever * direction - axis - roller * normal / length

    lever, axis, past = lever[:, 0], axis[:, 0], lead[:, 0] - limits.overshoot_rad
    tip = touched[:, -1]
    outer = np.abs(tip)
    reach = lever + roller + clearance
    cos_free = (reach**2 - axis**2 - outer**2) / (2 * axis * outer)
    free = np.arccos(np.clip(cos_free, -1.0, 1.0))
    corner = np.angle(axis + outer * np.exp(1j * free))
    bottom = lever * np.exp(1j * past) - axis
    over = np.mod(np.angle(tip) - free, 2 * math.pi)
    ahead = np.maximum(over, free_play_rad(over, limits.play_rad) + PLAY_MORE_RAD)
    fallen = law.lift_rad + ahead + limits.reserve_rad
    # The edge where the next lift begins, as it stands when the leg swings past rest.
    edge = touched[:, 0] * np.exp(-1j * fallen)
    swung = lever * np.exp(1j * (past + limits.overshoot_rad * np.array([[0.0], [0.5], [1.0]]))) - axis
    edge_gap = np.abs(edge - swung) - roller - clearance
    relief = np.abs(bottom) - roller - clearance
    face = np.abs(reach * np.exp(1j * past) - axis)
    highest, lowest = axis_range(law, limits, axis, lead[:, 0], outer)

    # The extremes lie at either end of the lift or just after the ramp, so each half is smooth in the shape.
    halves = [0, 2 * (samples // 4)]
    pressure_angle = np.arccos(np.clip(np.minimum.reduceat(cos_pressure, halves, axis=1), -1.0, 1.0))
    convex_radius = 1 / np.maximum(np.maximum.reduceat(curvature, halves, axis=1), 1e-9)
    peak_pressure = np.maximum.reduceat(pressure, halves, axis=1)
    margins = np.column_stack([
        limits.pressure_angle_rad - pressure_angle,
        convex_radius - roller - limits.undercut_margin_mm,
        limits.pressure_mpa - peak_pressure,
        limits.roller_load_n - force.max(axis=1),
        relief - limits.core_radius_mm,
        face - limits.core_radius_mm,
        axis - outer - limits.hub_radius_mm - clearance,
        np.where(np.abs(cos_free) <= 1, 2 * math.pi - fallen, NO_DROP_RAD),
        edge_gap.T,
        corner - past,
        past,
        highest - lowest,
    ])  # fmt: skip
    numbers = {
        "pressure_angle": pressure_angle.max(axis=1),
        "convex_radius": convex_radius.min(axis=1),
        "force": force.max(axis=1),
        "pressure": peak_pressure.max(axis=1),
    }
    return outer, margins.T, numbers


@lru_cache(maxsize=8)
def _sampled(law: CamLaw, samples: int) -> tuple[Array, Array, Array]:
    """Return a law's leg angle and its derivatives (samples,) over the lift; a search needs the same ones often.

    The second derivative jumps where the ramp ends, just after which the curvature is sharpest, and where the torque
    begins to fall.
    """
    even, ease = samples - samples // 4, samples // 4 if law.ease_rad else 0
    ramp = np.linspace(0.0, law.ramp_rad, samples // 4, endpoint=False)
    constant = law.lift_rad - law.ease_rad - law.ramp_rad
    rest = law.ramp_rad + constant * np.linspace(0.0, 1.0, even - ease, endpoint=not ease) ** 2
    end = law.lift_rad - law.ease_rad * np.linspace(1.0 - 1e-9, 0.0, ease)
    return law.derivatives(np.concatenate([ramp, rest, end]))


def axis_range(law: CamLaw, limits: CamLimits, axis: Array, lead: Array, outer: Array) -> tuple[Array, Array]:
    """Return the highest and lowest direction (n,) of the cam's axis that its place and the lever allow."""
    above = np.arcsin(np.minimum((outer + limits.lowest_mm) / axis, 1.0))
    highest = np.minimum(
        np.minimum(limits.axis_max_rad, limits.lever_loaded_max_rad - law.compression_rad - lead), math.pi - above
    )
    return highest, np.maximum(limits.axis_min_rad, above)
