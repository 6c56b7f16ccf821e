"""STL files, read again by another program."""

import io

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold, OpType

from jumpcad.errors import CannotBuildError
from jumpcad.solids.outline import disc, hole, rectangle, ring
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import faults, finished, require_part, to_trimesh, write_stl


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


def stl(mesh):
    return trimesh.exchange.stl.export_stl(mesh)


def test_a_box_is_a_part():
    assert faults(stl(trimesh.creation.box((1, 2, 3)))) == []


def test_a_missing_triangle_is_found():
    mesh = trimesh.creation.box((1, 2, 3))
    mesh.faces = mesh.faces[1:]
    assert faults(stl(mesh)) == ["its surface has edges that do not join two triangles"]


def test_a_part_inside_out_is_found():
    mesh = trimesh.creation.box((1, 1, 1))
    mesh.faces = mesh.faces[:, ::-1]
    assert faults(stl(mesh)) == ["its volume is -1 mm³"]


def test_a_triangle_turned_over_is_found():
    mesh = trimesh.creation.box((1, 1, 1))
    mesh.faces[0] = mesh.faces[0, ::-1]
    assert faults(stl(mesh)) == ["its surface is turned inside out in places"]


def test_two_pieces_are_found_even_when_they_overlap():
    two = trimesh.util.concatenate([trimesh.creation.box((2, 2, 2)), trimesh.creation.icosphere(radius=0.5)])
    assert faults(stl(two)) == ["it is 2 pieces"]
    with pytest.raises(CannotBuildError, match="part toe cannot be printed: it is 2 pieces"):
        require_part("toe", stl(two))


def test_boxes_that_touch_along_an_edge_are_found():
    boxes = [Manifold.cube((1, 1, 1)), Manifold.cube((1, 1, 1)).translate((1, 1, 0))]
    assert faults(stl(to_trimesh(Manifold.batch_boolean(boxes, OpType.Add)))) != []


def test_stacks_in_two_directions_finish_as_one_part():
    side = rectangle((60.0, 8.0), (25.0, 4.0)) - hole(3.2, (40.0, 4.0))
    rails = [side.extrude(3.0).rotate((90.0, 0.0, 0.0)).translate((0.0, y, 0.0)) for y in (8.0, -5.0)]
    toe = Manifold.batch_hull([disc(8.0).extrude(8.0), disc(5.0, (-50.0, 30.0)).extrude(4.0)])
    web = rectangle((10.0, 14.0)).extrude(4.0)
    solid = finished(Manifold.batch_boolean([*rails, toe, web], OpType.Add))
    assert faults(stl(to_trimesh(solid))) == []
