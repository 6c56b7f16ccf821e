"""Bought axles and pins, each with its retention, and the printed tubes on the axles (mm, g).

Axles and the springs' pin cross both plates. By the workshop's `bought.retention` they end in blind bores of the plates
(`plates`), carry a clip in a groove at either end (`clips`), or are screws with lock nuts (`nuts`). The pins of foot
and leg are clevis pins with split pins, or rods with clips.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from jumpcad.catalogue import Catalogue, Clip, Rod
from jumpcad.dimensions import AXLE_END_PLAY_MM, GAP_MM, SPACER_RADIUS_MM
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.mechanism.model import BODY, FOOT, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.robot.axles.steel import BASIS, steel_findings
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Check, Thing
from jumpcad.robot.sensor.place import GEAR_PLAY_MM
from jumpcad.solids.outline import Region, disc, hexagon, hole, rectangle, ring, union
from jumpcad.solids.slab import Interval
from jumpcad.solids.stack import Stack
from jumpcad.strength.axles import clipped_pins
from jumpcad.transforms import Array
from jumpcad.workshop import BoughtParts, Workshop

COTTER_SPAN_MM = 5.0
"""Across a split pin's bent ends; judgement: cut and bent around a pin of 3 mm, no wider than the pin's head."""
COTTER_ROOM_MM = 0.1
"""Around a split pin in its hole, for the picture: both are drawn square, a split pin with its ends bent."""
CLIP_OPENING = 0.8
"""Width of a clip's opening over the groove's diameter; judgement, for the picture."""


@dataclass(frozen=True)
class Place:
    """Where an axle or pin is: its body, its axis (2,) in x-z, and the outer faces that it joins, an interval of y.

    `turn_rad` is the direction of its split pin in x-z: 0 along x.
    """

    name: str
    body: str
    centre: Array
    faces: Interval
    turn_rad: float = 0.0


def axles_and_pins(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the axles across the plates and the springs' pin, with their clips or nuts, then the pins with theirs."""
    outside, catalogue, chosen = layout.lateral.outside, workshop.catalogue, workshop.bought
    places = {f"{name}_axle": place for name, place in layout.axles.items()} | {"spring_pin": layout.spring_pin_mm}
    for name, centre in places.items():
        place = Place(name, BODY, centre, outside)
        if layout.retention == "clips":
            yield from _clipped(place, layout.axle_mm, catalogue, catalogue.rods[chosen.axle])
        elif layout.retention == "nuts":
            yield from _screwed(place, catalogue)
        else:
            less = layout.floor_mm + AXLE_END_PLAY_MM
            yield _rod(place, (outside[0] + less, outside[1] - less), layout.axle_mm, catalogue, chosen)
    yield from _pins(layout, workshop)


def _pins(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the pins at the foot's two ends and of the springs' inner arms, with their retention."""
    foot, lug = layout.ankle_face_mm, layout.lateral.lug_left[1]
    arm = layout.lateral.leg[1] + GAP_MM + 2.0 * layout.drive.spring.wire_mm
    places = (
        Place("ankle_pin", FOOT, np.zeros(2), (-foot, foot)),
        Place("front_eye_pin", FOOT, np.array([layout.eye_x_mm, 0.0]), (-lug, lug)),
        Place("leg_spring_pin", MAIN_LEG, np.array([layout.leg_pin_mm, 0.0]), (-arm, arm), np.pi / 2.0),  # across it
    )
    catalogue = workshop.catalogue
    for place in places:
        if rod := clipped_pins(catalogue, workshop.bought):
            yield from _clipped(place, layout.axle_mm, catalogue, rod)
        else:
            yield from _clevis(place, layout.axle_mm, catalogue)


def require_retention(catalogue: Catalogue, chosen: BoughtParts) -> None:
    """Reject axles for which the workshop's retention is not possible."""
    rod, how, size = catalogue.rods[chosen.axle], chosen.retention, chosen.axle_mm
    if how == "nuts" and size != (thread := catalogue.screws["M3 long"].diameter_mm):
        raise JumpcadError(
            f'bought.axle_mm = {size:g}: bought.retention = "nuts" has screws of {thread:g} mm as axles: make it '
            f'{thread:g}, or choose "plates" or "clips"'
        )
    if how == "clips":
        catalogue.clip_for(size)
        if not rod.grooves:
            raise JumpcadError(
                f'bought.retention = "clips": no groove can be cut into {rod.name} at home: choose a bought.axle of '
                f'{", ".join(other.name for other in catalogue.rods.values() if other.grooves)}, or "plates"'
            )
        return
    if clipped_pins(catalogue, chosen):
        catalogue.clip_for(size)


def _rod(place: Place, y: Interval, diameter_mm: float, catalogue: Catalogue, chosen: BoughtParts) -> BoughtPart:
    rod, length = catalogue.rods[chosen.axle], y[1] - y[0]
    bore = rod.bore_share * diameter_mm
    section = ring(diameter_mm, bore) if bore else disc(diameter_mm)
    mass = rod.density_g_cm3 * np.pi / 4.0 * (diameter_mm**2 - bore**2) * length / 1000.0
    article = f"{rod.description} {diameter_mm:g} x {length:.1f} mm"
    return bought(place.name, article, place.body, mass, [(0.0, length, section)], _at(place, y[0]))


def _clipped(place: Place, diameter_mm: float, catalogue: Catalogue, rod: Rod) -> Iterator[BoughtPart]:
    """Yield a rod with a groove and a clip at either end, each a little outside of the faces."""
    clip = catalogue.clip_for(diameter_mm)
    low, high = place.faces
    reach = AXLE_END_PLAY_MM + clip.groove_width_mm + clip.end_mm
    length = high - low + 2.0 * reach
    shaft, groove = disc(diameter_mm), disc(clip.groove_mm)
    inner = clip.end_mm + clip.groove_width_mm
    slabs = [
        (0.0, clip.end_mm, shaft),
        (clip.end_mm, inner, groove),
        (inner, length - inner, shaft),
        (length - inner, length - clip.end_mm, groove),
        (length - clip.end_mm, length, shaft),
    ]
    mass = rod.density_g_cm3 * sum((y1 - y0) * region.area() for y0, y1, region in slabs) / 1000.0
    article = (
        f"{rod.description} {diameter_mm:g} x {length:.1f} mm, grooves {clip.groove_mm:g} x "
        f"{clip.groove_width_mm:g} mm, {clip.end_mm:g} mm from either end"
    )
    yield bought(place.name, article, place.body, mass, slabs, _at(place, low - reach))
    region = _clip(clip)
    for number, y in enumerate((low - AXLE_END_PLAY_MM - clip.thickness_mm, high + AXLE_END_PLAY_MM), start=1):
        slab = [(0.0, clip.thickness_mm, region)]
        name = f"{place.name}_clip_{number}"
        yield bought(name, f"E-clip {clip.name} DIN 6799", place.body, clip.mass_g, slab, _at(place, y))


def _screwed(place: Place, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield a screw whose head is at the left plate, so that its smooth shank is where hub, cam and gears turn."""
    screw, nut = catalogue.screws["M3 long"], catalogue.nuts["M3 nyloc"]
    low, high = place.faces
    needed = high - low + 2.0 * AXLE_END_PLAY_MM + nut.height_mm
    length = screw.length_for(needed, "bring the plates closer (a shorter motor, a narrower battery)")
    top = length + screw.cylinder_head_height_mm
    slabs = [(0.0, length, disc(screw.diameter_mm)), (length, top, disc(screw.cylinder_head_mm))]
    head = 0.7 * screw.cylinder_head_height_mm  # less its socket
    mass = catalogue.rod_mass_g(screw.diameter_mm, length) + catalogue.rod_mass_g(screw.cylinder_head_mm, head)
    start = high + AXLE_END_PLAY_MM - length
    article = f"screw M3 x {length:g} ISO 4762 - 12.9"
    yield bought(place.name, article, place.body, mass, slabs, _at(place, start))
    slabs = [(0.0, nut.height_mm, hexagon(nut.across_flats_mm) - hole(screw.diameter_mm))]
    y = low - AXLE_END_PLAY_MM - nut.height_mm
    yield bought(f"{place.name}_nut", "lock nut M3 DIN 985", place.body, nut.mass_g, slabs, _at(place, y))


def _clevis(place: Place, diameter_mm: float, catalogue: Catalogue) -> Iterator[BoughtPart]:
    """Yield a clevis pin, its head to the left, and its split pin."""
    pin = catalogue.clevis_pin_for(diameter_mm)
    low, high = place.faces
    needed = high - low + 2.0 * AXLE_END_PLAY_MM + pin.cotter_mm / 2.0 + pin.end_mm
    length = next((known for known in pin.lengths_mm if known >= needed - 1e-9), None)
    if length is None:
        raise CannotBuildError(
            f"no clevis pin of {needed:.1f} mm for the {place.name.replace('_', ' ')}; the longest is "
            f'{pin.lengths_mm[-1]:g} mm: choose bought.retention = "clips"',
            "clevis_pin", pin.lengths_mm[-1] - needed,
        )  # fmt: skip
    head, cotter = high + AXLE_END_PLAY_MM, pin.cotter_mm
    begin, end = pin.end_mm - cotter / 2.0 - COTTER_ROOM_MM, pin.end_mm + cotter / 2.0 + COTTER_ROOM_MM
    slabs = [
        (0.0, begin, disc(diameter_mm)),
        (begin, end, disc(diameter_mm) - rectangle((2.0 * diameter_mm, cotter + 2.0 * COTTER_ROOM_MM))),
        (end, length, disc(diameter_mm)),
        (length, length + pin.head_height_mm, disc(pin.head_mm)),
    ]
    mass = catalogue.rod_mass_g(diameter_mm, length) + catalogue.rod_mass_g(pin.head_mm, pin.head_height_mm)
    article = f"clevis pin B {diameter_mm:g} x {length:g} ISO 2341"
    yield bought(place.name, article, place.body, mass, slabs, _at(place, head - length), place.turn_rad)
    bent = rectangle((COTTER_SPAN_MM, 2.0 * cotter)) - disc(diameter_mm + 2.0 * COTTER_ROOM_MM)
    region = union([rectangle((COTTER_SPAN_MM, cotter)), bent])
    y = head - length + pin.end_mm - cotter / 2.0
    mass = catalogue.rod_mass_g(cotter, pin.cotter_length_mm)
    article = f"split pin {cotter:g} x {pin.cotter_length_mm:g} ISO 1234"
    slab = [(0.0, cotter, region)]
    yield bought(f"{place.name}_split_pin", article, place.body, mass, slab, _at(place, y), place.turn_rad)


def _at(place: Place, y_mm: float) -> tuple[float, float, float]:
    return float(place.centre[0]), y_mm, float(place.centre[1])


@lru_cache(maxsize=8)
def _clip(clip: Clip) -> Region:
    """Return a clip with its opening, seen along the axle."""
    opening = rectangle((clip.outer_mm, CLIP_OPENING * clip.groove_mm), (clip.outer_mm / 2.0, 0.0))
    return ring(clip.outer_mm, clip.groove_mm) - opening


def spacers(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    """Yield the tubes that hold front link, cam and idler apart from the plates."""
    lateral, half = layout.lateral, layout.sections.thickness_mm / 2.0
    (low, high), front, cam = lateral.inside, layout.front_mm, layout.cam_axis_mm
    yield spacer(layout, workshop, "front_spacer_left", [(front, half + GAP_MM / 2.0, high - GAP_MM / 2.0)])
    yield spacer(layout, workshop, "front_spacer_right", [(front, low + GAP_MM / 2.0, -half - GAP_MM / 2.0)])
    yield spacer(layout, workshop, "cam_spacer_right", [(cam, low, lateral.cam[0] - GAP_MM / 2.0)])
    if layout.idler_mm is not None:
        gear, beyond = lateral.gears[0], (layout.idler_mm, low + GAP_MM / 2.0, lateral.gears[0][0] - GAP_MM / 2.0)
        yield spacer(layout, workshop, "cam_spacer_left", [(cam, gear[1] + GEAR_PLAY_MM, high)])
        yield spacer(layout, workshop, "idler_spacer_right", [beyond])


def require_axle(workshop: Workshop) -> None:
    """Reject axles around which the spacers' tubes would have no wall."""
    axle, fits = workshop.bought.axle_mm, workshop.fits.drawn
    thickest = 2.0 * (SPACER_RADIUS_MM - fits.sliding_mm - fits.wall_min_mm)
    if axle > thickest:
        raise JumpcadError(
            f"bought.axle_mm = {axle:g} is more than {thickest:g}, the most with which spacers of "
            f"{2.0 * SPACER_RADIUS_MM:g} mm keep a wall of fits.wall_min_mm = {fits.wall_min_mm:g}: use a thinner axle"
        )


def spacer(layout: Layout, workshop: Workshop, name: str, places: list[tuple[np.ndarray, float, float]]) -> Drawing:
    """Return tubes on axles: copies of one length, each at a place (2,) from y0 to y1."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    length = places[0][2] - places[0][1]
    tube = _tube(2.0 * SPACER_RADIUS_MM, holes.running(layout.axle_mm), length)
    placements = tuple(Placement(BODY, lying_on_right(y0, place[0], place[1])) for place, y0, _ in places)
    return Drawing(name, "body", tube, placements)


@lru_cache(maxsize=32)
def _tube(outer_mm: float, bore_mm: float, length_mm: float) -> Stack:
    return Stack.of([(0.0, length_mm, ring(outer_mm, bore_mm))])


AXLES = Thing(spacers, axles_and_pins, (Check(steel_findings, BASIS),))
