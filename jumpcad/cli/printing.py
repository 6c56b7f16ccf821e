"""`jumpcad coupon`: a fit gauge to print, a workshop from its readings; `jumpcad slice`: a bundle in PrusaSlicer."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import jumpcad
from jumpcad.cli.output import ForceFlag, JsonFlag, answer, console, print_text, status, table
from jumpcad.cli.subjects import File, Text, option
from jumpcad.errors import without_controls

if TYPE_CHECKING:
    from jumpcad.bundle.sliced import SlicedBundle

FOLDER = Path("exports/coupon")
WORKSHOP = Path("my-workshop.toml")
OUTPUT, DEFAULTS = "Folder, or with --measured the workshop file.", f"{FOLDER}, or {WORKSHOP}"
WIDE = 120
"""Width of a table with the longest names of parts (characters)."""


def coupon(
    measured: Annotated[File, option("Turn these readings into a workshop file.", "READINGS.toml")] = None,
    workshop: Annotated[str, typer.Option(help="Workshop: a template's name or a file.")] = "default",
    output: Annotated[Path | None, typer.Option("-o", "--output", help=OUTPUT, show_default=DEFAULTS)] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write a fit coupon to print; with --measured, make a workshop file from its readings."""
    from jumpcad.files.outputs import require_apart

    require_apart({"--output": output}, {"--measured": measured, "--workshop": workshop})
    of_readings = measured and _measured(measured, workshop, output or WORKSHOP, force)
    facts = of_readings or _written(workshop, output or FOLDER, force)
    answer(as_json, facts, print_text, "coupon", **facts, base=workshop, measured=measured is not None)


def _written(workshop: str, folder: Path, force: bool) -> dict[str, Any]:
    """Write the coupon; return its folder, files and mass."""
    from jumpcad.bundle.export import export_coupon

    bundle = export_coupon(jumpcad.load_workshop(workshop), folder, force)
    return {"folder": str(folder), "files": [*bundle.files], "grams": 1000.0 * bundle.manifest["mass_kg"]}


def _measured(readings: Path, workshop: str, output: Path, force: bool) -> dict[str, Any]:
    """Write the complete workshop with the measured fits; return the changed values."""
    from jumpcad.coupon.readings import Readings, measured_workshop
    from jumpcad.files.outputs import require_target, write_atomically

    require_target(output, (".toml",), force)
    base = jumpcad.load_workshop(workshop)
    found = measured_workshop(Readings.from_toml(readings), base, str(readings))
    before, after = base.fits.model_dump(), found.fits.model_dump()
    changed = {key: value for key, value in after.items() if value != before[key]}
    write_atomically(output, _with_comments(workshop, output, found, changed), force)
    return {
        "workshop": str(output),
        "fits": {key: {"before": before[key], "after": value} for key, value in changed.items()},
        "strengths": _lowered(base, found, "strength_in_plane_mpa"),
        "strengths_interlayer": _lowered(base, found, "strength_interlayer_mpa"),
    }


def _with_comments(workshop: str, output: Path, found: "jumpcad.Workshop", fits: dict[str, float]) -> str:
    """Return the measured workshop as TOML with the comments of the one that it is made from, where that can be."""
    import tomllib

    from jumpcad.cli.commented import changed_toml, commented_workshop
    from jumpcad.files import find_template, read_toml

    source = find_template("workshops", workshop)
    data, base = read_toml(source)[0], jumpcad.load_workshop(workshop)
    relative = any(isinstance(data.get(key), str) and data[key].endswith(".toml") for key in ("base", "printer"))
    if relative and source.parent.resolve() != output.parent.resolve():
        return commented_workshop(found, workshop)
    changes: dict[str, dict[str, Any]] = {"fits": fits} if fits else {}
    for name, material in found.materials.items():
        new, old = material.model_dump(), base.materials[name].model_dump()
        if new != old:
            changes[f"materials.{name}"] = {key: value for key, value in new.items() if value != old[key]}
    text = changed_toml(source.read_text(encoding="utf-8"), changes)
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:  # its tables are written another way
        return commented_workshop(found, workshop)
    return text


def _lowered(base: "jumpcad.Workshop", found: "jumpcad.Workshop", key: str) -> dict[str, dict[str, float]]:
    """Return a strength before and after, of the materials in which it was changed."""
    strengths = {name: (getattr(one, key), getattr(found.materials[name], key)) for name, one in base.materials.items()}
    return {name: {"before": before, "after": after} for name, (before, after) in strengths.items() if before != after}


def slice_command(
    bundle: Annotated[Path, typer.Argument(help="A bundle's folder.", metavar="BUNDLE")],
    workshop: Annotated[Text, option("Print with another workshop: a template's name or a file.")] = None,
    write_masses: Annotated[
        File, option("Write the workshop, complete, with the sliced masses as weighed ones.", "FILE.toml")
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

    require_apart({"--write-masses": write_masses}, {"--workshop": workshop})
    if write_masses is not None:
        require_target(write_masses, (".toml",), force)
    printed_by = jumpcad.load_workshop(workshop) if workshop else None
    with status("slicing …") as tell:
        found = slice_bundle(bundle, printed_by, lambda name: tell(f"slicing {name} …"))
    if write_masses is not None:
        write_atomically(write_masses, found.weighed.to_toml(), force)
    if found.billed:
        write_times(found)
    answer(as_json, slice_facts(bundle, found, write_masses), _print_sliced, found, bundle, write_masses)


def slice_facts(bundle: Path, found: "SlicedBundle", write_masses: Path | None) -> dict[str, Any]:
    return {
        "bundle": str(bundle), "slicer": found.version,
        "ignored": {key: {"asked": asked, "used": used} for key, (asked, used) in found.ignored.items()},
        "parts": [vars(part) | {"difference": part.difference} for part in found.parts],
        "plates": [vars(plate) for plate in found.plates], "left_out": list(found.left_out),
        "grams": sum(plate.grams for plate in found.plates), "time_s": sum(plate.time_s for plate in found.plates),
        "workshop": write_masses and str(write_masses), "written": found.billed,
    }  # fmt: skip


def _print_sliced(found: "SlicedBundle", bundle: Path, write_masses: Path | None) -> None:
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
    if found.billed:
        print(f"written   the times, into bom.csv and order.md of {without_controls(str(bundle))}")
    if write_masses is not None:
        name = without_controls(str(write_masses))
        print(f"written   {name}: try jumpcad build DESIGN --workshop {name}")
