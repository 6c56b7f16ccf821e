"""Checks what public functions are given; the error says in one line what they take.

Not by pydantic's `validate_call`, which cannot build a schema of a Robot.
"""

import dataclasses
import functools
import inspect
import numbers
import types
import typing
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar, cast

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import described, shown

P = ParamSpec("P")
R = TypeVar("R")

MADE_BY = {
    "Design": "jumpcad.load_design('kenan-2.0')",
    "Mechanism": "jumpcad.build('kenan-2.0')",
    "Robot": "jumpcad.build('kenan-2.0')",
    "Settings": "jumpcad.load_settings('default')",
    "Workshop": "jumpcad.load_workshop('default')",
}
WORDS = {
    "Mechanism": "a Robot", "str": "a text", "bool": "True or False", "Path": "a path", "int": "a whole number",
    "float": "a number", "Sequence": "a list", "Iterable": "a list", "Mapping": "a table", "Callable": "a function",
}  # fmt: skip
RANGES = {"seed": (0, 2**32 - 1), "count": (1, 100_000), "made": (0, 10_000), "points": (1, 1000),
          "samples": (1, 100_000), "tries": (1, 10_000)}  # fmt: skip
"""Least and largest whole number that arguments of these names may be; judgement: hours of work."""
_hints = functools.cache(typing.get_type_hints)


def check_arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that checks its arguments against its annotations before it runs.

    Annotations are classes, runtime protocols, `Any`, or these joined by `|`. A `float` may be an int, but no bool is a
    number. A number of another library, such as numpy's, becomes Python's. The items of sequences are checked too,
    those of mappings are not.
    """
    signature = inspect.signature(function)
    plain = [one.replace(annotation=inspect.Parameter.empty) for one in signature.parameters.values()]
    title = function.__qualname__.removesuffix(".__init__")

    @functools.wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            given = signature.bind(*args, **kwargs)
        except TypeError as error:
            raise JumpcadError(f"{title}{inspect.Signature(plain)}: {error}") from None
        given.arguments.update(_checked(title, given.arguments, _hints(function)))
        return cast(Callable[..., R], function)(*given.args, **given.kwargs)

    return checked


def check_fields(record: Any) -> None:
    """Check the fields of a dataclass against their annotations, as `check_arguments`; for its `__post_init__`."""
    given = {field.name: getattr(record, field.name) for field in dataclasses.fields(record) if field.init}
    _checked(type(record).__name__, given, _hints(cast(Hashable, type(record))))


def _checked(title: str, given: Mapping[str, Any], hints: Mapping[str, Any]) -> dict[str, Any]:
    found = {}
    for name, value in given.items():
        kinds = _kinds(hints.get(name, Any))
        if isinstance(value, numbers.Real) and not isinstance(value, int | float):
            if isinstance(value, numbers.Integral) and (int in kinds or float in kinds):
                value = int(value)
            elif float in kinds:
                value = float(value)
        if wrong := _misfit(value, kinds):
            names = [_name(kind) for kind in kinds if kind is not type(None)]
            wanted = " or ".join(dict.fromkeys(_words(kind) for kind in kinds if kind is not type(None)))
            place = "" if names[0] == name.capitalize() else f" as {name}"
            made = next((f": {MADE_BY[one]} makes one" for one in names if one in MADE_BY), "")
            raise JumpcadError(f"{title}() takes {wanted}{place}, not {wrong}{made}")
        if isinstance(value, int) and name in RANGES and not RANGES[name][0] <= value <= RANGES[name][1]:
            low, high = RANGES[name]
            raise JumpcadError(f"{title}(): {name} = {shown(value)}: must be at least {low} and at most {high}")
        known = [one for kind in kinds if typing.get_origin(kind) is typing.Literal for one in typing.get_args(kind)]
        if known and value not in known:
            raise JumpcadError(f"{name} = {value!r}: must be one of {', '.join(map(repr, known))}")
        found[name] = value
    return found


def _kinds(hint: Any) -> tuple[Any, ...]:
    """Return the alternatives of an annotation."""
    return typing.get_args(hint) if typing.get_origin(hint) in (types.UnionType, typing.Union) else (hint,)


def _items(kind: Any) -> tuple[Any, ...]:
    """Return what the items of a sequence may be; nothing if they are not alike."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    alike = isinstance(origin, type) and issubclass(origin, Sequence) and inner[1:] in ((), (Ellipsis,))
    return _kinds(inner[0]) if alike else ()


def _misfit(value: Any, kinds: Sequence[Any]) -> str:
    """Return what is wrong with a value, in words: the value itself, or its first wrong item; empty if it fits."""
    said = ""
    for kind in kinds:
        if not _is_a(value, kind):
            continue
        wrong = (_misfit(one, _items(kind)) for one in value) if _items(kind) else ()
        said = next((f"one with {text}" for text in wrong if text), "")
        if not said:
            return ""
    return said or described(value)


def _is_a(value: Any, kind: Any) -> bool:
    origin = typing.get_origin(kind) or kind
    if origin is Any or isinstance(origin, TypeVar):
        return True
    if origin is typing.Literal:
        return type(value) in map(type, typing.get_args(kind))
    if origin in (Sequence, Iterable) and isinstance(value, str | bytes):  # else each of its letters would be an item
        return False
    if origin in (int, float) and isinstance(value, bool | int):  # True is an int, but no number of anything
        return not isinstance(value, bool)
    return isinstance(value, origin)


def _name(kind: Any) -> str:
    origin = typing.get_origin(kind) or kind
    return type(typing.get_args(kind)[0]).__name__ if origin is typing.Literal else str(origin.__name__)


def _words(kind: Any) -> str:
    name, items = _name(kind), _items(kind)
    words = WORDS.get(name, f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}")
    return f"{words} of {' or '.join(map(_name, items))}" if items else words
