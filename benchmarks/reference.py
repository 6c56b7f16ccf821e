"""The reference pages of the documentation, and the drawing of the eight parameters, written from the code.

    python benchmarks/reference.py [--write]

Without `--write` it compares the pages in `docs/` with what the program gives, and exits with 1 if they differ. It
builds one robot with its files and checks the templates (some ten seconds).
"""

import io
import json
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import redirect_stdout
from inspect import getmodule
from itertools import chain
from pathlib import Path
from typing import Any
from unittest.mock import patch

import typer
from field_words import meaning

import jumpcad
from jumpcad import checks
from jumpcad.bundle.manifest import open_bundle
from jumpcad.bundle.sliced import SlicedBundle, SlicedPart, SlicedPlate
from jumpcad.calibration import posterior, surface
from jumpcad.cli.commands import app, run
from jumpcad.cli.slicing import slice_facts
from jumpcad.exporters.registry import EXPORTERS
from jumpcad.files import find_template, template_names
from jumpcad.findings import Finding
from jumpcad.mechanism.model import Mechanism
from jumpcad.scene.parameters import parameter_drawing
from jumpcad.workshop import OWN_PARTS, Workshop, load_workshop

DOCS = Path(__file__).parents[1] / "docs"
EXAMPLE = "kenan-2.0"
DRAWING = "pictures/parameters.svg"
UNITS = {
    "nmm_per_deg": "N·mm/°", "nm_per_rad": "N·m/rad", "n_per_mm": "N/mm", "kg_m2": "kg·m²", "g_cm3": "g/cm³",
    "eur_per_kg": "EUR/kg", "area_mm2": "mm²", "mm": "mm", "deg": "°", "mpa": "MPa", "nm": "N·m", "n": "N", "g": "g",
    "c": "°C", "v": "V", "a": "A", "ma": "mA", "mah": "mAh", "ohm": "Ω", "rpm": "1/min", "uf": "µF", "eur": "EUR",
}  # fmt: skip
"""Units by the end of a key, the longest ends first."""
VARIANTS = {
    'bought.leg = "carbon-tube-4x2"': "kenan-2.0",
    'bought.kit = "strong-2s"': "kenan-2.0",
    'bought.spring = "9271K589"': "kenan-2.0",
    "body.toe_half_width_mm = 60": "best-ga",
}
"""What a workshop says that has other limits than the default one, and a design that can be built in it."""
MAPPINGS = {"design", "importance", "margins", "readings", "refused", "sweeps"}
"""Fields that map names to like things, though their names look like fields."""
WHOLE = {"identity"}
"""Fields that are not taken apart."""
GENERATED = "<!-- Written by benchmarks/reference.py: change the code, then run it with --write. -->\n"


def page(title: str, words: str, *blocks: str) -> str:
    """Return a page of Markdown."""
    return "\n\n".join([f"# {title}", GENERATED + words, *blocks]).rstrip("\n") + "\n"


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table of text."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


# Commands


def commands() -> str:
    """Return the page of all commands with arguments and options, as their help has them."""
    found = typer.main.get_command(app).commands  # type: ignore[attr-defined]
    words = "What `jumpcad COMMAND --help` says. Exit codes and common rules: [Command line](../commands.md)."
    return page("Commands", words, *(_command(name, command) for name, command in found.items()))


def _command(name: str, command: Any) -> str:
    rows = [
        (" ".join(f"`{word}`" for word in _words(one)), one.help or "", _default(one))
        for one in command.params
        if one.name != "help" and not getattr(one, "hidden", False)
    ]
    arguments = [_words(one)[0] for one in command.params if one.param_type_name == "argument"]
    usage = " ".join(["jumpcad", name, *arguments, "[OPTIONS]"])
    paragraphs = re.sub(r"[ \t]*\n[ \t]*", "\n", command.help.strip())
    return "\n\n".join(
        [f"## jumpcad {name}", f"```text\n{usage}\n```", paragraphs, table(("", "meaning", "default"), rows)]
    )


def _words(parameter: Any) -> list[str]:
    """Return the names of an option with the word for its value, or that of an argument."""
    value = parameter.metavar or parameter.name.upper()
    if parameter.param_type_name == "argument":
        return [value]
    names = [*parameter.opts, *parameter.secondary_opts]
    return names if parameter.is_flag else [*names[:-1], f"{names[-1]} {value}"]


def _default(parameter: Any) -> str:
    shown = getattr(parameter, "show_default", None)
    if isinstance(shown, str):
        return shown
    default = parameter.default
    if callable(default) or default is None or default is False or default == () or parameter.required:
        return "required" if parameter.required else ""
    return f"`{default}`"


# Workshop


def workshop_keys() -> str:
    """Return the page of every key of a workshop: unit, limits, default, and the source that the default has."""
    schema, default = Workshop.model_json_schema(), load_workshop("default").model_dump()
    comments = _comments(find_template("workshops", "default").read_text(encoding="utf-8"))
    blocks = []
    for name, entry in schema["properties"].items():
        kind = _definition(schema, entry)
        if name in OWN_PARTS:
            blocks.append(_own_part(name, kind))
        elif name == "materials":
            for material, values in default[name].items():
                text = find_template("materials", material.lower()).read_text(encoding="utf-8")
                blocks.append(_section(f"materials.{material}", kind, values, _comments(text)))
        elif name == "printer":
            blocks.append(_section(name, kind, default[name], {}))
        elif "properties" in kind:
            own = {key: comment for (section, key), comment in comments.items() if section == name}
            blocks.append(_section(name, kind, default[name], {("", key): text for key, text in own.items()}))
        else:
            blocks.append(f"## [{name}]\n\nThe beginning of an article's name, and the price of one piece (EUR).")
    words = (
        "Every key, what it may be, its value in the workshop `default`, and where that value comes from. "
        "How workshops are written: [Workshop](../workshop.md)."
    )
    return page("Workshop keys", words, *blocks)


def _definition(schema: dict[str, Any], entry: dict[str, Any]) -> dict[str, Any]:
    """Return the table that an entry refers to, itself or in a mapping."""
    for place in (entry, entry.get("additionalProperties", {})):
        if isinstance(place, dict) and "$ref" in place:
            return dict(schema["$defs"][place["$ref"].rsplit("/", 1)[1]])
    return entry


def _section(name: str, kind: dict[str, Any], values: dict[str, Any], comments: dict[tuple[str, str], str]) -> str:
    rows = [
        (f"`{key}`", _unit(key), _allowed(entry), _value(values.get(key)), comments.get(("", key), ""))
        for key, entry in kind["properties"].items()
    ]
    head = ("key", "unit", "allowed", "default", "meaning or source")
    return f"## [{name}]\n\n{_description(kind)}\n\n{table(head, rows)}"


def _own_part(name: str, kind: dict[str, Any]) -> str:
    required = set(kind.get("required", ()))
    rows = [
        (f"`{key}`", _unit(key), _allowed(entry), "yes" if key in required else "")
        for key, entry in kind["properties"].items()
        if key != "name"
    ]
    return f"## [{name}.NAME]\n\n{_description(kind)}\n\n{table(('key', 'unit', 'allowed', 'required'), rows)}"


def _description(kind: dict[str, Any]) -> str:
    return "\n".join(line.strip() for line in kind.get("description", "").splitlines())


def _unit(key: str) -> str:
    return next((unit for end, unit in UNITS.items() if key.endswith(f"_{end}")), "")


def _allowed(entry: dict[str, Any]) -> str:
    if "anyOf" in entry:
        return " or ".join(dict.fromkeys(_allowed(one) for one in entry["anyOf"] if one.get("type") != "null"))
    if values := entry.get("enum") or ([entry["const"]] if "const" in entry else []):
        return ", ".join(f"`{value}`" for value in values)
    if "prefixItems" in entry:
        return f"{len(entry['prefixItems'])} numbers, each {_allowed(entry['prefixItems'][0])}"
    if "minimum" in entry or "maximum" in entry:
        whole = "whole, " if entry.get("type") == "integer" else ""
        return f"{whole}{entry['minimum']:g} to {entry['maximum']:g}"
    return {"string": "text", "array": "list of names", "object": "table"}.get(entry.get("type", ""), "")


def _value(value: Any) -> str:
    if value is None or value == {}:
        return ""
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def _comments(text: str) -> dict[tuple[str, str], str]:
    """Return the comments of a TOML file's keys, by section and key."""
    found: dict[tuple[str, str], str] = {}
    section, last = "", None
    for line in text.splitlines():
        if heading := re.match(r"\[([\w.]+)\]", line):
            section, last = heading[1], None
        elif entry := re.match(r"(\w+)\s*=\s*(?:\"[^\"]*\"|[^#\"])*(?:#\s*(.*))?$", line):
            last = (section, entry[1])
            found[last] = entry[2] or ""
        elif last and (more := re.match(r"\s+#\s*(.*)", line)):
            found[last] += f" {more[1]}"
    return found


# Checks


def check_glossary() -> str:
    """Return the page of all checks: what each found in the example, what it compares, and what to change."""
    robot = jumpcad.build(jumpcad.load_design(EXAMPLE))
    quick = [*_templates(), *_variants()]
    found: dict[str, list[Finding]] = {}
    for check in checks.CHECKS:
        subjects = [robot, *quick] if check.cheap else [robot]
        found.setdefault(check.find.__module__, []).extend(chain.from_iterable(map(check.find, subjects)))
    met = {finding.name for finding in chain.from_iterable(found.values())}
    listed = re.findall(r"\b[a-z]+(?:_[a-z]+)*(?=,|;|\.$)", (checks.__doc__ or "").split("by module:")[1])
    missing = [f"`{name}`" for name in listed if name not in met]
    words = (
        f"Every limit that `jumpcad check` knows. The column “found” is what it says of `{EXAMPLE}` in the default "
        "workshop, or of the first template or other workshop that has the limit: figures show what is compared. The "
        "remedy is what it advises where the limit is violated, with figures of that robot. Formula and source are in "
        "the module named, and in those that it imports."
    )
    rest = f"Not met in any of these robots, since they are reported only where they fail: {', '.join(missing)}."
    blocks = [_checks_of(module, findings) for module, findings in found.items()]
    return page("Checks", words, *blocks, *([rest] if missing else []))


def _templates() -> Iterator[Mechanism]:
    for name in template_names("robots"):
        yield jumpcad.build(jumpcad.load_design(name))


def _variants() -> Iterator[Mechanism]:
    with tempfile.TemporaryDirectory() as folder:
        for variant, name in VARIANTS.items():
            path = Path(folder) / "variant.toml"
            path.write_text(variant, encoding="utf-8")
            yield jumpcad.build(jumpcad.load_design(name), load_workshop(path))


def _first_of_each(findings: Iterable[Finding]) -> Iterator[Finding]:
    seen = set()
    for finding in findings:
        if finding.name not in seen:
            seen.add(finding.name)
            yield finding


def _checks_of(module: str, findings: list[Finding]) -> str:
    doc = (sys.modules[module].__doc__ or "").strip()
    rows = [(f"`{one.name}`", one.unit, one.message, one.remedy) for one in _first_of_each(findings)]
    heading = f"## `{module.replace('.', '/')}.py`"
    return "\n\n".join([heading, doc, *([table(("check", "unit", "found", "remedy"), rows)] if rows else [])])


# Files and JSON


def files_and_json() -> str:
    """Return the page of a bundle's files, its manifest, and the JSON documents of commands."""
    with tempfile.TemporaryDirectory() as folder:
        built = _json("build", EXAMPLE, "-o", f"{folder}/bundle", "--no-pictures")
        manifest = json.loads((Path(folder) / "bundle" / "manifest.json").read_text(encoding="utf-8"))
        documents = {
            f"jumpcad build {EXAMPLE} --json": built,
            f"jumpcad simulate {EXAMPLE} --json": _json("simulate", EXAMPLE),
            f"jumpcad check {EXAMPLE} --json": _json("check", EXAMPLE),
            "jumpcad verify BUNDLE --json": _json("verify", f"{folder}/bundle"),
            "jumpcad slice BUNDLE --json": _slice_document(Path(folder) / "bundle"),
            "jumpcad coupon --json": _json("coupon", "-o", f"{folder}/coupon"),
            "jumpcad list engines --json": _json("list", "engines"),
            **_search_documents(folder),
            "jumpcad calibrate kenan-1.0 --predict kenan-2.0 --json": _calibration_document(),
        }
    folders = Counter(_folder(name) for name in manifest["files"])
    lines = [(f"`{name}`", str(count) if name.endswith("*") else "") for name, count in sorted(folders.items())]
    formats = [
        (f"`{one.name}`", _first_line(getmodule(one.files).__doc__), "on request" if one.optional else "")
        for one in EXPORTERS
    ]
    words = (
        f"From a build of `{EXAMPLE}` without pictures, and from small searches of the capsule robot. `…[]` is one "
        "element of a list, `*` any name. A name's end is its unit: `_m`, `_kg`, `_j`, `_nm`, `_s`, `_deg` and so on. "
        "Later versions may add fields."
    )
    head = ("field", "type", "meaning")
    return page(
        "Files and JSON", words,
        "## Files of a bundle", table(("path", "files"), lines),
        "## Formats", table(("exporter", "what it writes", ""), formats),
        "## manifest.json", table(head, _meant(manifest)),
        *(f"## {name}\n\n{table(head, _meant(data))}" for name, data in documents.items()),
    )  # fmt: skip


def _search_documents(folder: str) -> dict[str, Any]:
    """Return the documents of small searches of the capsule robot."""
    small = ("--model", "capsule", "--workers", "0")
    study = ("--study", f"{folder}/s.db")
    found = _json("optimize", *small, "--evaluations", "12", "--seed", "0", *study, "-o", f"{folder}/w.toml")
    documents = {"jumpcad optimize --json": found, "jumpcad study F.db --json": _json("study", f"{folder}/s.db")}
    views = {"sweep": ("--points", "2"), "pca": ("--samples", "20"), "importance": ("--samples", "100"),
             "feasibility": ("--points", "2")}  # fmt: skip
    return documents | {
        f"jumpcad explore {view} --json": _json("explore", view, *small, *more) for view, more in views.items()
    }


def _slice_document(folder: Path) -> Any:
    """Return the document of a sliced bundle, with one part that nobody sliced: the slicer takes a minute."""
    part, plate = SlicedPart("foot", "PETG", 1, 10.0, 10.0, 3600.0), SlicedPlate("plate-1-PETG", "PETG", 10.0, 3600.0)
    ignored = {"infill_every_layers": ("1", "2")}
    found = SlicedBundle(open_bundle(folder), "2.5.0", load_workshop(), True, (part,), (plate,), ignored)
    return slice_facts(folder, found, None)


def _calibration_document() -> Any:
    """Return the document of a calibration on coarse jumps with short chains."""
    coarse = ((0.45, 0.7, 1.0, 1.6, 2.5), (0.0, 0.9), (0.3, 0.5, 0.65, 1.0))
    with (
        patch.object(surface.surface_of, "__defaults__", (None, coarse)),
        patch.object(posterior.sampled, "__defaults__", (0, 200, 200, 10)),
    ):
        return _json("calibrate", "kenan-1.0", "--predict", "kenan-2.0")


def _meant(data: Any) -> list[tuple[str, str, str]]:
    """Return path, type and meaning of all fields."""
    return [(f"`{path}`", kind, meaning(path)) for path, kind in _fields(data)]


def _json(*arguments: str) -> Any:
    """Return the JSON document of a command."""
    with redirect_stdout(io.StringIO()) as said:
        code = run([*arguments, "--json"])
    if code:
        raise SystemExit(f"jumpcad {' '.join(arguments)} ends with {code}")
    return json.loads(said.getvalue())


def _folder(name: str) -> str:
    path = Path(name)
    stem = "NAME" if path.stem.split(".loop")[0] == EXAMPLE else None
    if stem:
        return str(path.with_name(path.name.replace(EXAMPLE, "NAME")))
    return f"{path.parent}/*" if path.parts[0] in ("stl", "dxf", "urdf", "print", "order") else name


def _first_line(doc: str | None) -> str:
    return (doc or "").strip().split("\n\n")[0].replace("\n", " ")


def _fields(data: Any, prefix: str = "") -> list[tuple[str, str]]:
    """Return the paths of all fields with their types; in a mapping of names to like things one stands for all."""
    if isinstance(data, list):
        merged: dict[str, str] = {}
        for one in data:
            merged |= dict(_fields(one, f"{prefix}[]")) if isinstance(one, dict | list) else {}
        return list(merged.items())
    rows: dict[str, str] = {}
    for key, value in _one_of_many(data, prefix.rpartition(".")[2]).items():
        path = f"{prefix}.{key}" if prefix else key
        deeper = (isinstance(value, dict) and value) or (
            isinstance(value, list) and value and isinstance(value[0], dict)
        )
        rows |= dict(_fields(value, path)) if deeper and key not in WHOLE else {path: _type(value)}
    return list(rows.items())


def _one_of_many(data: dict[str, Any], name: str) -> dict[str, Any]:
    """Return data, or for a mapping of names that are no fields its first value under `*`."""
    fields = all(re.fullmatch(r"[a-z][a-z0-9_]*", key) for key in data) and name not in MAPPINGS
    alike = (
        len({json.dumps(sorted(value)) if isinstance(value, dict) else _type(value) for value in data.values()}) == 1
    )
    return {"*": next(iter(data.values()))} if data and (name in MAPPINGS or (alike and not fields)) else data


def _type(value: Any) -> str:
    if isinstance(value, list):
        return f"list of {_type(value[0])}" if value else "list"
    words = {
        "bool": "true or false",
        "int": "number",
        "float": "number",
        "str": "text",
        "NoneType": "null",
        "dict": "{}",
    }
    return words[type(value).__name__]


PAGES = {
    "reference/commands.md": commands,
    "reference/workshop.md": workshop_keys,
    "reference/checks.md": check_glossary,
    "reference/files.md": files_and_json,
    DRAWING: lambda: parameter_drawing(jumpcad.load_design(EXAMPLE)),
}
"""Every file that this program writes, under `docs`, and what returns its content."""


def main(arguments: list[str] | None = None) -> int:
    """Compare or write all pages; return the exit code."""
    write = "--write" in (sys.argv[1:] if arguments is None else arguments)
    stale = []
    for name, content in PAGES.items():
        path, text = DOCS / name, content()
        if write:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            stale.append(f"docs/{name}: not what the program gives; run python benchmarks/reference.py --write")
    print("\n".join(stale) or "every reference page is what the program gives")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
