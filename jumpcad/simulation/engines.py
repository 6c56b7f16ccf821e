"""The registry of engines, and messages where one is not installed. An engine's library loads when it is first used."""

import importlib
import importlib.util
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import did_you_mean

if TYPE_CHECKING:
    from jumpcad.simulation.run import Engine


@dataclass(frozen=True)
class EngineEntry:
    """An entry of the registry: module and class of an engine, the package that it needs, a note for the help.

    A `general` engine is a rigid-body simulator independent of this project: `--engine both` compares those, and the
    first of them that is installed is the default.
    """

    module: str
    maker: str
    package: str = ""
    general: bool = True
    note: str = ""

    @property
    def is_installed(self) -> bool:
        """Tell whether the package is there, if one is needed."""
        return not self.package or importlib.util.find_spec(self.package) is not None


ENGINES = {
    "pybullet": EngineEntry("jumpcad.simulation.bullet", "BulletEngine", package="pybullet"),
    "mujoco": EngineEntry("jumpcad.simulation.mujoco", "MujocoEngine", package="mujoco"),
    "planar": EngineEntry("jumpcad.simulation.planar", "PlanarEngine", general=False, note="fast"),
}
"""Every engine by its name."""
GENERAL = tuple(name for name, entry in ENGINES.items() if entry.general)


@cache
def engine_named(name: str) -> "Engine":
    """Return the one engine of a name that this process has.

    Raises
    ------
    JumpcadError
        If there is none of the name, or it is not installed.
    """
    require_engine(name)
    engine: Engine = getattr(importlib.import_module(ENGINES[name].module), ENGINES[name].maker)()
    return engine


def require_engine(name: str) -> None:
    """Reject a name that no engine has.

    Raises
    ------
    JumpcadError
        With a list of the engines.
    """
    if name not in ENGINES:
        known = in_words(ENGINES, "and")
        raise JumpcadError(f"{name!r} is not an engine; there are {known}{did_you_mean(name, list(ENGINES))}")


def default_engine() -> str:
    """Return the first general engine that is installed.

    Raises
    ------
    JumpcadError
        If there is none.
    """
    for name in GENERAL:
        if ENGINES[name].is_installed:
            return name
    raise JumpcadError("no physics engine is installed: pip install mujoco")


def engine_help() -> str:
    """Return what the command line's help says of the choice: the general engines, `both`, the others."""
    others = [f"{name} ({entry.note})" for name, entry in ENGINES.items() if not entry.general]
    return f"{in_words([*GENERAL, 'both', *others], 'or')}; else the first installed."


def in_words(names: Iterable[str], word: str) -> str:
    """Return names as a sentence lists them: `a, b or c`."""
    *most, last = names
    return f"{', '.join(most)} {word} {last}" if most else last


def import_pybullet(without_it: str = "--engine mujoco works without it") -> ModuleType:
    """Return the module `pybullet`, or raise an error that says how to get it and what works `without_it`."""
    try:
        with _silent_stderr():
            return importlib.import_module("pybullet")
    except ImportError:
        raise JumpcadError(
            "PyBullet is not installed: pip install pybullet-arm64 (where it has no wheel, pip compiles it); "
            f"{without_it}"
        ) from None


def import_mujoco() -> ModuleType:
    """Return the module `mujoco`, or raise an error that says how to get it."""
    try:
        return importlib.import_module("mujoco")
    except ImportError:
        raise JumpcadError("MuJoCo is not installed: pip install mujoco; --engine pybullet works without it") from None


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Discard the process's standard error for a moment: PyBullet writes a banner there when it loads."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
