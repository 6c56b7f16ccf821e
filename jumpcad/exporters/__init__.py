"""File formats: one module each, and the registry of those that a bundle has.

The registry loads when it is first used, so that a simulation, which runs the MJCF model, loads that format alone.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jumpcad.exporters.registry import EXPORTERS as EXPORTERS
    from jumpcad.exporters.registry import Exporter as Exporter

__all__ = ["EXPORTERS", "Exporter"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from jumpcad.exporters import registry

    return getattr(registry, name)
