"""STL files, read again by another program."""

import io

import numpy as np
import pytest
import trimesh

from jumpcad.exporters.stl import write_stl
from jumpcad.solids.finish import to_trimesh
from jumpcad.solids.outline import ring
from jumpcad.solids.stack import Stack


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
