"""The switch that feels the cam gear's track: its printed mount, the plate's opening, what is bought (mm, g)."""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose, lower
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.parts.purchased import BoughtPart, bought, placed_screw
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Check, Thing
from jumpcad.robot.sensor.limits import BASIS, sensor_findings
from jumpcad.robot.sensor.place import EAR_RADIUS_MM, MOUNT_PLAY_MM, MOUNT_WALL_MM, OPENING_MM, SensorPlace
from jumpcad.solids.outline import Region, disc, hole, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array, pose_about_z
from jumpcad.workshop import Workshop

CEILING_MM = 1.2
"""Thickness of the mount over the switch's base: six layers."""
LEDGE_MM = 0.9
"""Of the base that lies against the ceiling, around the terminals."""
EAR_MM = 2.0
"""Least height of the mount's ears; judgement."""
THREAD_MIN_MM = 1.6
"""Least length of a mount's screw in the plate: four threads of M2."""
EDGE_MM = 2.0
"""Material of the plate around the switch's opening and its screws; judgement."""
SCREW_MM = next(length for length in (4.0, 5.0, 6.0) if length >= EAR_MM + THREAD_MIN_MM)
"""Of the mount's screws: the shortest M2 (ISO 14580) that holds in the plate."""


def sensor_mount(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    """Yield the mount, if there is a sensor."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    sensor = layout.sensor
    if sensor is None:
        return
    _require_base(layout, holes)
    length, width = sensor.needs.case_mm
    around = 2.0 * (MOUNT_PLAY_MM + MOUNT_WALL_MM)
    cavity = rectangle((length + 2.0 * MOUNT_PLAY_MM, width + 2.0 * MOUNT_PLAY_MM))
    body = rectangle((length + around, width + around), corner_radius_mm=0.8)
    window = rectangle((length - 2.0 * LEDGE_MM, width - 2.0 * LEDGE_MM))
    ears = union(disc(2.0 * EAR_RADIUS_MM, (side * sensor.needs.ear_mm, 0.0)) for side in (-1.0, 1.0))
    neck = rectangle((2.0 * sensor.needs.ear_mm, 2.0 * EAR_RADIUS_MM))
    screws = union(hole(holes.fits.m2_clearance_mm, (side * sensor.needs.ear_mm, 0.0)) for side in (-1.0, 1.0))
    full, base, top = union([body, ears, neck]) - screws, sensor.base_mm, sensor.base_mm + CEILING_MM
    ear = min(ear_height_mm(layout), top)
    slabs = [(0.0, min(ear, base), full - cavity), (base, top, body - window)]
    slabs += [(base, ear, full - window)] if ear > base else [(ear, base, body - cavity)]
    outside = layout.lateral.left_plate[1]
    yield Drawing("sensor_mount", "body", holes.chamfered(Stack.of(slabs)), (Placement(BODY, _pose(sensor, outside)),))


def ear_height_mm(layout: Layout) -> float:
    """Return the height of the ears with which the shortest screw that holds ends inside the plate."""
    plate = layout.lateral.left_plate[1] - layout.lateral.left_plate[0]
    return max(EAR_MM, SCREW_MM - plate + 0.2)


def screw_places(sensor: SensorPlace) -> list[Array]:
    """Return the mount's screws (2,) in the plate."""
    along = np.array([math.cos(sensor.turn_rad), math.sin(sensor.turn_rad)])
    return [np.round(sensor.place_mm + side * sensor.needs.ear_mm * along, 6) for side in (-1.0, 1.0)]


def plate_opening(sensor: SensorPlace, holes: HoleSizes) -> Region:
    """Return what the left plate lacks for the sensor: an opening for its case, and the mount's screws."""
    length, width = sensor.needs.case_mm
    case = rectangle((length + 2.0 * OPENING_MM, width + 2.0 * OPENING_MM), corner_radius_mm=0.8)
    return union([_turned(sensor, case), *(hole(holes.fits.m2_tap_mm, place) for place in screw_places(sensor))])


def plate_pad(sensor: SensorPlace, more_mm: float = 0.0) -> Region:
    """Return where the left plate needs material for the sensor, grown by a margin."""
    half_length_mm = sensor.needs.half_mm[0] + more_mm
    half_width_mm = sensor.needs.case_mm[1] / 2.0 + OPENING_MM + EDGE_MM + more_mm  # farther than the mount
    return _turned(sensor, rectangle((2.0 * half_length_mm, 2.0 * half_width_mm), corner_radius_mm=1.0 + more_mm))


def _require_base(layout: Layout, holes: HoleSizes) -> None:
    """Raise if the switch's base is too near the plate for the mount's rim around it."""
    assert layout.sensor is not None
    base, plate = layout.sensor.base_mm, layout.lateral.left_plate[1] - layout.lateral.left_plate[0]
    least = max(holes.fits.first_layer_chamfer_mm, holes.process.first_layer_mm)
    if base < least:
        raise CannotBuildError(
            f"no room for the sensor's mount: the base of its switch is {base:.2f} mm outside the left plate, which is "
            f"{plate:.1f} mm thick, {least:.2f} mm are needed",
            "sensor_mount", base - least,
            ways=(*lower("body.plate_mm"), "a stiffer material of the plates", *choose("a taller", "bought.sensor")),
        )  # fmt: skip


def _pose(sensor: SensorPlace, y_mm: float) -> Array:
    """Return the pose of the mount's printing frame: its x along the switch's long side."""
    x, z = sensor.place_mm
    # seen from the left the frame's x axis points backwards
    return lying_on_right(y_mm, x, z) @ pose_about_z(math.pi - sensor.turn_rad)


def _turned(sensor: SensorPlace, region: Region) -> Region:
    return region.rotate(math.degrees(sensor.turn_rad)).translate(tuple(sensor.place_mm))


def sensor(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the switch over the cam gear's track and the screws of its mount."""
    catalogue = workshop.catalogue
    felt, outside = layout.sensor, layout.lateral.left_plate[1]
    if felt is None:
        return
    part, at = felt.needs.part, (felt.place_mm[0], outside + felt.base_mm, felt.place_mm[1])
    height, case, travel = part.height_mm or 0.0, rectangle(felt.needs.case_mm), felt.needs.travel
    # from its base inwards, its plunger drawn at the end of its travel
    slabs = [(-height, 0.0, case), (-travel.total_mm, -height, disc(travel.pin_mm))]
    yield bought("sensor", part.description, BODY, part.mass_g, slabs, at, felt.turn_rad)
    head = outside + ear_height_mm(layout)
    for number, place in enumerate(screw_places(felt), start=1):
        shank = (head - SCREW_MM, head)
        yield placed_screw(f"sensor_screw_{number}", BODY, place, shank, 1.0, catalogue.screws["M2"], catalogue)


SENSOR = Thing(sensor_mount, sensor, (Check(sensor_findings, BASIS),))
