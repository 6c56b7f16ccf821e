"""Sections of blocks in closed form against slices of their solids, which another program cuts."""

import numpy as np
import pytest
import shapely

from jumpcad.building.assembly import layout_of
from jumpcad.design import load_design
from jumpcad.robot.foot.drawing import foot
from jumpcad.solids.blocks import Bar, Blocks, Finger, Turned
from jumpcad.solids.outline import disc, hole, rectangle
from jumpcad.workshop import load_workshop

FINGER = Finger(np.array([3.0, 8.0]), 8.0, 9.0, np.array([-60.0, 40.0]), 5.0, 4.0)


def require_same_sections(shape, heights_mm, tolerance_mm):
    """Compare sections with slices; where tops slope gently, `tolerance_mm` of height moves their edges."""
    solid = shape.solid()
    for z, region in zip(heights_mm, shape.regions_at(heights_mm), strict=True):
        low, high = (solid.slice(z + step) for step in (-tolerance_mm, tolerance_mm))
        assert (region - (low + high)).area() < 0.02
        assert ((low ^ high) - region).area() < 0.02


@pytest.mark.parametrize("name", ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"])
def test_the_foot_is_what_its_solid_is_at_every_layer(name):
    shop = load_workshop("default")
    shape = foot(layout_of(load_design(name), shop), shop).shape
    low, high = shape.solid().bounding_box()[:3], shape.solid().bounding_box()[3:]
    np.testing.assert_allclose(shape.bounds_mm, [low, high], atol=2e-3)
    require_same_sections(shape, np.arange(0.1, high[2], 0.2), 2e-3)


def test_a_finger_is_a_stadium_up_to_its_tip_and_shrinks_to_its_root():
    blocks = Blocks((FINGER,))
    require_same_sections(blocks, np.array([0.5, 3.99, 4.5, 6.0, 8.9]), 1e-6)
    low, middle, top, outside = blocks.regions_at([1.0, 6.5, 8.999, 9.0])
    assert low.bounds() == pytest.approx((-62.5, 4.0, 7.0, 42.5))
    # half-way up the slope the end has come half-way back, and has half of both diameters
    assert middle.bounds()[0] == pytest.approx(-28.5 - 6.5 / 2.0)
    assert top.area() == pytest.approx(disc(8.0).area(), rel=1e-2)
    assert outside.is_empty()


def test_a_bar_with_a_hole_is_rectangles_beside_the_hole():
    bar = Blocks((Bar(rectangle((20.0, 8.0), (0.0, 4.0)) - hole(4.0, (2.0, 5.0)), ((1.0, 3.0), (-3.0, -1.0))),))
    through, above = bar.regions_at([5.0, 7.5])
    assert len(through.to_polygons()) == 4
    assert through.area() == pytest.approx(2 * 2.0 * (20.0 - 4.0), rel=1e-3)
    assert above.area() == pytest.approx(2 * 2.0 * 20.0)


def test_what_is_removed_is_removed_and_equal_heights_are_one_outline():
    block = Blocks(
        (Bar(rectangle((10.0, 4.0), (0.0, 2.0)), ((0.0, 5.0),)),), (Bar(rectangle((2.0, 2.0)), ((-1.0, 6.0),)),)
    )
    outlines, which, inset, _ = block.sections_at([0.2, 0.8, 1.2, 3.0])
    assert [outline.area() for outline in outlines] == pytest.approx([40.0, 50.0])
    assert which.tolist() == [0, 0, 1, 1]
    assert not inset.any()


def test_moments_are_those_of_the_sections():
    blocks = Blocks((FINGER, Bar(disc(9.0, (0.0, 4.5)), ((-3.0, 9.0),))))
    z = (np.arange(2000) + 0.5) * blocks.bounds_mm[1, 2] / 2000.0
    areas = np.array([region.area() for region in blocks.regions_at(z)])
    step = blocks.bounds_mm[1, 2] / 2000.0
    assert blocks.moments[0] == pytest.approx(step * areas.sum(), rel=1e-3)
    assert blocks.moments[3] == pytest.approx(step * (areas * z).sum(), rel=1e-3)


def test_outlines_span_what_is_seen_from_above() -> None:
    """The hull of a bar across, 20 x 6 mm, and of a finger that tapers beside it."""
    bar = Bar(rectangle((20.0, 4.0), (10.0, 2.0)), ((-3.0, 3.0),))
    assert sorted(map(tuple, bar.outline_mm.tolist())) == [(0.0, -3.0), (0.0, 3.0), (20.0, -3.0), (20.0, 3.0)]
    finger = Finger(np.array([0.0, 10.0]), 6.0, 4.0, np.array([30.0, 10.0]), 4.0, 2.0)
    points = Blocks((bar, finger)).outline_mm
    solid = Blocks((bar, finger)).solid().to_mesh().vert_properties[:, :2]
    hull, seen = (shapely.MultiPoint(one).convex_hull for one in (points, solid))
    assert hull.symmetric_difference(seen).area < 0.01 * seen.area


def test_blocks_of_the_same_numbers_are_equal_and_others_are_not():
    def blocks(width=8.0, tip=4.0, angle=0.7, removed=2.0, place=(0.0, 0.0)):
        finger = Finger(np.array([3.0, 8.0]), 8.0, 9.0, np.array([-60.0, 40.0]), 5.0, tip)
        bar = Bar(rectangle((20.0, width)), ((1.0, 3.0),))
        return Blocks((Turned(finger, angle, np.array(place)), bar), (Bar(disc(removed), ((0.0, 9.0),)),))

    assert blocks() == blocks()
    assert hash(blocks()) == hash(blocks())
    assert len({blocks(), blocks(width=8.1), blocks(tip=4.1), blocks(angle=0.8), blocks(removed=2.1),
                blocks(place=(0.1, 0.0)), blocks(place=(0.0, 0.1))}) == 7  # fmt: skip
