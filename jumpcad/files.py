"""Reading the TOML files that users edit, with errors that name file, line, key, value and limit."""

import importlib.resources
import json
import os
import stat
import tomllib
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any, Self

import tomli_w
from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from jumpcad.arguments import described
from jumpcad.complaints import complaints, shown
from jumpcad.complaints import did_you_mean as did_you_mean
from jumpcad.errors import JumpcadError

Contradiction = tuple[tuple[str, ...], Any, str]
"""Where a value stands, the value, and what is wrong with it."""

LARGEST_BYTES = 1 << 20
"""Size of the largest file that is read; those of this program have some kilobytes."""
DEEPEST = 20
"""Levels of tables and lists that a file may have; those of this program have four."""
NESTED = f"nested deeper than {DEEPEST} levels"
MOST_DOTS = 200


class TomlTable(BaseModel):
    """A validated group of values: no unknown keys, no NaN, no guessing of types, immutable."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True, strict=True)


class Record(TomlTable):
    """A `TomlTable` that users make by name, in Python or as a TOML file; errors are `JumpcadError`."""

    def __init__(self, /, *unnamed: Any, **values: Any) -> None:
        if unnamed:
            first = next(iter(type(self).model_fields))
            raise JumpcadError(
                f"{type(self).__name__} takes its values by name, {type(self).__name__}({first}=…), "
                f"not {described(unnamed[0])}"
            )
        try:
            super().__init__(**values)
            if wrong := list(self.contradictions()):
                raise ValidationError.from_exception_data(type(self).__name__, [_line_error(*item) for item in wrong])
        except ValidationError as error:
            raise JumpcadError("; ".join(complaints(error, type(self)))) from error

    def contradictions(self) -> Iterable[Contradiction]:
        """Return values that are allowed alone but not together."""
        return ()

    def revalidated(self) -> Self:
        """Return the same record, validated anew: copies with changes, and changed dictionaries, never were.

        Raises
        ------
        JumpcadError
            If a value is out of range, of the wrong type, or contradicts another.
        """
        return type(self)(**self.model_dump(warnings=False))

    @classmethod
    def from_toml(cls, path: Path) -> Self:
        """Read a record from a TOML file; every bad key is named with its line, all at once."""
        data, text = read_toml(path)
        return cls.from_data(data, source=str(path), text=text)

    @classmethod
    def from_data(cls, data: dict[str, Any], source: str, text: str = "") -> Self:
        """Validate parsed data that came from `source`; `text` is searched for the lines of bad keys."""
        try:
            return cls(**data)
        except JumpcadError as error:
            if isinstance(error.__cause__, ValidationError):
                raise JumpcadError("; ".join(complaints(error.__cause__, cls, source, text))) from None
            raise


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Return the parsed TOML file and its text.

    Raises
    ------
    JumpcadError
        If it is no regular file, cannot be read, is too large, is no TOML, or is nested too deep.
    """
    text = read_text(path, "a TOML file")
    for number, line in enumerate(text.split("\n"), start=1):
        # Parsing takes time with the square of a key's parts, and no other line has so many dots.
        if line.count(".") > MOST_DOTS and not line.lstrip().startswith("#"):
            raise JumpcadError(f"{path}: line {number} has more than {MOST_DOTS} dots, more than any key or list has")
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
    """Return the content of a JSON file; NaN and infinity, which JSON does not have, are refused.

    Raises
    ------
    JumpcadError
        If it is no regular file, cannot be read, is too large, is no JSON, or is nested too deep.
    """
    try:
        data = json.loads(read_text(path, "a JSON file"), parse_constant=_no_constant)
    except ValueError as error:
        raise JumpcadError(f"{path}: not valid JSON: {str(error).partition(';')[0]}") from None
    except RecursionError:
        raise JumpcadError(f"{path}: {NESTED}") from None
    _require_shallow(data, path)
    return data


def read_text(path: Path, kind: str = "a text file") -> str:
    """Return the text of a file in UTF-8, for what it should be see `read_bytes`."""
    try:
        return read_bytes(path, kind).decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise JumpcadError(f"{path}: not a text file in UTF-8") from None


def read_bytes(path: Path, kind: str = "a file") -> bytes:
    """Return the content of a regular file of moderate size; `kind` says what it should be, such as `a TOML file`.

    What is looked at is the opened file, so nobody can exchange it in between; a pipe or a device does not block.

    Raises
    ------
    JumpcadError
        If it is no such file, or cannot be read.
    """
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags)
        try:
            status = os.fstat(descriptor)
            if stat.S_ISDIR(status.st_mode):
                raise IsADirectoryError
            if not stat.S_ISREG(status.st_mode):
                raise JumpcadError(f"{path}: is a pipe or a device, not {kind}")
            if status.st_size > LARGEST_BYTES:
                raise JumpcadError(f"{path}: is larger than {LARGEST_BYTES >> 20} MiB, too large for {kind}")
            with os.fdopen(descriptor, "rb", closefd=False) as stream:
                content = stream.read(status.st_size + 1)
        finally:
            os.close(descriptor)
    except FileNotFoundError:
        raise JumpcadError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise JumpcadError(f"{path}: is a folder, not {kind}") from None
    except PermissionError:
        raise JumpcadError(f"{path}: may not be read (permission denied)") from None
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError:
        raise JumpcadError(f"{shown(str(path))} cannot be the name of a file") from None
    if len(content) > status.st_size:
        raise JumpcadError(f"{path}: grows while it is read; try again")
    return content


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no number")


def _require_shallow(data: Any, path: Path) -> None:
    """Refuse data that are nested deeper than any file of this program; what works on them may call itself."""
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


def real_path(path: str | Path) -> Path:
    """Return where a path leads, all links followed; it need not exist.

    Raises
    ------
    JumpcadError
        If nothing can ever lie there: a loop of links, a name that is too long or has a NUL.
    """
    try:
        real = Path(path).resolve()
        real.exists()
    except (OSError, RuntimeError, ValueError) as error:
        raise JumpcadError(f"{path}: cannot be a path: {getattr(error, 'strerror', None) or error}") from None
    return real


def to_toml(data: dict[str, Any]) -> str:
    """Return `data` as TOML text; the same data gives the same text."""
    return tomli_w.dumps(data)


@cache
def templates_folder() -> Path:
    """Return the folder of the shipped templates, in an installed wheel or in a source tree."""
    package = Path(str(importlib.resources.files("jumpcad")))
    installed = package / "templates"
    return installed if installed.is_dir() else package.parent / "templates"


def template_names(kind: str) -> list[str]:
    """Return the names of the shipped templates of a kind (`robots`, `workshops`, …), sorted."""
    return sorted(path.stem for path in (templates_folder() / kind).glob("*.toml"))


def find_template(kind: str, name_or_path: str | Path) -> Path:
    """Return the TOML file that a template's name or a path stands for.

    A template's name without suffix or folder is the template, whatever lies in the current folder.
    """
    text = str(name_or_path)
    if "\0" in text:
        raise JumpcadError(f"{text!r}: cannot be a path: it has a NUL")
    if text.endswith(".toml") or os.path.dirname(text):
        return Path(text)
    names = template_names(kind)
    if text in names:
        return templates_folder() / kind / f"{text}.toml"
    if os.path.isfile(text):
        return Path(text)
    raise JumpcadError(
        f"{shown(text)} is neither a TOML file nor one of the {kind} {', '.join(names)}{did_you_mean(text, names)}"
    )


def _line_error(location: tuple[str, ...], value: Any, reason: str) -> InitErrorDetails:
    message = reason.replace("{", "{{").replace("}", "}}")
    return InitErrorDetails(type=PydanticCustomError("value_error", message), loc=location, input=value)
