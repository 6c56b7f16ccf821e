"""The page of a bundle's files and of the JSON documents of commands."""

import io
import json
import re
import tempfile
from collections import Counter
from contextlib import redirect_stdout
from dataclasses import asdict
from functools import partial
from inspect import getmodule
from pathlib import Path
from typing import Any
from unittest.mock import patch

from field_words import meaning
from reference_page import EXAMPLE, page, table

from jumpcad.building.bom import SlicedPlate
from jumpcad.bundle.manifest import open_bundle
from jumpcad.bundle.sliced import SlicedBundle, SlicedPart
from jumpcad.calibration import posterior, surface
from jumpcad.cli.commands import run
from jumpcad.cli.printing import slice_facts
from jumpcad.exporters.registry import EXPORTERS
from jumpcad.landing import lightest_cage
from jumpcad.search.robust_pick import ActiveBound
from jumpcad.simulation import uncertain
from jumpcad.validation import table as validation_table
from jumpcad.validation.family import family
from jumpcad.workshop import load_workshop

MAPPINGS = {
    "design", "deviation", "first_order", "importance", "interval", "margins", "readings", "refused", "sweeps",
}  # fmt: skip
"""Fields that map names to like things, though their names look like fields."""
WHOLE, ELSEWHERE = {"differs", "units", "engines", "evaluated", "identity"}, {"studies"}
"""Mappings that are not taken apart, and lists of what another table has."""


def files_and_json() -> str:
    """Return the page of a bundle's files, its manifest, and the JSON documents of commands."""
    with tempfile.TemporaryDirectory() as folder:
        built = _json("build", EXAMPLE, "-o", f"{folder}/bundle", "--no-pictures")
        manifest = json.loads((Path(folder) / "bundle" / "manifest.json").read_text(encoding="utf-8"))
        documents = {
            "jumpcad new DESIGN.toml --json": _json("new", f"{folder}/design.toml"),
            f"jumpcad build {EXAMPLE} --json": built,
            f"jumpcad simulate {EXAMPLE} --uncertain --json": _uncertain_document(),
            f"jumpcad simulate {EXAMPLE} --engine both --json": _json("simulate", EXAMPLE, "--engine", "both"),
            f"jumpcad simulate {EXAMPLE} --published --json": _json("simulate", EXAMPLE, "--published"),
            "jumpcad simulate best-jumper --jumps 2 --json": _json("simulate", "best-jumper", "--jumps", "2"),
            "jumpcad reproduce --json": _json("reproduce"),
            f"jumpcad check {EXAMPLE} --json": _json("check", EXAMPLE),
            "jumpcad compare A B --json": _json("compare", EXAMPLE, "kenan-1.0", "-o", f"{folder}/c.html"),
            "jumpcad cage DESIGN --json": _cage_document(),
            "jumpcad variants DESIGN --json": _json("variants", EXAMPLE, "--count", "1", "-o", f"{folder}/variants"),
            "jumpcad verify BUNDLE --json": _json("verify", f"{folder}/bundle"),
            "jumpcad slice BUNDLE --json": _slice_document(Path(folder) / "bundle"),
            "jumpcad coupon --json": _json("coupon", "-o", f"{folder}/coupon"),
            f"jumpcad render {EXAMPLE} --json": _json("render", EXAMPLE, "-o", f"{folder}/pictures"),
            f"jumpcad report {EXAMPLE} --json": _json("report", EXAMPLE, "-o", f"{folder}/report.html"),
            "jumpcad list engines --json": _json("list", "engines"),
            **_search_documents(folder),
            "jumpcad calibrate kenan-1.0 --predict kenan-2.0 --json": _calibration_document(),
            "jumpcad validate --json": _validation_document(),
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
        "## manifest.json", table(head, _meant("manifest", manifest)),
        *(f"## {name}\n\n{table(head, _meant(_command(name), data))}" for name, data in documents.items()),
    )  # fmt: skip


def _search_documents(folder: str) -> dict[str, Any]:
    """Return the documents of small searches of the capsule robot."""
    small = ("--model", "capsule", "--workers", "0")
    study = ("--study", f"{folder}/s.db")
    found = _json("optimize", "ga", *small, "--evaluations", "24", "--seed", "0", *study, "-o", f"{folder}/w.toml")
    found["active_bounds"] = [asdict(ActiveBound("c_coef", "lower", 0.8, 0.78, -0.1))]  # this search ends on none
    several = ("--study", f"{folder}/t.db", "-o", f"{folder}/t.toml")
    seeds = _json("optimize", "ga", *small, "--evaluations", "24", "--seeds", "0:2", *several)
    documents = {
        "jumpcad optimize --json": found,
        "jumpcad optimize --seeds 0:2 --json": {"seeds": seeds["seeds"]},
        "jumpcad study F.db --json": _json("study", f"{folder}/s.db"),
        "jumpcad study F.db G.db --json": _json("study", f"{folder}/s.db", f"{folder}/s.db"),
    }
    views = {"sweep": ("--points", "2"), "pca": ("--samples", "20"), "importance": ("--samples", "100"),
             "feasibility": ("--points", "2")}  # fmt: skip
    return documents | {
        f"jumpcad explore {view} --json": _json("explore", view, *small, *more) for view, more in views.items()
    }


def _uncertain_document() -> Any:
    """Return the document of a jump with few samples of what is uncertain."""
    with patch.object(uncertain.uncertain_jump, "__defaults__", (0, 8)):
        return _json("simulate", EXAMPLE, "--uncertain")


def _cage_document() -> Any:
    """Return the document of a cage that is the first tried, and dropped once."""
    with patch.object(lightest_cage, "MOST", 1), patch.object(lightest_cage, "TRIES", 1):
        return _json("cage", "best-printable")


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


def _validation_document() -> Any:
    """Return the document of other robots, with few geometries and short flights."""
    few = partial(family, members=2, generations=0, draws=200)
    with patch.object(validation_table, "family", few), patch.object(validation_table, "DRAWS", 2):
        found = _json("validate")
    return found | {"robots": [one | {"figures": one["figures"][:1]} for one in found["robots"][:1]]}


def _command(heading: str) -> str:
    """Return the last word of a command, before names and options: `pca` of `jumpcad explore pca --json`."""
    return [word for word in heading.partition(" --")[0].split() if word.isalpha() and word.islower()][-1]


def _meant(command: str, data: Any) -> list[tuple[str, str, str]]:
    """Return path, type and meaning of all fields of a command's document."""
    return [(f"`{path}`", kind, meaning(f"{command}.{path}")) for path, kind in _fields(data)]


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
        whole = key in (WHOLE if isinstance(value, dict) else ELSEWHERE)
        rows |= dict(_fields(value, path)) if deeper and not whole else {path: _type(value)}
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
