"""Hashes of code, jumpcad's and that of own objectives, and versions of packages: a study goes on only with its own."""

import hashlib
import importlib.metadata
import sysconfig
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache
from modulefinder import ModuleFinder
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from jumpcad.files import templates_folder

PRESENTATION = (
    "api.", "bundle/", "calibration/", "cli/", "comparison.", "coupon/", "environment.", "exporters/dxf.",
    "exporters/glb.", "exporters/registry.", "exporters/ros2.", "exporters/sdf.", "exporters/step.",
    "exporters/stl.", "exporters/threemf.", "exporters/urdf.", "landing/series.", "notebook.", "parts/plates.",
    "printing/prusaslicer.", "remedy_numbers.", "scene/labels.", "scene/raster.", "scene/renderer.",
    "search/report/", "steps/step_", "studio/", "templates/", "validation/",
)  # fmt: skip
"""Modules and packages that do not affect the trials of a study; templates lie in an installed package alone."""
FORKS = {"pybullet": "pybullet-arm64"}
"""What is installed in place of a package where that has no wheel."""
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
        codes = list(_codes(one.__code__))
        names = sorted({name for code in codes for name in code.co_names} & one.__globals__.keys())
        cells = [cell for cell in one.__closure__ or () if cell != CellType()]  # an empty one has no value yet
        used = [*(one.__globals__[name] for name in names), *(cell.cell_contents for cell in cells)]
        used += [one.__defaults__, one.__kwdefaults__]
        parts += [f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {code.co_freevars}" for code in codes]
        parts += [_value(value) for value in (*used, *(constant for code in codes for constant in code.co_consts))]
        waiting += [value for value in used if isinstance(value, FunctionType) and _is_own(value.__code__.co_filename)]
    return _sha256(parts)


def _sha256(parts: Iterable[str]) -> str:
    found = hashlib.sha256()
    for part in parts:
        found.update(f"{len(part)} {part}".encode("utf-8", "backslashreplace"))
    return found.hexdigest()


def _codes(code: CodeType) -> Iterator[CodeType]:
    """Yield a code object and those within it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _value(value: Any, depth: int = 0) -> str:
    """Return a plain value, or a list or table of such, as text that is equal in every run; others by their type."""
    kind = type(value).__qualname__
    if type(value) in PLAIN:
        return f"{kind} {hex(value) if type(value) is int else repr(value)}"  # a whole number of any length
    if depth < 20 and type(value) is dict:
        return f"{kind} {_value(list(value.items()), depth + 1)}"
    if depth < 20 and type(value) in (list, tuple, set, frozenset):
        parts = [_value(one, depth + 1) for one in value]
        return f"{kind} {parts if isinstance(value, list | tuple) else sorted(parts)}"
    if type(value) is np.ndarray and value.dtype != object:
        return f"{kind} {value.dtype} {value.shape} {value.tobytes().hex()}"
    if type(value) is ModuleType:
        file = getattr(value, "__file__", None)
        return f"{kind} {file_hash(Path(file), '') if file and _is_own(file) else value.__name__}"
    return f"{kind} {value.__module__}.{value.__qualname__}" if isinstance(value, type) else kind


def _is_own(file: str) -> bool:
    """Tell whether a file is the user's: no part of Python, of an installed package, or of jumpcad."""
    libraries = [str(Path(__file__).parents[2]), *map(sysconfig.get_path, ("stdlib", "platstdlib"))]
    installed = {"site-packages", "dist-packages"} & {*Path(file).parts}  # also of a system that an environment extends
    return not installed and not any(Path(file).is_relative_to(library) for library in libraries)


@cache
def code_digest() -> str:
    """Return a hash of what decides the trials of a study: between two releases the code changes, not the version."""
    package = Path(__file__).parents[2]
    files = {path.relative_to(package).as_posix(): path for path in package.rglob("*.py")}
    files |= {f"hardware/{path.name}": path for path in (templates_folder() / "hardware").glob("*.toml")}
    found = hashlib.sha256()
    for name in sorted(files):
        if not name.startswith(PRESENTATION):
            content = files[name].read_bytes()
            found.update(f"{name} {len(content)}\n".encode() + content)
    return found.hexdigest()[:16]


def versions(*packages: str) -> dict[str, str]:
    """Return the installed versions of packages; of those that are not installed, `none`."""
    return {package: _version(package) or _version(FORKS.get(package, package)) or "none" for package in packages}


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None
