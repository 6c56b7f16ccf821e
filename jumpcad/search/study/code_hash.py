"""Hashes of own objectives: a study goes on only with the one that it was made with."""

import hashlib
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import suppress
from modulefinder import ModuleFinder
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

PLAIN = (type(None), bool, int, float, complex, str, bytes)


def file_hash(file: Path, name: str) -> str:
    """Return a SHA-256 of a function's name, of its file, and of the modules beside it that this imports."""
    file = file.resolve()
    finder = ModuleFinder([str(file.parent)])
    with suppress(SyntaxError, ValueError):  # of a module that has been changed since it was imported
        finder.run_script(str(file))
    found = (getattr(module, "__file__", None) for module in finder.modules.values())
    files = {file, *(Path(one) for one in found if one)}
    return _sha256([name, *(f"{one.relative_to(file.parent)} {one.read_bytes().hex()}" for one in sorted(files))])


def function_hash(function: FunctionType) -> str:
    """Return a SHA-256 of a function's code, of the plain values that it uses, and of own functions and modules.

    Comments and line numbers do not count, nor do values in objects of classes.
    """
    parts, waiting, seen = [], [function], set()
    while waiting:
        one = waiting.pop()
        if id(one) in seen:
            continue
        seen.add(id(one))
        used = [*_used(one), *_contents(one), one.__defaults__, one.__kwdefaults__]
        parts += [_code(one.__code__), *map(_value, used)]
        waiting += [value for value in used if isinstance(value, FunctionType) and _is_own(value.__code__.co_filename)]
    return _sha256(parts)


def _sha256(parts: Iterable[str]) -> str:
    found = hashlib.sha256()
    for part in parts:
        found.update(f"{len(part)} {part}".encode("utf-8", "backslashreplace"))
    return found.hexdigest()


def _code(code: CodeType) -> str:
    """Return what a code object does, with those within it."""
    constants = [_code(one) if isinstance(one, CodeType) else _value(one) for one in code.co_consts]
    return f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {code.co_freevars} {constants}"


def _used(function: FunctionType) -> Iterator[Any]:
    """Yield the values of the global names that a function uses, with those of functions within it."""
    names: set[str] = set()
    waiting = [function.__code__]
    while waiting:
        code = waiting.pop()
        names.update(code.co_names)
        waiting += [constant for constant in code.co_consts if isinstance(constant, CodeType)]
    yield from (function.__globals__[name] for name in sorted(names) if name in function.__globals__)


def _contents(function: FunctionType) -> Iterator[Any]:
    """Yield the values of a function's closure that are set."""
    for cell in function.__closure__ or ():
        try:
            yield cell.cell_contents
        except ValueError:  # a name that has no value yet
            yield None


def _value(value: Any, depth: int = 0) -> str:
    """Return a plain value, or a list or table of such, as text that is equal in every run; others by their type."""
    kind = type(value).__qualname__
    if type(value) is int:
        return f"{kind} {hex(value)}"  # of any length
    if type(value) in PLAIN:
        return f"{kind} {value!r}"
    if depth < 20 and type(value) in (list, tuple):
        return f"{kind} {[_value(one, depth + 1) for one in value]}"
    if depth < 20 and type(value) in (set, frozenset):
        return f"{kind} {sorted(_value(one, depth + 1) for one in value)}"
    if depth < 20 and type(value) is dict:
        return f"{kind} {[(_value(key, depth + 1), _value(one, depth + 1)) for key, one in value.items()]}"
    if type(value) is np.ndarray and value.dtype != object:
        return f"{kind} {value.dtype} {value.shape} {value.tobytes().hex()}"
    if type(value) is ModuleType:
        file = getattr(value, "__file__", None)
        return f"{kind} {file_hash(Path(file), '') if file and _is_own(file) else value.__name__}"
    if isinstance(value, type):
        return f"{kind} {value.__module__}.{value.__qualname__}"
    return kind


def _is_own(file: str) -> bool:
    """Tell whether a file is the user's: no part of Python, of an installed package, or of jumpcad."""
    libraries = [str(Path(__file__).parents[2])]
    libraries += [str(sysconfig.get_path(kind)) for kind in ("stdlib", "platstdlib", "purelib", "platlib")]
    return not any(Path(file).is_relative_to(library) for library in libraries)
