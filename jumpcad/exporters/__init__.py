"""File formats: one module each, and the registry of those that a bundle has.

A simulation, which runs the MJCF model, loads that format alone.
"""

from typing import TYPE_CHECKING

from jumpcad.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from jumpcad.exporters.registry import EXPORTERS as EXPORTERS
    from jumpcad.exporters.registry import Exporter as Exporter

_HOMES = {"EXPORTERS": "registry", "Exporter": "registry"}

__all__ = list(_HOMES)
__getattr__, __dir__ = lazy_exports(__name__, _HOMES)
