"""Wheel, mount and what is bought for them, and what the plates have for the mount (mm).

The mount hangs between the plates, a tab through each: it prints upside down, its base on the bed, so that wheel and
floor bend the base along its layers. The motor lies below the base between walls, and a cable tie holds it.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from jumpcad.dimensions import PAD_WALL_MM, TIE_SLOT_MM
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement
from jumpcad.parts.purchased import TIE, TIE_G, BoughtPart
from jumpcad.robot.electronics.leads import lead_lengths
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import LEAN_DEG, steers
from jumpcad.robot.steering.place import (
    GROOVE_PLAY_MM,
    LEADS_MM,
    PLAY_MM,
    SLOT_EDGE_MM,
    TAB_MM,
    TIE_MM,
    TREAD_MM,
    WALL_MM,
    Steering,
)
from jumpcad.robot.train.drawing import ribbed_d_bore
from jumpcad.solids.outline import Region, disc, hull, rectangle, ring, union
from jumpcad.solids.slab import SlabLike
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array, chained, in_metres, pose_at
from jumpcad.workshop import Workshop

WHEEL_PARTS = ("steering_wheel", "steering_ring", "steering_shaft")
"""What turns with the wheel."""
HUB_WALL_MM = 2.0
"""Of the wheel's hub round the shaft; judgement: four lines of a 0.4 mm nozzle."""
WEB_MM = 1.6
"""Thickness of the wheel between hub and groove; judgement: eight layers of 0.2 mm."""
HELD = 0.7
"""Height of the walls beside the motor over its own; judgement."""
ROOT = 0.35
"""How far a plate's tail reaches from the leg's axle to the cam's; judgement: it is as wide there as at its tabs."""
NOTCH_MM = 0.5
"""Play of the gearhead's boss in the wall behind it, which keeps the motor from sliding out; judgement."""
BACKWARDS = np.array([[0.0, 0, -1], [0, 1, 0], [1, 0, 0]])
"""Rotation of what is drawn along the axle: its z points backwards, its x up."""
OVER = np.diag([1.0, -1.0, -1.0])
"""Rotation of what prints upside down."""


def steering_parts(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    place, holes = layout.of(Steering), HoleSizes.of(workshop, layout.hub_bearing)
    if place is None:
        return
    pose = _along(place, place.half_width_mm)
    yield Drawing("steering_wheel", "gears", holes.chamfered(_wheel(place, holes)), (Placement(BODY, pose),))
    pose = chained(place.T_body_axle, pose_at(OVER, (0.0, 0.0, place.base_z_mm[1])))
    yield Drawing("steering_mount", "body", _mount(place, layout, holes), (Placement(BODY, pose),))


def _wheel(place: Steering, holes: HoleSizes) -> Stack:
    """Return the wheel, its front side on the bed: two flanges, the groove's floor between, and a hub on the shaft."""
    motor, width = place.motor, 2.0 * place.half_width_mm
    bore = ribbed_d_bore(motor.shaft_mm, motor.shaft_flat_mm, holes)
    flange = disc(place.groove_mm + 2.0 * TREAD_MM) - bore
    hub = motor.shaft_mm + 2.0 * (holes.fits.press_mm + HUB_WALL_MM)
    low = (width - place.ring.section_mm - GROOVE_PLAY_MM) / 2.0
    web = ring(place.groove_mm - 2.0 * HUB_WALL_MM, hub) if place.groove_mm > hub + 4.0 * HUB_WALL_MM else union([])
    slabs = [
        (0.0, low, flange),
        (low, WEB_MM, disc(place.groove_mm) - bore),
        (WEB_MM, width - low, disc(place.groove_mm) - bore - web),
        (width - low, width, flange - web),
    ]
    if (behind := place.shaft_mm - place.half_width_mm) > 0.0:
        slabs.append((width, width + behind, disc(hub) - bore))
    return Stack.of(slabs)


def _mount(place: Steering, layout: Layout, holes: HoleSizes) -> Stack:
    """Return the mount: its frame is the axle's, upside down, and z = 0 its base's upper face."""
    (begin, end), middle = place.cradle_x_mm, float(place.T_body_axle[1, 3])
    across, up = place.half_motor_mm
    x, beside = (begin + end) / 2.0, place.half_mount_mm
    slots = [rectangle(TIE_SLOT_MM[::-1], (x, side * (beside + TIE_SLOT_MM[0] / 2.0))) for side in (-1.0, 1.0)]
    (low, high), (right, left) = layout.lateral.inside, layout.lateral.outside
    size = TAB_MM + 2.0 * SLOT_EDGE_MM, high - low - 2.0 * holes.fits.sliding_mm
    bridge = rectangle(size, (x, middle - (low + high) / 2.0), 1.0)
    tabs = rectangle((TAB_MM, left - right), (x, middle - (left + right) / 2.0))
    around = rectangle((end - begin, 2.0 * beside), (x, 0.0))
    base = union([bridge, tabs, around]) - union(slots)
    cavity = rectangle((end - begin - 2.0 * WALL_MM, 2.0 * (across + PLAY_MM)), (x, 0.0))
    boss = rectangle((2.0 * WALL_MM, place.motor.boss_mm + 2.0 * NOTCH_MM), (begin, 0.0))
    leads = rectangle((3.0 * WALL_MM, 2.0 * across + WALL_MM), (end, 1.5 * WALL_MM))  # and to the right
    walls = around - union([cavity, boss, leads])
    return Stack.of([(0.0, place.base_mm, base), (place.base_mm, place.base_mm + 2.0 * HELD * up, walls)])


def tail(layout: Layout) -> Region:
    """Return what the mount adds to the outline of both body plates: from leg's and cam's axle down to its tabs."""
    if (place := layout.of(Steering)) is None:
        return union([])
    pads = [layout.hub_mm, layout.hub_mm + ROOT * (layout.cam_axis_mm - layout.hub_mm)]
    return hull([*(disc(layout.axle_mm + 2.0 * PAD_WALL_MM, pad) for pad in pads), _slot(place, 2.0 * SLOT_EDGE_MM)])


def tail_slot(layout: Layout, play_mm: float) -> Region:
    """Return a plate's slot for the mount's tab."""
    place = layout.of(Steering)
    return union([]) if place is None else _slot(place, play_mm)


def _slot(place: Steering, more_mm: float) -> Region:
    flat = rectangle((TAB_MM + more_mm, place.base_mm + more_mm), (0.0, 0.0), more_mm / 4.0)
    return flat.rotate(place.turn_deg).translate(tuple(place.tab_mm))


def steering_hardware(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield motor, shaft, ring and tie."""
    place = layout.of(Steering)
    if place is None:
        return
    motor, rubber, (across, up) = place.motor, place.ring, place.half_motor_mm
    article = f"gear motor {motor.name}" + (f" ({motor.article})" if motor.article else "")
    shaft_g = workshop.catalogue.rod_mass_g(motor.shaft_mm, motor.shaft_length_mm)
    front, length = _along(place, place.front_mm), motor.body_length_mm
    box = rectangle((2.0 * up, 2.0 * across))
    yield _bought("steering_motor", article, [(-length, 0.0, box)], front, motor.mass_g - shaft_g)
    flat = rectangle((motor.shaft_mm, 2.0 * motor.shaft_mm), (motor.shaft_flat_mm, 0.0))
    shaft = [(0.0, motor.shaft_length_mm, disc(motor.shaft_mm) - flat)]
    yield _bought("steering_shaft", article, shaft, front, shaft_g, units=0)
    wide, narrow = rubber.section_mm / 2.0, rubber.section_mm / 4.0
    outer, inner = 2.0 * place.radius_mm, place.groove_mm
    less = ring(outer - 2.0 * (wide - 3.0**0.5 * narrow) - 0.6 * narrow, inner + 0.6 * narrow)
    slabs = [(-wide, -narrow, less), (-narrow, narrow, ring(outer, inner)), (narrow, wide, less)]
    yield _bought("steering_ring", rubber.description, slabs, _along(place, 0.0), rubber.mass_g)
    yield _tie(place, sum(place.cradle_x_mm) / 2.0)


def steering_words(robot: Robot) -> dict[str, Any] | None:
    """Return what the guide says of the wheel: articles and sizes (mm); None without one."""
    place = robot.layout.of(Steering)
    if place is None:
        return None
    does, toes_mm, cuts = steers(robot), 2.0 * robot.layout.toe_half_width_mm, lead_lengths(robot.layout, robot.wiring)
    return {
        "place": place, "motor": place.motor, "does": does, "ahead_mm": LEADS_MM,
        "wire_mm": max(mm for *_, end, _, mm in cuts if end.part == "steering motor"),
        "tread_mm": place.ring.section_mm - TREAD_MM,
        "high_mm": [toes_mm * float(np.radians(lean)) for lean in (does.lean_deg, LEAN_DEG)],
    }  # fmt: skip


def _tie(place: Steering, x_mm: float) -> BoughtPart:
    """Return the tie round mount and motor, through the slots beside the walls."""
    (across, up), (_, top) = place.half_motor_mm, place.base_z_mm
    slab = rectangle((2.5, 2.0 * across), (x_mm, 0.0))
    pose = chained(place.T_body_axle, pose_at(np.eye(3), (0.0, 0.0, -up - TIE_MM)))
    part = _bought("steering_tie", TIE, [(0.0, TIE_MM, slab)], pose, TIE_G / 2.0)
    y, low, high = place.half_mount_mm + TIE_MM / 2.0, -up - TIE_MM / 2.0, top + TIE_MM / 2.0
    loop = np.array(
        [(x_mm, 0, low), (x_mm, y, low), (x_mm, y, high), (x_mm, -y, high), (x_mm, -y, low), (x_mm, 0, low)]
    )
    turned = np.einsum("ij,nj->ni", place.T_body_axle[:3, :3], loop) + place.T_body_axle[:3, 3]
    return part.seen_as(DrawnWire(turned, TIE_MM))


def _along(place: Steering, x_mm: float) -> Array:
    """Return the pose (4, 4) in the body's frame of what is drawn along the axle from a place on it, backwards."""
    return chained(place.T_body_axle, pose_at(BACKWARDS, (x_mm, 0.0, 0.0)))


def _bought(
    name: str, article: str, slabs: Iterable[SlabLike], pose: Array, mass_g: float, units: int = 1
) -> BoughtPart:
    shape = Stack.of(slabs)
    mass = shape.mass_properties(1.0).scaled_to(mass_g / 1000.0).placed(in_metres(pose))
    return BoughtPart(name, article, BODY, shape, pose, mass, units)
