"""Involute spur gears: profiles as the ISO 53 rack cuts them, and the strength of a tooth.

Basic rack A of ISO 53: pressure angle 20°, addendum 1, dedendum 1.25, fillet 0.38 (all in modules). Formulas for
shifts and for measuring over teeth and pins: ISO 21771. Lengths in mm, angles in rad.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt

from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

PRESSURE_ANGLE_RAD = math.radians(20)
_SIN, _COS, _TAN = math.sin(PRESSURE_ANGLE_RAD), math.cos(PRESSURE_ANGLE_RAD), math.tan(PRESSURE_ANGLE_RAD)
DEDENDUM, _FILLET = 1.25, 0.38
"""Of the basic rack, in modules."""


def involute(angle_rad: float) -> float:
    """Return the involute function, tan(a) - a (rad)."""
    return math.tan(angle_rad) - angle_rad


def inverse_involute(value: npt.ArrayLike) -> Array:
    """Return the angles (rad) of positive involute values, by Newton's method.

    It begins above the angle: tan(a) - a is at least a³/3, and tan(a) = value + a at most value + π/2.
    """
    value = np.asarray(value, dtype=float)
    angle = np.minimum(np.cbrt(3 * value), np.arctan(value + math.pi / 2))
    for _ in range(20):
        tangent = np.tan(angle)
        angle = angle - (tangent - angle - value) / tangent**2
    return np.asarray(angle)


def least_shift(teeth: int) -> float:
    """Return the smallest profile shift without undercut, in modules; negative for large numbers of teeth."""
    depth = DEDENDUM - _FILLET * (1 - _SIN)
    return depth - teeth * _SIN**2 / 2


@dataclass(frozen=True)
class Gear:
    """One spur gear; the profile has a tooth centred on +x.

    `shift` is in modules; `thinning_mm` by how much its teeth are thinner than a backlash-free pair's, on the pitch
    circle; `tip_cut_mm` is taken off the tip radius, where shifts would reduce the clearance to the mating root.
    """

    teeth: int
    module_mm: float
    shift: float
    face_width_mm: float
    thinning_mm: float = 0.0
    tip_cut_mm: float = 0.0

    def __post_init__(self) -> None:
        if self.shift < least_shift(self.teeth) - 1e-9:
            raise JumpcadError(
                f"a gear with {self.teeth} teeth and shift {self.shift:g} would be undercut: "
                f"shift it by at least {least_shift(self.teeth):.3f}"
            )

    @property
    def pitch_radius_mm(self) -> float:
        """Radius of the reference circle (mm)."""
        return self.module_mm * self.teeth / 2

    @property
    def base_radius_mm(self) -> float:
        """Radius of the base circle of the involutes (mm)."""
        return self.pitch_radius_mm * _COS

    @property
    def tip_radius_mm(self) -> float:
        """Radius of the tip circle (mm)."""
        return self.pitch_radius_mm + self.module_mm * (1 + self.shift) - self.tip_cut_mm

    @property
    def root_radius_mm(self) -> float:
        """Radius of the root circle (mm)."""
        return self.pitch_radius_mm - self.module_mm * (DEDENDUM - self.shift)

    @property
    def form_radius_mm(self) -> float:
        """Radius at which fillet and involute meet (mm)."""
        _, radii = self._flank
        return float(radii[self._fillet_points - 1])

    @property
    def tip_thickness_mm(self) -> float:
        """Width of the top land (mm)."""
        angles, radii = self._flank
        return float(2 * angles[-1] * radii[-1])

    _fillet_points = 8
    _involute_points = 10

    @cached_property
    def _flank(self) -> tuple[Array, Array]:
        """Angles (n,) from the tooth's middle and radii (n,) of one flank, root to tip, as a rack generates it.

        The rack's straight flank touches where its normal passes the pitch point, at distance t along the line of
        action; its rounded corner, likewise, in line with the pitch point. `u` is how far the rack has moved.
        """
        m, r = self.module_mm, self.pitch_radius_mm
        rounding = _FILLET * m
        depth = (DEDENDUM - _FILLET - self.shift) * m
        half_tooth = math.pi * m / 4 + self.thinning_mm / 2
        corner = half_tooth - (DEDENDUM - _FILLET) * m * _TAN - rounding / _COS
        # The corner's centre moves from below the pitch point to where it touches the straight flank.
        across = np.linspace(0.0, depth / _TAN, self._fillet_points)
        reach = np.hypot(across, depth)
        fillet = np.stack([across, np.full_like(across, -depth)]) * (1 + rounding / reach)
        first = depth / _SIN + rounding
        last = r * _SIN - math.sqrt(self.tip_radius_mm**2 - self.base_radius_mm**2)
        t = np.linspace(first, last, self._involute_points + 1)[1:]
        straight = np.stack([t * _COS, -t * _SIN])
        u = np.concatenate([across - corner, t / _COS - half_tooth + self.shift * m * _TAN])
        x, y = np.concatenate([fillet, straight], axis=1)
        from_gap = np.arctan2(x, y + r) - u / r
        return math.pi / self.teeth - from_gap, np.hypot(x, y + r)

    @cached_property
    def profile_mm(self) -> Array:
        """Outline (n, 2), counter-clockwise, not closed by repeating its first point (mm)."""
        angles, radii = self._flank
        tip = np.linspace(-angles[-1], angles[-1], 4)[1:-1]
        tooth_angles = np.concatenate([[-math.pi / self.teeth], -angles, tip, angles[::-1]])
        tooth_radii = np.concatenate([radii[:1], radii, np.full(len(tip), radii[-1]), radii[::-1]])
        turns = 2 * math.pi / self.teeth * np.arange(self.teeth)[:, None] + tooth_angles
        return np.stack([tooth_radii * np.cos(turns), tooth_radii * np.sin(turns)], axis=-1).reshape(-1, 2)

    @cached_property
    def lewis_factor(self) -> float:
        """Lewis form factor Y = t²/(6·h·m) of the weakest section, load at the tip (the parabola inscribed)."""
        angles, radii = self._flank
        tip_pressure = math.acos(self.base_radius_mm / self.tip_radius_mm)
        load = self.base_radius_mm / math.cos(tip_pressure - angles[-1])
        fillet = slice(0, self._fillet_points)
        half, height = radii[fillet] * np.sin(angles[fillet]), load - radii[fillet] * np.cos(angles[fillet])
        return float(((2 * half) ** 2 / (6 * height * self.module_mm)).min())

    def lewis_stress_mpa(self, torque_nm: float) -> float:
        """Return the bending stress at the root under a torque, loaded at the tip of one tooth (MPa)."""
        force = 1000 * torque_nm / self.pitch_radius_mm
        return force / (self.face_width_mm * self.module_mm * self.lewis_factor)


@dataclass(frozen=True)
class GearPair:
    """Two gears in mesh.

    - `centre_distance_mm`: Working distance: that of the shifts without backlash; the backlash is in the thinned teeth.
    """

    pinion: Gear
    wheel: Gear
    centre_distance_mm: float

    @property
    def ratio(self) -> float:
        """Wheel's teeth over pinion's."""
        return self.wheel.teeth / self.pinion.teeth

    @property
    def working_angle_rad(self) -> float:
        """Pressure angle at the working centre distance (rad)."""
        return math.acos((self.pinion.base_radius_mm + self.wheel.base_radius_mm) / self.centre_distance_mm)

    @property
    def backlash_circumferential_mm(self) -> float:
        """Play of the pair along the pitch circles (mm)."""
        return self.pinion.thinning_mm + self.wheel.thinning_mm

    @property
    def contact_ratio(self) -> float:
        """Pairs of teeth in contact on average."""
        path = sum(_tip_roll_mm(gear) for gear in (self.pinion, self.wheel)) - self._line_mm
        return path / (math.pi * self.pinion.module_mm * _COS)

    @property
    def involute_margin_mm(self) -> float:
        """By how much contact ends before either fillet begins, as roll length; negative is interference (mm)."""
        margins = []
        for gear, mate in ((self.pinion, self.wheel), (self.wheel, self.pinion)):
            form = math.sqrt(max(0.0, gear.form_radius_mm**2 - gear.base_radius_mm**2))
            margins.append(self._line_mm - _tip_roll_mm(mate) - form)
        return min(margins)

    @property
    def _line_mm(self) -> float:
        """Length of the line of action between the base circles (mm)."""
        return self.centre_distance_mm * math.sin(self.working_angle_rad)


@lru_cache(maxsize=256)
def gear_pair(
    pinion_teeth: int, wheel_teeth: int, module_mm: float, face_width_mm: float, backlash_circumferential_mm: float
) -> GearPair:
    """Return a pair with the least shifts that avoid undercut, and tips cut to the standard clearance.

    - `backlash_circumferential_mm`: For the pair, at the pitch circle; each gear's teeth are thinned by half of it.
    """
    shifts = [max(0.0, least_shift(teeth)) for teeth in (pinion_teeth, wheel_teeth)]
    total = pinion_teeth + wheel_teeth
    distance = float(centre_distance_mm(total, sum(shifts), module_mm))
    tip_cut = max(0.0, module_mm * (total / 2 + sum(shifts)) - distance)
    pinion, wheel = (
        Gear(teeth, module_mm, shift, face_width_mm, backlash_circumferential_mm / 2, tip_cut)
        for teeth, shift in zip((pinion_teeth, wheel_teeth), shifts, strict=True)
    )
    return GearPair(pinion, wheel, distance)


def centre_distance_mm(teeth: npt.ArrayLike, shifts: npt.ArrayLike, module_mm: npt.ArrayLike) -> Array:
    """Return the centre distances (n,) of pairs without backlash: sums of teeth (n,) and of shifts (n,), modules (n,).

    ISO 21771: inv(working angle) = inv(20°) + 2·tan(20°)·(x1 + x2)/(z1 + z2).
    """
    total = np.asarray(teeth, dtype=float)
    working = inverse_involute(involute(PRESSURE_ANGLE_RAD) + 2 * _TAN * np.asarray(shifts) / total)
    return np.asarray(np.asarray(module_mm) * total / 2 * _COS / np.cos(working))


def _tip_roll_mm(gear: Gear) -> float:
    return math.sqrt(gear.tip_radius_mm**2 - gear.base_radius_mm**2)
