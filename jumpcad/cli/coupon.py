"""`jumpcad coupon`: a fit gauge to print, and a workshop from its readings."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, print_json, print_text

if TYPE_CHECKING:
    from jumpcad.workshop import Workshop

FOLDER = Path("exports/coupon")
WORKSHOP = Path("my-workshop.toml")


def coupon(
    measured: Annotated[
        Path | None, typer.Option(help="Turn these readings into a workshop file.", metavar="READINGS.toml")
    ] = None,
    workshop: Annotated[str, typer.Option(help="Workshop: a template's name or a file.")] = "default",
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            help="Folder, or with --measured the workshop file.",
            show_default=f"{FOLDER}, or {WORKSHOP}",
        ),
    ] = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Write a fit coupon to print; with --measured, make a workshop file from its readings."""
    from jumpcad.files.outputs import require_apart

    require_apart({"--output": output}, {"--measured": measured, "--workshop": workshop})
    if measured is not None:
        facts = _measured(measured, workshop, output or WORKSHOP, force)
    else:
        facts = _written(workshop, output or FOLDER, force)
    if as_json:
        print_json(facts)
    else:
        print_text("coupon", **facts, base=workshop, measured=measured is not None)


def _written(workshop: str, folder: Path, force: bool) -> dict[str, Any]:
    """Write the coupon; return its folder, files and mass."""
    from jumpcad.bundle.export import export_coupon
    from jumpcad.workshop import load_workshop

    bundle = export_coupon(load_workshop(workshop), folder, force)
    return {"folder": str(folder), "files": [*bundle.files], "grams": 1000.0 * bundle.manifest["mass_kg"]}


def _measured(readings: Path, workshop: str, output: Path, force: bool) -> dict[str, Any]:
    """Write the complete workshop with the measured fits; return the changed values."""
    from jumpcad.coupon.readings import Readings, measured_workshop
    from jumpcad.files.outputs import require_target, write_atomically
    from jumpcad.workshop import load_workshop

    require_target(output, (".toml",), force)
    base = load_workshop(workshop)
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


def _with_comments(workshop: str, output: Path, found: "Workshop", fits: dict[str, float]) -> str:
    """Return the measured workshop as TOML with the comments of the one that it is made from, where that can be."""
    import tomllib

    from jumpcad.cli.commented import changed_toml, commented_workshop
    from jumpcad.files import find_template, read_toml
    from jumpcad.workshop import load_workshop

    source = find_template("workshops", workshop)
    data, base = read_toml(source)[0], load_workshop(workshop)
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


def _lowered(base: "Workshop", found: "Workshop", key: str) -> dict[str, dict[str, float]]:
    """Return a strength before and after, of the materials in which it was changed."""
    strengths = {name: (getattr(one, key), getattr(found.materials[name], key)) for name, one in base.materials.items()}
    return {name: {"before": before, "after": after} for name, (before, after) in strengths.items() if before != after}
