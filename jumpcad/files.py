"""Reading the TOML files that users edit, with errors that name file, line, key, value and limit."""

import difflib
import importlib.resources
import os
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Self

import tomli_w
from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from jumpcad.errors import JumpcadError

Contradiction = tuple[tuple[str, ...], Any, str]
"""Where a value stands, the value, and what is wrong with it."""


class Section(BaseModel):
    """A validated group of values: no unknown keys, no NaN, no guessing of types, immutable."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True, strict=True)


class Record(Section):
    """A `Section` that users make by name, in Python or as a TOML file; errors are `JumpcadError`."""

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
            if wrong := list(self.contradictions()):
                raise ValidationError.from_exception_data(type(self).__name__, [_line_error(*item) for item in wrong])
        except ValidationError as error:
            raise JumpcadError("; ".join(_complaints(error, type(self)))) from error

    def contradictions(self) -> Iterable[Contradiction]:
        """Return values that are allowed alone but not together."""
        return ()

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
                raise JumpcadError("; ".join(_complaints(error.__cause__, cls, source, text))) from None
            raise


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Return the parsed TOML file and its text."""
    try:
        text = path.read_text(encoding="utf-8")
        return tomllib.loads(text), text
    except FileNotFoundError:
        raise JumpcadError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise JumpcadError(f"{path}: is a folder, not a TOML file") from None
    except PermissionError:
        raise JumpcadError(f"{path}: may not be read (permission denied)") from None
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise JumpcadError(f"{path}: not a text file in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise JumpcadError(f"{path}: not valid TOML: {error}") from None


def to_toml(data: dict[str, Any]) -> str:
    """Return `data` as TOML text; the same data gives the same text."""
    return tomli_w.dumps(data)


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
    if text.endswith(".toml") or os.path.dirname(text):
        return Path(text)
    names = template_names(kind)
    if text in names:
        return templates_folder() / kind / f"{text}.toml"
    if os.path.isfile(text):
        return Path(text)
    raise JumpcadError(
        f"{text!r} is neither a TOML file nor one of the {kind} {', '.join(names)}{did_you_mean(text, names)}"
    )


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return a hint at the nearest known word, or nothing."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f" (did you mean {near[0]}?)" if near else ""


def _line_error(location: tuple[str, ...], value: Any, reason: str) -> InitErrorDetails:
    message = reason.replace("{", "{{").replace("}", "}}")
    return InitErrorDetails(type=PydanticCustomError("value_error", message), loc=location, input=value)


def _complaints(error: ValidationError, model: type[BaseModel], source: str = "", text: str = "") -> list[str]:
    """Return one clause a bad key: `file:line: key = value: what is wrong`."""
    clauses = []
    for item in error.errors():
        location = tuple(str(step) for step in item["loc"])
        key = ".".join(location) or model.__name__
        if item["type"] == "extra_forbidden":
            clause = f"{key}: unknown key{did_you_mean(location[-1], _known_keys(model, location[:-1]))}"
        elif item["type"] == "missing":
            clause = f"{key}: missing"
        elif not location:  # a validator that speaks of the whole record
            clause = _reason(item)
        else:
            clause = f"{key} = {_shown(item['input'])}: {_reason(item)}"
        clauses.append(_place(source, text, location) + clause)
    return clauses


def _reason(item: Any) -> str:
    context = item.get("ctx", {})
    limits = {
        "greater_than": ("must be more than", "gt"),
        "greater_than_equal": ("must be at least", "ge"),
        "less_than": ("must be less than", "lt"),
        "less_than_equal": ("must be at most", "le"),
    }
    if item["type"] in limits:
        words, bound = limits[item["type"]]
        return f"{words} {context[bound]:g}"
    if item["type"] == "finite_number":
        return "must be a finite number"
    reason = str(item["msg"]).removeprefix("Value error, ").removeprefix("Input should be ")
    return reason if item["type"] == "value_error" else f"must be {reason}"


def _shown(value: Any) -> str:
    shown = repr(value)
    return shown if len(shown) <= 60 else shown[:57] + "..."


def _known_keys(model: type[BaseModel], location: tuple[str, ...]) -> list[str]:
    """Return the keys known at a nested location of a model."""
    for step in location:
        field = model.model_fields.get(step)
        annotation = field.annotation if field else None
        if not (isinstance(annotation, type) and issubclass(annotation, BaseModel)):
            return []
        model = annotation
    return list(model.model_fields)


def _place(source: str, text: str, location: tuple[str, ...]) -> str:
    """Return `file:line: ` of a key in a TOML text, or as much of that as is known."""
    if not source:
        return ""
    section = ""
    for number, line in enumerate(text.splitlines(), start=1):
        header = re.match(r"\s*\[\[?\s*([^\]]+?)\s*\]\]?", line)
        if header:
            section = header.group(1) + "."
        entry = re.match(r"\s*([\w.\"-]+)\s*=", line)
        if entry and section + entry.group(1).strip('"') == ".".join(location):
            return f"{source}:{number}: "
    return f"{source}: "
