"""Reads files that need not be trusted: regular files of limited size and depth; errors are one line. Writes tables."""

import csv
import io
import json
import os
import re
import stat
import tomllib
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files.complaints import shown

LARGEST_BYTES = 1 << 20
"""Size of the largest file that is read; those of this program have some kilobytes."""
DEEPEST = 20
"""Largest number of nested tables and lists; files of this program have four."""
NESTED = f"nested deeper than {DEEPEST} levels"
MOST_DOTS = 200
DECIMAL = re.compile(r"(?<=[\[,\s])[-+]?\d+\.\d+(?=\s*[],])")
"""A number in a list; in keys there are none before a comma or a bracket."""
FORMULA = ("=", "+", "-", "@", "\t", "\n", "＝", "＋", "－", "＠")
"""First characters of formulas (OWASP, CSV injection), also in full-width form."""
BOM = "\ufeff"
"""Byte order mark: without it, Excel on Windows reads a file in the system's old character set."""


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Return the parsed TOML file and its text."""
    text = read_text(path, "a TOML file")
    for number, line in enumerate(text.split("\n"), start=1):
        # Parsing time grows with the square of the number of a key's parts; no useful line has so many dots.
        keys = DECIMAL.sub("", line) if line.count(".") > MOST_DOTS and not line.lstrip().startswith("#") else ""
        if keys.count(".") > MOST_DOTS:
            raise JumpcadError(f"{path}: line {number} has more than {MOST_DOTS} dots, more than any key has")
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise JumpcadError(f"{path}: not valid TOML: {error}") from None
    except ValueError:
        raise JumpcadError(f"{path}: not valid TOML: holds an integer of more digits than can be read") from None
    except RecursionError:
        raise JumpcadError(f"{path}: {NESTED}") from None
    _require_shallow(data, path)
    return data, text


def read_json(path: Path) -> Any:
    """Return the content of a JSON file."""
    try:
        data = json.loads(read_text(path, "a JSON file"), parse_constant=_no_constant)
    except ValueError as error:
        raise JumpcadError(f"{path}: not valid JSON: {str(error).partition(';')[0]}") from None
    except RecursionError:
        raise JumpcadError(f"{path}: {NESTED}") from None
    _require_shallow(data, path)
    _require_writable_again(data, path)
    return data


def read_text(path: Path, kind: str = "a text file") -> str:
    """Return the text of a file in UTF-8, with line feeds as line breaks; for `kind` see `read_bytes`."""
    try:
        return read_bytes(path, kind).decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise JumpcadError(f"{path}: not a text file in UTF-8") from None


def read_bytes(path: Path, kind: str = "a file", most: int = LARGEST_BYTES) -> bytes:
    """Return the content of a regular file of moderate size; `kind` says what it should be, such as `a TOML file`."""
    try:
        there = os.stat(path)  # before it is opened, since some devices act then
        mode = there.st_mode
        if stat.S_ISDIR(mode):
            raise JumpcadError(f"{path}: is a folder, not {kind}")
        if not stat.S_ISREG(mode):
            raise JumpcadError(f"{path}: is a pipe or a device, not {kind}")
        data: bytes | None = None
        blocks = os.statvfs(path).f_blocks if hasattr(os, "statvfs") else 1
        if there.st_size or blocks:  # what has neither is no stored file, as in /proc, where opening may do something
            with open(path, "rb", opener=_open_at_once) as stream:
                data = stream.read(most + 1)  # None: it waits for more
                size = os.fstat(stream.fileno()).st_size
        if data is not None and len(data) > most:
            raise JumpcadError(f"{path}: is larger than {most >> 20} MiB, too large for {kind}")
        if data is None or len(data) != size:  # as in /proc and /sys, which have no sizes
            raise JumpcadError(f"{path}: is made by the system as it is read, or still being written: not {kind}")
        return data
    except FileNotFoundError:
        raise JumpcadError(f"{path}: no such file") from None
    except PermissionError:
        raise JumpcadError(f"{path}: may not be read (permission denied)") from None
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError:
        raise JumpcadError(f"{shown(str(path))} cannot be the name of a file") from None


def _open_at_once(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no number")


def _require_writable_again(data: Any, path: Path) -> None:
    """Raise `JumpcadError` for what JSON allows, but cannot be written again: lone surrogates, numbers like 1e999."""
    try:
        json.dumps(data, ensure_ascii=False, allow_nan=False).encode()
    except UnicodeEncodeError:
        raise JumpcadError(f"{path}: not valid JSON: half of a character (a lone surrogate)") from None
    except ValueError:
        raise JumpcadError(f"{path}: not valid JSON: a number is too large") from None


def _require_shallow(data: Any, path: Path) -> None:
    """Raise `JumpcadError` for data that are nested deeper than `DEEPEST`: recursive functions use them."""
    level = [data]
    for _ in range(DEEPEST):
        level = [
            item
            for outer in level
            if isinstance(outer, dict | list)
            for item in (outer.values() if isinstance(outer, dict) else outer)
        ]
    if level:
        raise JumpcadError(f"{path}: {NESTED}")


def to_toml(data: dict[str, Any]) -> str:
    """Return `data` as TOML text; the same data gives the same text."""
    import tomli_w  # the command line's help writes nothing

    return tomli_w.dumps(data)


def to_csv(rows: Iterable[Sequence[object]]) -> str:
    """Return rows as CSV; the first is the heading. Text that would be a formula is preceded by an apostrophe.

    A table with other characters than ASCII begins with a byte order mark: read it as `utf-8-sig`.
    """
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows([_cell(value) for value in row] for row in rows)
    text = stream.getvalue()
    return text if text.isascii() else BOM + text


def _cell(value: object) -> object:
    """Return a value that is safe in a cell; numbers, also those given as text, stay as they are."""
    if not isinstance(value, str):
        return value
    with suppress(ValueError):
        float(value)
        return value
    text = value.replace("\r\n", "\n").replace("\r", "\n")  # a lone \r is not quoted, and would begin another row
    text = without_controls(text, "[\n\t]")
    return f"'{text}" if text.startswith(FORMULA) else text
