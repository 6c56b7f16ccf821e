"""The hash of an objective's code follows what it uses of the user's own modules, objects and closures."""

import datetime
import functools
import importlib
import json
import math
import random
import re
import sys
import sysconfig
from pathlib import Path
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from jumpcad.errors import JumpcadError
from jumpcad.search.study import code_hash as code_hash_module
from jumpcad.search.study.code_hash import code_hash

HELPER = "FACTOR = {factor}\n\ndef scaled(x):\n    return {factor} * x\n\ndef unused(x):\n    return {other} * x\n"


@pytest.fixture
def hashed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a function that gives the hash of an objective that uses a module of these numbers."""
    monkeypatch.syspath_prepend(tmp_path)

    def of(factor: float, other: float = 1.0, use: str = "my_aims.scaled(m['range'])") -> str:
        (tmp_path / "my_aims.py").write_text(HELPER.format(factor=factor, other=other))
        sys.modules.pop("my_aims", None)
        importlib.invalidate_caches()
        monkeypatch.setattr(sys, "dont_write_bytecode", True)
        space: dict[str, Any] = {"my_aims": importlib.import_module("my_aims")}
        exec(f"def light(m):\n    return {use}\n", space)
        function = space["light"]
        assert isinstance(function, FunctionType)
        return code_hash(function)

    yield of
    sys.modules.pop("my_aims", None)


@pytest.mark.parametrize("use", ["my_aims.scaled(m['range'])", "my_aims.FACTOR * m['range']"])
def test_a_module_of_one_s_own_counts_by_what_is_used_of_it(hashed: Any, use: str) -> None:
    assert hashed(2.0, use=use) == hashed(2.0, use=use) != hashed(3.0, use=use)
    assert hashed(2.0, use=use) == hashed(2.0, other=5.0, use=use)


def test_values_of_closures_and_defaults_count() -> None:
    def weighted(weight: float) -> Any:
        return lambda m: weight * m["range"]

    def default(weight: float) -> Any:
        def light(m: Any, by: float = weight) -> float:
            return by * m["range"]

        return light

    def named_default(weight: float) -> Any:
        def light(m: Any, *, by: float = weight) -> float:
            return by * m["range"]

        return light

    for make in (weighted, default, named_default):
        assert code_hash(make(1.0)) == code_hash(make(1.0)) != code_hash(make(2.0))


@pytest.mark.parametrize(
    ("module", "by_name"),
    [("jumpcad.made", True), ("math", True), ("an_installed", True), ("my_aims", False), ("a_frozen", True)],
)
def test_functions_of_libraries_count_by_their_names(
    module: str, by_name: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Another version of jumpcad or of Python is no other objective; the user's own code is."""
    places = {"an_installed": f"{sysconfig.get_path('purelib')}/an_installed.py", "my_aims": f"{tmp_path}/my_aims.py"}
    if module in (*places, "a_frozen"):
        monkeypatch.setitem(sys.modules, module, SimpleNamespace(__file__=places.get(module)))  # type: ignore[misc]

    def using(factor: float) -> str:
        space: dict[str, Any] = {"__name__": module}
        exec(f"def helper(x):\n    return {factor} * x\n", space)
        own: dict[str, Any] = {"helper": space["helper"]}
        exec("def light(m):\n    return helper(m['range'])\n", own)
        return code_hash(own["light"])

    assert (using(2.0) == using(3.0)) is by_name
    assert using(2.0) == using(2.0)


def test_a_function_uses_as_many_values_as_the_message_says(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a list each counts; the function itself takes fewer than a hundred."""
    monkeypatch.setattr(code_hash_module, "MOST", 2000)

    def using(count: int) -> Any:
        values = list(range(count))
        return lambda m: m["range"] + sum(values)

    assert len(code_hash(using(1900))) == 64
    with pytest.raises(JumpcadError, match="uses more than 2000 values; keep long lists in an array of numpy's"):
        code_hash(using(2000))


def test_a_value_that_cannot_be_looked_at_is_told_by_its_error() -> None:
    class Shy:
        def __getattribute__(self, name: str) -> Any:
            raise ZeroDivisionError

    shy = Shy()
    with pytest.raises(JumpcadError, match=r"cannot be looked at \(ZeroDivisionError\); make it in the function$"):
        code_hash(lambda m: m["range"] + (shy is None))  # type: ignore[arg-type]


def test_a_script_is_no_library_wherever_the_program_lies_that_runs_it() -> None:
    """What runs here as `__main__` is an installed package; its functions would be an objective's own code."""
    assert not code_hash_module._is_library("__main__")
    assert not code_hash_module._is_library("no_such_module")
    for known in ("sys", "json", "numpy", "jumpcad.design"):
        assert code_hash_module._is_library(known)


class Named:
    """A value that is copied by the name that it has in its module."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __reduce__(self) -> str:
        return self.name


FIRST, SECOND = Named("FIRST"), Named("SECOND")


KINDS = ("value", "base", "getter", "setter", "static", "of_class", "comparison")


def made(body: int, kind: str = "value") -> type:
    """Return a class in which one thing has a number: a value, a method of some kind, or what it is derived from."""
    value, base, getter, setter, static, of_class, comparison = (body if kind == one else 0 for one in KINDS)

    class Base:
        below = base

    class Made(Base):
        whole = value

        @property
        def part(self) -> int:
            return getter

        @part.setter
        def part(self, to: int) -> None:
            self.kept = to + setter

        @staticmethod
        def still() -> int:
            return static

        @classmethod
        def whose(cls) -> int:
            return of_class

        def __eq__(self, other: object) -> bool:
            return bool(other == comparison)

        __hash__ = None  # type: ignore[assignment]

    return Made


@pytest.mark.parametrize(
    ("one", "same", "other"),
    [
        ({1, 2, 3}, {3, 2, 1}, {1, 2, 4}), (frozenset("ab"), frozenset("ba"), frozenset("a")), (1, 1, True),
        (1, 1, 1.0),
        ("a", "a", b"a"), ([1, 2], [1, 2], [2, 1]), ((1, 2), (1, 2), [1, 2]), ({"a": 1}, {"a": 1}, {"a": 2}),
        ({"a": 1}, {"a": 1}, {"b": 1}), (-0.0, -0.0, 0.0), (None, None, ...), ([[]], [[]], [[], []]),
        (10**30, 10**30, 10**30 + 1), (np.array([1.0, 2.0]), np.array([1.0, 2.0]), np.array([1.0, 2.5])),
        (np.array([1.0]), np.array([1.0]), np.array([1])), (math.sin, math.sin, math.cos), (math, math, json),
        (functools.partial(round, ndigits=1), functools.partial(round, ndigits=1), functools.partial(round, ndigits=2)),
        *((made(1, kind), made(1, kind), made(2, kind)) for kind in KINDS),
        (made(1)(), made(1)(), made(2)()), ([].append, [].append, [1].append),
        (re.compile("a"), re.compile("a"), re.compile("b")), (FIRST, FIRST, SECOND),
        (random.Random(1), random.Random(1), random.Random(2)), (range(3), range(3), range(4)),
        (datetime.date(2020, 1, 2), datetime.date(2020, 1, 2), datetime.date(2020, 1, 3)),
    ],
)  # fmt: skip
def test_equal_values_have_one_hash_and_others_another(one: Any, same: Any, other: Any) -> None:
    """Of a function that uses them."""

    def using(value: Any) -> str:
        return code_hash(lambda figures: value)  # type: ignore[arg-type]

    assert using(one) == using(same) != using(other)
