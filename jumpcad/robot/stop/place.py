"""The rest stop: a bar between the plates behind the main leg, with a pad that the leg's heel touches (mm).

Nothing else may touch before: the links' room extends as far past rest as stop and pad let them turn.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from jumpcad.catalogue import Pad
from jumpcad.dimensions import CLEAR_MM, GAP_MM, STOP_EDGE_MM, STOP_PAD_MM, STOP_SEAT_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose, higher, lower
from jumpcad.mechanism.linkage import FARTHER_PAST_REST, Linkage
from jumpcad.robot.sizing import Sections
from jumpcad.robot.space.inside import legs_apart_mm
from jumpcad.robot.space.room import Obstacle, box_obstacle, clearance, shortfall
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array, direction
from jumpcad.workshop.workshop import STOP_PAD_MIN_MM

LEAST_DEG, STEP_DEG = 3.0, 0.5
"""Least angle past rest, and step to the angles tried below the required one; judgement: less is within play and
bending."""
GIVE_ROOM_RAD = math.radians(3.0)
"""Room beyond the stop for the pad's deflection, with the usual clearances; judgement, checked by `stop_clearance`."""
HEEL_MM = 0.2
"""By how much the leg's heel stands out beyond its boss, so that a flat face touches the pad; one layer."""
TAB_MM = (5.0, 4.0)
"""Size of the bar's tabs in the plates, along the leg and in the direction of the impact; judgement. They lie at the
bar's edge nearest to the hub, so that the plates reach down no further than the bar."""
EAR_MM = 16.0
"""Width of the plates' ears at the pivots' line, from the leg's axle forwards; judgement: the impact bends them."""
KNOWN_MM = 3.0
"""The stop's room is known up to this; more does not matter."""
NEAREST_MM, FARTHEST_MM, WANTED_MM, STEP_MM = 9.0, 24.0, 18.0, 0.25
"""Distances of the pad's middle from the hub, along the leg; judgement: a pad near the hub lets the leg turn far."""


@dataclass(frozen=True)
class StopPlace:
    """Where the stop is, in the body frame's x-z plane (mm).

    - `angle_rad`: Of the leg past rest when its heel touches the pad.
    - `direction_rad`: Direction of the leg then, below the x axis: the pad's face is parallel to it.
    - `radius_mm`, `heel_mm`: From the hub to the pad's middle, along the leg; from the leg's middle line to its heel.
    - `face_mm`: Middle (2,) of the pad's free face.
    - `depth_mm`: Of the bar, in the direction of the impact.
    - `room_mm`: How much farther than needed the freest place for it is from everything else, at most `KNOWN_MM`.
    """

    angle_rad: float
    direction_rad: float
    radius_mm: float
    heel_mm: float
    face_mm: Array
    depth_mm: float
    pad: Pad
    room_mm: float

    @property
    def reach_rad(self) -> float:
        """How far past rest the links have room: angle of the stop plus deflection of the pad."""
        return self.angle_rad + GIVE_ROOM_RAD

    @property
    def behind(self) -> Array:
        """Unit vector (2,) of the impact, from the pad's face into the bar."""
        return _unit(self.direction_rad + math.pi / 2.0)

    @property
    def seat_mm(self) -> Array:
        """Middle (2,) of the bar's face, at the edge of the pad's seat."""
        return self.face_mm + (self.pad.thickness_mm - STOP_SEAT_MM) * self.behind

    @property
    def along(self) -> Array:
        """Unit vector (2,) along the pad's face, away from the hub."""
        return _unit(self.direction_rad)

    @property
    def middle_mm(self) -> Array:
        """Middle (2,) of the bar."""
        return self.seat_mm + self.depth_mm / 2.0 * self.behind

    @property
    def tab_mm(self) -> Array:
        """Middle (2,) of the bar's tabs and of the slots for them."""
        return self.seat_mm + tab_offset_mm(self.along, self.behind)

    @property
    def turn_rad(self) -> float:
        """Turn of the bar's box in x-z, counter-clockwise: its first side lies along the leg."""
        return -self.direction_rad

    def pad_n_per_mm(self, width_mm: float) -> float:
        """Return the stiffness of the pad, pressed flat by a leg of some thickness."""
        return self.pad.rate_n_per_mm(width_mm, STOP_PAD_MM)


@lru_cache(maxsize=64)
def _unit(angle_rad: float) -> Array:
    """Return a rounded unit vector (2,); a stop's are asked for often."""
    return np.round(direction(angle_rad), 9)


def tab_offset_mm(along: Array, behind: Array) -> Array:
    """Return the middle (2,) of the tabs from that of the bar's face."""
    return (TAB_MM[0] - STOP_PAD_MM) / 2.0 * along + TAB_MM[1] / 2.0 * behind


def stop_angle_rad(linkage: Linkage, sections: Sections, wanted_rad: float, gap_mm: float = GAP_MM) -> float:
    """Return the angle past rest of the stop: the required one, or the largest below it that the links can reach.

    Leg and front link then have `gap_mm` between them.
    """
    least = math.radians(LEAST_DEG)
    angle = wanted_rad
    while True:
        missing, short = _missing(linkage, sections, angle + GIVE_ROOM_RAD, gap_mm)
        if not missing:
            return angle
        if angle <= least:
            raise CannotBuildError(
                f"no rest stop: {missing} with the leg {math.degrees(angle + GIVE_ROOM_RAD):.1f}° past rest, which a "
                f"stop at {LEAST_DEG:g}° and its pad's deflection need",
                "stop_reach", -short, ways=FARTHER_PAST_REST,
            )  # fmt: skip
        angle = max(angle - math.radians(STEP_DEG), least)


def _missing(linkage: Linkage, sections: Sections, reach_rad: float, gap_mm: float) -> tuple[str, float]:
    """Return what prevents the links from turning that far past rest, and by how much (mm); empty if nothing does."""
    short = float(linkage.diagonal_mm(reach_rad)) - linkage.l3 - linkage.l4
    if short > 0.0:
        return f"foot and front link are {short:.1f} mm too short to close the loop", short
    room = legs_apart_mm(linkage, sections, reach_rad) - gap_mm
    return f"the gap of main leg and front link is {-room:.1f} mm less than {gap_mm:g} mm" if room < 0.0 else "", -room


def stop_place(
    obstacles: list[Obstacle], linkage: Linkage, sections: Sections, angle_rad: float, pad: Pad, inside: Interval,
    plate: Interval, reserve_mm: float = 0.0,
) -> StopPlace:  # fmt: skip
    """Return the place of the stop behind the leg, across both plates: the free one nearest to the wanted radius.

    It has `reserve_mm` more than the usual clearances around it.
    """
    if pad.thickness_mm < STOP_PAD_MIN_MM:
        raise CannotBuildError(
            f"body.stop_pad = {pad.name} is {pad.thickness_mm:g} mm thick; the rest stop needs at least "
            f"{STOP_PAD_MIN_MM:g} mm",
            ways=choose("a thicker", "body.stop_pad"),
        )
    below = linkage.rest_rad + angle_rad
    heel = max(sections.leg_root_mm / 2.0, sections.eye_radius_mm) + HEEL_MM
    along, behind = _unit(below), _unit(below + math.pi / 2.0)
    radii = np.arange(NEAREST_MM, FARTHEST_MM + STEP_MM, STEP_MM)
    radii = radii[np.argsort(np.abs(radii - WANTED_MM), kind="stable")]
    faces = linkage.back_pivot_mm + radii[:, None] * along + heel * behind
    half = (STOP_PAD_MM / 2.0, (pad.thickness_mm - STOP_SEAT_MM + sections.stop_mm) / 2.0)
    known_mm = KNOWN_MM + reserve_mm
    room = clearance(obstacles, faces + half[1] * behind, half, -below, inside, known_mm)
    slots = faces + (pad.thickness_mm - STOP_SEAT_MM) * behind + tab_offset_mm(along, behind)
    edge = (TAB_MM[0] / 2.0 + STOP_EDGE_MM, TAB_MM[1] / 2.0 + STOP_EDGE_MM)
    room = np.minimum(room, clearance(obstacles, slots, edge, -below, plate, known_mm)) - reserve_mm
    if not (room >= 0.0).any():
        raise CannotBuildError(
            f"no room for the rest stop behind the main leg: {shortfall(room.max())} too little",
            "stop_room", room.max(), ways=lower("compression_ratio") + higher("rest_angle_deg"),
        )  # fmt: skip
    best = int(np.argmax(room >= 0.0))
    return StopPlace(
        angle_rad, below, float(radii[best]), heel, np.round(faces[best], 6), sections.stop_mm, pad,
        min(float(room.max()), KNOWN_MM),
    )  # fmt: skip


def stop_obstacles(stop: StopPlace, inside: Interval) -> Iterable[Obstacle]:
    """Yield the bar as an obstacle for what is placed after it."""
    half = (STOP_PAD_MM / 2.0 + CLEAR_MM, stop.depth_mm / 2.0 + CLEAR_MM)
    yield box_obstacle("rest stop", stop.middle_mm, half, stop.turn_rad, inside)


def stop_tab_obstacle(stop: StopPlace, plate: Interval) -> Obstacle:
    """Return the slot in a plate for a tab of the bar."""
    return box_obstacle("rest stop's slot", stop.tab_mm, (TAB_MM[0] / 2.0, TAB_MM[1] / 2.0), stop.turn_rad, plate)
