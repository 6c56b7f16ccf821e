"""From a solid to the mesh that is written, and the check that the written file is one printable part."""

import io
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Manifold

from jumpcad.errors import CannotBuildError

if TYPE_CHECKING:
    import trimesh

TOLERANCE_MM = 1e-3
FILES_KEPT = 32
"""Files whose faults are remembered: the parts of a robot, which are looked at as they are written and as a limit."""


def finished(solid: Manifold) -> Manifold:
    """Return the result of 3D booleans without the slivers that would open its surface in a file."""
    return solid.set_tolerance(TOLERANCE_MM).as_original().simplify(TOLERANCE_MM)


def to_trimesh(solid: Manifold) -> "trimesh.Trimesh":
    """Return a solid as a mesh (mm) with the same vertices, at full precision."""
    import trimesh  # takes 0.3 s, and masses need no mesh

    mesh = solid.to_mesh64()
    faces = np.asarray(mesh.tri_verts).astype(np.int64)
    return trimesh.Trimesh(np.array(mesh.vert_properties[:, :3]), faces, process=False)


@lru_cache(FILES_KEPT)
def faults(stl: bytes) -> list[str]:
    """Return what keeps the re-read bytes of an STL file from being one printable part; empty if nothing does.

    Corners are joined where their 32-bit coordinates are equal, as slicers do.
    """
    import trimesh

    mesh = trimesh.load_mesh(io.BytesIO(stl), file_type="stl")
    if len(mesh.faces) == 0:
        return ["it is empty"]
    found = []
    if not mesh.is_watertight:
        found.append("its surface has edges that do not join two triangles")
    elif not mesh.is_winding_consistent:
        found.append("its surface is turned inside out in places")
    elif not mesh.volume > 0:
        found.append(f"its volume is {mesh.volume:g} mm³")
    nodes = np.arange(len(mesh.faces))
    if (pieces := len(trimesh.graph.connected_components(mesh.face_adjacency, nodes=nodes, min_len=1))) != 1:
        found.append(f"it is {pieces} pieces")
    return found


def require_part(name: str, stl: bytes) -> None:
    """Refuse a file that is not one closed part.

    Raises
    ------
    CannotBuildError
        Naming the part and its faults.
    """
    if found := faults(stl):
        raise CannotBuildError(f"part {name} cannot be printed: {', '.join(found)}: thicken it where it is thinnest")
