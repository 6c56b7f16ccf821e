"""`Robot`: a mechanism with the printed and bought parts that it is made of, its layout, and the workshop."""

from dataclasses import dataclass

from jumpcad.layout.layout import Layout
from jumpcad.mechanism.model import Mechanism
from jumpcad.parts.part import Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.workshop import Workshop


@dataclass(frozen=True, repr=False)
class Robot(Mechanism):
    """One printed robot; its bodies have the mass and inertia of its parts.

    `parts` are printed, `hardware` is bought, `layout` says where everything goes, and `workshop` what it is made with.
    """

    parts: tuple[Part, ...]
    hardware: tuple[BoughtPart, ...]
    workshop: Workshop
    layout: Layout
