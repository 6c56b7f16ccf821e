"""Error messages about wrong values in users' files: one clause per key, `MOST_NAMED` at most."""

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:  # for did_you_mean alone, pydantic takes too long
    from pydantic import BaseModel, ValidationError

MOST_NAMED = 10
"""Largest number of keys that are named; the others are counted."""
LONGEST = 60
"""Largest number of characters of a value that are shown."""
LIMITS = {
    "greater_than": ("must be more than", "gt"),
    "greater_than_equal": ("must be at least", "ge"),
    "less_than": ("must be less than", "lt"),
    "less_than_equal": ("must be at most", "le"),
}
OF_A_TABLE = ("model_type", "model_attributes_type", "dict_type")
OF_A_LIST = ("tuple_type", "list_type")


class Origin(NamedTuple):
    """A TOML file of which a record was made: its path, text and values, and the table that it is the content of."""

    path: str
    text: str
    data: Mapping[str, Any]
    table: str = ""


def complaints(
    error: "ValidationError", model: "type[BaseModel]", source: str = "", text: str = "", origins: Sequence[Origin] = ()
) -> list[str]:
    """Return one clause per wrong key, `file:line: key = value: what is wrong`, for the first ten of them.

    Lines are looked up in the TOML text of `source`, or of the first of `origins` that has the key.
    """
    items = error.errors(include_url=False)
    wrong = {item["loc"][:depth] for item in items for depth in range(len(item["loc"]))}
    items = [item for item in items if item["loc"] not in wrong]  # a list lacks what is wrong in it
    files = origins or [Origin(source, text, {})]
    lines = [_lines(one.text) for one in files]
    clauses = []
    for item in items[:MOST_NAMED]:
        location = tuple(str(step) for step in item["loc"] if step != "[key]")
        keys = location[:-1] if item["type"] == "missing" else location
        holds = (at for at, one in enumerate(files) if (_holds(one.data, keys) if keys else not one.table))
        at = next(holds, 0)
        line, file = lines[at].get(".".join(keys).removeprefix(f"{files[at].table}.")), files[at].path
        place = "" if not file else f"{file}: " if line is None else f"{file}:{line}: "
        clauses.append(place + _clause(item, location, model))
    if len(items) > MOST_NAMED:
        clauses.append(f"and {len(items) - MOST_NAMED} more")
    return clauses


def _holds(data: Any, keys: Sequence[str]) -> bool:
    for key in keys:
        if not isinstance(data, Mapping):  # in a list
            return True
        if key not in data:
            return False
        data = data[key]
    return True


def place(source: str, text: str, key: str) -> str:
    """Return the place of a dotted key in the TOML text of the file `source`: `file:line`, or the file alone."""
    line = _lines(text).get(key)
    return source if line is None else f"{source}:{line}"


def did_you_mean(word: str, known: Iterable[str], alike: float = 0.6) -> str:
    """Return a hint at the most similar known word, by its letters in whatever case, or nothing."""
    words = {one.casefold(): one for one in known}
    near = difflib.get_close_matches(word[:LONGEST].casefold(), list(words), n=1, cutoff=alike)
    return f" (did you mean {words[near[0]]}?)" if near else ""


def shown(value: Any) -> str:
    """Return a value as text for one line: quoted if it is text, without control characters, and shortened."""
    try:
        text = " ".join(repr(value).split()) if not isinstance(value, str) else repr(value)
    except (ValueError, RecursionError):  # more than 4300 digits, or a value that contains itself
        return "a value too long to show"
    except Exception:  # from a user's class
        return "a value that cannot be shown"
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."


def described(value: Any) -> str:
    """Return a value and its type, short enough for one line."""
    return f"{shown(value)} ({type(value).__name__[:LONGEST]})" if value is not None else "None"


MISSING = {"source": ": say where the figures come from", "mass_g": ": weigh it, or take the maker's figure"}
"""What to do about keys that own parts need most."""


def _clause(item: Any, location: tuple[str, ...], model: "type[BaseModel]") -> str:
    key = ".".join(_step(step) for step in location) or model.__name__
    if item["type"] == "extra_forbidden":
        return f"{key}: unknown key{did_you_mean(location[-1], _known_keys(model, location[:-1]))}"
    if item["type"] == "missing":
        return f"{key}: missing{MISSING.get(location[-1], '')}"
    if not location:  # a validator of the whole record
        return _reason(item, location, model)
    if item["loc"][-1] == "[key]":
        return f"{key}: {_reason(item, location, model)}"
    return f"{key} = {shown(item['input'])}: {_reason(item, location, model)}"


def _step(name: str) -> str:
    """Return a key's name as text: without quotes if it is short and printable."""
    return name if name and name.isprintable() and len(name) <= LONGEST else shown(name)


def _reason(item: Any, location: tuple[str, ...], model: "type[BaseModel]") -> str:
    kind, context = item["type"], item.get("ctx", {})
    if kind in LIMITS:
        words, bound = LIMITS[kind]
        return f"{words} {context[bound]:g}"
    if kind in OF_A_TABLE:
        keys = _known_keys(model, location)
        some = ", ".join(keys[:MOST_NAMED]) + ", …" * (len(keys) > MOST_NAMED)
        return f"must be a table: [{'.'.join(map(_step, location))}]{' with ' * bool(keys)}{some}"
    if kind in OF_A_LIST:
        return "must be a list"
    if kind in ("too_long", "too_short"):
        count = f"at most {context['max_length']}" if kind == "too_long" else f"at least {context['min_length']}"
        return f"must have {count} values, not {context['actual_length']}"
    if kind == "finite_number":
        return "must be a finite number"
    reason = str(item["msg"]).removeprefix("Value error, ").removeprefix("Input should be ")
    return reason if kind == "value_error" else f"must be {reason}"


def _known_keys(model: "type[BaseModel]", location: tuple[str, ...]) -> list[str]:
    """Return the keys known at a nested location of a model."""
    annotation: Any = model
    for step in location:
        if _is_model(annotation):
            field = annotation.model_fields.get(step)
            annotation = field.annotation if field else None
        else:  # a table whose keys the user chooses: the type of its values
            annotation = (getattr(annotation, "__args__", None) or (None,))[-1]
    fields = annotation.model_fields if _is_model(annotation) else {}
    return [name for name, field in fields.items() if not field.exclude]


def _is_model(annotation: Any) -> bool:
    from pydantic import BaseModel

    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _lines(text: str) -> dict[str, int]:
    """Return the line number of each key of a TOML text, for keys that begin a line."""
    section = ""
    found: dict[str, int] = {}
    for number, line in enumerate(text.split("\n"), start=1):
        if header := re.match(r"\s*\[\[?([^\]]*)\]", line):
            section = header[1].strip().replace('"', "") + "."
            found.setdefault(section[:-1], number)
        elif entry := re.match(r"""\s*("[^"]*"|[\w."-]+)\s*=""", line):
            found.setdefault(section + entry[1].replace('"', ""), number)
    return found
