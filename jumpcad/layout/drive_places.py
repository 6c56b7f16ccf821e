"""Places of the drive in the body: spring pin, idler and motor, beside cam and springs (mm).

In-plane places are in the body frame's x-z plane.
"""

import math

import numpy as np

from jumpcad.catalogue import Motor
from jumpcad.dimensions import CLEAR_MM, GAP_MM, SPACER_RADIUS_MM
from jumpcad.drive import Drive
from jumpcad.drive.socket import socket_half_mm
from jumpcad.errors import CannotBuildError
from jumpcad.layout.lateral import Interval, Lateral
from jumpcad.layout.places import around, best_place, ring_candidates
from jumpcad.layout.room import Obstacle, bar, box_obstacle, clearance, disc
from jumpcad.transforms import Array

PIN_RADIUS_MM = 1.5
"""Of the pin that holds the springs' body arms: half of a 3 mm rod."""
PIN_FROM_DEG, PIN_UP_TO_DEG, PIN_WANTED_DEG = 20.0, 131.0, 40.0
"""Directions of that pin from the hub, counter-clockwise from forward; judgement: between leg and cam."""
PIN_STEPS_DEG = (5.0, 1.0)
"""Between the directions tried, the second where the first finds no room; judgement."""
ARM_RADIUS_MM = 1.5
"""Of a spring's arm: half of the catalogue's thickest wire, 2.5 mm, rounded up."""
ARM_BEYOND_MM = 2.0
"""How far a spring's arm reaches beyond its pin; judgement."""
MOTOR_WANTED_MM = np.array([0.0, 14.0])
"""Where the motor is wanted in the body frame; judgement: between the pivots, its socket just above their line."""
IDLER_STEP = 2
"""Every second free place of an idler is tried: 10° apart; judgement."""


def spring_pin_place(obstacles: list[Obstacle], hub: Array, radius_mm: float, inside: Interval) -> Array:
    """Return the place (2,) of the pin that holds the springs' body arms: across both plates, in front of the hub."""

    def place(step_deg: float) -> Array:
        angles = np.radians(np.arange(PIN_FROM_DEG, PIN_UP_TO_DEG, step_deg))
        places = around(hub, radius_mm, angles)
        index = best_place(
            "spring pin", obstacles, places, (PIN_RADIUS_MM, PIN_RADIUS_MM), 0.0, inside,
            lambda p: np.abs(np.arctan2(p[:, 1] - hub[1], p[:, 0] - hub[0]) - math.radians(PIN_WANTED_DEG)),
            "lower stiffness_nmm_per_deg (a smaller spring) or raise carrying_link_mm",
        )  # fmt: skip
        return np.asarray(places[index])

    coarse, fine = PIN_STEPS_DEG
    try:
        return place(coarse)
    except CannotBuildError:
        return place(fine)


def spring_arm(hub: Array, pin: Array, radius_mm: float, inside: Interval) -> Obstacle:
    """Return the springs' arm from the hub to a little beyond its pin, which is a radius away."""
    points = bar(hub, hub + (pin - hub) * (1.0 + ARM_BEYOND_MM / radius_mm))
    return Obstacle("spring arm", points, ARM_RADIUS_MM + CLEAR_MM, inside)


def require_shaft(motor: Motor, lateral: Lateral) -> None:
    """Reject a motor whose shaft reaches less than its diameter into its pinion (judgement; usual for hubs)."""
    needed = lateral.gears[-1][0] + motor.shaft_mm - lateral.motor[1]
    if motor.shaft_length_mm < needed - 1e-9:
        raise CannotBuildError(
            f"the shaft of motor {motor.name} is {motor.shaft_length_mm:g} mm long; it needs {needed:.1f} mm to pass "
            f"its cap and reach {motor.shaft_mm:g} mm into its pinion: allow a motor with a longer shaft"
        )


def require_gear_room(hub_things: list[Obstacle], axis: Array, tip_mm: float, y: Interval) -> None:
    """Reject a cam gear that collides with the springs or an axle."""
    room = clearance(hub_things, axis[None], (0.0, 0.0), 0.0, y)[0] - tip_mm
    if room < 0:
        raise CannotBuildError(
            f"the cam gear's tip radius of {tip_mm:.1f} mm is {-room:.1f} mm too large beside the leg's axle: "
            "allow a stronger motor (a smaller ratio), or a smaller gear module"
        )


def train_places(
    obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array
) -> tuple[Array | None, Array, float]:
    """Return the idler's place (two stages), the motor's, and the motor's direction."""
    stages, motor = drive.train.stages, drive.train.motor
    half = socket_half_mm(motor)
    body_y = (lateral.inside[0], lateral.gears[-1][0] - GAP_MM)
    tip, remedy = stages[0].pinion.tip_radius_mm, _smaller(motor)
    meshes_with = "cam gear" if len(stages) == 1 else "idler wheel"

    def motor_place(axis: Array, extra: list[Obstacle]) -> tuple[Array, float]:
        places, angles = ring_candidates(axis, stages[0].centre_distance_mm)
        others = [obstacle for obstacle in obstacles + extra if obstacle.name != meshes_with]
        free = clearance(others, places, (0.0, 0.0), 0.0, lateral.gears[-1]) >= tip
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
    best: tuple[float, Array, Array, float] | None = None
    for candidate in _idler_places(obstacles, drive, lateral, cam_axis)[::IDLER_STEP]:
        try:
            place, angle = motor_place(candidate, idler_obstacles(candidate, drive, lateral))
        except CannotBuildError:
            continue
        cost = float(np.linalg.norm(place - MOTOR_WANTED_MM) + np.linalg.norm(candidate - MOTOR_WANTED_MM))
        if best is None or cost < best[0]:
            best = (cost, candidate, place, angle)
    if best is None:
        raise CannotBuildError(f"no room for the idler and the motor beside the cam: {remedy}")
    return best[1:]


def _smaller(motor: Motor) -> str:
    return (
        "raise d_coef or carrying_link_mm (a longer body), or allow a smaller motor than "
        f"{motor.name} ({motor.width_mm:g} x {motor.height_mm:g} mm)"
    )


def _idler_places(obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array) -> Array:
    """Return the places (n, 2) of an idler around the cam gear in which its wheel and its axle are free."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    places, _ = ring_candidates(cam_axis, last.centre_distance_mm)
    wheel_free = clearance(obstacles, places, (0.0, 0.0), 0.0, lateral.gears[1]) - first.wheel.tip_radius_mm
    others = [obstacle for obstacle in obstacles if obstacle.name != "cam gear"]  # which its pinion meshes with
    axle_free = clearance(others, places, (0.0, 0.0), 0.0, lateral.inside) - SPACER_RADIUS_MM
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
    motor: Array, angle_rad: float, idler: Array | None, drive: Drive, lateral: Lateral
) -> list[Obstacle]:
    """Return motor, its pinion, and the idler where there is one."""
    pinion = drive.train.stages[0].pinion
    obstacles = [
        box_obstacle("motor", motor, socket_half_mm(drive.train.motor), angle_rad, lateral.inside),
        disc("pinion", motor, pinion.tip_radius_mm + CLEAR_MM, lateral.gears[-1]),
    ]
    return obstacles if idler is None else [*obstacles, *idler_obstacles(idler, drive, lateral)]
