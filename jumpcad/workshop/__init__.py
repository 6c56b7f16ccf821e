"""`Workshop`: printer, process, materials, fits, bought parts, safety and masses, from a template or a TOML file."""

from jumpcad.design import DEFAULT, own_workshop
from jumpcad.workshop.loading import load_workshop
from jumpcad.workshop.tables import BoughtParts, Fits, Material, Printer, Process
from jumpcad.workshop.varied import varied, workshop_value
from jumpcad.workshop.workshop import OWN_PARTS, Workshop

__all__ = [
    "DEFAULT", "OWN_PARTS", "BoughtParts", "Fits", "Material", "Printer", "Process", "Workshop", "load_workshop",
    "own_workshop", "varied", "workshop_value",
]  # fmt: skip
