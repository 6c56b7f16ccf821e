"""Closed surfaces over outlines on a grid: Euler's formula, volumes by hand, and outlines that nearly meet."""

from collections import Counter

import numpy as np
import pytest
import trimesh
from manifold3d import CrossSection

from jumpcad.solids.skin import GRID_MM, _chains, _conforming, skin

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


def stars(rng, count):
    """Return outlines of random stars, counter-clockwise, as contours of one region each (mm)."""
    turns = np.sort(rng.uniform(0.0, 2.0 * np.pi, (count, 9)), axis=1)
    return [
        [rng.uniform(2.0, 9.0, 9)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]) + rng.uniform(-2.0, 2.0, 2)]
        for turn in turns
    ]


@pytest.mark.parametrize("seed", range(6))
def test_slabs_of_stars_are_closed_and_as_large_as_their_outlines(seed):
    """Against the polygons' own areas; every edge has two faces, run through once in either direction."""
    rng = np.random.default_rng(seed)
    contours, heights = stars(rng, 4), [(0.0, 1.0), (1.0, 3.0), (3.0, 3.5), (5.0, 6.0)]
    vertices, faces = skin(heights, contours)
    runs = Counter(tuple(edge) for face in faces.tolist() for edge in zip(face, face[1:] + face[:1], strict=True))
    assert set(runs.values()) == {1}
    assert all((end, start) in runs for start, end in runs)
    areas = [CrossSection(one).area() for one in contours]
    volume = sum(area * (top - bottom) for area, (bottom, top) in zip(areas, heights, strict=True))
    assert trimesh.Trimesh(vertices, faces, process=False).volume == pytest.approx(volume, rel=2e-4)
    at_bottom = vertices[vertices[:, 2] == 0.0]
    for corner in contours[0][0]:
        assert np.abs(at_bottom[:, :2] - corner).max(axis=1).min() < 8 * GRID_MM


def cross(one, other):
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


@pytest.mark.parametrize("seed", range(4))
def test_edges_meet_in_their_ends_alone_and_pass_no_point_within_half_a_step(seed):
    """Snap rounding (Hobby 1999), checked pair by pair in whole numbers; no edge is 4 steps long or shorter."""
    contours = stars(np.random.default_rng(seed), 3)
    bar = np.array([[-9.0, 0.0], [9.0, 1e-3], [9.0, 0.5], [-9.0, 0.5]])
    points, edges, signs = _conforming(*_chains([*contours, [bar], [bar + np.array([0.0, 0.5005])]]))
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    run = end - start
    assert ((run**2).sum(axis=1) > 16).all()
    assert signs.any(axis=1).all()
    for point in range(len(points)):
        own = (edges == point).any(axis=1)
        away = points[point] - start
        off = np.abs(cross(run, away))
        along = (run * away).sum(axis=1)
        beside = (along > 0) & (along < (run**2).sum(axis=1))
        assert not (beside & ~own & (2 * off <= np.abs(run).sum(axis=1))).any()
    for one in range(len(edges)):
        side = [
            np.sign(run[one, 0] * (at - start[one])[:, 1] - run[one, 1] * (at - start[one])[:, 0])
            for at in (start, end)
        ]
        other = [
            np.sign(run[:, 0] * (at - start)[:, 1] - run[:, 1] * (at - start)[:, 0]) for at in (start[one], end[one])
        ]
        assert not ((side[0] * side[1] < 0) & (other[0] * other[1] < 0)).any()
