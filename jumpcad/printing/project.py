"""The print settings that a 3MF file carries for PrusaSlicer; `print/README.md` has them in words for other slicers.

They are those of the printed-mass model, and the material's temperatures. Speeds, retraction and the G-code at start
and end belong to a printer: PrusaSlicer takes its defaults until the user chooses the printer.
"""

from jumpcad.catalogue import Pad
from jumpcad.printing.prusaslicer import slicer_settings
from jumpcad.workshop import Material, Printer, Process

OF_THE_PRINTER = "start_gcode", "end_gcode"
"""Settings of the mass model that a print must not have: it starts by heating and homing."""
LAYERS = "first_layer_", ""
"""Beginnings of the keys of temperatures: of the first layer, and of the others."""


def project_settings(printer: Printer, process: Process, material: Material | Pad, filament: str) -> dict[str, str]:
    """Return PrusaSlicer's settings of a print; `filament` is the material's name.

    Temperatures that the workshop does not know are left out. Pads are printed as parts are, but solid, as their mass
    is computed.
    """
    if isinstance(material, Pad):
        process, heats = process.model_copy(update={"infill": 1.0}), {}
    else:
        heats = {"temperature": material.nozzle_c, "bed_temperature": material.bed_c}
    settings = slicer_settings(printer, process, material)
    return {
        **{key: value for key, value in settings.items() if key not in OF_THE_PRINTER},
        "filament_type": filament,
        **{f"{layer}{key}": f"{heat:g}" for key, heat in heats.items() if heat is not None for layer in LAYERS},
    }
