"""Motor and gears that turn the cam: as few printed pairs as fit, small, strong enough, and soon wound.

The motor is a DC machine: speed falls and current rises in proportion to its torque. Torques in N·m, lengths in mm.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from jumpcad.catalogue import Motor
from jumpcad.drive.cam import CamLaw
from jumpcad.drive.gears import Gear, GearPair, centre_distance_mm, gear_pair, least_shift
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, at_most, limit
from jumpcad.transforms import Array

Pairs = npt.NDArray[np.void]
"""A table of gear pairs with named columns."""


class NoTrainError(CannotBuildError):
    """No motor and gears turn a cam within their limits."""


_PINION_TEETH, _WHEEL_TEETH = range(12, 46), range(13, 91)


@dataclass(frozen=True)
class TrainLimits:
    """What motor and gears must respect.

    Attributes
    ----------
    stall_share, torque_max_nm
        Largest share of a motor's stall torque, and largest torque on its gearbox (2 kg·cm for the N20: its maker).
    pair_efficiency, cam_efficiency
        Of each printed gear pair, and of cam, roller and their axles together (judgement).
    modules_mm, face_width_mm, backlash_circumferential_mm
        What may be printed; the backlash is for a pair, at the pitch circle.
    stress_mpa
        Allowable bending stress of the teeth: that of the printed material over its safety factor.
    tip_min_mm
        Least width of a tooth's tip: one line of the nozzle.
    pinion_root_min_mm, cam_gear_root_min_mm
        Least root radius: shaft or axle, its fit and a wall; for the cam gear, its key and a wall.
    cam_gear_tip_max_mm
        Room for the cam gear beside what surrounds the leg's pivot; without limit unless given.
    motor_distance_min_mm
        Least distance of the motor's axis from the cam's.
    idler_distance_min_mm
        Least distance of an idler's axle from the cam's: it crosses the plane in which the cam turns.
    axle_mm
        Radius around the cam's axle that an idler's large gear must leave free.
    cam_speed_max_rad_s
        Of the unloaded cam: while the leg falls, it must not bring the next lift under the roller.
    seconds_per_gram
        Which loss of winding time is worth a gram of gears.
    """

    stall_share: float = 0.25
    torque_max_nm: float = 0.196
    pair_efficiency: float = 0.9
    cam_efficiency: float = 0.85
    modules_mm: tuple[float, ...] = (1.0, 1.25, 1.5)
    face_width_mm: float = 5.0
    backlash_circumferential_mm: float = 0.15
    stress_mpa: float = 10.0
    tip_min_mm: float = 0.4
    pinion_root_min_mm: float = 3.2
    cam_gear_root_min_mm: float = 5.6
    cam_gear_tip_max_mm: float = math.inf
    motor_distance_min_mm: float = 12.0
    idler_distance_min_mm: float = 0.0
    axle_mm: float = 4.0
    cam_speed_max_rad_s: float = 4.6
    seconds_per_gram: float = 2.0


@dataclass(frozen=True)
class GearTrain:
    """Motor and gear pairs, in order from the motor to the cam.

    Attributes
    ----------
    ratio, efficiency
        Motor turns a cam turn; share of the motor's work that reaches the springs while they are wound.
    motor_torque_nm, stall_margin
        Largest torque on the motor's output, and what is left of its allowed torque, as a share of stall.
    winding_s, mean_current_a, peak_current_a, electrical_j
        For one turn of the cam, which is one jump, at the motor's rated voltage.
    """

    motor: Motor
    stages: tuple[GearPair, ...]
    ratio: float
    efficiency: float
    motor_torque_nm: float
    stall_margin: float
    winding_s: float
    mean_current_a: float
    peak_current_a: float
    electrical_j: float
    findings: tuple[Finding, ...]


def synthesise_train(law: CamLaw, motors: Sequence[Motor], limits: TrainLimits) -> GearTrain:
    """Choose motor and gears for a cam.

    Raises
    ------
    NoTrainError
        If no motor turns the cam with one or two pairs that fit.
    """
    if not motors:
        raise CannotBuildError("no motor is allowed: name at least one of the catalogue's motors")
    for count in (1, 2):
        for motor, stages in _by_cost(law, motors, limits, count):
            train = _train(law, motor, stages, limits)
            if all(finding.margin >= 0 for finding in train.findings):
                return train
    torque = law.peak_torque_nm / limits.cam_efficiency
    allowed = max(_allowed_nm(motor, limits) for motor in motors)
    raise NoTrainError(
        f"no motor turns the cam: it takes {1000 * torque:.0f} mN·m, the strongest allowed motor may give "
        f"{1000 * allowed:.0f} mN·m, and no one or two gear pairs make "
        f"{torque / allowed / limits.pair_efficiency:.1f}:1 at no more than {limits.cam_speed_max_rad_s:.1f} rad/s "
        f"with a cam gear of at most {limits.cam_gear_tip_max_mm:.1f} mm radius and {limits.stress_mpa:g} MPa in "
        f"teeth {limits.face_width_mm:g} mm wide: lower stiffness_nmm_per_deg or compression_ratio, or allow a "
        "stronger motor"
    )


def least_tip_mm(law: CamLaw, motors: Sequence[Motor], limits: TrainLimits) -> float:
    """Return the least tip radius of a cam gear that needs no second pair, were there room; infinite if none does."""
    pairs = _last_pairs(_printable_pairs(limits), law, replace(limits, cam_gear_tip_max_mm=math.inf))
    ratio = min(_least_ratio(law, motor, limits, 1) for motor in motors)
    good = (pairs["wheel"] >= ratio * pairs["pinion"]) & (pairs["distance_mm"] >= limits.motor_distance_min_mm)
    return float(pairs["tip_mm"][good].min(initial=math.inf))


def _allowed_nm(motor: Motor, limits: TrainLimits) -> float:
    return min(limits.stall_share * motor.stall_torque_nm, limits.torque_max_nm)


def _free_speed_rad_s(motor: Motor) -> float:
    return motor.no_load_rpm * 2 * math.pi / 60


def _efficiency(limits: TrainLimits, count: int) -> float:
    return limits.cam_efficiency * limits.pair_efficiency**count


def _least_ratio(law: CamLaw, motor: Motor, limits: TrainLimits, count: int) -> float:
    """Return the motor turns a cam turn that torque and speed ask for with a number of gear pairs."""
    for_torque = law.peak_torque_nm / _efficiency(limits, count) / _allowed_nm(motor, limits)
    return max(for_torque, _free_speed_rad_s(motor) / limits.cam_speed_max_rad_s)


def _by_cost(
    law: CamLaw, motors: Sequence[Motor], limits: TrainLimits, count: int
) -> Iterator[tuple[Motor, tuple[GearPair, ...]]]:
    """Yield motors with a number of gear pairs that turn the cam, the lightest and quickest first.

    The cost is the mass of the gears as full discs of PETG, with the winding time converted to it.
    """
    candidates = _candidates(law, limits, count)
    efficiency = _efficiency(limits, count)
    found: list[tuple[float, int, int]] = []
    for number, motor in enumerate(motors):
        good = np.flatnonzero(candidates[:, 0] >= _least_ratio(law, motor, limits, count))
        for row in good[np.argsort(candidates[good, 1], kind="stable")][:4]:
            ratio, area = candidates[row, :2]
            seconds = _winding_s(law, motor, ratio, efficiency)
            mass_g = 1.27e-3 * math.pi / 4 * area * limits.face_width_mm
            found.append((mass_g + seconds / limits.seconds_per_gram, number, int(row)))
    for _, number, row in sorted(found):
        pairs = candidates[row, 2:].reshape(count, 3)
        stages = (
            gear_pair(int(p), int(w), float(m), limits.face_width_mm, limits.backlash_circumferential_mm)
            for p, w, m in pairs
        )
        yield motors[number], tuple(stages)


def _candidates(law: CamLaw, limits: TrainLimits, count: int) -> Array:
    """Return rows of ratio, squared pitch diameters and, from the motor on, pinion's and wheel's teeth and module.

    Only what fits and is strong enough is returned.
    """
    printable = _printable_pairs(limits)
    smallest = printable[printable["pinion"] == printable["least_teeth"]]
    torque = law.peak_torque_nm / limits.cam_efficiency
    last = _last_pairs(printable if count == 1 else smallest, law, limits)
    if count == 1:
        last = last[last["distance_mm"] >= limits.motor_distance_min_mm]
        return np.column_stack([last["wheel"] / last["pinion"], _area(last), _teeth(last)])
    last = last[last["distance_mm"] >= limits.idler_distance_min_mm]
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(len(smallest)), np.arange(len(last)), indexing="ij"))
    first, last = smallest[i], last[j]
    fits = first["tip_mm"] + limits.axle_mm <= last["distance_mm"]
    fits &= first["distance_mm"] + last["distance_mm"] >= limits.motor_distance_min_mm
    fits &= _strong(first, torque / limits.pair_efficiency * last["pinion"] / last["wheel"], limits)
    first, last = first[fits], last[fits]
    ratio = first["wheel"] / first["pinion"] * last["wheel"] / last["pinion"]
    return np.column_stack([ratio, _area(first) + _area(last), _teeth(first), _teeth(last)])


def _last_pairs(pairs: Pairs, law: CamLaw, limits: TrainLimits) -> Pairs:
    """Return the pairs whose wheel can be the cam gear."""
    fits = (pairs["tip_mm"] <= limits.cam_gear_tip_max_mm) & (pairs["root_mm"] >= limits.cam_gear_root_min_mm)
    return pairs[fits & _strong(pairs, law.peak_torque_nm / limits.cam_efficiency, limits)]


def _strong(pairs: Pairs, wheel_torque_nm: npt.ArrayLike, limits: TrainLimits) -> npt.NDArray[np.bool_]:
    """Return which pairs (n,) bear torques (n,) on their wheels, by the pinion's Lewis stress."""
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
        pinions = [Gear(z, module, max(0.0, least_shift(z)), 1.0, backlash_mm / 2) for z in _PINION_TEETH]
        pinions = [g for g in pinions if g.tip_thickness_mm >= tip_min_mm and g.root_radius_mm >= root_min_mm]
        for pinion, teeth in itertools.product(pinions, _WHEEL_TEETH):
            if teeth < pinion.teeth:
                continue
            shift = max(0.0, least_shift(teeth))
            radius = module * teeth / 2
            tip, root = radius + module * (1 + shift), radius - module * (1.25 - shift)
            least, shifts = pinions[0].teeth, pinion.shift + shift
            rows.append((pinion.teeth, teeth, module, least, shifts, tip, root, pinion.lewis_factor))
    columns = ("pinion", "wheel", "module", "least_teeth", "distance_mm", "tip_mm", "root_mm", "lewis")
    table = np.array(rows, dtype=[(name, np.float64) for name in columns])
    table["distance_mm"] = centre_distance_mm(table["pinion"] + table["wheel"], table["distance_mm"], table["module"])
    table.setflags(write=False)
    return table


def _winding_s(law: CamLaw, motor: Motor, ratio: float, efficiency: float) -> float:
    """Return the time of one turn of the cam (s): ramp, constant torque, and unloaded from release on."""
    share = law.peak_torque_nm / (ratio * efficiency * motor.stall_torque_nm)
    ramp = -math.log1p(-share) / share * law.ramp_rad
    constant = (law.lift_rad - law.ramp_rad) / (1 - share)
    return ratio / _free_speed_rad_s(motor) * (ramp + constant + 2 * math.pi - law.lift_rad)


def _train(law: CamLaw, motor: Motor, stages: tuple[GearPair, ...], limits: TrainLimits) -> GearTrain:
    """Return a train with its figures and findings."""
    ratio = math.prod(pair.ratio for pair in stages)
    efficiency = _efficiency(limits, len(stages))
    peak = law.peak_torque_nm / (ratio * efficiency)
    free_speed = _free_speed_rad_s(motor)
    cam = np.linspace(0.0, law.lift_rad, 201)
    share = law.torque_nm(cam) / (ratio * efficiency * motor.stall_torque_nm)
    current = motor.no_load_current_a + (motor.stall_current_a - motor.no_load_current_a) * share
    seconds_per_rad = ratio / free_speed
    unloaded = (2 * math.pi - law.lift_rad) * motor.no_load_current_a
    charge = seconds_per_rad * (float(np.trapezoid(current / (1 - share), cam)) + unloaded)
    winding_s = _winding_s(law, motor, ratio, efficiency)
    allowed = _allowed_nm(motor, limits)
    findings = [
        at_most(
            "motor_torque", peak, allowed, "N·m",
            f"{motor.name} gives {1000 * peak:.1f} mN·m at most; {1000 * allowed:.1f} mN·m are allowed",
            "a stronger motor, or a larger ratio",
        ),
        at_most(
            "cam_speed", free_speed / ratio, limits.cam_speed_max_rad_s, "rad/s",
            f"the unloaded cam turns at {free_speed / ratio:.1f} rad/s",
            "a slower motor, or a larger ratio",
        ),
    ]  # fmt: skip
    wheel_torque = law.peak_torque_nm / limits.cam_efficiency
    for number, pair in reversed(list(enumerate(stages, start=1))):
        stress = pair.pinion.lewis_stress_mpa(wheel_torque / pair.ratio)
        findings += [
            at_most(
                f"gear_strength_{number}", stress, limits.stress_mpa, "MPa",
                f"teeth of pair {number} bear {stress:.1f} of {limits.stress_mpa:g} MPa (Lewis, load at one tip)",
                "wider gears, or a larger module",
            ),
            limit(
                f"gear_mesh_{number}", min(pair.involute_margin_mm, pair.contact_ratio - 1.1), "mm",
                f"pair {number} meshes with a contact ratio of {pair.contact_ratio:.2f}",
                "more teeth",
            ),
        ]  # fmt: skip
        wheel_torque /= pair.ratio * limits.pair_efficiency
    findings.append(
        at_most(
            "cam_gear_room", stages[-1].wheel.tip_radius_mm, limits.cam_gear_tip_max_mm, "mm",
            f"the cam gear's tip radius is {stages[-1].wheel.tip_radius_mm:.1f} mm; "
            f"{limits.cam_gear_tip_max_mm:.1f} mm fit",
            "a stronger motor, or another pair of gears",
        )
    )  # fmt: skip
    return GearTrain(
        motor=motor,
        stages=stages,
        ratio=ratio,
        efficiency=efficiency,
        motor_torque_nm=peak,
        stall_margin=(allowed - peak) / motor.stall_torque_nm,
        winding_s=winding_s,
        mean_current_a=charge / winding_s,
        peak_current_a=float(current.max()),
        electrical_j=motor.voltage_v * charge,
        findings=tuple(findings),
    )
