"""`Robot`: a mechanism with the printed and bought parts that it is made of, its layout, and the workshop."""

from dataclasses import dataclass

from jumpcad.layout.plan import Plan
from jumpcad.mechanism.model import Mechanism
from jumpcad.parts.part import Part
from jumpcad.parts.purchased import Bought
from jumpcad.workshop import Workshop


@dataclass(frozen=True, repr=False)
class Robot(Mechanism):
    """One printed robot; its bodies have the mass and inertia of its parts.

    `parts` are printed, `hardware` is bought, `plan` says where everything goes, and `workshop` what it is made with.
    """

    parts: tuple[Part, ...]
    hardware: tuple[Bought, ...]
    workshop: Workshop
    plan: Plan
