"""Objectives that users write: a function that takes the figures of a jump and returns a score.

Scores are computed by the process that runs the search, so the function needs not be sent to workers. A study keeps a
hash of the function; another function is another study.
"""

import os
import random
import re
import runpy
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout, suppress
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files import did_you_mean, read_bytes
from jumpcad.files.complaints import described, shown
from jumpcad.files.records import NAME
from jumpcad.search.study.code_hash import file_hash, function_hash

SUFFIX = ".py"
UNIT = re.compile(r"[\w %°·/^().²³-]{0,30}")
LARGEST = 1e12
"""Largest absolute score; study files hold no larger figure."""
REMEDY = "mend it; what a study file holds is kept, and `--from-study` takes it over into a new study"


class TriedFigures(dict[str, float]):
    """Equal figures on which a function is tried, and the names that it asked for besides."""

    def __init__(self, names: Iterable[str], value: float) -> None:
        super().__init__(dict.fromkeys(names, value))
        self.value = value
        self.lacking: list[str] = []

    def __missing__(self, name: object) -> float:
        self.lacking.append(str(name) if isinstance(name, str | int | float) else type(name).__name__)
        return self.value


def own_function(asked: Any) -> tuple[str, Callable[[Mapping[str, float]], float], str, str]:
    """Return the name of an own objective, its function with errors of one line, the hash of its code, and its unit.

    It is a function made by `def` or `lambda`, or `FILE.py:FUNCTION`. The returned function raises `JumpcadError` if
    the user's raises anything or returns no finite number. Name and unit are the function's attributes of these names.
    """
    function: Any = _loaded(asked) if isinstance(asked, str) else asked
    if not isinstance(function, FunctionType):
        raise JumpcadError(f"an own objective takes a function made by `def` or `lambda`, not {described(function)}")
    usual = function.__name__ if NAME.fullmatch(function.__name__) else "own"
    title, unit = getattr(function, "name", usual), getattr(function, "unit", "")
    for key, value, form in (("name", title, NAME), ("unit", unit, UNIT)):
        if not isinstance(value, str) or not form.fullmatch(value):
            raise JumpcadError(f"the objective {usual} has as {key} {described(value)}: give {form.pattern} as a text")
    file, _, name = asked.rpartition(":") if isinstance(asked, str) else ("", "", "")

    def refused(reason: str) -> JumpcadError:
        return JumpcadError(f"the objective {title} {reason}; {REMEDY}")

    def figure(metrics: Mapping[str, float]) -> float:
        try:
            with _undisturbed():
                value: Any = function(metrics if isinstance(metrics, TriedFigures) else dict(metrics))
        except KeyError as error:
            key = shown(error.args[0] if error.args else "")
            raise refused(f"asks for {key}; a jump of this model has {', '.join(metrics)}") from None
        except (Exception, SystemExit, GeneratorExit) as error:
            raise refused(f"fails for a design that jumps: {_told(error)}") from None
        if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
            raise refused(f"returns {described(value)}, not a number")
        if not -LARGEST <= value <= LARGEST:  # nor is NaN
            raise refused(f"returns {shown(value)}, not a number within ±{LARGEST:g}")
        return float(value)

    return title, figure, file_hash(Path(file), name) if file else function_hash(function), unit


def _loaded(place: str) -> Any:
    """Return what `FILE.py:NAME` names; the file is run, and finds the modules beside it."""
    file, _, name = place.rpartition(":")
    if Path(file).suffix != SUFFIX or not name.isidentifier():
        raise JumpcadError(f"{shown(place)}: give an own objective as FILE{SUFFIX}:FUNCTION")
    read_bytes(Path(file), "a file of Python")
    beside = os.path.dirname(os.path.realpath(file))
    if beside not in sys.path:
        sys.path.append(beside)
    try:
        with _undisturbed():
            defined = runpy.run_path(file, run_name="objective")
    except (Exception, SystemExit, GeneratorExit) as error:
        raise JumpcadError(f"{shown(file)}: does not run: {_told(error)}") from None
    if name not in defined:
        raise JumpcadError(f"{shown(file)}: defines no {name}{did_you_mean(name, defined)}")
    return defined[name]


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Run a user's code without its side effects on output and search: prints, working directory, random numbers."""
    here, drawn, drawn_by_numpy = os.getcwd(), random.getstate(), np.random.get_state()  # noqa: NPY002
    try:
        with redirect_stdout(sys.stderr):
            yield
    finally:
        random.setstate(drawn)
        np.random.set_state(drawn_by_numpy)  # noqa: NPY002
        with suppress(OSError):
            os.chdir(here)


def _told(error: BaseException) -> str:
    return without_controls(f"{type(error).__name__}: {error}".removesuffix(": "))[:120]
