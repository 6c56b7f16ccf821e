"""Places of the drive in the body: spring pin, idler and motor, beside cam and springs (mm).

In-plane places are in the body frame's x-z plane.
"""

import math
from typing import Literal

import numpy as np

from jumpcad.catalogue import Motor
from jumpcad.dimensions import (
    CAP_EAR_MM,
    CLEAR_MM,
    GAP_MM,
    SPACER_RADIUS_MM,
    SPRING_BOSS_MIN_MM,
    SPRING_BOSS_MM,
    SPRING_BOSS_WALL_MM,
)
from jumpcad.drive import Drive, TorsionSpring
from jumpcad.drive.socket import socket_half_mm
from jumpcad.errors import CannotBuildError
from jumpcad.robot.space.lateral import Interval, Lateral
from jumpcad.robot.space.places import around, best_place, ring_candidates
from jumpcad.robot.space.room import Obstacle, bar, box_obstacle, clearance, disc, shortfall
from jumpcad.transforms import Array

PIN_FROM_DEG, PIN_UP_TO_DEG, PIN_WANTED_DEG = 20.0, 131.0, 40.0
"""Directions of that pin from the hub, counter-clockwise from forward; judgement: between leg and cam."""
PIN_STEPS_DEG = (5.0, 1.0)
"""Between the directions tried, the second where the first finds no room; judgement."""
MOTOR_WANTED_MM = np.array([0.0, 14.0])
"""Where the motor is wanted in the body frame; judgement: between the pivots, its socket just above their line."""
ROUND_OFF_MM = 1e-5
"""Larger than the error of a rounded place."""
IDLER_STEP = 2
"""Every second free place of an idler is tried: 10° apart; judgement."""


def pin_directions_rad(step_deg: float) -> tuple[float, ...]:
    """Return directions of the springs' pin in the plates, the nearest to the wanted one first."""
    degrees = np.arange(PIN_FROM_DEG, PIN_UP_TO_DEG, step_deg).tolist()
    return tuple(math.radians(angle) for angle in sorted(degrees, key=lambda angle: abs(angle - PIN_WANTED_DEG)))


PLATE_PINS_RAD = pin_directions_rad(PIN_STEPS_DEG[0])
"""The directions that are tried at first."""


class NoPinRoomError(CannotBuildError):
    """Something stands where the springs want their pin; `free_rad` are directions in which nothing does."""

    def __init__(self, message: str, free_rad: tuple[float, ...]) -> None:
        super().__init__(message)
        self.free_rad = free_rad


def spring_pin_place(obstacles: list[Obstacle], hub: Array, spring: TorsionSpring, inside: Interval) -> Array:
    """Return the place (2,) of the pin that holds the springs' body arms: across both plates, in front of the hub.

    The springs' turns fit one direction only.

    Raises
    ------
    NoPinRoomError
        With the other directions that are free: springs for one of them may fit.
    """
    half, radius = (spring.arms.pin_mm / 2.0,) * 2, spring.pin_radius_mm
    (place,) = places = around(hub, radius, np.array([spring.plate_pin_rad]))
    remedy = "lower stiffness_nmm_per_deg (a smaller spring) or raise carrying_link_mm"
    try:
        best_place("spring pin", obstacles, places, half, 0.0, inside, lambda p: np.zeros(len(p)), remedy)
    except CannotBuildError as refusal:
        free: list[float] = []
        for step in PIN_STEPS_DEG:
            directions = np.array(pin_directions_rad(step))
            room = clearance(obstacles, around(hub, radius, directions), half, 0.0, inside)
            free = free or directions[room >= 0.0].tolist()
        raise NoPinRoomError(str(refusal), tuple(free)) from None
    return np.asarray(place)


def spring_obstacles(hub: Array, pin: Array, spring: TorsionSpring, inside: Interval) -> list[Obstacle]:
    """Return the springs' body arms, from their coils to a little beyond their pin, and the pin."""
    arm = bar(*arm_line(hub, spring, "plate"))
    return [
        Obstacle("spring arm", arm, spring.wire_mm / 2.0 + CLEAR_MM, inside),
        disc("spring pin", pin, spring.arms.pin_mm / 2.0 + CLEAR_MM, inside),
    ]


def spring_boss_mm(obstacles: list[Obstacle], pin: Array, axle_mm: float, lateral: Lateral) -> float:
    """Return how high the boss for the springs' pin can be on the right plate: 0 where it would be of no use.

    It may grow together with the motor's socket, which is part of that plate too.
    """
    low, radius = lateral.inside[0], axle_mm / 2.0 + SPRING_BOSS_WALL_MM
    top = min(low + SPRING_BOSS_MM, lateral.spring_right[0] - GAP_MM)
    for one in obstacles:
        if one.y_mm[0] < top and one.name not in ("spring arm", "spring pin", "motor"):
            near = clearance([one], pin[None], (0.0, 0.0), 0.0, (low, low + SPRING_BOSS_MM), radius)[0] < radius
            top = min(top, one.y_mm[0]) if near else top
    return round(top - low, 6) if top - low >= SPRING_BOSS_MIN_MM else 0.0


def arm_line(hub: Array, spring: TorsionSpring, pin: Literal["plate", "leg"]) -> tuple[Array, Array]:
    """Return where an arm's middle line leaves its coil (2,) and where it ends (2,), at rest.

    For the leg's arm in a frame whose x axis points to its pin.
    """
    sign = 1.0 if pin == "plate" else -1.0
    angle = sign * spring.arms.turn_rad + (spring.plate_pin_rad if pin == "plate" else 0.0)
    outwards, along = np.array([math.cos(angle), math.sin(angle)]), np.array([math.sin(angle), -math.cos(angle)])
    start = hub + spring.arms.mean_mm / 2.0 * outwards
    return np.round(start, 6), np.round(start + sign * spring.arm_length_mm * along, 6)


def require_shaft(motor: Motor, lateral: Lateral) -> None:
    """Reject a motor whose shaft reaches less than its diameter into its pinion (judgement; usual for hubs)."""
    needed = lateral.gears[-1][0] + motor.shaft_mm - lateral.motor[1]
    if motor.shaft_length_mm < needed - 1e-9:
        raise CannotBuildError(
            f"the shaft of motor {motor.name} is {motor.shaft_length_mm:g} mm long; it needs {needed:.1f} mm to pass "
            f"its cap and reach {motor.shaft_mm:g} mm into its pinion: allow a motor with a longer shaft",
            "shaft", motor.shaft_length_mm - needed,
        )  # fmt: skip


def require_gear_room(hub_things: list[Obstacle], axis: Array, tip_mm: float, y: Interval) -> None:
    """Reject a cam gear that collides with the springs or an axle."""
    room = clearance(hub_things, axis[None], (0.0, 0.0), 0.0, y, tip_mm)[0] - tip_mm
    if room < 0:
        raise CannotBuildError(
            f"the cam gear's tip radius of {tip_mm:.1f} mm is {shortfall(room)} too large beside the leg's axle: "
            "allow a stronger motor (a smaller ratio), or a smaller gear module",
            "gear_room", room,
        )  # fmt: skip


def train_places(
    obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array, ear_mm: float = CAP_EAR_MM
) -> tuple[Array | None, Array, float]:
    """Return the idler's place (two stages), the motor's, and the motor's direction."""
    stages, motor = drive.train.stages, drive.train.motor
    half = socket_half_mm(motor, ear_mm)
    body_y = (lateral.inside[0], lateral.gears[-1][0] - GAP_MM)
    tip, remedy = stages[0].pinion.tip_radius_mm, _smaller(motor)
    meshes_with = "cam gear" if len(stages) == 1 else "idler wheel"

    def motor_place(axis: Array, extra: list[Obstacle]) -> tuple[Array, float]:
        places, angles = ring_candidates(axis, stages[0].centre_distance_mm)
        others = [obstacle for obstacle in obstacles + extra if obstacle.name != meshes_with]
        free = clearance(others, places, (0.0, 0.0), 0.0, lateral.gears[-1], tip) >= tip
        if not free.any():
            raise CannotBuildError(f"no room for the pinion of {tip:.1f} mm radius on the motor: {remedy}")
        places, angles = places[free], angles[free]
        index = best_place(
            "motor", obstacles + extra, places, half, angles, body_y,
            lambda p: np.linalg.norm(p - MOTOR_WANTED_MM, axis=1), remedy,
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
        raise CannotBuildError(f"no room for the idler and the motor beside the cam: {remedy}")
    _, index, place, angle = best
    return idlers[index], place, angle


def _smaller(motor: Motor) -> str:
    return (
        "raise d_coef or carrying_link_mm (a longer body), or allow a smaller motor than "
        f"{motor.name} ({motor.width_mm:g} x {motor.height_mm:g} mm)"
    )


def _idler_places(obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array) -> Array:
    """Return the places (n, 2) of an idler around the cam gear in which its wheel and its axle are free."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    places, _ = ring_candidates(cam_axis, last.centre_distance_mm)
    tip = first.wheel.tip_radius_mm
    wheel_free = clearance(obstacles, places, (0.0, 0.0), 0.0, lateral.gears[1], tip) - tip
    others = [obstacle for obstacle in obstacles if obstacle.name != "cam gear"]  # which its pinion meshes with
    axle_free = clearance(others, places, (0.0, 0.0), 0.0, lateral.inside, SPACER_RADIUS_MM) - SPACER_RADIUS_MM
    return np.asarray(places[np.minimum(wheel_free, axle_free) >= 0])


def idler_obstacles(place: Array, drive: Drive, lateral: Lateral) -> list[Obstacle]:
    """Return the idler's wheel, pinion and axle as obstacles."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    return [
        disc("idler wheel", place, first.wheel.tip_radius_mm + CLEAR_MM, lateral.gears[1]),
        disc("idler pinion", place, last.pinion.tip_radius_mm + CLEAR_MM, lateral.gears[0]),
        disc("idler axle", place, SPACER_RADIUS_MM + CLEAR_MM, lateral.inside),
    ]


def train_obstacles(
    motor: Array, angle_rad: float, idler: Array | None, drive: Drive, lateral: Lateral, ear_mm: float = CAP_EAR_MM
) -> list[Obstacle]:
    """Return motor, its pinion, and the idler where there is one."""
    pinion = drive.train.stages[0].pinion
    obstacles = [
        box_obstacle("motor", motor, socket_half_mm(drive.train.motor, ear_mm), angle_rad, lateral.inside),
        disc("pinion", motor, pinion.tip_radius_mm + CLEAR_MM, lateral.gears[-1]),
    ]
    return obstacles if idler is None else [*obstacles, *idler_obstacles(idler, drive, lateral)]
