"""Separate toes, and holes that print lying."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
import trimesh
from support.built import LONG_TOES, built, placed

from jumpcad.parts.foot import foot
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.toes import (
    lying_hole,
    on_the_foot,
    toes,
    toes_apart,
)
from jumpcad.solids.outline import hole


@pytest.mark.parametrize("diameter", [2.9, 3.4])
def test_a_lying_hole_holds_its_shaft_under_a_roof_of_45_degrees(diameter: float) -> None:
    """Above the round no wall overhangs by more than 45°, up to a flat bridge of a quarter of the width."""
    region = lying_hole(diameter, (5.0, 7.0))
    points = np.concatenate(region.to_polygons()) - [5.0, 7.0]
    radius = diameter / 2.0
    assert np.hypot(*points.T).min() > 0.99 * radius
    assert (hole(diameter, (5.0, 7.0)) - region).area() < 1e-6
    assert points.min(axis=0) == pytest.approx([-radius, -radius], rel=2e-3)
    above = points[points[:, 1] > 0.75 * radius]
    flat = above[above[:, 1] > above[:, 1].max() - 1e-6]
    assert np.ptp(flat[:, 0]) == pytest.approx(0.264 * diameter, rel=0.01)
    assert above[:, 1].max() == pytest.approx(1.15 * radius)
    np.testing.assert_allclose(np.abs(above[:, 0]) + above[:, 1], math.sqrt(2.0) * radius, atol=0.02 * radius)


def test_toes_apart_are_mirror_images() -> None:
    robot = built(LONG_TOES)
    left, right = (placed(robot, name) for name in ("toe_left", "toe_right"))
    assert left.volume == pytest.approx(right.volume, rel=1e-5)
    np.testing.assert_allclose(left.center_mass * [1, -1, 1], right.center_mass, atol=2e-3)
    signs = np.array([[1, -1, 1], [-1, 1, -1], [1, -1, 1]])
    np.testing.assert_allclose(left.moment_inertia * signs, right.moment_inertia, rtol=1e-3, atol=100.0)


def test_screws_of_toes_cut_their_thread_into_the_stubs() -> None:
    """Holes as wide as the workshop taps for M3, at 16 and 30 mm from the root of either toe."""
    robot = built(LONG_TOES)
    holes = HoleSizes.of(robot.workshop, None)
    holes = replace(holes, fits=holes.fits.model_copy(update={"m3_tap_mm": 2.7}))
    _, cuts = on_the_foot(robot.layout, holes)
    assert len(cuts) == 2
    for toe, stub in zip(toes(robot.layout), cuts, strict=True):
        (x0, y0, _), (x1, y1, _) = stub.block.bounds_mm  # type: ignore[attr-defined]
        assert (x0, x1) == pytest.approx((16.0 - 1.35, 30.0 + 1.35), abs=0.01)
        assert y0 == -y1 < -robot.layout.sections.toe_width_mm / 2.0
        assert (stub.angle_rad, stub.place_mm) == (toe.angle_rad, pytest.approx(toe.root_mm))  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", ["kenan-2.0", LONG_TOES])
def test_bare_toes_have_two_grooves_across_the_sole_at_their_tips(name: str) -> None:
    """Two layers of 0.2 mm deep, two lines of 0.4 mm wide, 2.4 mm apart about the tip's middle, closed at both ends."""
    robot = built(name)
    layout = replace(robot.layout, sections=replace(robot.layout.sections, pad_mm=0.0))
    for toe in toes(layout):
        if layout.toes_apart:
            (mesh,) = (one.mesh for one in toes_apart(layout, robot.workshop) if one.name == toe.name)
        else:
            turn = np.linalg.inv(toe.pose_mm)
            mesh = foot(layout, robot.workshop).mesh.copy().apply_transform(turn)
        slits = [
            shapely.Polygon(ring)
            for polygon in trimesh.load_path(
                trimesh.intersections.mesh_plane(mesh, [0.0, 0.0, 1.0], [0.0, 0.0, 0.39])[:, :, :2]
            ).polygons_full
            for ring in polygon.interiors
            if shapely.Polygon(ring).distance(shapely.Point(toe.length_mm, 0.0)) < 3.0
        ]
        expected = [toe.length_mm - 1.2, toe.length_mm + 1.2]
        assert sorted(slit.centroid.x for slit in slits) == pytest.approx(expected, abs=0.01)
        for slit in slits:
            low_x, low_y, high_x, high_y = slit.bounds
            assert (high_x - low_x, low_y, high_y) == pytest.approx((0.8, -1.5, 1.5), abs=0.01)
        above = trimesh.intersections.mesh_plane(mesh, [0.0, 0.0, 1.0], [0.0, 0.0, 0.41])[:, :, :2]
        assert (
            shapely.Point(expected[0], 0.0).distance(shapely.multilinestrings(list(shapely.linestrings(above)))) > 1.0
        )
