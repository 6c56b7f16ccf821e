"""What a tree of files holds, what changed in it, and whether what was written can be read by others."""

import ast
import csv
import io
import json
import os
import re
import stat
import zipfile
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from xml.parsers import expat

CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
"""Characters that no text may hold: all control characters but tab and line feed, line separators, surrogates."""
FORMULA = re.compile(r"\s*[=+\-@]")
"""Beginning of a cell that a spreadsheet computes."""
TEXTS = (".csv", ".html", ".json", ".md", ".py", ".sdf", ".svg", ".toml", ".urdf", ".xml")
XMLS = (".html", ".sdf", ".svg", ".urdf", ".xml")


@dataclass(frozen=True)
class State:
    """What a path is: its kind, permissions, content or target, and when it was changed (ns; files only)."""

    kind: str
    mode: int
    content: bytes | str = ""
    changed_ns: int = 0


Snapshot = dict[str, State]
"""State by path relative to the root."""


def snapshot(root: Path) -> Snapshot:
    """Return the state of everything in a tree; links are not followed."""
    found: Snapshot = {}
    folders = [""]
    while folders:
        above = folders.pop()
        with os.scandir(f"{root}/{above}") as entries:
            for entry in entries:
                found[f"{above}{entry.name}"] = state = _state(entry)
                if state.kind == "folder":
                    folders.append(f"{above}{entry.name}/")
    return found


def _state(entry: os.DirEntry[str]) -> State:
    status = entry.stat(follow_symlinks=False)
    mode = stat.S_IMODE(status.st_mode)
    if stat.S_ISLNK(status.st_mode):
        return State("link", mode, os.readlink(entry.path))
    if stat.S_ISREG(status.st_mode):
        with open(entry.path, "rb", buffering=0) as file:
            return State("file", mode, file.read(), status.st_mtime_ns)
    return State("folder" if stat.S_ISDIR(status.st_mode) else "device", mode)


def changes(before: Snapshot, after: Snapshot, allowed: Collection[str], kept: Collection[str]) -> Iterator[str]:
    """Yield what was made, changed or removed outside of the allowed places, or within the kept ones."""
    for name in sorted(before.keys() | after.keys()):
        if _lies_in(name, allowed) and not _lies_in(name, kept):
            continue
        if name not in before:
            yield f"made {name!a}"
        elif name not in after:
            yield f"removed {name!a}"
        elif before[name] != after[name]:
            yield f"changed {name!a}"


def _lies_in(name: str, places: Collection[str]) -> bool:
    return any(name == place or name.startswith(f"{place}/") for place in places)


@cache
def file_faults(suffix: str, content: bytes) -> list[str]:
    """Return why a file cannot be read as what its name says, or would run in its reader; known contents are known."""
    return list(_file_faults(suffix, content))


def _file_faults(suffix: str, content: bytes) -> Iterator[str]:
    try:
        if suffix == ".3mf":
            with zipfile.ZipFile(io.BytesIO(content)) as package:
                for name in package.namelist():
                    if name.endswith((".model", ".rels", ".xml")):
                        _read_xml(package.read(name))
        if suffix not in TEXTS:
            return
        text = content.decode("utf-8")
        if found := CONTROL.search(text):
            yield f"control character {found[0]!a}"
        if suffix == ".json":
            strict_json(text)
        elif suffix == ".csv":
            yield from formulas(text.removeprefix("\ufeff"))
        elif suffix == ".py":
            ast.parse(text)
        elif suffix in XMLS:
            _read_xml(text)
    except (ValueError, SyntaxError, expat.ExpatError, zipfile.BadZipFile, csv.Error) as error:
        yield f"{type(error).__name__}: {str(error)[:200]}"


def _read_xml(content: str | bytes) -> None:
    """Raise ExpatError where a document is not well-formed XML with known name spaces; no tree is made of it."""
    expat.ParserCreate(namespace_separator="}").Parse(content, True)


def formulas(text: str) -> Iterator[str]:
    """Yield the cells of a CSV table that a spreadsheet computes; signed numbers are not among them."""
    usual = csv.field_size_limit(10_000_000)
    try:
        rows = list(csv.reader(text.splitlines()))
    finally:
        csv.field_size_limit(usual)
    for row in rows:
        yield from (f"a formula: {cell[:60]!a}" for cell in row if FORMULA.match(cell) and not _is_number(cell))


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def strict_json(text: str) -> Any:
    """Return a JSON document; ValueError where it has NaN or an infinity, as Python alone reads them."""

    def refuse(name: str) -> None:
        raise ValueError(f"{name} is no JSON")

    return json.loads(text, parse_constant=refuse)
