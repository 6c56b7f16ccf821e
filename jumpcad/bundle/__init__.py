"""A folder with everything to print, buy, assemble and simulate a robot: written, opened, verified, sliced."""

from typing import TYPE_CHECKING

from jumpcad.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from jumpcad.bundle.manifest import Bundle as Bundle
    from jumpcad.bundle.manifest import open_bundle as open_bundle
    from jumpcad.bundle.manifest import verify as verify
    from jumpcad.bundle.sliced import slice_bundle as slice_bundle

_HOMES = {"Bundle": "manifest", "open_bundle": "manifest", "slice_bundle": "sliced", "verify": "manifest"}

__all__ = list(_HOMES)
__getattr__, __dir__ = lazy_exports(__name__, _HOMES)
