"""The print settings that a 3MF file carries for PrusaSlicer, and the same in words for other slicers.

They are those of the printed-mass model, and the material's temperatures. Speeds, retraction and the G-code at start
and end belong to a printer: PrusaSlicer takes its defaults until the user chooses the printer.
"""

from jumpcad.catalogue import Pad
from jumpcad.printing.prusaslicer import slicer_settings
from jumpcad.workshop import Material, Printer, Process

OF_THE_PRINTER = "start_gcode", "end_gcode"
"""Settings of the mass model that a print must not have: it starts by heating and homing."""
PADS_HOW = (
    "solid (100 % infill), lying on their sides, the rest as above; temperatures and speed are your filament's, 20 to "
    "30 mm/s where it is flexible (judgement)"
)
"""How printed pads are printed, in words."""
LAYERS = "first_layer_", ""
"""Beginnings of the keys of temperatures: of the first layer, and of the others."""


def project_settings(printer: Printer, process: Process, material: Material, filament: str) -> dict[str, str]:
    """Return PrusaSlicer's settings of a print; `filament` is the material's name.

    Temperatures that the workshop does not know are left out.
    """
    settings = slicer_settings(printer, process, material)
    heats = {"temperature": material.nozzle_c, "bed_temperature": material.bed_c}
    return {
        **{key: value for key, value in settings.items() if key not in OF_THE_PRINTER},
        "filament_type": filament,
        **{f"{layer}{key}": f"{heat:g}" for key, heat in heats.items() if heat is not None for layer in LAYERS},
    }


def pad_settings(printer: Printer, process: Process, pad: Pad) -> dict[str, str]:
    """Return PrusaSlicer's settings of pads: as those of parts, but solid, as their mass is computed."""
    settings = slicer_settings(printer, process.model_copy(update={"infill": 1.0}), pad)
    return {
        **{key: value for key, value in settings.items() if key not in OF_THE_PRINTER},
        "filament_type": pad.name,
    }


def settings_in_words(printer: Printer, process: Process) -> list[str]:
    """Return the settings that every part is printed with, one a line."""
    solid = process.infill >= 1.0
    area_mm2 = process.solid_below_area_mm2
    small = f"areas below {area_mm2:g} mm² filled solid" if area_mm2 else "small areas filled like the others (0 mm²)"
    infill = "none but solid layers" if process.infill == 0.0 else f"{100.0 * process.infill:g} %"
    return [
        f"printer: {printer.name}, nozzle {printer.nozzle_mm:g} mm",
        f"layers: {process.layer_height_mm:g} mm, the first {process.first_layer_mm:g} mm",
        f"width of every line: {process.line_width_mm:g} mm",
        f"perimeters (walls): {process.perimeters}",
        f"solid layers: {process.top_layers} at the top, {process.bottom_layers} at the bottom",
        f"infill: {infill}, {'rectilinear' if solid else process.infill_pattern}",
        f"{small}; no extra solid shell (ensure vertical shell thickness off)",
        "no support, no brim, no elephant foot compensation: plates, links and gears are chamfered at the bed",
    ]


def temperatures_in_words(material: Material) -> str:
    """Return a material's temperatures, or that they are the user's to enter."""
    heats = ("nozzle", material.nozzle_c), ("bed", material.bed_c)
    known = [f"{part} {heat:g} °C" for part, heat in heats if heat is not None]
    return ", ".join(known) or "no temperatures in the workshop: enter your filament's"
