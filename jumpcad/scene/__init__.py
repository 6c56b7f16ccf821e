"""Pictures of a robot: placed meshes with colours, cameras, shading, the renderer, the assembly steps."""

from typing import TYPE_CHECKING

from jumpcad.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from jumpcad.scene.assembly_steps import Step as Step
    from jumpcad.scene.camera import View as View
    from jumpcad.scene.renderer import Renderer as Renderer
    from jumpcad.scene.visuals import Visual as Visual

_HOMES = {"Renderer": "renderer", "Step": "assembly_steps", "View": "camera", "Visual": "visuals"}

__all__ = list(_HOMES)
__getattr__, __dir__ = lazy_exports(__name__, _HOMES)
