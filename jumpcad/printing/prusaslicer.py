"""Mass and time of a part by PrusaSlicer, printed as the workshop says; the settings of a 3MF file for it."""

import math
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from jumpcad.catalogue import Pad
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files.reading import read_bytes
from jumpcad.workshop import Material, Printer, Process

PROGRAM = "prusa-slicer"
MAJOR = 2
"""The major version whose settings, remarks and exit codes are known here."""
TIMEOUT_S = 600
FILAMENT_MM = 1.75
REMARK = re.compile(r"^; ([\w \[\]()]+?) = (.*)$", re.MULTILINE)
"""A closing comment of its G-code: a setting, the time, the filament."""
USED, TIME = "filament used [mm]", "estimated printing time (normal mode)"
USUAL = {USED: re.compile(r"\d{1,9}(\.\d+)?"), TIME: re.compile(r"(\d{1,4}[dhms] ?)+")}
"""How its remarks say a length and a duration."""
LARGEST_GCODE, LARGEST_SAID = 1 << 28, 1 << 20
"""Bytes of its file, and of what it prints, that are read."""
REFUSED = 1
"""PrusaSlicer's exit code for input that it will not print; any other means a crash."""


@dataclass(frozen=True)
class Sliced:
    """One sliced part: grams, seconds of printing, settings that the slicer did not take over, and its G-code.

    `ignored` maps a setting to what was asked for and what the slicer says it used.
    """

    grams: float
    time_s: float
    ignored: dict[str, tuple[str, str]]
    gcode: str


def slicer_program() -> str | None:
    """Return the path of PrusaSlicer's program, or None."""
    return shutil.which(PROGRAM)


def slicer_settings(printer: Printer, process: Process, material: Material | Pad) -> dict[str, str]:
    """Return PrusaSlicer's settings for a workshop: all that decides a part's plastic; brims are parts' own."""
    width, height = printer.bed_mm[:2]
    solid = process.infill >= 1.0
    lines = ("", "perimeter_", "external_perimeter_", "infill_", "solid_infill_", "top_infill_", "first_layer_")
    return {
        "bed_shape": f"0x0,{width:g}x0,{width:g}x{height:g},0x{height:g}", "max_print_height": f"{printer.bed_mm[2]:g}",
        "nozzle_diameter": f"{printer.nozzle_mm:g}", "filament_diameter": f"{FILAMENT_MM:g}",
        "filament_density": f"{material.density_g_cm3:g}", "layer_height": f"{process.layer_height_mm:g}",
        "first_layer_height": f"{process.first_layer_mm:g}",
        **{f"{line}extrusion_width": f"{process.line_width_mm:g}" for line in lines},
        "perimeters": str(process.perimeters), "top_solid_layers": str(process.top_layers),
        "bottom_solid_layers": str(process.bottom_layers), "top_solid_min_thickness": "0",
        "bottom_solid_min_thickness": "0", "fill_density": f"{100.0 * process.infill:g}%",
        "fill_pattern": "rectilinear" if solid else process.infill_pattern,
        "solid_infill_below_area": f"{process.solid_below_area_mm2:g}", "skirts": "0", "brim_width": "0",
        "elefant_foot_compensation": "0", "support_material": "0", "ensure_vertical_shell_thickness": "0",
        "start_gcode": "", "end_gcode": "",
    }  # fmt: skip


def slicer_version() -> str:
    """Return the version of the installed PrusaSlicer, such as `2.5.0`."""
    done = _run(["--help"], "its help")
    found = re.search(r"PrusaSlicer-((\d+)[\w.-]*)", done.stdout + done.stderr)
    if found is None:
        raise JumpcadError(f"{PROGRAM} does not say that it is PrusaSlicer: install PrusaSlicer {MAJOR} in its place")
    if int(found[2]) != MAJOR:
        raise JumpcadError(f"{PROGRAM} is of version {found[1]}, whose settings are not known: install version {MAJOR}")
    return found[1]


def slice_model(model: Path, printer: Printer, process: Process, material: Material) -> Sliced:
    """Slice an STL file in the middle of the bed, or a print plate of which every part stays where it lies."""
    centre = f"{printer.bed_mm[0] / 2.0:g},{printer.bed_mm[1] / 2.0:g}"
    place = ["--center", centre] if model.suffix == ".stl" else ["--dont-arrange"]
    asked = slicer_settings(printer, process, material)
    with tempfile.TemporaryDirectory() as folder:
        config, output = Path(folder) / "config.ini", Path(folder) / "part.gcode"
        config.write_text("".join(f"{key} = {value}\n" for key, value in asked.items()), encoding="utf-8")
        files = ["--load", str(config), "--output", str(output), str(model)]
        done = _run(["--export-gcode", *place, *files], model.name)
        if done.returncode != 0 or not output.is_file():
            words = [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]
            if words and done.returncode == REFUSED:
                raise CannotBuildError(f"{PROGRAM} refused {model.name}: {words[-1]}")
            said = words[-1] if words else "it printed no message"
            raise JumpcadError(f"{PROGRAM} crashed on {model.name} with exit code {done.returncode}: {said}")
        gcode = read_bytes(output, "G-code", LARGEST_GCODE).decode(errors="replace")
    remarks = dict(REMARK.findall(gcode))
    if not all(usual.fullmatch(remarks.get(key, "")) for key, usual in USUAL.items()):
        raise JumpcadError(
            f"{PROGRAM} wrote G-code without its usual remarks for {model.name}: another version or program?"
        )
    ignored = {key: (value, remarks.get(key, "nothing")) for key, value in asked.items() if remarks.get(key) != value}
    return Sliced(
        grams=float(remarks[USED]) * math.pi / 4.0 * FILAMENT_MM**2 * material.density_g_cm3 / 1000.0,
        time_s=_seconds(remarks[TIME]),
        ignored=ignored,
        gcode=gcode,
    )


def _run(arguments: list[str], purpose: str) -> subprocess.CompletedProcess[str]:
    """Run PrusaSlicer; output that is not UTF-8 is replaced, not an error."""
    program = slicer_program()
    if program is None:
        raise JumpcadError(f"{PROGRAM} is not installed: install PrusaSlicer, or leave the printed masses as modelled")
    try:
        with (
            tempfile.TemporaryFile() as said,
            tempfile.TemporaryFile() as errors,
        ):  # children may hold a pipe
            done = subprocess.run(
                [program, *arguments], stdin=subprocess.DEVNULL, stdout=said, stderr=errors, timeout=TIMEOUT_S,
                check=False,
            )  # fmt: skip
            texts = [(one.seek(0), one.read(LARGEST_SAID).decode(errors="replace"))[1] for one in (said, errors)]
            return subprocess.CompletedProcess(done.args, done.returncode, *texts)
    except subprocess.TimeoutExpired:
        raise JumpcadError(f"{PROGRAM} did not finish {purpose} within {TIMEOUT_S} s") from None
    except OSError as error:
        raise JumpcadError(f"{PROGRAM} at {program} cannot be run: {error.strerror}: reinstall PrusaSlicer") from None


def _seconds(text: str) -> float:
    """Return the seconds of a duration such as `1d 2h 3m 4s`."""
    units = {"d": 86400.0, "h": 3600.0, "m": 60.0, "s": 1.0}
    return sum(float(value) * units[unit] for value, unit in re.findall(r"(\d+)([dhms])", text))


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
