"""Letters engraved in plates: where they may lie."""

import itertools

import numpy as np
import pytest

from jumpcad.parts.engraving import TEXT_HEIGHTS_MM, _possible, letters_on
from jumpcad.solids.outline import rectangle
from jumpcad.solids.text import text


def test_letters_may_lie_where_no_point_of_the_raster_below_them_is_outside() -> None:
    """A box of 5 x 3 mm covers what is less than 2.5 and 1.5 mm from its middle; beyond the raster all is outside."""
    outside = np.zeros((6, 9), dtype=bool)
    outside[1, 1] = True
    free = {(x, z) for z, x in itertools.product(range(6), range(9)) if not outside[z, x]}
    around = list(itertools.product((-2, -1, 0, 1, 2), (-1, 0, 1)))
    expected = [all((x + dx, z + dz) in free for dx, dz in around) for z in range(6) for x in range(9)]
    assert 0 < sum(expected) < 4 * 5
    assert _possible(outside, (5.0, 3.0)).tolist() == expected


@pytest.mark.parametrize(("more_mm", "high"), [((0.02, 0.02), True), ((-0.02, 0.02), False), ((0.02, -0.02), False)])
def test_a_label_has_0_8_mm_around_it_on_either_side(more_mm: tuple[float, float], high: bool) -> None:
    """In a window just so wide and high; in one that is a little smaller the letters are lower."""
    large, small = (text("Fy R", height) for height in TEXT_HEIGHTS_MM)
    low_x, low_z, high_x, high_z = large.bounds()
    window = (high_x - low_x + 2.0 * (0.8 + more_mm[0]), high_z - low_z + 2.0 * (0.8 + more_mm[1]))
    plate = rectangle((60.0, 40.0))  # the raster of places begins at its corner
    face = rectangle(window) + (plate - rectangle((59.0, 39.0)))
    letters = letters_on("Fy R", face, mirrored=False)
    assert letters is not None
    assert letters.area() == pytest.approx((large if high else small).area(), rel=1e-6)
