"""The search's functions and records in Python, with what they were not made for: what they take is said in a line."""

import inspect
from collections.abc import Callable
from typing import Any

import pytest
from support.each import each
from support.sandbox import LONGEST, Sandbox

import jumpcad
from jumpcad import search
from jumpcad.search.report import plots

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(search, name) for name in search.__all__ if inspect.isfunction(getattr(search, name))},
    **{f"plots.{name}": one for name, one in inspect.getmembers(plots, inspect.isfunction)
       if one.__module__ == plots.__name__ and not name.startswith("_")},
    "Evaluator": search.Evaluator,
    "Request": search.Request,
    "PrintedModel": search.PrintedModel,
    "CapsuleModel": search.CapsuleModel,
    "Space": search.Space,
    "StudyStore.read": search.StudyStore.read,
    "StudyStore.write": search.StudyStore.write,
}  # fmt: skip
WRONG_PATHS = {"study": ("a\0.db", "a\ud800.db"), "prior": ("a\0.db", "a\ud800.db"), "workshop": ("a\ud800.toml",)}


def refused(call: Callable[[], Any]) -> str:
    with pytest.raises(jumpcad.JumpcadError) as caught:
        call()
    said = str(caught.value)
    assert "\n" not in said
    assert 0 < len(said) <= LONGEST
    said.encode()
    return said


@each("name", FUNCTIONS)
def test_nonsense_is_refused_by_name(sandbox: Sandbox, name: str) -> None:
    needed = [one for one in inspect.signature(FUNCTIONS[name]).parameters.values() if one.default is one.empty]
    for odd in (object(), jumpcad.Design, b"kenan-2.0", float("nan")):
        with sandbox.untouched():
            said = refused(lambda odd=odd: FUNCTIONS[name](*[odd] * max(1, len(needed))))
        assert "takes" in said or "robot" in said


@each(("option", "path"), [(option, path) for option, some in WRONG_PATHS.items() for path in some])
def test_what_cannot_be_a_path_is_refused(sandbox: Sandbox, option: str, path: str) -> None:
    with sandbox.untouched():
        said = refused(lambda: jumpcad.optimize(**{"evaluations": 1, "workers": 0, option: path}))
    assert "cannot be" in said
