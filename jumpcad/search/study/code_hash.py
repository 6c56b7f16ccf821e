"""A hash of a user's function: equal in every run for the same code and values, different for all others.

The user's code is followed: functions with the names that they use, classes, and objects by their parts as for
`pickle`. Objects of installed libraries count by their names, objects without parts (a lock, an open file) by their
types.
"""

import copyreg
import functools
import hashlib
import site
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import CodeType, FunctionType, MethodType, ModuleType
from typing import Any

from jumpcad.errors import JumpcadError

MOST = 200_000
"""Largest number of values that a function may use; an array counts as one."""
PLAIN = (type(None), bool, int, float, complex, str, bytes, type(Ellipsis), type(NotImplemented))
UNSAID = {
    "__annotations__", "__builtins__", "__dict__", "__doc__", "__firstlineno__", "__module__", "__qualname__",
    "__static_attributes__", "__weakref__", "_abc_impl",
}  # fmt: skip
"""Attributes of a class that do not change what it does."""


def code_hash(function: FunctionType) -> str:
    """Return a SHA-256 (hexadecimal) of a function's code, and of the values and functions that it uses.

    Comments, names of files and line numbers do not count.

    Raises
    ------
    JumpcadError
        If it uses more than `MOST` values, or one of them cannot be read.
    """
    try:
        return _Walk([0]).digest(function)
    except JumpcadError:
        raise
    except Exception as error:  # raised by a method of a user's class
        raise JumpcadError(
            f"a value that the own objective uses cannot be looked at ({type(error).__name__}); make it in the function"
        ) from None


class _Walk:
    """Visits a value and all its parts, each once; `count` is shared by all walks of one function."""

    def __init__(self, count: list[int]) -> None:
        self._count = count
        self._seen: dict[int, int] = {}
        self._kept: list[Any] = []  # so that no later object gets the `id` of one that was deleted

    def digest(self, value: Any) -> str:
        found, waiting = hashlib.sha256(), [value]
        while waiting:
            self._count[0] += 1
            if self._count[0] > MOST:
                raise JumpcadError(
                    f"the own objective uses more than {MOST} values; keep long lists in an array of numpy's"
                )
            one = waiting.pop()
            inner: list[Any] = []
            if type(one) in PLAIN:
                part = f"{type(one).__name__} {hex(one) if type(one) is int else one!r}"
            elif type(one) is tuple:  # equal ones may be one object or several, as Python likes
                part, inner = "tuple", list(one)
            elif (before := self._seen.get(id(one))) is not None:
                part = f"again {before}"
            else:
                self._seen[id(one)] = len(self._seen)
                self._kept.append(one)
                part, inner = self._taken_apart(one)
            found.update(f"{len(part)} {len(inner)} {part}".encode("utf-8", "backslashreplace"))
            waiting += reversed(inner)
        return found.hexdigest()

    def _taken_apart(self, value: Any) -> tuple[str, list[Any]]:
        """Return a value's kind as text, and its parts."""
        if isinstance(value, set | frozenset):
            return f"set {sorted(_Walk(self._count).digest(one) for one in value)}", []
        if type(value) is list:
            return "list", value
        if isinstance(value, Mapping) and (type(value) is dict or type(value).__module__ == "builtins"):
            return "dict", [part for pair in value.items() for part in pair]
        if isinstance(value, ModuleType):
            return f"module {value.__name__}", []
        if named := _library_name(value):
            return f"of {named}", []
        if isinstance(value, FunctionType):
            return "function", [value.__code__, _used(value), value.__defaults__, value.__kwdefaults__]
        if isinstance(value, CodeType):
            names = (value.co_names, value.co_freevars, value.co_cellvars, value.co_varnames)
            return f"code {value.co_code.hex()}", [*names, value.co_argcount, value.co_flags, value.co_consts]
        if isinstance(value, type):
            said = {key: one for key, one in vars(value).items() if key not in UNSAID}
            return "class", [type(value), value.__bases__, said]
        if isinstance(value, MethodType):
            return "method", [value.__func__, value.__self__]
        if isinstance(value, property):
            return "property", [value.fget, value.fset]
        wrapped = getattr(value, "__wrapped__", None)
        if isinstance(wrapped, FunctionType):  # staticmethod, classmethod, functools.cache
            return type(value).__name__, [wrapped]
        return type(value).__qualname__, _reduced(value)


def _used(function: FunctionType) -> list[Any]:
    """Return names and values that a function uses: globals, also those of the user's modules, and its closure's."""
    names = sorted(set(_names(function.__code__)))
    used = [(name, function.__globals__[name]) for name in names if name in function.__globals__]
    modules = [module for _, module in used if isinstance(module, ModuleType) and not _is_library(module.__name__)]
    used += [(name, vars(module)[name]) for module in modules for name in names if name in vars(module)]
    return [*used, *(_content(cell) for cell in function.__closure__ or ())]


def _names(code: CodeType) -> Iterator[str]:
    """Yield the names that a code object and those within it use."""
    waiting = [code]
    while waiting:
        one = waiting.pop()
        yield from one.co_names
        waiting += [constant for constant in one.co_consts if isinstance(constant, CodeType)]


def _content(cell: Any) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # a name that has no value yet
        return ()


def _reduced(value: Any) -> list[Any]:
    """Return the parts from which a copy of an object would be made: class or function, arguments and state."""
    try:
        registered = copyreg.dispatch_table.get(type(value))
        parts = registered(value) if registered else value.__reduce_ex__(4)
    except Exception:  # what cannot be copied
        return [type(value)]
    if not isinstance(parts, tuple):  # the name of something in its module
        return [type(value), parts]
    return [type(value), *(list(one) if isinstance(one, Iterator) else one for one in parts)]


def _library_name(value: Any) -> str:
    """Return the full name of a function or class of an installed library; empty for others."""
    module, name = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    named = isinstance(module, str) and isinstance(name, str)
    return f"{module}.{name}" if named and _is_library(str(module)) else ""


@functools.cache
def _is_library(module: str) -> bool:
    """Tell whether a module is part of Python, of an installed package, or of jumpcad."""
    if module.partition(".")[0] in (*sys.builtin_module_names, "jumpcad"):
        return True
    loaded = sys.modules.get(module)
    if loaded is None or module == "__main__":
        return False
    file = getattr(loaded, "__file__", None)
    return file is None or any(Path(file).is_relative_to(folder) for folder in _library_folders())


def _library_folders() -> set[str]:
    paths = sysconfig.get_paths()
    return {paths[kind] for kind in ("stdlib", "platstdlib", "purelib", "platlib")} | {site.getusersitepackages()}
