"""The registry of engines, and messages where one is not installed. An engine's library loads when it is first used."""

import importlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import did_you_mean

if TYPE_CHECKING:
    from jumpcad.simulation.run import Engine

ENGINES = {
    "pybullet": ("jumpcad.simulation.bullet", "BulletEngine"),
    "mujoco": ("jumpcad.simulation.mujoco", "MujocoEngine"),
    "planar": ("jumpcad.simulation.planar", "PlanarEngine"),
}
"""Module and class of every engine by its name."""
GENERAL = ("pybullet", "mujoco")
"""Rigid-body simulators independent of this project, of packages of these names: `--engine both` compares them, and the
first of them that is installed is the default."""
BUNDLE_ENGINE = "mujoco"
"""The engine of a bundle, its page and what `build` says, whatever is installed: it has a wheel on every platform, so
that the bundle of a robot is the same everywhere."""
ENGINE_HELP = "pybullet, mujoco, both or planar (fast); else the first installed."


def is_installed(name: str) -> bool:
    """Tell whether the package of an engine is there and loads, if it needs one."""
    if name not in GENERAL or sys.modules.get(name):
        return True
    try:
        (import_pybullet if name == "pybullet" else import_mujoco)()
    except JumpcadError:
        return False
    return True


@cache
def engine_named(name: str) -> "Engine":
    """Return the one engine of a name that this process has."""
    require_engine(name)
    module, maker = ENGINES[name]
    engine: Engine = getattr(importlib.import_module(module), maker)()
    return engine


def require_engine(name: str) -> None:
    """Reject a name that no engine has."""
    if name not in ENGINES:
        hint = did_you_mean(name, list(ENGINES))
        raise JumpcadError(f"{name!r} is not an engine; there are pybullet, mujoco and planar{hint}")


def default_engine() -> str:
    """Return the first general engine that is installed."""
    for name in GENERAL:
        if is_installed(name):
            return name
    raise JumpcadError("no physics engine is installed: pip install mujoco")


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
