"""STL files, read again by another program."""

import io

import numpy as np
import pytest
import trimesh

from jumpcad.solids.finish import to_trimesh
from jumpcad.solids.outline import ring
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import write_stl


def hub():
    return to_trimesh(Stack.of([(0, 5, ring(20.0, 6.0)), (5, 8, ring(10.0, 6.0))]).solid())


def test_the_file_holds_the_mesh():
    mesh, data = hub(), write_stl(hub())
    read = trimesh.load_mesh(io.BytesIO(data), file_type="stl")
    assert len(data) == 84 + 50 * len(mesh.faces)
    assert read.is_volume
    assert read.volume == pytest.approx(mesh.volume, rel=1e-6)
    np.testing.assert_allclose(read.bounds, mesh.bounds, atol=1e-6)


def test_the_same_mesh_gives_the_same_bytes_and_never_reads_as_text():
    assert write_stl(hub()) == write_stl(hub())
    assert not write_stl(hub()).startswith(b"solid")


def test_normals_are_those_of_the_corners_that_are_written():
    """Far from the origin 32-bit floats are 15 µm apart, so that a hundredth of a millimetre is another triangle."""
    mesh = trimesh.creation.icosphere(subdivisions=1, radius=0.05).apply_translation((200.1234567, 150.7654321, 3.0))
    facets = np.frombuffer(write_stl(mesh)[84:], dtype=np.dtype([("vectors", "<f4", (4, 3)), ("spare", "<u2")]))
    normal, corners = facets["vectors"][:, 0], facets["vectors"][:, 1:].astype(float)
    right = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    np.testing.assert_allclose(normal, right / np.linalg.norm(right, axis=1)[:, None], atol=1e-6)
