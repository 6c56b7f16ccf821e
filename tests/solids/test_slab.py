"""Slabs: areas of what they extrude by elementary geometry, and which of them are equal."""

import math

import numpy as np
import pytest

from jumpcad.solids.outline import rectangle
from jumpcad.solids.slab import Slab, rounded_z


@pytest.mark.parametrize(("inset", "area"), [(1.0, 8.0 * 4.0), (0.25, 9.5 * 5.5), (2.9, 4.2 * 0.2), (3.1, 0.0)])
def test_an_inset_sets_every_side_back_and_leaves_corners_sharp(inset: float, area: float) -> None:
    """Of a rectangle of 10 x 6 mm: less twice the inset to either side."""
    region = Slab(0.0, 1.0, rectangle((10.0, 6.0)), inset).region
    assert region.area() == pytest.approx(area, abs=1e-9)
    assert region.num_vert() == (4 if area else 0)


def test_an_inset_widens_holes() -> None:
    """Of 4 x 4 mm in 20 x 20 mm: 6 x 6 mm in 18 x 18 mm."""
    outline = rectangle((20.0, 20.0)) - rectangle((4.0, 4.0))
    assert Slab(0.0, 1.0, outline, 1.0).region.area() == pytest.approx(18.0**2 - 6.0**2)


def test_a_pocket_with_a_number_is_taken_out_before_the_border_is_set_back() -> None:
    """Of 3 x 5 mm: with an inset of half a millimetre it is 4 x 6 mm. One without a number is not taken out."""
    outline, pocket = rectangle((10.0, 10.0)), rectangle((3.0, 5.0))
    assert Slab(0.0, 1.0, outline, pocket=pocket, pocket_number=2).region.area() == pytest.approx(100.0 - 15.0)
    assert Slab(0.0, 1.0, outline, 0.5, 0, pocket, 1).region.area() == pytest.approx(81.0 - 24.0)
    assert Slab(0.0, 1.0, outline, pocket=pocket).region.area() == pytest.approx(100.0)


def test_faces_that_meet_do_so_in_32_bit_floats_too() -> None:
    """Up to the height of a bed: sums of layers are as exact as their product."""
    for layers in (3, 7, 30, 999):
        stacked = math.fsum([0.2] * layers) + 1e-9
        assert np.float32(rounded_z(stacked)) == np.float32(rounded_z(0.2 * layers))
