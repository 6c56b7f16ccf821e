"""`jumpcad slice`: masses and printing times of a bundle's parts and plates by PrusaSlicer."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, console, print_json, status, table
from jumpcad.errors import without_controls

if TYPE_CHECKING:
    from jumpcad.bundle.sliced import SlicedBundle

WIDE = 120
"""Width of a table with the longest names of parts (characters)."""


def slice_command(
    bundle: Annotated[Path, typer.Argument(help="A bundle's folder.", metavar="BUNDLE")],
    workshop: Annotated[
        str | None, typer.Option(help="Print with another workshop: a template's name or a file.")
    ] = None,
    write_masses: Annotated[
        Path | None,
        typer.Option(help="Write the workshop, complete, with the sliced masses as weighed ones.", metavar="FILE.toml"),
    ] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Slice a bundle with PrusaSlicer: masses beside the model's, printing times, settings that it ignored.

    The times are written into the bundle's bill of materials and order.md,
    unless --workshop is given.
    """
    from jumpcad.bundle.sliced import slice_bundle, write_times
    from jumpcad.files.outputs import require_apart, require_target, write_atomically
    from jumpcad.workshop import load_workshop

    require_apart({"--write-masses": write_masses}, {"--workshop": workshop})
    if write_masses is not None:
        require_target(write_masses, (".toml",), force)
    printed_by = load_workshop(workshop) if workshop else None
    with status("slicing …") as tell:
        found = slice_bundle(bundle, printed_by, lambda name: tell(f"slicing {name} …"))
    if write_masses is not None:
        write_atomically(write_masses, found.weighed.to_toml(), force)
    if found.billed:
        write_times(found)
    if as_json:
        print_json(slice_facts(bundle, found, write_masses))
        return
    _print_sliced(found)
    if found.billed:
        print(f"written   the times, into bom.csv and order.md of {without_controls(str(bundle))}")
    if write_masses is not None:
        name = without_controls(str(write_masses))
        print(f"written   {name}: try jumpcad build DESIGN --workshop {name}")


def slice_facts(bundle: Path, found: "SlicedBundle", write_masses: Path | None) -> dict[str, Any]:
    """Return the JSON document of a sliced bundle."""
    return {
        "bundle": str(bundle),
        "slicer": found.version,
        "ignored": {key: {"asked": asked, "used": used} for key, (asked, used) in found.ignored.items()},
        "parts": [vars(part) | {"difference": part.difference} for part in found.parts],
        "plates": [vars(plate) for plate in found.plates],
        "left_out": list(found.left_out),
        "grams": sum(plate.grams for plate in found.plates),
        "time_s": sum(plate.time_s for plate in found.plates),
        "workshop": write_masses and str(write_masses),
        "written": found.billed,
    }


def _print_sliced(found: "SlicedBundle") -> None:
    from jumpcad.bundle.guide.markdown import duration

    screen = console(width=WIDE)
    parts = table("part", ">quantity", "material", ">g each", ">model g", ">model", ">time each", wraps="none")
    for part in found.parts:
        grams = f"{part.grams:.2f}", f"{part.modelled_grams:.2f}", f"{100.0 * part.difference:+.1f} %"
        parts.add_row(part.name, str(part.quantity), part.material, *grams, duration(part.time_s))
    screen.print(parts)
    print()
    plates = table("plate", "material", ">g", ">time", wraps="none")
    for plate in found.plates:
        plates.add_row(plate.name, plate.material, f"{plate.grams:.2f}", duration(plate.time_s))
    total_g, total_s = (sum(getattr(plate, key) for plate in found.plates) for key in ("grams", "time_s"))
    plates.add_row("all", "", f"{total_g:.2f}", duration(total_s))
    screen.print(plates)
    print()
    for path in found.left_out:
        print(f"left out  {path}: printed pads, whose filament and settings the guide names")
    print(f"slicer    PrusaSlicer {found.version}")
    for key, (asked, used) in found.ignored.items():
        print(f"ignored   {key} = {asked}: the slicer used {used}")
    if not found.ignored:
        print("settings  all taken over")
