"""The engines, and what to say where one is missing."""

import importlib
import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

from jumpcad.errors import JumpcadError

GENERAL = ("pybullet", "mujoco")
"""General rigid-body engines, independent of each other and of this package."""
ENGINES = (*GENERAL, "planar")


def import_pybullet(without_it: str = "--engine mujoco works without it") -> ModuleType:
    """Return the module `pybullet`, or say in one line how to get it and what works `without_it`."""
    try:
        with _silent_stderr():
            return importlib.import_module("pybullet")
    except ImportError:
        raise JumpcadError(
            'PyBullet is not installed: pip install "pybullet==3.2.7" (wheels exist for Python 3.11 on Linux x86_64); '
            f"{without_it}"
        ) from None


def import_mujoco() -> ModuleType:
    """Return the module `mujoco`, or say in one line how to get it."""
    try:
        return importlib.import_module("mujoco")
    except ImportError:
        raise JumpcadError(
            'MuJoCo is not installed: pip install "jumpcad[mujoco]"; --engine pybullet works without it'
        ) from None


def default_engine() -> str:
    """Return the first general engine that is installed.

    Raises
    ------
    JumpcadError
        If there is none.
    """
    for engine in GENERAL:
        if importlib.util.find_spec(engine) is not None:
            return engine
    raise JumpcadError(
        'no physics engine is installed: pip install "jumpcad[mujoco]" (everywhere) or "pybullet==3.2.7" '
        "(Python 3.11 on Linux x86_64)"
    )


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Keep the process's standard error shut: PyBullet greets there when it loads, where only errors belong."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
