"""Closed surfaces over outlines on a grid: Euler's formula, volumes by hand, and outlines that nearly meet."""

from collections import Counter

import numpy as np
import pytest
import trimesh

from jumpcad.solids.skin import GRID_MM, skin

SQUARE = np.array([[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]])
HOLE = np.array([[2.0, 2.0], [2.0, 6.0], [6.0, 6.0], [6.0, 2.0]])
STEP = SQUARE * 0.5


def mesh(heights, contours):
    return trimesh.Trimesh(*skin(heights, contours), process=False)


def test_a_slab_is_a_box():
    box = mesh([(1.0, 4.0)], [[SQUARE]])
    assert (len(box.vertices), len(box.faces)) == (8, 12)
    assert box.volume == pytest.approx(8 * 8 * 3)
    assert box.euler_number == 2


def test_a_hole_makes_a_torus():
    frame = mesh([(0.0, 5.0)], [[SQUARE, HOLE]])
    assert frame.is_volume
    assert frame.volume == pytest.approx((64 - 16) * 5)
    assert frame.euler_number == 0


def test_a_step_has_a_floor_around_it():
    stepped = mesh([(0.0, 2.0), (2.0, 3.0)], [[SQUARE], [STEP + 1.0]])
    assert stepped.is_volume
    assert stepped.volume == pytest.approx(64 * 2 + 16)
    floor = np.isclose(stepped.triangles[:, :, 2], 2.0).all(axis=1)
    assert stepped.area_faces[floor].sum() == pytest.approx(64 - 16)
    assert (stepped.face_normals[floor][:, 2] > 0).all()


def test_slabs_that_do_not_touch_are_closed_each():
    apart = mesh([(0.0, 1.0), (2.0, 3.0)], [[SQUARE], [SQUARE]])
    assert apart.is_volume
    assert apart.body_count == 2
    assert apart.volume == pytest.approx(128)


@pytest.mark.parametrize("gap_mm", [0.0, 1e-9, 1e-6, 3e-4, 2e-3])
def test_every_edge_has_two_faces_however_near_outlines_are(gap_mm):
    """Two rectangles cross, and two of their sides are a gap apart; corners are on the grid after that."""
    bar = np.array([[2.0, -gap_mm], [11.0, 3.0], [9.0, 5.0 + gap_mm], [-1.0, 2.0]])
    vertices, faces = skin([(0.0, 1.0), (1.0, 2.0)], [[SQUARE], [bar]])
    edges = Counter(
        tuple(sorted(edge)) for face in faces.tolist() for edge in zip(face, face[1:] + face[:1], strict=True)
    )
    assert set(edges.values()) == {2}
    assert np.array_equal(vertices[:, :2], np.rint(vertices[:, :2] / GRID_MM) * GRID_MM)
    assert trimesh.Trimesh(vertices.astype(np.float32), faces).is_watertight
