"""Which gear pairs turn a cam: every printable pair in one table, and those that fit and are strong enough.

Torques in N·m, lengths in mm.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from jumpcad.catalogue import Motor
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.gears import DEDENDUM, Gear, GearPair, centre_distance_mm, gear_pair, least_shift
from jumpcad.drive.motor import TrainLimits, least_ratio, winding_s
from jumpcad.transforms import Array

Pairs = npt.NDArray[np.void]
"""A table of gear pairs with named columns."""

PINION_TEETH, WHEEL_TEETH = range(12, 46), range(13, 91)
"""Judgement: fewer teeth than 12 need large shifts; more than 90 make a wheel larger than a body, at any module."""
DISC_G_MM3 = 1.27e-3
"""Density (g/mm³) of the solid discs by which gears are compared: PETG."""
MOST_TRIED = 4
"""Pairs tried for each motor, the lightest first; judgement."""


def least_tip_mm(law: CamLaw, motors: Sequence[Motor], limits: TrainLimits) -> float:
    """Return the least tip radius of a cam gear that works without a second pair, if it fits; infinite if none does."""
    least = math.inf
    for beside, group in _by_shape(motors, limits).items():
        pairs = _last_pairs(_printable_pairs(beside), law, replace(beside, cam_gear_tip_max_mm=math.inf))
        ratio = min(least_ratio(law, motors[number], beside, 1) for number in group)
        good = (pairs["wheel"] >= ratio * pairs["pinion"]) & (pairs["distance_mm"] >= beside.motor_distance_min_mm)
        least = float(pairs["tip_mm"][good].min(initial=least))
    return least


def by_cost(
    law: CamLaw, motors: Sequence[Motor], limits: TrainLimits, count: int
) -> Iterator[tuple[Motor, tuple[GearPair, ...]]]:
    """Yield motors with a number of gear pairs that turn the cam, the lightest and quickest first.

    The cost is the mass of the motor and of the gears as solid discs, plus the winding time converted to mass.
    """
    efficiency = limits.efficiency(count)
    found: list[tuple[float, int, int]] = []
    candidates: dict[int, Array] = {}
    for beside, group in _by_shape(motors, limits).items():
        of_shape = _candidates(law, beside, count)
        for number in group:
            motor, candidates[number] = motors[number], of_shape
            driven = limits.driven(motor)
            good = np.flatnonzero(of_shape[:, 0] >= least_ratio(law, motor, limits, count))
            for row in good[np.argsort(of_shape[good, 1], kind="stable")][:MOST_TRIED]:
                ratio, area = of_shape[row, :2]
                seconds = winding_s(law, driven, ratio, efficiency)
                mass_g = motor.mass_g + DISC_G_MM3 * math.pi / 4 * area * limits.face_width_mm
                found.append((mass_g + seconds / limits.seconds_per_gram, number, int(row)))
    width, backlash = limits.face_width_mm, limits.backlash_circumferential_mm
    for _, number, row in sorted(found):
        pairs = candidates[number][row, 2:].reshape(count, 3)
        yield motors[number], tuple(gear_pair(int(p), int(w), float(m), width, backlash) for p, w, m in pairs)


def _by_shape(motors: Sequence[Motor], limits: TrainLimits) -> dict[TrainLimits, list[int]]:
    """Return the numbers of the motors that set the same limits; those of one family do."""
    groups: dict[TrainLimits, list[int]] = {}
    for number, motor in enumerate(motors):
        groups.setdefault(limits.beside(motor), []).append(number)
    return groups


def _candidates(law: CamLaw, limits: TrainLimits, count: int) -> Array:
    """Return rows of ratio, squared pitch diameters and, from the motor on, pinion's and wheel's teeth and module.

    Gears that do not fit or are too weak are left out.
    """
    printable = _printable_pairs(limits)
    smallest = printable[printable["pinion"] == printable["least_teeth"]]
    torque = law.peak_torque_nm / limits.cam_efficiency
    last = _last_pairs(printable if count == 1 else smallest, law, limits)
    if count == 1:
        last = last[last["distance_mm"] >= limits.motor_distance_min_mm]
        return np.column_stack([last["wheel"] / last["pinion"], _area(last), _teeth(last)])
    last = last[last["distance_mm"] >= limits.idler_distance_min_mm]
    first = smallest[:, None]  # each with every last pair
    fits = first["tip_mm"] + limits.axle_mm <= last["distance_mm"]
    fits &= first["distance_mm"] + last["distance_mm"] >= limits.motor_distance_min_mm
    fits &= _strong(first, torque / limits.pair_efficiency * last["pinion"] / last["wheel"], limits)
    i, j = np.nonzero(fits)
    first, last = smallest[i], last[j]
    ratio = first["wheel"] / first["pinion"] * last["wheel"] / last["pinion"]
    return np.column_stack([ratio, _area(first) + _area(last), _teeth(first), _teeth(last)])


def _last_pairs(pairs: Pairs, law: CamLaw, limits: TrainLimits) -> Pairs:
    """Return the pairs whose wheel can be the cam gear."""
    fits = (pairs["tip_mm"] <= limits.cam_gear_tip_max_mm) & (pairs["root_mm"] >= limits.cam_gear_root_min_mm)
    return pairs[fits & _strong(pairs, law.peak_torque_nm / limits.cam_efficiency, limits)]


def _strong(pairs: Pairs, wheel_torque_nm: npt.ArrayLike, limits: TrainLimits) -> npt.NDArray[np.bool_]:
    """Return which pairs are strong enough for torques on their wheels, by the pinion's Lewis stress.

    Pairs (n,) with torques (n,), or (n, 1) with (m,): the result is then (n, m).
    """
    force = 2000 * np.asarray(wheel_torque_nm) / (pairs["module"] * pairs["wheel"])
    stress = force / (limits.face_width_mm * pairs["module"] * pairs["lewis"])
    return np.asarray(stress <= limits.stress_mpa)


def _area(pairs: Pairs) -> Array:
    """Return the sum (n,) of a pair's squared pitch diameters (mm²)."""
    return np.asarray(pairs["module"] ** 2 * (pairs["pinion"] ** 2 + pairs["wheel"] ** 2))


def _teeth(pairs: Pairs) -> Array:
    return np.column_stack([pairs["pinion"], pairs["wheel"], pairs["module"]])


def _printable_pairs(limits: TrainLimits) -> Pairs:
    return _printable(
        limits.modules_mm, limits.backlash_circumferential_mm, limits.tip_min_mm, limits.pinion_root_min_mm
    )


@lru_cache(maxsize=32)
def _printable(modules_mm: tuple[float, ...], backlash_mm: float, tip_min_mm: float, root_min_mm: float) -> Pairs:
    """Return every printable pair with a ratio of at least 1.

    Beside teeth and module: the smallest number of teeth that a pinion of this module may have, centre distance,
    wheel's tip and root radius, and the pinion's Lewis factor.
    """
    rows: list[tuple[float, ...]] = []
    for module in modules_mm:
        pinions = [Gear(z, module, max(0.0, least_shift(z)), 1.0, backlash_mm / 2) for z in PINION_TEETH]
        pinions = [g for g in pinions if g.tip_thickness_mm >= tip_min_mm and g.root_radius_mm >= root_min_mm]
        for pinion, teeth in itertools.product(pinions, WHEEL_TEETH):
            if teeth < pinion.teeth:
                continue
            shift = max(0.0, least_shift(teeth))
            radius = module * teeth / 2
            tip, root = radius + module * (1 + shift), radius - module * (DEDENDUM - shift)
            least, shifts = pinions[0].teeth, pinion.shift + shift
            rows.append((pinion.teeth, teeth, module, least, shifts, tip, root, pinion.lewis_factor))
    columns = ("pinion", "wheel", "module", "least_teeth", "distance_mm", "tip_mm", "root_mm", "lewis")
    table = np.array(rows, dtype=[(name, np.float64) for name in columns])
    table["distance_mm"] = centre_distance_mm(table["pinion"] + table["wheel"], table["distance_mm"], table["module"])
    table.setflags(write=False)
    return table
