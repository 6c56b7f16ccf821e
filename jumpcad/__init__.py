"""From eight numbers to a jumping robot that can be printed, simulated and trusted.

The public names load when they are first used, so that `import jumpcad` and the command line start at once.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jumpcad.api import check as check
    from jumpcad.api import export as export
    from jumpcad.api import simulate as simulate
    from jumpcad.building import build as build
    from jumpcad.design import SEARCH_BOUNDS as SEARCH_BOUNDS
    from jumpcad.design import Design as Design
    from jumpcad.design import load_design as load_design
    from jumpcad.errors import CannotBuildError as CannotBuildError
    from jumpcad.errors import JumpcadError as JumpcadError
    from jumpcad.evaluation import evaluate as evaluate
    from jumpcad.findings import Finding as Finding
    from jumpcad.mechanism.capsule import capsule_robot as capsule_robot
    from jumpcad.paper import published as published
    from jumpcad.robot import Robot as Robot
    from jumpcad.simulation import Jump as Jump
    from jumpcad.simulation import Settings as Settings
    from jumpcad.simulation import load_settings as load_settings
    from jumpcad.workshop import Workshop as Workshop
    from jumpcad.workshop import load_workshop as load_workshop

from jumpcad.version import __version__

_HOMES = {
    "CannotBuildError": "errors",
    "Design": "design",
    "Finding": "findings",
    "Jump": "simulation",
    "JumpcadError": "errors",
    "Robot": "robot",
    "SEARCH_BOUNDS": "design",
    "Settings": "settings",
    "Workshop": "workshop",
    "build": "building",
    "capsule_robot": "mechanism.capsule",
    "check": "api",
    "evaluate": "evaluation",
    "export": "api",
    "load_design": "design",
    "load_settings": "settings",
    "load_workshop": "workshop",
    "simulate": "api",
}
_MODULES = {"published": "paper.published"}

__all__ = ["__version__", *sorted(_HOMES), *sorted(_MODULES)]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        value = getattr(importlib.import_module(f"jumpcad.{_HOMES[name]}"), name)
    elif name in _MODULES:
        value = importlib.import_module(f"jumpcad.{_MODULES[name]}")
    else:
        raise AttributeError(f"module 'jumpcad' has no attribute {name!r}")
    globals()[name] = value
    return value
