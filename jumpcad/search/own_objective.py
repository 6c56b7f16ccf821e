"""Objectives that users write: a function that takes the figures of a jump and returns a score.

Scores are computed by the process that runs the search, so the function needs not be sent to workers. A study keeps a
hash of the function's code and of the values that it uses; another function is another study.
"""

import hashlib
import runpy
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import described, shown
from jumpcad.files.names import NAME

SUFFIX = ".py"
LARGEST = 1e12
"""Greatest score by amount; study files hold no greater figure."""
REMEDY = "mend it; what a study file holds is kept, and `--from-study` takes it over into a new study"


def load_function(place: str) -> Callable[..., Any]:
    """Return the function that `FILE.py:FUNCTION` names; the file is run.

    Raises
    ------
    JumpcadError
        If there is no such file or function, or the file does not run.
    """
    file, _, name = place.rpartition(":")
    if Path(file).suffix != SUFFIX or not name.isidentifier():
        raise JumpcadError(f"{shown(place)}: give an own objective as FILE{SUFFIX}:FUNCTION")
    if not Path(file).is_file():
        raise JumpcadError(f"{shown(file)}: no such file, so there is no objective {name}")
    try:
        defined = runpy.run_path(file, run_name="objective")
    except (Exception, SystemExit) as error:
        raise JumpcadError(f"{shown(file)}: does not run: {_told(error)}") from None
    if name not in defined:
        raise JumpcadError(f"{shown(file)}: defines no {name}{did_you_mean(name, defined)}")
    function: Callable[..., Any] = defined[name]
    return function


def require_function(function: Any) -> FunctionType:
    """Return a function; refuse what has no code of its own, of which a hash could be kept.

    Raises
    ------
    JumpcadError
        Saying what to give instead.
    """
    if not isinstance(function, FunctionType):
        raise JumpcadError(f"an own objective takes a function made by `def` or `lambda`, not {described(function)}")
    return function


def name_of(function: FunctionType) -> str:
    """Return a name for the study file."""
    return function.__name__ if NAME.fullmatch(function.__name__) else "own"


def checked(function: FunctionType) -> Callable[[Mapping[str, float]], float]:
    """Return the function with its errors in one line, and refusing what is no finite number.

    Raises
    ------
    JumpcadError
        From the returned function: how the own one fails.
    """

    def refused(reason: str) -> JumpcadError:
        return JumpcadError(f"the objective {name_of(function)} {reason}; {REMEDY}")

    def figure(metrics: Mapping[str, float]) -> float:
        try:
            value: Any = function(dict(metrics))
        except KeyError as error:
            key = shown(str(error.args[0] if error.args else error))
            raise refused(f"asks for {key}; a jump of this model has {', '.join(metrics)}") from None
        except (Exception, SystemExit) as error:
            raise refused(f"fails for a design that jumps: {_told(error)}") from None
        if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
            raise refused(f"returns {described(value)}, not a number")
        if not -LARGEST <= value <= LARGEST:  # nor is NaN
            raise refused(f"returns {shown(value)}, not a number within ±{LARGEST:g}")
        return float(value)

    return figure


def code_hash(function: FunctionType) -> str:
    """Return a SHA-256 (hexadecimal) of a function's code, and of the values and functions that it uses.

    Comments, names of files and line numbers do not count; modules count by name, other objects as `repr` shows them.
    """
    found = hashlib.sha256()
    for part in _parts(function, set()):
        found.update(f"{len(part)} {part}".encode("utf-8", "backslashreplace"))
    return found.hexdigest()


def _parts(value: Any, seen: set[int]) -> Iterator[str]:
    if isinstance(value, FunctionType):
        if id(value) in seen:
            return
        seen.add(id(value))
        yield from _parts(value.__code__, seen)
        used = [value.__globals__[name] for name in sorted(_names(value.__code__)) if name in value.__globals__]
        cells = [cell.cell_contents for cell in value.__closure__ or ()]
        for one in (*used, *cells, value.__defaults__, value.__kwdefaults__):
            yield from _parts(one, seen)
    elif isinstance(value, CodeType):
        yield from (value.co_code.hex(), repr(value.co_names), repr(value.co_freevars), repr(value.co_varnames))
        for constant in value.co_consts:
            yield from _parts(constant, seen)
    elif isinstance(value, ModuleType):
        yield value.__name__
    elif isinstance(value, set | frozenset):
        yield repr(sorted(map(repr, value)))
    else:
        yield repr(value)


def _names(code: CodeType) -> set[str]:
    """Return the names that a piece of code, and those within it, look up."""
    inner = (_names(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*inner)


def _told(error: BaseException) -> str:
    """Return an error in one line."""
    return without_controls(f"{type(error).__name__}: {error}".removesuffix(": "))[:120]
