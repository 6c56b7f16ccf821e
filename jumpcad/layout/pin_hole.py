"""The way of the leg's springs' pin: a hole in the left plate opposite its seat, and the free room behind it (mm).

The pin goes in last, when both plates hold the pin that the springs' other arms lie on. The hole is as long as the
leg's pin moves from its rest pose to the stop, so that it is free in both.
"""

from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import PIN_HOLE_EDGE_MM
from jumpcad.errors import CannotBuildError
from jumpcad.layout.lateral import Interval
from jumpcad.layout.room import Obstacle, clearance
from jumpcad.transforms import Array, direction


@dataclass(frozen=True)
class PinHole:
    """Where the left plate has its hole: the pin's places (2,) in the rest pose and with the leg at its stop.

    `diameter_mm` is the width of the hole, which the pin's head or clip passes.
    """

    rest_mm: Array
    stop_mm: Array
    diameter_mm: float

    @property
    def places_mm(self) -> Array:
        """Both ends (2, 2)."""
        return np.stack([self.rest_mm, self.stop_mm])

    @property
    def pad_mm(self) -> float:
        """Width of the plate's material around it."""
        return self.diameter_mm + 2.0 * PIN_HOLE_EDGE_MM

    def obstacle(self, y_mm: Interval) -> Obstacle:
        """Return hole and way as an obstacle for what is placed after them."""
        return Obstacle("way of the leg's pin", self.places_mm, self.pad_mm / 2.0, y_mm)


def pin_hole(
    hub_mm: Array, radius_mm: float, rest_rad: float, stop_rad: float, diameter_mm: float,
    obstacles: list[Obstacle], inside: Interval, plate: Interval,
) -> PinHole:  # fmt: skip
    """Return the hole for the pin at a radius from the hub, with the leg's directions at rest and at the stop.

    Parameters
    ----------
    rest_rad, stop_rad
        Directions of the leg, below the x axis.
    obstacles
        What does not move with the leg, with its clearance, and what sweeps past the plate.
    inside, plate
        Intervals of y: from the leg to the left plate, and that plate.

    Raises
    ------
    CannotBuildError
        If something is in the pin's way, or too close to the hole.
    """
    rest, stop = (np.round(hub_mm + radius_mm * direction(angle), 6) for angle in (rest_rad, stop_rad))
    hole = PinHole(rest, stop, diameter_mm)
    for y, radius in ((inside, diameter_mm / 2.0), (plate, hole.pad_mm / 2.0)):
        room = float(clearance(obstacles, hole.places_mm, (0.0, 0.0), 0.0, y, radius).min()) - radius
        if room < 0.0:
            blocker = min(obstacles, key=lambda one: clearance([one], hole.places_mm, (0.0, 0.0), 0.0, y, radius).min())
            raise CannotBuildError(
                f"no way for the leg's springs' pin through the left plate: {-room:.1f} mm too little beside the "
                f"{blocker.name}: raise d_coef or rest_angle_deg, or choose a softer spring (a smaller one)",
                "pin_way", room,
            )  # fmt: skip
    return hole
