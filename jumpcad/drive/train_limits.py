"""The limits of motor and gears."""

import math
from dataclasses import dataclass, replace
from typing import Self

from jumpcad.catalogue import Motor
from jumpcad.dimensions import CLEAR_MM, SPACER_RADIUS_MM
from jumpcad.drive.socket import socket_half_mm
from jumpcad.electronics.supply import Supply

FACE_WIDTHS_MM = (5.0, 6.5, 8.0)
"""Widths of gears, the least first; judgement: 25 layers of 0.2 mm, and up to 1.6 times that."""


@dataclass(frozen=True)
class TrainLimits:
    """The limits of motor and gears. Lengths in mm; values that a workshop gives have no default here.

    Attributes
    ----------
    stall_share, torque_max_nm
        Largest share of a motor's stall torque, and largest torque on its gearbox.
    pair_efficiency
        Efficiency of each printed gear pair.
    supply, blocked_nm
        What drives the motor, under the PWM with which the blocked motor gives no more than this torque: that of the
        firmware. Without a supply it turns at its rated voltage.
    backlash_circumferential_mm
        Backlash of a pair, at the pitch circle.
    stress_mpa
        Allowable bending stress of the teeth: that of the printed material over its safety factor.
    tip_min_mm
        Least width of a tooth's tip: one printed line.
    cam_gear_root_min_mm
        Least root radius of the cam gear: its key and a wall.
    pinion_root_min_mm
        Least root radius of every other gear: an idler's axle, its fit and a wall.
    shaft_wall_mm
        Fit and wall around the motor's shaft in its pinion.
    cam_efficiency
        Efficiency of cam, roller and their axles together; judgement.
    modules_mm
        Modules tried; judgement: the smallest whose teeth a nozzle of 0.4 mm prints, and the next of ISO 54.
    face_width_mm
        Face width of all gears.
    cam_gear_tip_max_mm
        Largest tip radius of the cam gear beside what is around the leg's pivot; no limit by default.
    motor_distance_min_mm
        Least distance of the motor's axis from the cam's, whatever the motor; judgement: the height of an N20.
    cam_room_mm
        Radius around the cam's axis that the motor's socket must leave free.
    idler_distance_min_mm
        Least distance of an idler's axle from the cam's: it crosses the plane in which the cam turns.
    axle_mm
        Radius around the cam's axle that an idler's large gear must leave free: that of its spacer, and the gap.
    cam_speed_max_rad_s
        Of the unloaded cam; judgement. `synthesis` allows less, so that the next lift does not reach the roller
        while the leg swings back.
    seconds_per_gram
        Seconds of winding accepted per gram saved; judgement.
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
    axle_mm: float = SPACER_RADIUS_MM + CLEAR_MM
    cam_speed_max_rad_s: float = 4.6
    seconds_per_gram: float = 2.0
    supply: Supply | None = None
    blocked_nm: float = math.inf

    def efficiency(self, pairs: int) -> float:
        """Return the share of the motor's work that reaches the springs through a number of gear pairs."""
        return self.cam_efficiency * self.pair_efficiency**pairs

    def driven(self, motor: Motor) -> Motor:
        """Return a motor as it behaves at the supply's nominal voltage under load."""
        return self.supply.driven(motor, self.supply.nominal_v, self.blocked_nm) if self.supply else motor

    def weakest(self, motor: Motor) -> Motor:
        """Return a motor as it behaves with an empty battery."""
        return self.supply.driven(motor, self.supply.empty_v, self.blocked_nm) if self.supply else motor

    def fastest(self, motor: Motor) -> Motor:
        """Return a motor as it behaves with a full battery."""
        return self.supply.driven(motor, self.supply.full_v, self.blocked_nm) if self.supply else motor

    def beside(self, motor: Motor) -> Self:
        """Return the limits with those that a motor's shaft and socket set."""
        root = motor.shaft_mm / 2.0 + self.shaft_wall_mm
        distance = self.cam_room_mm + min(socket_half_mm(motor))
        return replace(
            self,
            pinion_root_min_mm=max(self.pinion_root_min_mm, root),
            motor_distance_min_mm=max(self.motor_distance_min_mm, distance),
        )
