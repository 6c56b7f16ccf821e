"""Simulated jumps of a mechanism, by any of several engines: release, push-off, take-off, flight, audit.

The public names load when they are first used: the command line's help names the engines without loading one.
"""

import importlib
from typing import TYPE_CHECKING, Any

from jumpcad.simulation.engines import ENGINES, default_engine

if TYPE_CHECKING:
    from jumpcad.settings import Settings as Settings
    from jumpcad.settings import load_settings as load_settings
    from jumpcad.simulation.jump import Jump as Jump
    from jumpcad.simulation.simulator import simulate as simulate

_HOMES = {
    "Jump": "jumpcad.simulation.jump",
    "Settings": "jumpcad.settings",
    "load_settings": "jumpcad.settings",
    "simulate": "jumpcad.simulation.simulator",
}

__all__ = ["ENGINES", "Jump", "Settings", "default_engine", "load_settings", "simulate"]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)
