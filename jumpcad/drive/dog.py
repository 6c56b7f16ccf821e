"""The dog clutch between cam gear and cam: two jaws that transmit torque one way and have play the other way.

While the motor winds, the gear's jaws push the cam's. At release the springs throw the cam forward faster than the
gear turns; with free play ahead of it, the cam swings clear of the roller without turning gears and motor.

Frame as in `cam`: the cam turns clockwise, so angles counter-clockwise from x fall while it winds.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jumpcad.dimensions import DOG_PLAY_MIN_DEG
from jumpcad.transforms import Array

PLAY_MORE_RAD = math.radians(3.0)
"""Play beyond the roll-over, and window beyond what the play needs: for printing tolerances and wear; judgement."""
JAWS = 2
ASIDE_MORE_RAD = math.radians(3.0)
"""By how much more than half of the play a jaw stands aside; judgement: turned by half a turn, the jaws then overlap
the pockets' ends by twice that, 0.6 mm on the smallest dog."""


def free_play_rad(roll_over_rad: npt.ArrayLike, fixed_rad: float | None = None) -> Array:
    """Return the dog's free play (n,): the roll-over and a margin, or what a workshop fixes (0 is a rigid key)."""
    roll_over = np.asarray(roll_over_rad, dtype=float)
    if fixed_rad is not None:
        return np.full_like(roll_over, fixed_rad)
    return np.maximum(math.radians(DOG_PLAY_MIN_DEG), roll_over + PLAY_MORE_RAD)


@dataclass(frozen=True)
class Dog:
    """Jaws of cam and gear, which share a ring around the cam's axle.

    The cam's two jaws are equal but not opposite to each other, and so are the gear's pockets: the gear fits in one
    position only. Of the gear's own jaws, which hub and web hold on either side, one is narrower for it.

    Attributes
    ----------
    play_rad
        How far the cam can run ahead of the gear.
    outer_mm
        Diameter of the cam's boss and jaws.
    """

    play_rad: float
    outer_mm: float

    @property
    def jaw_rad(self) -> float:
        """Width of a jaw of the cam; those of the gear are as wide on average."""
        return (2.0 * math.pi / JAWS - self.play_rad) / 2.0

    @property
    def aside_rad(self) -> float:
        """How far the second jaw stands from opposite the first: twice this is more than the play."""
        return self.play_rad / 2.0 + ASIDE_MORE_RAD

    @property
    def cam_jaws_rad(self) -> list[tuple[float, float]]:
        """Where the cam's jaws begin and end, counter-clockwise from x, at cam angle 0."""
        middles = (0.0, math.pi + self.aside_rad)
        return [(middle - self.jaw_rad / 2.0, middle + self.jaw_rad / 2.0) for middle in middles]

    @property
    def pockets_rad(self) -> list[tuple[float, float]]:
        """Where the gear's pockets begin and end while it pushes the cam, as it stands at cam angle 0.

        The cam turns clockwise: the gear pushes at the counter-clockwise end of a jaw, and the play lies beyond the
        other one.
        """
        return [(begin - self.play_rad, end) for begin, end in self.cam_jaws_rad]
