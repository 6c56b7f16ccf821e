"""The gear motor as a DC machine: speed falls and current rises in proportion to its torque (N·m, rad/s, A, V)."""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Motor
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.train_limits import TrainLimits

POSITIONS = 201
"""Number of cam angles of the lift at which the current is computed."""

EMPTY_SHARE = 0.6
"""Largest share of the stall torque on an empty battery; judgement: beyond half of it a motor gives less power."""
LEAST_NM = 1e-9
"""Torque of a motor that does not turn on an empty battery: too small for any gears."""


@dataclass(frozen=True)
class Winding:
    """One turn of the cam at the motor's voltage: time, mean and peak current, and electrical work."""

    seconds: float
    mean_current_a: float
    peak_current_a: float
    electrical_j: float


def allowed_nm(motor: Motor, limits: TrainLimits) -> float:
    """Return the largest torque that a motor may give on its output.

    It is a share of the stall torque at the rated voltage, whatever the battery's is, since current heats the winding;
    and a share of the stall torque on an empty battery, so that it can always load the springs.
    """
    allowed = min(limits.stall_share * motor.stall_torque_nm, limits.torque_max_nm)
    return max(LEAST_NM, min(allowed, EMPTY_SHARE * limits.weakest(motor).stall_torque_nm))


def free_speed_rad_s(motor: Motor) -> float:
    """Return the speed of the unloaded output."""
    return motor.no_load_rpm * 2 * math.pi / 60


def least_ratio(law: CamLaw, motor: Motor, limits: TrainLimits, pairs: int) -> float:
    """Return the least motor turns per cam turn for torque and speed, with a number of gear pairs."""
    for_torque = law.peak_torque_nm / limits.efficiency(pairs) / allowed_nm(motor, limits)
    return max(for_torque, free_speed_rad_s(limits.fastest(motor)) / limits.cam_speed_max_rad_s)


def winding_s(law: CamLaw, motor: Motor, ratio: float, efficiency: float) -> float:
    """Return the time of one turn of the cam (s): ramp, constant torque, and unloaded from release on."""
    loaded = _unloaded_rad(law, motor, ratio * efficiency, law.lift_rad)
    return ratio / free_speed_rad_s(motor) * (loaded + 2 * math.pi - law.lift_rad)


def lift_s(law: CamLaw, motor: Motor, ratio: float, efficiency: float, cam_rad: float) -> float:
    """Return the time from rest to an angle of the cam's lift (s), under the load of the springs."""
    return ratio / free_speed_rad_s(motor) * _unloaded_rad(law, motor, ratio * efficiency, cam_rad)


def _unloaded_rad(law: CamLaw, motor: Motor, gain: float, cam_rad: float) -> float:
    """Return how far an unloaded cam turns while the loaded one turns to an angle of its lift: ramp, then constant."""
    share = law.peak_torque_nm / (gain * motor.stall_torque_nm)
    ramp_rad = min(cam_rad, law.ramp_rad)
    return -math.log1p(-share * ramp_rad / law.ramp_rad) / share * law.ramp_rad + (cam_rad - ramp_rad) / (1 - share)


def winding(law: CamLaw, motor: Motor, ratio: float, efficiency: float) -> Winding:
    """Return time, currents and electrical work of one turn of the cam."""
    cam = np.linspace(0.0, law.lift_rad, POSITIONS)
    share = law.torque_nm(cam) / (ratio * efficiency * motor.stall_torque_nm)
    current = motor.no_load_current_a + (motor.stall_current_a - motor.no_load_current_a) * share
    seconds_per_rad = ratio / free_speed_rad_s(motor)
    unloaded = (2 * math.pi - law.lift_rad) * motor.no_load_current_a
    charge = seconds_per_rad * (float(np.trapezoid(current / (1 - share), cam)) + unloaded)
    seconds = winding_s(law, motor, ratio, efficiency)
    return Winding(seconds, charge / seconds, float(current.max()), motor.voltage_v * charge)
