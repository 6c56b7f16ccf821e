"""Checks what public functions are given; the error says in one line what they take."""

import dataclasses
import functools
import inspect
import numbers
import types
import typing
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ParamSpec, TypeVar, cast

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import LONGEST, described, did_you_mean, shown

P = ParamSpec("P")
R = TypeVar("R")

MADE_BY = {
    "Design": "jumpcad.load_design({}) makes one",
    "Mechanism": "jumpcad.build(jumpcad.load_design({})) makes one",
    "Robot": "jumpcad.build(jumpcad.load_design({})) makes one",
    "Settings": "jumpcad.load_settings({}) makes one",
    "Workshop": "jumpcad.load_workshop({}) makes one",
}
TEMPLATES = dict.fromkeys(("Design", "Mechanism", "Robot"), "kenan-2.0") | dict.fromkeys(
    ("Settings", "Workshop"), "default"
)
WORDS = {
    "Mechanism": "a Robot", "str": "a text", "bool": "True or False", "Path": "a path", "int": "a whole number",
    "float": "a number", "Sequence": "a list", "Iterable": "a list", "Mapping": "a table", "Callable": "a function",
}  # fmt: skip


@dataclass(frozen=True)
class Kind:
    """What an annotation allows: a class, and of a sequence what its items may be, if that is known."""

    of: type
    items: tuple["Kind", ...] = ()

    def misfit(self, value: Any) -> str:
        """Return what is wrong with a value, in words: the value itself, or its first wrong item; empty if it fits."""
        if isinstance(value, bool) and self.of in (int, float):  # True is an int, but no number of anything
            return described(value)
        if not _is_instance(value, self.of):
            return described(value)
        for item in value if self.items else ():
            wrong = _misfit(item, self.items)
            if wrong:
                return f"one with {wrong}"
        return ""


def typed(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that checks its arguments against its annotations before it runs.

    Annotations are classes, `Any`, or classes joined by `|`, known in the function's own module. A `float` may be an
    int, but no bool is a number. A number of another library, such as numpy's, becomes Python's. The items of sequences
    are checked too, those of mappings are not.

    Raises
    ------
    JumpcadError
        From the returned function: what it takes, what it was given, and how to make what it takes.
    """
    signature = inspect.signature(function)
    title = function.__qualname__.removesuffix(".__init__")
    takes_any = any(one.kind is inspect.Parameter.VAR_KEYWORD for one in signature.parameters.values())

    @functools.cache
    def kinds() -> dict[str, tuple[Kind, ...]]:
        return {name: _kinds(hint) for name, hint in typing.get_type_hints(function).items()}

    @functools.wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        unknown = [] if takes_any else [name for name in kwargs if name not in signature.parameters]
        if unknown:
            hint = did_you_mean(unknown[0], signature.parameters)
            raise JumpcadError(f"{title}() takes no {shown(unknown[0])}{hint}, only {_listed(signature)}")
        try:
            given = signature.bind(*args, **kwargs)
        except TypeError as error:
            raise JumpcadError(f"{title}{_shape(signature)}: {error}") from None
        for name in given.arguments.keys() & kinds().keys():
            given.arguments[name] = _plain(given.arguments[name], kinds()[name])
        _require(title, given.arguments, kinds())
        return cast(Callable[..., R], function)(*given.args, **given.kwargs)

    return checked


def require_fields(record: Any) -> None:
    """Check the fields of a dataclass against their annotations; for its `__post_init__`.

    Raises
    ------
    JumpcadError
        As from `typed`.
    """
    given = {field.name: getattr(record, field.name) for field in dataclasses.fields(record) if field.init}
    _require(type(record).__name__, given, _field_kinds(cast(Hashable, type(record))))


@functools.cache
def _field_kinds(kind: Hashable) -> dict[str, tuple[Kind, ...]]:
    return {name: _kinds(hint) for name, hint in typing.get_type_hints(cast(type, kind)).items()}


def _require(title: str, given: Mapping[str, Any], kinds: Mapping[str, tuple[Kind, ...]]) -> None:
    for name, value in given.items():
        if name in kinds and (wrong := _misfit(value, kinds[name])):
            raise JumpcadError(f"{title}() takes {_refusal(name, kinds[name], value, wrong)}")


def _plain(value: Any, kinds: Sequence[Kind]) -> Any:
    """Return a number of another library as Python's where a number is taken; all else as it is."""
    allowed = {kind.of for kind in kinds}
    if isinstance(value, numbers.Integral) and not isinstance(value, int) and allowed & {int, float}:
        return int(value)
    if isinstance(value, numbers.Real) and not isinstance(value, int | float) and float in allowed:
        return float(value)
    return value


def _misfit(value: Any, kinds: Sequence[Kind]) -> str:
    """Return why a value is of none of the kinds; empty if it is of one."""
    wrong = [kind.misfit(value) for kind in kinds]
    return max(wrong, key=lambda text: text.startswith("one with")) if all(wrong) else ""


def _is_instance(value: Any, kind: type) -> bool:
    if kind is float:
        return isinstance(value, float | int)
    if isinstance(value, str | bytes) and kind in (Sequence, Iterable):  # else each of its letters would be an item
        return False
    if getattr(kind, "_is_protocol", False):
        named = all(hasattr(type(value), name) for name in vars(kind) if not name.startswith("_"))
        return named and (callable(value) or "__call__" not in vars(kind))
    return isinstance(value, kind)


def _kinds(hint: Any) -> tuple[Kind, ...]:
    """Return what an annotation allows."""
    if hint is Any or isinstance(hint, TypeVar):
        return (Kind(object),)
    origin, inner = typing.get_origin(hint), typing.get_args(hint)
    if isinstance(hint, types.UnionType) or origin is typing.Union:
        return tuple(kind for one in inner for kind in _kinds(one))
    if origin is None:
        return (Kind(hint),)
    if origin is typing.Literal:
        return tuple({Kind(type(one)) for one in inner})
    sequence = isinstance(origin, type) and issubclass(origin, Sequence)
    alike = sequence and (len(inner) == 1 or inner[1:] == (Ellipsis,))
    return (Kind(origin, _kinds(inner[0]) if alike else ()),)


def _refusal(name: str, kinds: Sequence[Kind], value: Any, wrong: str) -> str:
    names = [_words(kind) for kind in kinds if kind.of is not type(None)]
    wanted = " or ".join(dict.fromkeys(names))
    place = "" if kinds[0].of.__name__ == name.capitalize() else f" as {name}"
    made = next((kind.of.__name__ for kind in kinds if kind.of.__name__ in MADE_BY), None)
    if made is None:
        return f"{wanted}{place}, not {wrong}"
    named = value if isinstance(value, str | Path) and len(str(value)) <= LONGEST else TEMPLATES[made]
    return f"{wanted}{place}, not {wrong}: {MADE_BY[made].format(repr(str(named)))}"


def _words(kind: Kind) -> str:
    name = kind.of.__name__
    words = WORDS.get(name, f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}")
    return f"{words} of {' or '.join(one.of.__name__ for one in kind.items)}" if kind.items else words


def _listed(signature: inspect.Signature) -> str:
    """Return the names of a function's parameters in words: design, workshop and name."""
    *others, last = [name for name in signature.parameters if name != "self"] or ["no arguments"]
    return f"{', '.join(others)} and {last}" if others else last


def _shape(signature: inspect.Signature) -> str:
    """Return the parameters of a function with their defaults: (design, workshop=None)."""
    plain = [one.replace(annotation=inspect.Parameter.empty) for one in signature.parameters.values()]
    return str(inspect.Signature(plain))
