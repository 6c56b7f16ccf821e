"""Checks what public functions are given; the error says in one line what they take."""

import functools
import inspect
import types
import typing
from collections.abc import Callable
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import LONGEST, described

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
WORDS = {"Mechanism": "a Robot", "str": "a text", "bool": "True or False", "Path": "a path"}


def typed(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that checks its arguments against its annotations before it runs.

    Annotations are classes, `Any`, or classes joined by `|`, known in the function's own module.

    Raises
    ------
    JumpcadError
        From the returned function: what it takes, what it was given, and how to make what it takes.
    """
    signature = inspect.signature(function)

    @functools.cache
    def kinds() -> dict[str, tuple[type, ...]]:
        hints = typing.get_type_hints(function)
        return {name: _classes(hints[name]) for name in signature.parameters}

    @functools.wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            given = signature.bind(*args, **kwargs).arguments
        except TypeError as error:
            raise JumpcadError(f"{function.__name__}{_shape(signature)}: {error}") from None
        for name, value in given.items():
            if not isinstance(value, kinds()[name]):
                raise JumpcadError(f"{function.__name__}() takes {_refusal(name, kinds()[name], value)}")
        return function(*args, **kwargs)

    return checked


def _classes(hint: Any) -> tuple[type, ...]:
    """Return the classes that an annotation allows; of a container, only its own class."""
    if hint is Any:
        return (object,)
    if isinstance(hint, types.UnionType) or typing.get_origin(hint) is typing.Union:
        return tuple(kind for one in typing.get_args(hint) for kind in _classes(one))
    return (typing.get_origin(hint) or hint,)


def _refusal(name: str, kinds: tuple[type, ...], value: Any) -> str:
    names = [kind.__name__ for kind in kinds if kind is not type(None)]
    wanted = " or ".join(WORDS.get(one, f"a {one}") for one in names)
    place = "" if names[0] == name.capitalize() else f" as {name}"
    made = next((one for one in names if one in MADE_BY), None)
    if made is None:
        return f"{wanted}{place}, not {described(value)}"
    named = value if isinstance(value, str | Path) and len(str(value)) <= LONGEST else TEMPLATES[made]
    return f"{wanted}{place}, not {described(value)}: {MADE_BY[made].format(repr(str(named)))}"


def _shape(signature: inspect.Signature) -> str:
    """Return the parameters of a function with their defaults: (design, workshop=None)."""
    plain = [one.replace(annotation=inspect.Parameter.empty) for one in signature.parameters.values()]
    return str(inspect.Signature(plain))
