"""The printed tubes on the axles (mm)."""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from jumpcad.dimensions import GAP_MM, SPACER_RADIUS_MM
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.robot.layout import Layout
from jumpcad.robot.sensor.place import GEAR_PLAY_MM
from jumpcad.solids.outline import ring
from jumpcad.solids.stack import Stack
from jumpcad.workshop import Workshop


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
