"""From a solid to its mesh and its STL file: binary, in mm, in printing orientation; and the check of such a file."""

from functools import lru_cache

import numpy as np
from manifold3d import Manifold
from scipy import sparse
from scipy.sparse import csgraph

from jumpcad.errors import CannotBuildError
from jumpcad.transforms import Trimesh

TOLERANCE_MM = 1e-3
HEADER_BYTES = 84
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""Of a binary STL file."""
FILES_KEPT = 32
"""Files whose faults are remembered: the parts of a robot, which are looked at as they are written and as a limit."""


def finished(solid: Manifold) -> Manifold:
    """Return the result of 3D booleans without the slivers that would open its surface in a file."""
    return solid.set_tolerance(TOLERANCE_MM).as_original().simplify(TOLERANCE_MM)


def to_trimesh(solid: Manifold) -> Trimesh:
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
    corners = np.frombuffer(stl, FACET, offset=HEADER_BYTES)["corners"].reshape(-1, 3) + np.float32(0.0)  # -0 is 0
    if len(corners) == 0:
        return ["it is empty"]
    start = np.zeros(len(corners), dtype=np.int64)
    for axis in corners.T.copy().view(np.uint32):
        start = np.unique((start << 32) + axis, return_inverse=True)[1]
    end = np.roll(start.reshape(-1, 3), -1, axis=1).ravel()
    edges = (np.minimum(start, end) << 32) + np.maximum(start, end)
    order = np.argsort(edges)
    edges, forwards, face = edges[order], (start < end)[order], order // 3
    same = edges[1:] == edges[:-1]
    volume = float(np.linalg.det(corners.reshape(-1, 3, 3).astype(float)).sum()) / 6.0
    found = []
    if len(edges) % 2 or not same[::2].all() or same[1::2].any():
        found.append("its surface has edges that do not join two triangles")
    elif (forwards[::2] == forwards[1::2]).any():
        found.append("its surface is turned inside out in places")
    elif not volume > 0:
        found.append(f"its volume is {volume:g} mm³")
    joined = sparse.coo_array((same[same], (face[:-1][same], face[1:][same])), (len(start) // 3,) * 2)
    if (pieces := csgraph.connected_components(joined, directed=False, return_labels=False)) != 1:
        found.append(f"it is {pieces} pieces")
    return found


def require_part(name: str, stl: bytes) -> None:
    """Refuse a file that is not one closed part."""
    if found := faults(stl):
        raise CannotBuildError(f"part {name} cannot be printed: {', '.join(found)}: thicken it where it is thinnest")


HEADER = b"jumpcad, millimetres".ljust(80)  # must not begin with "solid", which marks text files


def write_stl(mesh: Trimesh) -> bytes:
    """Return the STL file of a mesh (mm); the same mesh gives the same bytes.

    `jumpcad.solids.stl.faults` checks that a file is one printable part.
    """
    import trimesh
    from trimesh.exchange.stl import export_stl

    corners = mesh.vertices.astype(np.float32)  # what is written: the normals must be those of these
    written = trimesh.Trimesh(corners, mesh.faces, process=False)
    return HEADER + bytes(export_stl(written)[len(HEADER) :])
