"""Where trays and standoffs are, and openings of the plates for switch, USB plug and wires (mm, x-z of the body)."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from jumpcad.catalogue import Component
from jumpcad.dimensions import CLEAR_MM, GAP_MM, STANDOFF_RADIUS_MM, TRAY_MM
from jumpcad.findings import higher
from jumpcad.mechanism.linkage import LONGER_BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.robot.electronics.place import TAPE_MM, Electronics, Side
from jumpcad.robot.space.inside import Lateral
from jumpcad.robot.space.room import EVERYWHERE, Obstacle, best_place, box_obstacle, disc, grid_candidates
from jumpcad.solids.outline import Region, hole, rectangle, stadium
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

TRAY_AHEAD_MM, TRAY_HIGHEST_MM = 30.0, 60.0
"""Places tried for trays: from the hub to this far ahead of the front pivot, up to this height; judgement."""
HEIGHT_COST = 1.2
"""Cost of a tray's height over that of its distance from the front pivot; judgement: a low body tips less."""
STANDOFF_BEHIND_MM, STANDOFF_AHEAD_MM, STANDOFF_HIGHEST_MM = 20.0, 40.0, 80.0
"""Places tried for standoffs: this far behind the cam's axis, ahead of the front pivot or trays, and up; judgement.
"""
STANDOFFS_APART_MM = 8.0
"""Distance added to the usual clearance between standoffs; judgement: closer ones hold the plates in one place only."""


def tray_place(obstacles: list[Obstacle], electronics: Electronics, front_mm: float, inside: Interval) -> Array:
    """Return the middle (2,) of the lower tray's underside, with pivots that far behind and ahead of the body's middle.

    Over the front pivot the battery balances cam and motor: the body's centre of mass then lies between the pivots.
    """
    half = electronics.half_mm
    places = grid_candidates((-front_mm, front_mm + TRAY_AHEAD_MM), (0.0, TRAY_HIGHEST_MM), GRID_MM)
    index = best_place(
        "battery and electronics", obstacles, places + np.array([0.0, half[1]]), half, 0.0, inside,
        lambda p: np.abs(p[:, 0] - front_mm) + HEIGHT_COST * np.abs(p[:, 1] - half[1]),
        (*LONGER_BODY, "choose a smaller battery or smaller boards: "
         f"{electronics.names} take {electronics.length_mm:.1f} x {electronics.height_mm:.1f} mm"),
    )  # fmt: skip
    return np.asarray(places[index])


def electronics_obstacle(electronics: Electronics, tray_mm: Array, inside: Interval) -> Obstacle:
    """Return trays, battery and boards as one box across the whole body."""
    return box_obstacle("electronics", electronics.middle_mm(tray_mm), electronics.half_mm, 0.0, inside)


def standoff_places(
    obstacles: list[Obstacle], cam_axis: Array, front: Array, electronics: Electronics, tray_mm: Array, inside: Interval
) -> tuple[Array, ...]:
    """Return the places of the standoffs that, with the axles, hold the plates apart at the top of the body.

    They are wanted in front of the boards, and between cam and boards, above both.
    """
    centre = electronics.middle_mm(tray_mm)
    top_z = centre[1] + electronics.half_mm[1] + STANDOFF_RADIUS_MM + GAP_MM
    wanted = [
        np.array([centre[0] + electronics.half_mm[0], top_z]),
        np.array([(cam_axis[0] + centre[0]) / 2.0, max(top_z, cam_axis[1])]),
    ]
    x = (cam_axis[0] - STANDOFF_BEHIND_MM, max(front[0], centre[0]) + STANDOFF_AHEAD_MM)
    places = grid_candidates(x, (0.0, STANDOFF_HIGHEST_MM), GRID_MM)
    around = STANDOFF_RADIUS_MM + CLEAR_MM + STANDOFFS_APART_MM
    found: list[Array] = []
    for target in wanted:
        taken = [disc("standoff", place, around, EVERYWHERE) for place in found]
        index = best_place(
            "standoffs", [*obstacles, *taken], places, (STANDOFF_RADIUS_MM, STANDOFF_RADIUS_MM), 0.0, inside,
            lambda p, target=target: np.linalg.norm(p - target, axis=1),  # type: ignore[misc]
            higher("carrying_link_mm"),
        )  # fmt: skip
        found.append(places[index])
    return tuple(found)


HOLE_MM = 5.0
"""Of a wire hole; judgement: three leads with their heat-shrink."""
RELIEF_UP_MM, RELIEF_APART_MM, RELIEF_SLOT_MM = 5.0, 5.2, (1.8, 3.4)
"""A cable tie above the hole holds the leads: its two slots, above the hole's middle and apart; judgement."""
HOLE_HALF_MM = (6.0, 8.0)
"""Half of the plate's room for a hole with its tie."""
SWITCH_DEPTH_MM = 5.0
"""Behind the switch for terminals and the bend of their wires; judgement."""
SWITCH_EDGE_MM = 1.2
"""Material around the switch; judgement: three lines."""
USB_EDGE_MM = 2.5
"""Material around the opening for the USB plug; judgement, as around the trays' tabs."""
GRID_MM = 2.0
AROUND_MM = 45.0
"""Places tried: this far around where something is wanted; judgement."""


@dataclass(frozen=True)
class Fittings:
    """Places (2,) of the plates' openings; None for what a robot does not have.

    `usb_mm` is the middle of the opening for the USB plug in the plate `usb_side`, `usb_size_mm` its size. The
    switch lies along x at the inside of the right plate. Leads of sensor and motor pass the plates at `left_mm` and
    `right_mm`.
    """

    switch: Component | None
    switch_mm: Array | None
    usb_mm: Array | None
    usb_size_mm: tuple[float, float]
    left_mm: Array
    right_mm: Array
    usb_side: Side | None


def fittings_of(
    obstacles: list[Obstacle], lateral: Lateral, electronics: Electronics, tray_mm: Array, seats: list[Array],
    seat_mm: float,
) -> Fittings:  # fmt: skip
    """Return the places of all openings, as near to the boards as the plates are free.

    `seats` are what the plates hold besides the obstacles, such as axles, which keep `seat_mm` around them.
    """
    low, high = lateral.inside
    kept = [disc("axle's seat", place, seat_mm, (low - 100.0, high + 100.0)) for place in seats]
    free = [*obstacles, *kept]
    middle, (usb, usb_size) = electronics.middle_mm(tray_mm), _usb(electronics, lateral.inside, tray_mm)
    if usb is not None:
        half = (usb_size[0] / 2.0 + USB_EDGE_MM, usb_size[1] / 2.0 + USB_EDGE_MM)
        plate = (low - 8.0, low + 0.1) if electronics.usb_side == "right" else (high - 0.1, high + 8.0)
        free.append(box_obstacle("opening for USB", usb, half, 0.0, plate))
    left = _near(middle, free, HOLE_HALF_MM, (high - 3.0, high + 8.0), "hole for the sensor's wires")
    right = _near(middle, free, HOLE_HALF_MM, (low - 8.0, low + 3.0), "hole for the motor's wires")
    free += [box_obstacle("hole for wires", right, HOLE_HALF_MM, 0.0, (low - 8.0, low + 8.0))]
    place, switch = None, electronics.components.get("switch")
    if switch is not None and switch.length_mm:
        half = switch_half_mm(switch)
        depth = (low - 8.0, low + (switch.height_mm or 0.0) + SWITCH_DEPTH_MM)
        place = _near(middle, free, half, depth, "switch")
    side = None if usb is None else electronics.usb_side
    return Fittings(switch if place is not None else None, place, usb, usb_size, left, right, side)


def switch_half_mm(switch: Component) -> tuple[float, float]:
    """Return half of the room that a switch needs in the plate."""
    return (switch.length_mm or 0.0) / 2.0 + SWITCH_EDGE_MM, (switch.width_mm or 0.0) / 2.0 + SWITCH_EDGE_MM


def _near(wanted: Array, obstacles: list[Obstacle], half: tuple[float, float], y: Interval, what: str) -> Array:
    """Return the free place nearest to the wanted one."""
    x, z = ((float(c) - AROUND_MM, float(c) + AROUND_MM) for c in wanted)
    places = np.round(grid_candidates(x, z, GRID_MM), 6)
    places = places[places[:, 1] > half[1]]  # above the pivots' line, where the plates are
    index = best_place(
        what, obstacles, places, (half[0] + CLEAR_MM / 2.0, half[1] + CLEAR_MM / 2.0), 0.0, y,
        lambda p: np.linalg.norm(p - wanted, axis=1), LONGER_BODY,
    )  # fmt: skip
    return np.asarray(places[index])


def _usb(electronics: Electronics, inside: Interval, tray_mm: Array) -> tuple[Array | None, tuple[float, float]]:
    """Return middle and size of the opening for the controller's USB plug."""
    board = electronics.controller
    if board.usb_mm is None:
        return None, (0.0, 0.0)
    seat = electronics.seats(inside)["controller"]
    up = electronics.upper_tray_mm + TRAY_MM + TAPE_MM + board.usb_height_mm
    return np.round(tray_mm + np.array([seat.x_mm, up]), 6), board.usb_mm


KNOB_MM = (8.0, 4.4)
"""Slot for the switch's knob, along its travel and across; judgement: a knob of 4 x 3 mm that goes 3 mm."""
SWITCH_SCREWS_MM, SWITCH_SLOT_MM = 7.2, (7.0, 7.8)
"""From the switch's middle to its screws, and to the ends of the plate's slots for them: ears of SS-12F15 have holes
14.4 mm apart, of others of its kind 14.8 or 15 mm."""


def fitting_pads(fittings: Fittings, more_mm: float) -> Iterator[Region]:
    """Yield where the plates need material, grown by a margin."""
    boxes = [(place, HOLE_HALF_MM) for place in (fittings.left_mm, fittings.right_mm)]
    if fittings.switch is not None and fittings.switch_mm is not None:
        boxes.append((fittings.switch_mm, switch_half_mm(fittings.switch)))
    if fittings.usb_mm is not None:
        width, height = fittings.usb_size_mm
        boxes.append((fittings.usb_mm, (width / 2.0 + USB_EDGE_MM, height / 2.0 + USB_EDGE_MM)))
    for place, half in boxes:
        yield rectangle([2.0 * (side + more_mm) for side in half], place, 1.0 + more_mm)


def fitting_openings(fittings: Fittings, holes: HoleSizes, side: Literal["left", "right"]) -> Iterator[Region]:
    """Yield what a plate lacks: holes for leads with the slots of their tie, USB plug; in the right one the switch."""
    x, z = wire_hole_mm(fittings.left_mm if side == "left" else fittings.right_mm)
    yield hole(HOLE_MM, (x, z))
    for sign in (-1.0, 1.0):
        yield rectangle(RELIEF_SLOT_MM, (x + sign * RELIEF_APART_MM / 2.0, z + RELIEF_UP_MM), 0.5)
    if fittings.switch_mm is not None and side == "right":
        x, z = fittings.switch_mm
        yield rectangle(KNOB_MM, (x, z), 1.0)
        for sign in (-1.0, 1.0):
            inner, outer = ((x + sign * end, z) for end in SWITCH_SLOT_MM)
            yield stadium(inner, outer, holes.fits.m2_clearance_mm)
    if fittings.usb_mm is not None and side == fittings.usb_side:
        yield rectangle(fittings.usb_size_mm, fittings.usb_mm, 1.0)


def wire_hole_mm(place_mm: Array) -> tuple[float, float]:
    """Return the middle (x, z) of the hole for leads in the plate's room for it and its tie."""
    return float(place_mm[0]), float(place_mm[1] - HOLE_HALF_MM[1] + HOLE_MM)
