"""`jumpcad list`: what ships with jumpcad and can be named on the command line or in a workshop."""

from collections.abc import Callable
from itertools import takewhile
from typing import Annotated, Any

import typer

from jumpcad.cli.output import JsonFlag, console, print_json, table
from jumpcad.dimensions import unit_of_key
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean, find_template, read_toml, template_names

USED_AS = {
    "templates": "a DESIGN of every command; jumpcad new FILE.toml --from NAME",
    "workshops": "--workshop NAME",
    "printers": "--printer NAME",
    "materials": "--material NAME; [roles] in a workshop",
    "settings": "jumpcad simulate DESIGN --settings NAME",
    "engines": "jumpcad simulate DESIGN --engine NAME",
    "objectives": "jumpcad optimize --objective NAME",
    "figures": "jumpcad optimize --require FIGURE<=NUMBER; an own objective",
    "kits": "[bought] kit in a workshop",
    "motors": "[bought] motors",
    "batteries": "[bought] battery",
    "boards": "[bought] controller, driver, regulator; [steering] gyroscope",
    "components": "[bought] sensor, switch, plug, capacitor, diode, wire",
    "bearings": "[bought] leg_bearing, roller",
    "springs": "[bought] spring",
    "rods": "[bought] axle",
    "pads": "[ground] pad, [body] stop_pad",
    "small_motors": "[steering] motor, besides motors",
}
"""Every kind that is listed, and where its names are used."""
GROUPS = {"parts": tuple(USED_AS)[tuple(USED_AS).index("kits") :]}
"""Names for several kinds: parts are those from the kits on."""
FOLDERS = {"templates": "robots", "workshops": "workshops", "settings": "settings"}
"""Kinds whose files begin with a comment that describes them, and their folders."""

KINDS = f"{', '.join(USED_AS)}; parts: all that are bought; all kinds unless given."
KindArgument = Annotated[
    str | None, typer.Argument(help=KINDS, metavar="KIND", autocompletion=lambda: [*USED_AS, *GROUPS])
]


def list_names(kind: KindArgument = None, as_json: JsonFlag = False) -> None:
    """List what ships: templates, workshops, printers, materials, kits, motors and more."""
    if kind is not None and kind not in {*USED_AS, *GROUPS}:
        raise JumpcadError(f"{kind!r} is none of the kinds {', '.join(USED_AS)}{did_you_mean(kind, USED_AS)}")
    found = {name: described(name) for name in (GROUPS.get(kind, (kind,)) if kind else USED_AS)}
    if as_json:
        print_json({kind: [{"name": name, "description": words} for name, words in entries.items()]
                    for kind, entries in found.items()})  # fmt: skip
        return
    for number, (name, entries) in enumerate(found.items()):
        if number:
            print()
        print(f"{name} ({USED_AS[name]})")
        listed = table("name", "words", wraps="words", show_header=False, padding=(0, 2, 0, 0))
        for entry, words in entries.items():
            listed.add_row(f"  {entry}", words)
        console().print(listed)


def described(kind: str) -> dict[str, str]:
    """Return the names of a kind, each with its description."""
    if kind in FOLDERS:
        files = {name: find_template(FOLDERS[kind], name) for name in template_names(FOLDERS[kind])}
        return {name: _first_sentence(file.read_text(encoding="utf-8")) for name, file in files.items()}
    if kind in ("printers", "materials"):
        tables = {name: read_toml(find_template(kind, name))[0] for name in template_names(kind)}
        return {name if kind == "printers" else name.upper(): IN_WORDS[kind](one) for name, one in tables.items()}
    if kind == "engines":
        from jumpcad.simulation.engines import ENGINES, is_installed

        return {name: "installed" if is_installed(name) else "not installed" for name in ENGINES}
    if kind == "objectives":
        from jumpcad.search.study.objective import OBJECTIVES

        return {name: f"{one.meaning} ({one.unit})" for name, one in OBJECTIVES.items()}
    if kind == "figures":
        from jumpcad.evaluation import FIGURES

        units = {name: unit_of_key(name) for name in FIGURES}
        return {name: f"{words} ({units[name]})" if units[name] else words for name, words in FIGURES.items()}
    from jumpcad.catalogue import load_catalogue

    words = IN_WORDS.get(kind.removeprefix("small_"), lambda one: str(one.description).rstrip(","))
    return {name: words(part) for name, part in getattr(load_catalogue(), kind).items()}


IN_WORDS: dict[str, Callable[[Any], str]] = {
    "printers": lambda one: (
        f"{one['name']}: bed {' x '.join(f'{side:g}' for side in one['bed_mm'])} mm, nozzle {one['nozzle_mm']:g} mm"
    ),
    "materials": lambda one: _material(one),
    "kits": lambda one: f"{', '.join(one.motors)}; {one.battery}; {one.controller}; {one.driver}",
    "motors": lambda one: (
        f"{one.ratio:g}:1, {one.voltage_v:g} V, {one.no_load_rpm:g}/min, "
        f"{1000.0 * one.stall_torque_nm:.0f} mN·m stalled, {one.mass_g:g} g"
    ),
    "bearings": lambda one: (
        f"{one.bore_mm:g} x {one.outer_mm:g} x {one.width_mm:g} mm, {one.static_load_n:g} N, {one.mass_g:g} g"
    ),
    "batteries": lambda one: f"{one.description}, {one.mass_g:g} g",
    "springs": lambda one: (
        f"wire {one.wire_mm:g} mm, inside {one.inside_diameter_mm:g} mm, {one.turns:g} turns, "
        f"{one.rate_nmm_per_deg:g} N·mm/°"
    ),
}
"""Main figures of what is listed, of those kinds whose description does not say them."""


def _first_sentence(text: str) -> str:
    """Return the first sentence of the comment at the beginning of a file."""
    lines = takewhile(lambda line: line.startswith("#") and line.strip() != "#", text.splitlines())
    return " ".join(line[1:].strip() for line in lines).split(". ")[0].removesuffix(".")


def _material(data: dict[str, Any]) -> str:
    strength = data.get("strength_in_plane_mpa")
    bears = f"{strength:g} MPa along its layers" if strength else "strengths to be entered in the workshop"
    return f"{data['density_g_cm3']:g} g/cm³, {bears}"
