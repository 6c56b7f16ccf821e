"""The gear motor, its limits, and the room that it needs in the body (N·m, rad/s, A, V, mm).

It is a DC machine: speed falls and current rises in proportion to its torque.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np

from jumpcad import dimensions
from jumpcad.catalogue import Motor
from jumpcad.drive.cam_law import CamLaw
from jumpcad.electronics.supply import Supply

FACE_WIDTHS_MM = (5.0, 6.5, 8.0)
"""Widths of gears, in the order tried: the next one where no gears are strong enough and also fit; judgement: 25 layers
of 0.2 mm, and up to 1.6 times that."""


@dataclass(frozen=True)
class TrainLimits:
    """The limits of motor and gears. Lengths in mm; values that a workshop gives have no default here.

    - `stall_share`, `torque_max_nm`: Largest share of a motor's stall torque, and largest torque on its gearbox.
    - `supply`, `blocked_nm`: What drives the motor, under the PWM with which the blocked motor gives no more than this
      torque: that of the firmware. Without a supply it turns at its rated voltage.
    - `backlash_circumferential_mm`: Backlash of a pair, at the pitch circle.
    - `stress_mpa`: Allowable bending stress of the teeth: that of the printed material over its safety factor.
    - `tip_min_mm`: Least width of a tooth's tip: one printed line.
    - `cam_gear_root_min_mm`: Least root radius of the cam gear: its key and a wall.
    - `pinion_root_min_mm`: Least root radius of every other gear: an idler's axle, its fit and a wall.
    - `shaft_wall_mm`: Fit and wall around the motor's shaft in its pinion.
    - `cam_efficiency`: Efficiency of cam, roller and their axles together; judgement.
    - `modules_mm`: Modules tried; judgement: the smallest whose teeth a nozzle of 0.4 mm prints, and the next of ISO
      54.
    - `cam_gear_tip_max_mm`: Largest tip radius of the cam gear beside what is around the leg's pivot; no limit by
      default.
    - `motor_distance_min_mm`: Least distance of the motor's axis from the cam's, whatever the motor; judgement: the
      height of an N20.
    - `cam_room_mm`: Radius around the cam's axis that the motor's socket must leave free.
    - `idler_distance_min_mm`: Least distance of an idler's axle from the cam's: it crosses the plane in which the cam
      turns.
    - `axle_mm`: Radius around the cam's axle that an idler's large gear must leave free: that of its spacer, and the
      gap.
    - `cam_speed_max_rad_s`: Of the unloaded cam; judgement. `synthesis` allows less, so that the next lift does not
      reach the roller while the leg swings back.
    - `seconds_per_gram`: Seconds of winding accepted per gram saved; judgement.
    """

    stall_share: float
    torque_max_nm: float
    pair_efficiency: float
    backlash_circumferential_mm: float
    stress_mpa: float
    tip_min_mm: float
    cam_gear_root_min_mm: float
    pinion_root_min_mm: float
    shaft_wall_mm: float
    cam_efficiency: float = 0.85
    modules_mm: tuple[float, ...] = (1.0, 1.25, 1.5)
    face_width_mm: float = FACE_WIDTHS_MM[0]
    cam_gear_tip_max_mm: float = math.inf
    motor_distance_min_mm: float = 12.0
    cam_room_mm: float = 0.0
    idler_distance_min_mm: float = 0.0
    axle_mm: float = dimensions.SPACER_RADIUS_MM + dimensions.CLEAR_MM
    cam_speed_max_rad_s: float = 4.6
    seconds_per_gram: float = 2.0
    supply: Supply | None = None
    blocked_nm: float = math.inf

    def efficiency(self, pairs: int) -> float:
        """Return the share of the motor's work that reaches the springs through a number of gear pairs."""
        return self.cam_efficiency * self.pair_efficiency**pairs

    def driven(self, motor: Motor, battery: Literal["empty", "nominal", "full"] = "nominal") -> Motor:
        """Return a motor as it behaves under load at a voltage of the supply."""
        volts = getattr(self.supply, f"{battery}_v", 0.0)
        return self.supply.driven(motor, volts, self.blocked_nm) if self.supply else motor

    def beside(self, motor: Motor) -> Self:
        """Return the limits with those that a motor's shaft and socket set."""
        root = max(self.pinion_root_min_mm, motor.shaft_mm / 2.0 + self.shaft_wall_mm)
        distance = max(self.motor_distance_min_mm, self.cam_room_mm + min(socket_half_mm(motor)))
        return replace(self, pinion_root_min_mm=root, motor_distance_min_mm=distance)


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
    return max(LEAST_NM, min(allowed, EMPTY_SHARE * limits.driven(motor, "empty").stall_torque_nm))


def free_speed_rad_s(motor: Motor) -> float:
    """Return the speed of the unloaded output."""
    return motor.no_load_rpm * 2 * math.pi / 60


def least_ratio(law: CamLaw, motor: Motor, limits: TrainLimits, pairs: int) -> float:
    """Return the least motor turns per cam turn for torque and speed, with a number of gear pairs."""
    for_torque = law.peak_torque_nm / limits.efficiency(pairs) / allowed_nm(motor, limits)
    return max(for_torque, free_speed_rad_s(limits.driven(motor, "full")) / limits.cam_speed_max_rad_s)


def winding_s(law: CamLaw, motor: Motor, ratio: float, efficiency: float) -> float:
    """Return the time of one turn of the cam (s): ramp, constant torque, and unloaded from release on."""
    loaded = _unloaded_rad(law, motor, ratio * efficiency, law.lift_rad)
    return ratio / free_speed_rad_s(motor) * (loaded + 2 * math.pi - law.lift_rad)


def lift_s(law: CamLaw, motor: Motor, ratio: float, efficiency: float, cam_rad: float) -> float:
    """Return the time from rest to an angle of the cam's lift (s), under the load of the springs."""
    return ratio / free_speed_rad_s(motor) * _unloaded_rad(law, motor, ratio * efficiency, cam_rad)


def _unloaded_rad(law: CamLaw, motor: Motor, gain: float, cam_rad: float) -> float:
    """Return how far an unloaded cam turns while the loaded one turns to an angle of its lift: up, constant, down."""
    share = law.peak_torque_nm / (gain * motor.stall_torque_nm)
    ramp_rad, down_rad = min(cam_rad, law.ramp_rad), max(0.0, cam_rad - law.lift_rad + law.ease_rad)
    up = -math.log1p(-share * ramp_rad / law.ramp_rad) / share * law.ramp_rad
    down = math.log1p(share * down_rad / law.ease_rad / (1 - share)) / share * law.ease_rad if down_rad else 0.0
    return up + (cam_rad - ramp_rad - down_rad) / (1 - share) + down


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


FACETS_MM = 0.04
"""What the facets of a head's seat take off both walls beside it."""


def cap_ear_mm(wall_min_mm: float) -> float:
    """Return how far the ears for the cap's screws reach beyond the socket, with walls that a printer can print."""
    return max(dimensions.CAP_EAR_MM, dimensions.CAP_HEAD_MM + 2.0 * wall_min_mm + FACETS_MM)


def socket_half_mm(motor: Motor, ear_mm: float = dimensions.CAP_EAR_MM) -> tuple[float, float]:
    """Return the half sizes of a motor's socket: along its width, and along its height with the cap's ears."""
    wall = dimensions.SOCKET_PLAY_MM + dimensions.SOCKET_WALL_MM
    return motor.width_mm / 2.0 + wall, motor.height_mm / 2.0 + wall + ear_mm


def front_length_mm(motor: Motor) -> float:
    """Return how far the cap, or a boss that is longer, reaches from the motor's front."""
    return max(dimensions.MOTOR_CAP_MM, motor.boss_length_mm)


def window_mm(motor: Motor) -> tuple[float, float]:
    """Return width and height of the window in the socket's floor, through which terminals and wires pass."""
    return motor.width_mm - 2.0 * dimensions.MOTOR_RIM_MM, motor.height_mm - 2.0 * dimensions.MOTOR_RIM_MM
