"""STL: one mesh a file, binary, in millimetres, in printing orientation."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import trimesh

HEADER = b"jumpcad, millimetres".ljust(80)  # must not begin with "solid", which marks text files


def write_stl(mesh: "trimesh.Trimesh") -> bytes:
    """Return the STL file of a mesh (mm); the same mesh gives the same bytes.

    `jumpcad.solids.finish.faults` checks that a file is one printable part.
    """
    import trimesh
    from trimesh.exchange.stl import export_stl

    corners = mesh.vertices.astype(np.float32)  # what is written: the normals must be those of these
    written = trimesh.Trimesh(corners, mesh.faces, process=False)
    return HEADER + bytes(export_stl(written)[len(HEADER) :])
