"""Places of the drive in the body: idler and motor, beside cam and springs (mm).

In-plane places are in the body frame's x-z plane.
"""

import numpy as np

from jumpcad.catalogue import Motor
from jumpcad.dimensions import CAP_EAR_MM, CLEAR_MM, GAP_MM, SPACER_RADIUS_MM
from jumpcad.drive import Drive
from jumpcad.drive.motor import socket_half_mm
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import LONGER_BODY
from jumpcad.robot.space import room as rooms
from jumpcad.robot.space.inside import Lateral
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

MOTOR_WANTED_MM = np.array([0.0, 14.0])
"""Where the motor is wanted in the body frame; judgement: between the pivots, its socket just above their line."""
ROUND_OFF_MM = 1e-5
"""Larger than the error of a rounded place."""
IDLER_STEP = 2
"""Every second free place of an idler is tried: 10° apart; judgement."""


def require_shaft(motor: Motor, lateral: Lateral) -> None:
    """Reject a motor whose shaft reaches less than its diameter into its pinion (judgement; usual for hubs)."""
    needed = lateral.gears[-1][0] + motor.shaft_mm - lateral.motor[1]
    if motor.shaft_length_mm < needed - 1e-9:
        raise CannotBuildError(
            f"the shaft of motor {motor.name} is {motor.shaft_length_mm:g} mm long; it needs {needed:.1f} mm to pass "
            f"its cap and reach {motor.shaft_mm:g} mm into its pinion: allow a motor with a longer shaft",
            "shaft", motor.shaft_length_mm - needed,
        )  # fmt: skip


def require_gear_room(hub_things: list[rooms.Obstacle], axis: Array, tip_mm: float, y: Interval) -> None:
    """Reject a cam gear that collides with the springs or an axle."""
    room = rooms.clearance(hub_things, axis[None], (0.0, 0.0), 0.0, y, tip_mm)[0] - tip_mm
    if room < 0:
        raise CannotBuildError(
            f"the cam gear's tip radius of {tip_mm:.1f} mm is {rooms.shortfall(room)} too large beside the leg's axle: "
            "allow a stronger motor (a smaller ratio), or a smaller gear module",
            "gear_room", room,
        )  # fmt: skip


def train_places(
    obstacles: list[rooms.Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array, ear_mm: float = CAP_EAR_MM
) -> tuple[Array | None, Array, float]:
    """Return the idler's place (two stages), the motor's, and the motor's direction."""
    stages, motor = drive.train.stages, drive.train.motor
    half = socket_half_mm(motor, ear_mm)
    body_y = (lateral.inside[0], lateral.gears[-1][0] - GAP_MM)
    smaller = f"allow a smaller motor than {motor.name} ({motor.width_mm:g} x {motor.height_mm:g} mm)"
    tip, ways = stages[0].pinion.tip_radius_mm, (*LONGER_BODY, smaller)
    meshes_with = "cam gear" if len(stages) == 1 else "idler wheel"

    def motor_place(axis: Array, extra: list[rooms.Obstacle]) -> tuple[Array, float]:
        places, angles = rooms.ring_candidates(axis, stages[0].centre_distance_mm)
        others = [obstacle for obstacle in obstacles + extra if obstacle.name != meshes_with]
        free = rooms.clearance(others, places, (0.0, 0.0), 0.0, lateral.gears[-1], tip) >= tip
        if not free.any():
            raise CannotBuildError(f"no room for the pinion of {tip:.1f} mm radius on the motor", ways=ways)
        places, angles = places[free], angles[free]
        index = rooms.best_place(
            "motor", obstacles + extra, places, half, angles, body_y,
            lambda p: np.linalg.norm(p - MOTOR_WANTED_MM, axis=1), ways,
        )  # fmt: skip
        return places[index], float(angles[index])

    if len(stages) == 1:
        place, angle = motor_place(cam_axis, [])
        return None, place, angle
    idlers = _idler_places(obstacles, drive, lateral, cam_axis)[::IDLER_STEP]
    away = np.linalg.norm(idlers - MOTOR_WANTED_MM, axis=1)
    least = away + np.abs(away - stages[0].centre_distance_mm)
    best: tuple[float, int, Array, float] | None = None
    for index in np.argsort(least, kind="stable").tolist():
        if best is not None and least[index] > best[0] + ROUND_OFF_MM:
            break  # of what is left, no motor can be nearer
        candidate = idlers[index]
        try:
            place, angle = motor_place(candidate, idler_obstacles(candidate, drive, lateral))
        except CannotBuildError:
            continue
        cost = float(np.linalg.norm(place - MOTOR_WANTED_MM) + np.linalg.norm(candidate - MOTOR_WANTED_MM))
        if best is None or (cost, index) < best[:2]:
            best = (cost, index, place, angle)
    if best is None:
        raise CannotBuildError("no room for the idler and the motor beside the cam", ways=ways)
    _, index, place, angle = best
    return idlers[index], place, angle


def _idler_places(obstacles: list[rooms.Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array) -> Array:
    """Return the places (n, 2) of an idler around the cam gear in which its wheel and its axle are free."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    places, _ = rooms.ring_candidates(cam_axis, last.centre_distance_mm)
    tip = first.wheel.tip_radius_mm
    wheel_free = rooms.clearance(obstacles, places, (0.0, 0.0), 0.0, lateral.gears[1], tip) - tip
    others = [obstacle for obstacle in obstacles if obstacle.name != "cam gear"]  # which its pinion meshes with
    axle_free = rooms.clearance(others, places, (0.0, 0.0), 0.0, lateral.inside, SPACER_RADIUS_MM) - SPACER_RADIUS_MM
    return np.asarray(places[np.minimum(wheel_free, axle_free) >= 0])


def idler_obstacles(place: Array, drive: Drive, lateral: Lateral) -> list[rooms.Obstacle]:
    """Return the idler's wheel, pinion and axle as obstacles."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    return [
        rooms.disc("idler wheel", place, first.wheel.tip_radius_mm + CLEAR_MM, lateral.gears[1]),
        rooms.disc("idler pinion", place, last.pinion.tip_radius_mm + CLEAR_MM, lateral.gears[0]),
        rooms.disc("idler axle", place, SPACER_RADIUS_MM + CLEAR_MM, lateral.inside),
    ]


def train_obstacles(
    motor: Array, angle_rad: float, idler: Array | None, drive: Drive, lateral: Lateral, ear_mm: float = CAP_EAR_MM
) -> list[rooms.Obstacle]:
    """Return motor, its pinion, and the idler where there is one."""
    pinion = drive.train.stages[0].pinion
    obstacles = [
        rooms.box_obstacle("motor", motor, socket_half_mm(drive.train.motor, ear_mm), angle_rad, lateral.inside),
        rooms.disc("pinion", motor, pinion.tip_radius_mm + CLEAR_MM, lateral.gears[-1]),
    ]
    return obstacles if idler is None else [*obstacles, *idler_obstacles(idler, drive, lateral)]
