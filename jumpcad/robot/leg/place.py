"""Places in the legs: bars between printed ends, and the way in of the leg's springs' pin (mm).

The hole for it in the left plate is opposite its seat, with free room behind. The pin goes in last, when both plates
hold the pin that the springs' other arms lie on. The hole is as long as the leg's pin moves from its rest pose to the
stop, so that it is free in both.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from jumpcad.catalogue import LegBar
from jumpcad.dimensions import CLEAR_MM, PIN_HOLE_EDGE_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import higher, lower
from jumpcad.mechanism.linkage import Linkage
from jumpcad.robot.space.inside import Lateral
from jumpcad.robot.space.room import Obstacle, clearance, disc, shortfall
from jumpcad.robot.stop.place import StopPlace, stop_obstacles, stop_tab_obstacle
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array, direction


@dataclass(frozen=True)
class PinHole:
    """Where the left plate has its hole: the pin's places (2,) in the rest pose and with the leg at its stop.

    `diameter_mm` is the width of the hole, which the pin's head or clip passes; `room_mm` is what it has left.
    """

    rest_mm: Array
    stop_mm: Array
    diameter_mm: float
    room_mm: float = math.inf

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
    linkage: Linkage, around_leg: list[Obstacle], stop: StopPlace, lateral: Lateral, radius_mm: float,
    diameter_mm: float, axle_mm: float,
) -> PinHole:  # fmt: skip
    """Return the hole for the pin at a radius from the hub, beside the bores of axles.

    `around_leg` stands beside the leg or sweeps past it, with a gap: not lever and front link, which move with the pin.
    """
    hub, plate = linkage.back_pivot_mm, lateral.left_plate
    rest, at_stop = (
        np.round(hub + radius_mm * direction(angle), 6) for angle in (linkage.rest_rad, stop.direction_rad)
    )
    found, rooms = PinHole(rest, at_stop, diameter_mm), []
    bores = [
        disc(f"bore of the {name} axle", place, axle_mm / 2.0 + CLEAR_MM, plate)
        for name, place in (("leg", hub), ("front", linkage.front_pivot_mm))
    ]
    others = [one for one in around_leg if one.name not in ("lever", "front link")]
    others += [*bores, *stop_obstacles(stop, lateral.inside), stop_tab_obstacle(stop, plate)]
    for y, reach in (((lateral.leg[1], plate[0]), diameter_mm / 2.0), (plate, found.pad_mm / 2.0)):

        def room_mm(things: list[Obstacle], y: Interval = y, reach: float = reach) -> float:
            return float(clearance(things, found.places_mm, (0.0, 0.0), 0.0, y, reach).min()) - reach

        if (room := room_mm(others)) < 0.0:
            blocker = min(others, key=lambda one: room_mm([one]))
            raise CannotBuildError(
                f"no way for the leg's springs' pin through the left plate: {shortfall(room)} too little beside the "
                f"{blocker.name}",
                "pin_way", room,
                ways=higher("d_coef") + lower("stiffness_nmm_per_deg", note="a smaller spring"),
            )  # fmt: skip
        rooms.append(room)
    return replace(found, room_mm=min(rooms))


SOCKET_HEIGHTS = 5.0
"""Length of the socket that carries the leg's bending moment, in heights of the bar; judgement: pultruded carbon has
little shear strength, and the shorter the socket, the larger the forces by which it transmits the moment."""
END_SOCKET_MM = 8.0
"""Length of the other sockets, at eyes without a moment; judgement: twice the bar's height or more."""
END_PLAY_MM = 0.2
"""Gap between the bar's ends and the sockets' floors; judgement: bars cut by hand, and room for displaced glue."""
FREE_MM = 5.0
"""Least length between the sockets; judgement: less is not worth a bar."""


@dataclass(frozen=True)
class BarPlace:
    """One bar: its sockets' floors and mouths along the leg, in order from the body to the foot."""

    bar: LegBar
    floor_mm: float
    mouth_mm: float
    far_mouth_mm: float
    far_floor_mm: float

    @property
    def length_mm(self) -> float:
        """Length to cut."""
        return self.far_floor_mm - self.floor_mm - 2.0 * END_PLAY_MM

    @property
    def middle_mm(self) -> float:
        """Its middle along the leg."""
        return (self.floor_mm + self.far_floor_mm) / 2.0


def bar_place(what: str, bar: LegBar, first_mm: float, least_mouth_mm: float, last_mm: float, bends: bool) -> BarPlace:
    """Return the place of a bar from `first_mm` to `last_mm` along a leg, the first socket's mouth not before a limit.

    `bends` tells whether the first socket carries a bending moment.
    """
    socket = SOCKET_HEIGHTS * bar.height_mm if bends else END_SOCKET_MM
    mouth, far = max(first_mm + socket, least_mouth_mm), last_mm - END_SOCKET_MM
    if far - mouth < FREE_MM:
        raise CannotBuildError(
            f"bought.leg = {bar.name!r}: {far - mouth:.1f} mm of the {what} are free between the bar's sockets; "
            f"{FREE_MM:g} mm are needed",
            "leg_bar", far - mouth - FREE_MM,
            ways=('bought.leg = ""', *higher("carrying_link_mm"), "choose a lower bar"),
        )  # fmt: skip
    return BarPlace(bar, first_mm, mouth, far, last_mm)
