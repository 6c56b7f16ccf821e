"""Pixels show the nearest triangle that faces the camera, with neither gaps nor overlaps."""

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay

from jumpcad.scene.raster import rasterized, with_normals

SIZE = (40, 30)
CENTRES = np.stack(np.meshgrid(np.arange(40) + 0.5, np.arange(30) + 0.5), axis=-1).reshape(-1, 2)


def facing(corners: np.ndarray) -> np.ndarray:
    """Return triangles (n, 3, k) turned counter-clockwise as seen, on pixels that count downwards."""
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T[:2], (corners[:, 2] - corners[:, 0]).T[:2]
    return np.where((ax * by > ay * bx)[:, None, None], corners[:, ::-1], corners)


def triangles(points: np.ndarray, faces: np.ndarray, nearness: float = 1.0, shade: float = 1.0) -> np.ndarray:
    values = np.column_stack([points, np.full(len(points), nearness), np.full(len(points), shade)])
    return facing(values[faces])


def test_a_net_of_triangles_covers_every_pixel_by_the_triangle_around_its_centre() -> None:
    inner = np.random.default_rng(5).uniform([0.0, 0.0], [40.0, 30.0], (400, 2))
    inner[:40, 1] = inner[0, 1]  # a row of points: edges along the rows, and slivers
    net = Delaunay(np.concatenate([inner, [[-9.0, -9.0], [49.0, -9.0], [49.0, 39.0], [-9.0, 39.0]]]))
    number, _, _ = rasterized(triangles(net.points, net.simplices), SIZE)
    assert np.array_equal(number.ravel(), net.find_simplex(CENTRES))


def test_a_square_has_as_many_pixels_as_its_area() -> None:
    corners = np.array([[4.0, 7.0], [24.0, 7.0], [24.0, 17.0], [4.0, 17.0]])
    number, nearness, _ = rasterized(triangles(corners, np.array([[0, 1, 2], [0, 2, 3]])), SIZE)
    assert (number >= 0).sum() == 20 * 10
    assert (number[7:17, 4:24] >= 0).all()
    assert np.array_equal(nearness > 0.0, number >= 0)


def test_what_is_nearer_is_seen_in_whatever_order_and_backs_never() -> None:
    corners = np.array([[0.0, 0.0], [40.0, 0.0], [0.0, 60.0]])
    near, far = (triangles(corners, np.array([[0, 1, 2]]), nearness, nearness) for nearness in (2.0, 1.0))
    for order, seen in (((near, far), 0), ((far, near), 1)):
        number, _, shade = rasterized(np.concatenate(order), SIZE)
        assert set(number[number >= 0]) == {seen}
        assert set(shade[number >= 0]) == {2.0}
    number, _, _ = rasterized(np.concatenate([near[:, ::-1], far]), SIZE)
    assert set(number[number >= 0]) == {1}
    assert (rasterized(near[:, ::-1], SIZE)[0] == -1).all()
    near[0, 0, 2] = -0.1
    assert (rasterized(near, SIZE)[0] == -1).all(), "it reaches behind the camera"


def test_nearness_and_shade_of_a_slope_are_those_at_the_pixels_centre() -> None:
    corners = np.array([[-30.0, -20.0], [90.0, -10.0], [10.0, 80.0]])
    plane = np.column_stack([corners, 3.0 + corners @ [0.02, -0.01], 0.5 + corners @ [0.001, 0.003]])
    number, nearness, shade = rasterized(facing(plane[None]), SIZE)
    assert (number == 0).all()
    assert np.allclose(nearness.ravel(), 3.0 + CENTRES @ [0.02, -0.01])
    assert np.allclose(shade.ravel(), 0.5 + CENTRES @ [0.001, 0.003])


def test_a_box_has_three_vertices_at_a_corner_and_a_ball_one():
    vertices, normals, faces = with_normals(trimesh.creation.box((1.0, 2.0, 3.0)))
    assert (len(vertices), len(faces)) == (24, 12)
    assert np.array_equal(np.abs(normals).max(axis=1), np.ones(24))
    ball = trimesh.creation.icosphere(subdivisions=3)
    vertices, normals, _ = with_normals(ball)
    assert len(vertices) == len(ball.vertices)
    np.testing.assert_allclose(normals, vertices, atol=0.02)


def test_faces_stay_where_they_are():
    mesh = trimesh.creation.cylinder(5.0, 8.0, sections=48)
    vertices, normals, faces = with_normals(mesh)
    np.testing.assert_allclose(vertices[faces], mesh.triangles)
    assert ((normals[faces] * mesh.face_normals[:, None]).sum(axis=2) > np.cos(0.5)).all()


def test_a_cylinder_has_two_rims_and_is_round_between() -> None:
    vertices, normals, faces = with_normals(trimesh.creation.cylinder(5.0, 8.0, sections=64))
    side = np.abs(normals[:, 2]) < 0.5
    assert side.sum() == (~side & (np.hypot(*vertices[:, :2].T) > 1.0)).sum() == 2 * 64
    assert np.allclose(normals[side, :2], vertices[side, :2] / 5.0, atol=0.03)
    assert np.allclose(trimesh.Trimesh(vertices, faces).area, trimesh.creation.cylinder(5.0, 8.0, sections=64).area)


@pytest.mark.parametrize(("sides", "faceted"), [(6, True), (8, True), (24, False), (48, False)])
def test_a_nut_has_edges_and_a_rod_has_none(sides: int, faceted: bool) -> None:
    """The sides of a prism of n sides meet at 360°/n: a hexagon nut shows its flats, a rod drawn with 24 is round."""
    _, normals, _ = with_normals(trimesh.creation.cylinder(5.0, 8.0, sections=sides))
    around = normals[np.abs(normals[:, 2]) < 0.5]
    directions = np.unique(np.round(np.arctan2(around[:, 1], around[:, 0]), 3))
    assert (len(around) > 2 * sides) == faceted
    assert len(directions) >= sides
