"""Letters: their size, their holes, and what cannot be drawn."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.solids.text import text


def test_capitals_have_the_height_asked_for_and_stand_on_the_line():
    _, low, _, high = text("HEH", 5.0).bounds()
    assert (low, high) == pytest.approx((0.0, 5.0), abs=0.01)


def test_letters_have_their_holes():
    assert len(text("o", 5.0).to_polygons()) == 2
    assert len(text("B8", 5.0).to_polygons()) == 6
    assert text("o", 5.0).area() < text("o", 5.0).hull().area()


def test_what_cannot_be_engraved_is_refused():
    for label, height in (("", 3.0), ("  ", 3.0), ("leg", 0.0)):
        with pytest.raises(JumpcadError, match="cannot be engraved"):
            text(label, height)
