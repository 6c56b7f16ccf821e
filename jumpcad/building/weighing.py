"""Drawings become parts: with a material, and the mass of the layer model or of the user's scales."""

from collections.abc import Iterable, Sequence

from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.parts.part import Drawing, Part
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.workshop import Workshop

WEIGHED_OFF = 20.0
"""By how much a printed part may be heavier or lighter than as drawn; judgement: kilograms are 1000 times off."""
NOT_IN_EVERY_ROBOT = (
    "idler",
    "cam_spacer_left",
    "idler_spacer_right",
    "toe_left",
    "toe_right",
    "main_leg_end",
    "sensor_mount",
)
"""Parts that only some designs have: a workshop with their weights serves the other designs too."""


def weighed_part(drawing: Drawing, workshop: Workshop) -> Part:
    """Return a drawing with its material and the mass of one copy."""
    material, material_name = workshop.material(drawing.role), workshop.material_name(drawing.role)
    model, nozzle = workshop.mass.model, workshop.printer.nozzle_mm
    mass = mass_properties(drawing.shape, material.density_g_cm3, workshop.process, nozzle, model)
    weighed = workshop.mass.weighed_g.get(drawing.name)
    if weighed is not None:
        grams = 1000.0 * mass.mass_kg
        if not grams / WEIGHED_OFF <= weighed <= grams * WEIGHED_OFF:
            raise JumpcadError(
                f"mass.weighed_g.{drawing.name} = {weighed:g}: as drawn it weighs about {grams:.2g} g: is it in grams?"
            )
        return Part(drawing, material_name, mass.scaled_to(weighed / 1000.0), "weighed")
    return Part(drawing, material_name, mass, model)


def require_parts(weighed: Iterable[str], names: Sequence[str]) -> None:
    """Reject weights of parts that neither this robot, whose parts have these names, nor any other has."""
    known = (*names, *NOT_IN_EVERY_ROBOT)
    for name in weighed:
        if name not in known:
            raise JumpcadError(
                f"mass.weighed_g.{name}: no such part{did_you_mean(name, known)}; the robot has {', '.join(names)}"
            )
