"""Two gears in mesh: centre distance, contact ratio, clearances (formulas: ISO 21771; mm, rad)."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from jumpcad.drive.gears import PRESSURE_ANGLE_RAD, Gear, inverse_involute, involute, least_shift
from jumpcad.transforms import Array

_COS, _TAN = math.cos(PRESSURE_ANGLE_RAD), math.tan(PRESSURE_ANGLE_RAD)


@dataclass(frozen=True)
class GearPair:
    """Two gears in mesh.

    Attributes
    ----------
    centre_distance_mm
        Working distance: that of the shifts without backlash; the backlash is in the thinned teeth.
    """

    pinion: Gear
    wheel: Gear
    centre_distance_mm: float

    @property
    def ratio(self) -> float:
        """Wheel's teeth over pinion's."""
        return self.wheel.teeth / self.pinion.teeth

    @property
    def module_mm(self) -> float:
        """Common module (mm)."""
        return self.pinion.module_mm

    @property
    def face_width_mm(self) -> float:
        """Common width (mm)."""
        return self.pinion.face_width_mm

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
        return path / (math.pi * self.module_mm * _COS)

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

    Parameters
    ----------
    backlash_circumferential_mm
        For the pair, at the pitch circle; each gear's teeth are thinned by half of it.
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
