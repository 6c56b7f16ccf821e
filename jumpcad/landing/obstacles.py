"""Things on the floor that a robot jumps over, onto or against."""

import math
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from jumpcad.files import Record
from jumpcad.transforms import Array, chained, pose_about_z, pose_at

Kind = Literal["bar", "step", "wall"]
Place = Annotated[
    tuple[Annotated[float, Field(ge=-1000, le=1000)], ...], Field(strict=False, min_length=2, max_length=2)
]
"""x and y of a point on the floor (m)."""
BAR_M, WALL_M = 0.005, 0.01
"""Thickness of a bar, of a wall."""
STEP_M = (1.5, 0.5)
"""Half of the length and height of a step's box, most of which lies below the floor."""
BOX = (
    '<body name="obstacle{0}" mocap="true" pos="0 0 -9"><geom name="obstacle{0}" type="box" size="{1} {2} {3}" '
    'priority="-1" /></body>'
)


class Obstacle(Record):
    """A bar across the way, a step or a wall.

    `at_m` is the middle of the face that a robot meets which comes along `facing_deg` (left positive from x),
    `height_mm` the height of its top. A bar is 5 mm thick and has nothing below it, a wall stands on the floor. A step
    is 3 m long.
    """

    kind: Kind
    at_m: Place
    height_mm: Annotated[float, Field(ge=1, le=500)]
    facing_deg: Annotated[float, Field(ge=-360, le=360)] = 0.0
    wide_m: Annotated[float, Field(ge=0.05, le=10)] = 2.0

    @property
    def half_m(self) -> tuple[float, float, float]:
        """Half of the length, width and height of its box."""
        (length, high), wide = STEP_M, self.wide_m / 2.0
        if self.kind == "step":
            return length, wide, high
        return (BAR_M / 2.0, wide, BAR_M / 2.0) if self.kind == "bar" else (WALL_M / 2.0, wide, self.height_mm / 2000.0)

    @property
    def pose(self) -> Array:
        """Pose (4, 4) of its box's middle (m)."""
        length, _, high = self.half_m
        front = pose_about_z(math.radians(self.facing_deg))
        front[:3, 3] = *self.at_m, self.height_mm / 1000.0 - high
        return chained(front, pose_at(np.eye(3), (length, 0.0, 0.0)))
