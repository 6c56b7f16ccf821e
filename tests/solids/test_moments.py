"""Integrals over regions and volumes against handbook formulas and an independent program."""

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold

from jumpcad.mechanism.mass import combined
from jumpcad.solids import moments, outline


def test_second_moments_of_a_rectangle_off_the_origin():
    b, h, x, y = 8.0, 3.0, 5.0, -2.0
    expected = [b * h, b * h * x, b * h * y, h * b**3 / 12 + b * h * x**2, b * h**3 / 12 + b * h * y**2, b * h * x * y]
    assert moments.areas_moments([outline.rectangle((b, h), (x, y))])[0] == pytest.approx(expected)


def test_product_moment_of_a_right_triangle():
    # handbook: I_xy = b²h²/24 about the right-angled corner
    triangle = outline.polygon([(0.0, 0.0), (6.0, 0.0), (0.0, 4.0)])
    assert moments.areas_moments([triangle])[0, 5] == pytest.approx(6.0**2 * 4.0**2 / 24.0)


def test_holes_count_negative():
    plate, hole = outline.rectangle((20.0, 20.0)), outline.rectangle((4.0, 2.0), (3.0, 1.0))
    whole, empty, left = moments.areas_moments([plate, hole, plate - hole])
    assert left == pytest.approx(whole - empty)


def test_moments_of_a_border_are_those_of_a_thin_strip():
    whole = outline.rectangle((30.0, 12.0), (4.0, 7.0)) - outline.polygon([(-8.0, 3.0), (9.0, 4.0), (1.0, 11.0)])
    region, width = whole - outline.disc(3.0, (14.0, 6.0)), 0.05
    strip = outline.grown(region, width / 2) - outline.grown(region, -width / 2)
    areas, borders = moments.areas_and_borders([region, strip])
    assert width * borders[0] == pytest.approx(areas[1], rel=5e-3)


def test_a_border_goes_around_holes_too():
    plate, hole = outline.rectangle((30.0, 12.0)), outline.rectangle((4.0, 2.0), (3.0, 1.0))
    holed, empty = plate - hole, plate - plate
    measured = moments.Measured(empty)
    for regions, lengths in (([holed, empty, holed], [96, 0, 96]), ([hole, holed], [12, 96])):
        areas, borders = measured.of(regions)
        assert borders[:, 0] == pytest.approx(lengths)
        assert areas[:, 0] == pytest.approx([region.area() for region in regions])


def test_many_regions_at_once_are_each_as_alone():
    # a polygon of n corners on a circle: area n/2·r²·sin(2π/n), border 2·n·r·sin(π/n)
    radii = [3.0, 0.5, 80.0, 60.0, 1.0, 90.0, 40.0]
    counts = np.array([7, 3, moments.BATCH_SIDES - 2, moments.BATCH_SIDES + 500, 5, 2500, 2400])
    turns = [2.0 * np.pi * np.arange(count) / count for count in counts]
    regions = [
        outline.polygon(radius * np.column_stack([np.cos(turn), np.sin(turn)]))
        for radius, turn in zip(radii, turns, strict=True)
    ]
    squares = np.square(radii)
    areas, borders = moments.areas_and_borders(regions)
    assert areas[:, 0] == pytest.approx(counts / 2.0 * squares * np.sin(2.0 * np.pi / counts))
    assert borders[:, 0] == pytest.approx(2.0 * counts * np.array(radii) * np.sin(np.pi / counts))
    assert moments.areas_moments([]).shape == (0, 6)


def test_a_prism_is_a_box():
    area = moments.areas_moments([outline.rectangle((40.0, 20.0), (7.0, -3.0))])
    found = moments.mass_of(moments.prism_moments(area, 2.0, 12.0), 1.27)
    mass = 1.27e-6 * 8000.0
    assert found.mass_kg == pytest.approx(mass)
    assert found.com_m == pytest.approx([0.007, -0.003, 0.007])
    box = mass / 12.0 * np.diag([0.02**2 + 0.01**2, 0.04**2 + 0.01**2, 0.04**2 + 0.02**2])
    np.testing.assert_allclose(found.inertia_kg_m2, box, atol=1e-15)


def test_several_prisms_add_up_like_bodies():
    areas = moments.areas_moments([outline.rectangle(size) for size in ((9.0, 4.0), (3.0, 5.0))])
    together = moments.mass_of(moments.prism_moments(areas, [0.0, 2.0], [2.0, 5.0]), 1.0)
    alone = [moments.mass_of(moments.prism_moments(areas[n], z0, z1), 1.0) for n, z0, z1 in ((0, 0, 2), (1, 2, 5))]
    np.testing.assert_allclose(together.inertia_kg_m2, combined(alone).inertia_kg_m2, atol=1e-18)


def test_a_mesh_agrees_with_an_independent_program():
    solid = Manifold.cube((30.0, 20.0, 10.0)).rotate((20.0, 30.0, 40.0)).translate((5.0, 6.0, 7.0)) - Manifold.sphere(
        12.0
    )
    mesh = solid.to_mesh64()
    judge = trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts, process=False)
    judge.density = 1.0
    found = moments.mass_of(moments.mesh_moments(solid), 1.0)
    assert found.mass_kg / moments.G_PER_CM3 == pytest.approx(judge.mass)
    assert found.com_m * 1000.0 == pytest.approx(judge.center_mass)
    inertia = found.inertia_kg_m2 / moments.G_PER_CM3 / moments.MM**2
    np.testing.assert_allclose(inertia, judge.moment_inertia, atol=1e-9 * np.abs(judge.moment_inertia).max())
