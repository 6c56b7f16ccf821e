"""Names beside a picture: apart from each other, inside it, on the side of their parts."""

import numpy as np
import pytest
from PIL import Image

from jumpcad.scene.labels import EDGE_PX, ROW_PX, _rows, _spread, _width, labelled


@pytest.mark.parametrize("wanted", [[], [5.0], [50.0, 51.0, 52.0, 53.0], [380.0, 390.0, 399.0], [10.0, 200.0, 398.0]])
def test_rows_are_apart_and_inside_the_picture(wanted: list[float]) -> None:
    placed = _spread(wanted, 400)
    assert len(placed) == len(wanted)
    assert (np.diff(placed) >= ROW_PX - 1e-9).all()
    assert all(ROW_PX - 1e-9 <= y <= 400 - ROW_PX + 1e-9 for y in placed)


def test_names_stand_on_the_side_of_their_parts_in_their_order() -> None:
    """The left half of the parts has its names on the left, the others on the right, each list from top to bottom."""
    ends = np.array([[300.0, 50.0], [20.0, 200.0], [40.0, 100.0], [280.0, 300.0]])
    rows = {name: (end, text, left) for name, end, text, left in _rows(["a", "b", "c", "d"], ends, (400, 400), 0)}
    assert {name for name, (*_, left) in rows.items() if left} == {"b", "c"}
    for index, name in enumerate("abcd"):
        end, (x, y), left = rows[name]
        assert (end == ends[index]).all()
        assert y == end[1]
        widest = max(_width(one) for one in ("bc" if left else "ad"))
        assert x == pytest.approx(EDGE_PX + widest if left else 400.0 - EDGE_PX - widest)


def test_an_arrow_leads_from_where_a_part_is_drawn_to_its_place() -> None:
    """Its head, wider than its shaft, is at the place."""
    picture = Image.new("RGB", (300, 200), (255, 255, 255))
    at, place = np.array([[150.0, 40.0]]), np.array([[150.0, 160.0]])
    drawn = np.asarray(labelled(picture, ["part"], at, place, 0)).astype(int)
    red = (drawn[..., 0] - drawn[..., 2]) > 80
    width = red.sum(axis=1)
    shaft = width[95:105].max()
    assert width[145:160].max() > 2 * shaft > 0
    assert width[46:60].max() <= shaft + 1
