"""Gears and cam: the drive's profiles made solid and turned so that teeth are in gaps (mm).

The cam stands as it does at cam angle 0, springs at rest, and the cam gear as it pushes the cam. The cam's jaws stand
on a boss and reach into pockets of the cam gear, longer than the jaws by the dog's play; both run on the cam's dead
axle. The boss ends beside the gear and holds it in its plane.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from jumpcad.dimensions import GAP_MM
from jumpcad.drive.dog import Dog
from jumpcad.drive.gears import Gear
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_left, lying_on_right, lying_stack
from jumpcad.robot.layout import Layout
from jumpcad.robot.sensor.place import GEAR_PLAY_MM, TRACK_WALL_MM, SensorPlace
from jumpcad.robot.sizing import dog_inside_mm
from jumpcad.solids.outline import Region, d_bore, disc, hole, polygon, rectangle, ring, rounded, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import pose_about_z
from jumpcad.workshop import Workshop

WEB_RIM_MM = 3.0
"""Material kept inside the root circle and around the hub of a gear with web holes."""
WEB_HOLES = 6
WEB_CORNER_MM = 1.0
"""Radius of a web hole's corners: no hole is narrower than twice this."""
SECTOR_POINTS = 16
"""On the rim of a sector: twice as far out as what it cuts, so that few are enough."""
RIB_MM, RIB_ROOT_MM = 0.6, 0.2
"""Width of a crush rib, and how far it reaches into the gear; judgement: little more than a printed line."""


def cam(layout: Layout, workshop: Workshop) -> Drawing:
    """Return the cam with its boss and the dog's jaws."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    centre = layout.cam_axis_mm
    profile = polygon(layout.drive.cam.profile_mm).translate(centre)
    bore = hole(holes.running(layout.axle_mm), centre)
    (y0, y1), (gear_y0, gear_y1), dog = layout.lateral.cam, layout.lateral.gears[0], layout.drive.dog
    shoulder = gear_y0 - GAP_MM / 2.0
    jaws = ring(dog.outer_mm, dog_inside_mm(holes.fits, layout.axle_mm)) ^ sectors(dog.cam_jaws_rad, dog.outer_mm)
    slabs = [
        (y0, y1, profile - bore),
        (y1, shoulder, disc(dog.outer_mm, centre) - bore),
        (shoulder, gear_y1, jaws.translate(centre)),
    ]
    stack, pose = lying_stack(slabs, "right")
    return Drawing("cam", "gears", holes.chamfered(stack), (Placement(BODY, pose),))


def gears(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return motor pinion, compound idler where there is one, and cam gear.

    Each is drawn with a tooth on +x and turned where it is placed, so that equal gears are one shape in every robot.
    The cam gear stands as it is and prints with its left face up, in which the sensor's track is.
    """
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    stages, motor = layout.drive.train.stages, layout.drive.train.motor
    cam_y, motor_y = layout.lateral.gears[0], layout.lateral.gears[-1]
    turns = gear_turns(layout)
    hub = GAP_MM - GEAR_PLAY_MM if layout.idler_mm is None else 0.0  # none where a spacer lies between gear and plate
    shape = (stages[-1].wheel, layout.drive.dog, layout.axle_mm, holes, hub)
    cam_gear = _cam_gear(*shape, None) if layout.sensor is None else _grooved(*shape, _track(layout, layout.sensor))
    pinion = _motor_pinion(stages[0].pinion, motor.shaft_mm, motor.shaft_flat_mm, holes)
    made = [
        Drawing("cam_gear", "gears", cam_gear, (Placement(BODY, lying_on_right(cam_y[0], *layout.cam_axis_mm)),)),
        Drawing("motor_pinion", "gears", pinion, (_placed(motor_y[1], layout.motor_mm, turns["motor_pinion"]),)),
    ]
    if layout.idler_mm is not None:
        idler = _idler(stages[0].wheel, stages[-1].pinion, motor_y[0] - cam_y[1], layout.axle_mm, holes)
        made.append(Drawing("idler", "gears", idler, (_placed(motor_y[1], layout.idler_mm, turns["idler"]),)))
    return made


def gear_turns(layout: Layout) -> dict[str, float]:
    """Return the turns (rad, counter-clockwise in x-z) of cam gear, motor pinion and idler, springs at rest."""
    stages = layout.drive.train.stages
    if layout.idler_mm is None:
        pinion = mesh_turn(stages[0].wheel, stages[0].pinion, layout.cam_axis_mm, layout.motor_mm, 0.0)
        return {"cam_gear": 0.0, "motor_pinion": pinion}
    idler = mesh_turn(stages[-1].wheel, stages[-1].pinion, layout.cam_axis_mm, layout.idler_mm, 0.0)
    pinion = mesh_turn(stages[0].wheel, stages[0].pinion, layout.idler_mm, layout.motor_mm, idler)
    return {"cam_gear": 0.0, "motor_pinion": pinion, "idler": idler}


def mesh_turn(wheel: Gear, pinion: Gear, wheel_mm: np.ndarray, pinion_mm: np.ndarray, wheel_turn_rad: float) -> float:
    """Return the turn (counter-clockwise in x-z) of a pinion whose teeth sit in the middle of a wheel's gaps.

    Both profiles have a tooth centred on +x. The wheel is turned as given; the pinion gets a gap where a tooth of the
    wheel points at it.
    """
    line = math.atan2(pinion_mm[1] - wheel_mm[1], pinion_mm[0] - wheel_mm[0])
    offset = (line - wheel_turn_rad) * wheel.teeth / (2.0 * math.pi)
    # distance of the wheel's nearest tooth from the line of centres, as a share of a pitch
    share = offset - round(offset)
    pinion_pitch = 2.0 * math.pi / pinion.teeth
    return line + math.pi + pinion_pitch * (0.5 + share)


def _placed(top_mm: float, centre_mm: np.ndarray, turn_rad: float) -> Placement:
    """Return the place of a gear that lies on its left face, turned about its axis."""
    return Placement(BODY, lying_on_left(top_mm, *centre_mm) @ pose_about_z(turn_rad))


@lru_cache(maxsize=64)
def _cam_gear(
    gear: Gear, dog: Dog, axle_mm: float, holes: HoleSizes, hub_mm: float, track_mm: tuple[float, float] | None
) -> Stack:
    """Return the cam gear: a hub on the axle, and around it pockets in which the cam's jaws slide.

    The hub stands out by `hub_mm` to the left, up to the plate. Web holes leave the sensor's track with a wall on
    either side. As it prints, x points to the back.
    """
    play = 2.0 * holes.fits.sliding_mm
    outer, inner = dog.outer_mm + play, dog_inside_mm(holes.fits, axle_mm) - play
    around = hole(outer) - disc(inner)
    bore, width = hole(holes.running(axle_mm)), gear.face_width_mm
    inside, outside = track_mm or (0.0, 0.0)
    solid = ring(2.0 * (outside + TRACK_WALL_MM), 2.0 * (inside - TRACK_WALL_MM)) if track_mm else None
    region = _webbed(gear, bore, outer / 2.0, solid) - (around ^ sectors(dog.pockets_rad, outer))
    slabs = [(0.0, width, region.mirror((1.0, 0.0)))]
    slabs += [(width, width + hub_mm, disc(inner) - bore)] if hub_mm > 0.0 else []
    return holes.chamfered(Stack.of(slabs))


@dataclass(frozen=True)
class Track:
    """The sensor's groove in the cam gear, and the steps (bottom, top, begin, end) of the land in it, as deep as it."""

    radii_mm: tuple[float, float]
    steps: tuple[tuple[float, float, float, float], ...]


def _track(layout: Layout, sensor: SensorPlace) -> Track:
    """Return the sensor's groove and, in it, the land, whose ramps rise at 45° a layer a step."""
    top, lift = layout.lateral.gears[0][1] - layout.lateral.gears[0][0], layout.drive.cam.law.lift_rad
    low, step = top - sensor.depth_mm, sensor.needs.layer_mm
    steps = tuple(
        (low + n * step, low + (n + 1) * step, *sensor.land_rad((n + 0.5) * step, lift))
        for n in range(round(sensor.depth_mm / step))
    )
    return Track((sensor.radius_mm - sensor.half_width_mm, sensor.radius_mm + sensor.half_width_mm), steps)


@lru_cache(maxsize=8)
def _grooved(gear: Gear, dog: Dog, axle_mm: float, holes: HoleSizes, hub_mm: float, track: Track) -> Stack:
    """Return the cam gear with the sensor's track: often that of the round of growth before."""
    inside, outside = track.radii_mm
    groove = ring(2.0 * outside, 2.0 * inside)

    def beside_land(begin_rad: float, end_rad: float) -> Region:
        return groove - (groove ^ sectors([(begin_rad, end_rad)], 2.0 * track.radii_mm[1])).mirror((1.0, 0.0))

    steps = [(low, high, beside_land(begin, end)) for low, high, begin, end in track.steps]
    return _cam_gear(gear, dog, axle_mm, holes, hub_mm, track.radii_mm).pocketed(steps)


def sectors(ends_rad: Iterable[tuple[float, float]], diameter_mm: float) -> Region:
    """Return sectors about the origin, counter-clockwise from one angle to the other, that hold a circle's."""
    made = []
    for begin, end in ends_rad:
        angles = np.linspace(begin, end, SECTOR_POINTS)
        rim = diameter_mm * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        made.append(polygon(np.vstack([np.zeros((1, 2)), rim])))
    return union(made)


@lru_cache(maxsize=64)
def _motor_pinion(gear: Gear, shaft_mm: float, flat_mm: float, holes: HoleSizes) -> Stack:
    """Return a pinion whose bore has crush ribs: the shaft cuts into them, so that the pinion has no play."""
    region = _webbed(gear, ribbed_d_bore(shaft_mm, flat_mm, holes), 0.0)
    return holes.chamfered(Stack.of([(0.0, gear.face_width_mm, region)]))


def ribbed_d_bore(shaft_mm: float, flat_mm: float, holes: HoleSizes, rib_mm: float | None = None) -> Region:
    """Return the hole for a D-shaft with a press fit around it and five crush ribs, `rib_mm` or `fits.rib_mm` into it.

    Two ribs press on the flat, which faces +x and transmits the torque, and three on the round side.
    """
    press, rib = holes.fits.press_mm, holes.fits.rib_mm if rib_mm is None else rib_mm
    bore = d_bore(shaft_mm + 2.0 * press, flat_mm + 2.0 * press)
    depth = press + rib + RIB_ROOT_MM
    edge = flat_mm - shaft_mm / 2.0 - rib + depth / 2.0
    ribs = [rectangle((depth, RIB_MM), (edge, side * shaft_mm / 4.0)) for side in (-1.0, 1.0)]
    middle = shaft_mm / 2.0 - rib + depth / 2.0
    ribs += [rectangle((depth, RIB_MM), (middle, 0.0)).rotate(angle) for angle in (90.0, 180.0, 270.0)]
    return bore - union(ribs)


@lru_cache(maxsize=64)
def _idler(wheel: Gear, pinion: Gear, gap_mm: float, axle_mm: float, holes: HoleSizes) -> Stack:
    """Return an idler on its wheel's left face; the small teeth are on top of it, so that no support is needed."""
    bore = hole(holes.running(axle_mm))
    low = wheel.face_width_mm
    slabs = [
        (0.0, low, _webbed(wheel, bore, pinion.tip_radius_mm)),
        (low, low + gap_mm + pinion.face_width_mm, polygon(pinion.profile_mm) - bore),
    ]
    return holes.chamfered(Stack.of(slabs))


def _webbed(gear: Gear, bore: Region, hub_radius_mm: float, solid: Region | None = None) -> Region:
    """Return a gear with its bore, and web holes where there is room between hub and rim, outside what stays solid."""
    low_x, _, high_x, _ = bore.bounds()
    hub = max(hub_radius_mm, (high_x - low_x) / 2.0) + WEB_RIM_MM
    rim = gear.root_radius_mm - WEB_RIM_MM
    region = polygon(gear.profile_mm) - bore
    if rim - hub < 4.0:
        return region
    spokes = union(
        rectangle((2.0 * rim, WEB_RIM_MM)).rotate(180.0 * index / (WEB_HOLES / 2)) for index in range(WEB_HOLES // 2)
    )
    kept = union([disc(2.0 * hub), spokes, *([] if solid is None else [solid])])
    return region - rounded(disc(2.0 * rim) - kept, WEB_CORNER_MM)
