"""Shading: one vertex where a surface is round, several where it has an edge."""

import numpy as np
import pytest
import trimesh

from jumpcad.scene.shading import with_normals


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
