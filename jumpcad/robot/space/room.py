"""Finding room: obstacles as clouds of points with radii, and the clearance of boxes among them (numpy only, mm).

All motion is in planes parallel to x-z, so an obstacle is a flat cloud that occupies an interval of y; two of them can
only collide where their intervals overlap. Each thing takes the free place that keeps the body small and its weight
over the feet, above the line through the two pivots. Candidates are fixed grids: the same inputs give the same robot.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jumpcad.errors import CannotBuildError
from jumpcad.findings import Remedy
from jumpcad.transforms import Array

EVERYWHERE = (-math.inf, math.inf)
"""The interval of every y."""
"""What makes room between the plates."""
BAR_SPACING_MM = 4.0
"""Distance between the points of a bar; judgement: notches of 0.4 mm between discs of 5 mm radius."""
BOX_POINT_MM = 1.0
"""Radius of the points of a box; they are twice that apart; judgement."""
GROUP = 12
"""Boxes measured at once, neighbours in their list: few points are near all of them."""


@dataclass(frozen=True)
class Obstacle:
    """Points (n, 2) with one radius or radii (n,) in the body frame's x-z plane, over an interval of y (mm)."""

    name: str
    points_mm: Array
    radius_mm: float | Array
    y_mm: tuple[float, float]


def disc(name: str, centre_mm: npt.ArrayLike, radius_mm: float, y_mm: tuple[float, float]) -> Obstacle:
    """Return a round obstacle."""
    return Obstacle(name, np.atleast_2d(np.asarray(centre_mm, dtype=float)), radius_mm, y_mm)


def bar(start_mm: npt.ArrayLike, end_mm: npt.ArrayLike, spacing_mm: float = BAR_SPACING_MM) -> Array:
    """Return points (n, 2), or (m·n, 2) for ends (m, 2), along straight bars."""
    start, end = np.atleast_2d(np.asarray(start_mm, dtype=float)), np.atleast_2d(np.asarray(end_mm, dtype=float))
    longest = float(np.linalg.norm(end - start, axis=1).max())
    share = np.linspace(0.0, 1.0, max(2, 1 + round(longest / spacing_mm)))
    points: Array = start[:, None] + share[None, :, None] * (end - start)[:, None]
    return points.reshape(-1, 2)


def box_obstacle(
    name: str, centre_mm: npt.ArrayLike, half_mm: npt.ArrayLike, angle_rad: float, y_mm: tuple[float, float]
) -> Obstacle:
    """Return a box (half sizes (2,), turned by an angle in x-z) as a grid of points with a radius."""
    half = np.asarray(half_mm, dtype=float)
    ticks = [np.linspace(-h + BOX_POINT_MM, h - BOX_POINT_MM, max(2, 1 + round(h / BOX_POINT_MM))) for h in half]
    grid = np.stack(np.meshgrid(*ticks), axis=-1).reshape(-1, 2)
    return Obstacle(name, np.asarray(centre_mm, dtype=float) + grid @ _frame(angle_rad).T, BOX_POINT_MM, y_mm)


def clearance(
    obstacles: Iterable[Obstacle], centres_mm: Array, half_mm: npt.ArrayLike, angles_rad: npt.ArrayLike,
    y_mm: tuple[float, float], within_mm: float = 0.0,
) -> Array:  # fmt: skip
    """Return the smallest distance (k,) from k boxes to any obstacle that shares an interval of y; negative inside.

    Centres are (k, 2), turns in x-z (k,) or one for all; all have the half sizes (2,), of which (0, 0) measures from
    points. What is farther away than `within_mm` may be left out: the distance is then larger, or infinite.
    """
    angles = np.broadcast_to(np.asarray(angles_rad, dtype=float), len(centres_mm))
    cloud = Cloud.of(obstacles, y_mm).near(centres_mm, half_mm, within_mm)
    free = np.empty(len(centres_mm))
    for first in range(0, len(centres_mm), GROUP):
        group = slice(first, first + GROUP)
        near = cloud.near(centres_mm[group], half_mm, within_mm)
        free[group] = near.clearance(centres_mm[group], half_mm, angles[group])
    return free


def shortfall(room_mm: float) -> str:
    """Return how much room is missing, rounded up to a tenth of a mm."""
    return f"{math.ceil(-10.0 * room_mm - 1e-6) / 10.0:.1f} mm"


@dataclass(frozen=True)
class Cloud:
    """The points (n, 2) and radii (n,) of several obstacles together (mm)."""

    points_mm: Array
    radii_mm: Array

    @classmethod
    def of(cls, obstacles: Iterable[Obstacle], y_mm: tuple[float, float]) -> "Cloud":
        """Return the cloud of those obstacles that share an interval of y."""
        met = [obstacle for obstacle in obstacles if obstacle.y_mm[0] < y_mm[1] and y_mm[0] < obstacle.y_mm[1]]
        if not met:
            return cls(np.zeros((0, 2)), np.zeros(0))
        radii = [np.full(len(obstacle.points_mm), obstacle.radius_mm) for obstacle in met]
        return cls(np.concatenate([obstacle.points_mm for obstacle in met]), np.concatenate(radii))

    def near(self, centres_mm: Array, half_mm: npt.ArrayLike, within_mm: float = 0.0) -> "Cloud":
        """Return the discs that can be within a distance of boxes of half sizes (2,), however turned, at (k, 2)."""
        reach = np.hypot(*np.asarray(half_mm, dtype=float)) + within_mm + self.radii_mm
        (low_x, low_z), (high_x, high_z) = centres_mm.min(axis=0), centres_mm.max(axis=0)
        kept = np.flatnonzero(self.points_mm[:, 1] > low_z - reach)  # not what lies below, as most of the foot does
        x, z, reach = self.points_mm[kept, 0], self.points_mm[kept, 1], reach[kept]
        kept = kept[(x > low_x - reach) & (x < high_x + reach) & (z < high_z + reach)]
        return Cloud(self.points_mm[kept], self.radii_mm[kept])

    def thinned(self, step: int) -> "Cloud":
        """Return one disc in so many."""
        return Cloud(self.points_mm[::step], self.radii_mm[::step])

    def clearance(self, centres_mm: Array, half_mm: npt.ArrayLike, angles_rad: Array) -> Array:
        """Return the smallest distance (k,) from k boxes to any disc; negative inside, infinite where there is none."""
        half_u, half_v = np.asarray(half_mm, dtype=float)
        x = self.points_mm[:, 0] - centres_mm[:, 0, None]
        z = self.points_mm[:, 1] - centres_mm[:, 1, None]
        if angles_rad.any():
            cos, sin = np.cos(angles_rad)[:, None], np.sin(angles_rad)[:, None]
            x, z = cos * x + sin * z, cos * z - sin * x
        beyond_u, beyond_v = np.abs(x) - half_u, np.abs(z) - half_v
        out_u, out_v = np.maximum(beyond_u, 0.0), np.maximum(beyond_v, 0.0)
        outside = np.sqrt(out_u * out_u + out_v * out_v)
        distance = outside + np.minimum(np.maximum(beyond_u, beyond_v), 0.0) - self.radii_mm
        return np.asarray(distance.min(axis=1, initial=np.inf))


def _frame(angle_rad: float) -> Array:
    """Return the rotation (2, 2) that turns x towards z by an angle."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[cos, -sin], [sin, cos]])


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
    what: str, obstacles: Sequence[Obstacle], centres_mm: Array, half_mm: tuple[float, float],
    angles_rad: Array | float, y_mm: tuple[float, float], cost: Callable[[Array], Array], ways: Remedy,
) -> int:  # fmt: skip
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
