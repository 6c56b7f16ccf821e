"""The switch over the cam gear, and the screws of its mount (mm, g)."""

from collections.abc import Iterator

from jumpcad.mechanism.model import BODY
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import placed_screw
from jumpcad.robot.layout import Layout
from jumpcad.robot.sensor import drawing
from jumpcad.workshop import Workshop


def sensor(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the switch over the cam gear's track and the screws of its mount."""
    catalogue = workshop.catalogue
    felt, outside = layout.sensor, layout.lateral.left_plate[1]
    if felt is None:
        return
    part, at = felt.needs.part, (felt.place_mm[0], outside + felt.base_mm, felt.place_mm[1])
    slabs = drawing.sensor_slabs(part, felt.needs.travel)
    yield bought("sensor", part.description, BODY, part.mass_g, slabs, at, felt.turn_rad)
    head = outside + drawing.ear_height_mm(layout)
    for number, place in enumerate(drawing.screw_places(felt), start=1):
        shank = (head - drawing.screw_mm(), head)
        yield placed_screw(f"sensor_screw_{number}", BODY, place, shank, 1.0, catalogue.screws["M2"], catalogue)
