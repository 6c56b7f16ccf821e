"""Places of the springs' arms and of the pin that holds them (mm).

In-plane places are in the body frame's x-z plane.
"""

import math
from typing import Literal

import numpy as np

from jumpcad.dimensions import CLEAR_MM, GAP_MM, SPRING_BOSS_MIN_MM, SPRING_BOSS_MM, SPRING_BOSS_WALL_MM
from jumpcad.drive import TorsionSpring
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Remedy, higher, lower
from jumpcad.robot.space.inside import Lateral
from jumpcad.robot.space.room import Obstacle, around, bar, best_place, clearance, disc
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

PIN_FROM_DEG, PIN_UP_TO_DEG, PIN_WANTED_DEG = 20.0, 131.0, 40.0
"""Directions of that pin from the hub, counter-clockwise from forward; judgement: between leg and cam."""
PIN_STEPS_DEG = (5.0, 1.0)
"""Between the directions tried, the second where the first finds no room; judgement."""


def pin_directions_rad(step_deg: float) -> tuple[float, ...]:
    """Return directions of the springs' pin in the plates, the nearest to the wanted one first."""
    degrees = np.arange(PIN_FROM_DEG, PIN_UP_TO_DEG, step_deg).tolist()
    return tuple(math.radians(angle) for angle in sorted(degrees, key=lambda angle: abs(angle - PIN_WANTED_DEG)))


PLATE_PINS_RAD = pin_directions_rad(PIN_STEPS_DEG[0])
"""The directions that are tried at first."""


class NoPinRoomError(CannotBuildError):
    """Something stands where the springs want their pin; `free_rad` are directions in which nothing does."""

    def __init__(self, message: str, free_rad: tuple[float, ...], ways: Remedy) -> None:
        super().__init__(message, ways=ways)
        self.free_rad = free_rad


def spring_pin_place(obstacles: list[Obstacle], hub: Array, spring: TorsionSpring, inside: Interval) -> Array:
    """Return the place (2,) of the pin that holds the springs' body arms: across both plates, in front of the hub.

    The springs' turns fit one direction only.
    """
    half, radius = (spring.arms.pin_mm / 2.0,) * 2, spring.arms.pin_radius_mm
    (place,) = places = around(hub, radius, np.array([spring.plate_pin_rad]))
    ways = lower("stiffness_nmm_per_deg", note="a smaller spring") + higher("carrying_link_mm")
    try:
        best_place("spring pin", obstacles, places, half, 0.0, inside, lambda p: np.zeros(len(p)), ways)
    except CannotBuildError as refusal:
        free: list[float] = []
        for step in PIN_STEPS_DEG:
            directions = np.array(pin_directions_rad(step))
            room = clearance(obstacles, around(hub, radius, directions), half, 0.0, inside)
            free = free or directions[room >= 0.0].tolist()
        raise NoPinRoomError(refusal.what, tuple(free), refusal.ways) from None
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
