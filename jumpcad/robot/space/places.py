"""Places in the plane of motion for motor, idler, electronics, standoffs and spring pins (mm).

Everything bought sits above the line through the two pivots, outside the sweep of leg, lever, cam and foot. Each thing
takes the free place that keeps the body small and its weight over the feet. Candidates are fixed grids, so that the
same inputs give the same robot.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from jumpcad.errors import CannotBuildError
from jumpcad.findings import Remedy
from jumpcad.robot.space.room import GROUP, Cloud, Obstacle, clearance, shortfall
from jumpcad.transforms import Array

TURN_STEPS = 72
"""Candidates on a ring, one every 5°; judgement."""
BATCH, LARGER = 48, 2
"""Candidates measured at once, the cheapest first, and how many times more after every failure."""
THINNED = 16
"""One in so many of the discs in the way is looked at first."""
ROUND_OFF_MM = 1e-6
"""Accepted shortfall: a synthesised drive may have a clearance of exactly 0."""


def ring_candidates(centre_mm: Array, radius_mm: float) -> tuple[Array, Array]:
    """Return places (n, 2) on a circle, and their directions (n,) counter-clockwise from x."""
    angle = np.linspace(0.0, 2.0 * math.pi, TURN_STEPS, endpoint=False)
    return around(centre_mm, radius_mm, angle), angle


def around(centre_mm: Array, radius_mm: float, angle_rad: Array) -> Array:
    """Return the places (n, 2) at angles (n,) on a circle, rounded to 1 nm: cosines differ between processors."""
    return np.round(centre_mm + radius_mm * np.stack([np.cos(angle_rad), np.sin(angle_rad)], axis=-1), 6)


def grid_candidates(x_mm: tuple[float, float], z_mm: tuple[float, float], step_mm: float) -> Array:
    """Return places (n, 2) on a regular grid that includes the lower corner."""
    x, z = np.arange(*x_mm, step_mm), np.arange(*z_mm, step_mm)
    return np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2)


def best_place(
    what: str,
    obstacles: Sequence[Obstacle],
    centres_mm: Array,
    half_mm: tuple[float, float],
    angles_rad: Array | float,
    y_mm: tuple[float, float],
    cost: Callable[[Array], Array],
    ways: Remedy,
) -> int:
    """Return the index of the cheapest candidate that collides with no obstacle."""
    order = np.argsort(cost(centres_mm), kind="stable")
    angles = np.broadcast_to(np.asarray(angles_rad, dtype=float), len(centres_mm))
    cloud = Cloud.of(obstacles, y_mm)

    def among(discs: Cloud, places: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """Return those of some places that collide with none of the discs."""
        return places[discs.clearance(centres_mm[places], half_mm, angles[places]) >= -ROUND_OFF_MM]

    first, size = 0, BATCH
    while first < len(order):
        batch = order[first : first + size]
        first, size = first + size, LARGER * size
        near = cloud.near(centres_mm[batch], half_mm)
        left = among(near.thinned(THINNED), batch)  # most places collide with one of few discs
        for begin in range(0, len(left), GROUP):  # and few of those that are left collide with one of the others
            found = among(near, left[begin : begin + GROUP])
            if found.size:
                return int(found[0])
    free = clearance(obstacles, centres_mm, half_mm, angles, y_mm)
    best = int(np.argmax(free))
    here, turn = centres_mm[best : best + 1], angles[best : best + 1]
    blocker = min(obstacles, key=lambda obstacle: clearance([obstacle], here, half_mm, turn, y_mm)[0])
    raise CannotBuildError(
        f"no room for the {what}: {shortfall(free[best])} too little beside the {blocker.name}",
        f"room_{what.replace(' ', '_')}", free[best], ways=ways,
    )  # fmt: skip
