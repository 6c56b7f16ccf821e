"""Letters: their size, their holes, and what cannot be drawn."""

from pathlib import Path

import matplotlib
import pytest
from fontTools.ttLib import TTFont

from jumpcad.errors import JumpcadError
from jumpcad.solids.text import FONT, text


def test_capitals_have_the_height_asked_for_and_stand_on_the_line():
    _, low, _, high = text("HEH", 5.0).bounds()
    assert (low, high) == pytest.approx((0.0, 5.0), abs=0.01)


def test_letters_may_be_lower_than_a_millimetre():
    assert text("H", 0.7).bounds()[3] == pytest.approx(0.7, abs=0.01)


def test_letters_have_their_holes():
    assert len(text("o", 5.0).to_polygons()) == 2
    assert len(text("B8", 5.0).to_polygons()) == 6
    assert text("o", 5.0).area() < text("o", 5.0).hull().area()


def test_longer_words_are_longer_and_blanks_count():
    width = {word: text(word, 4.0).bounds()[2] for word in ("leg", "leg leg", "legleg")}
    assert width["leg"] < width["legleg"] < width["leg leg"]


def test_letters_are_as_far_apart_as_the_font_says():
    """By another reader of its tables: advance widths, and the height of H, in units of the font."""
    font = TTFont(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / FONT)
    widths, codes, capital = font["hmtx"].metrics, font.getBestCmap(), font["glyf"]["H"].yMax
    for before in ("H", "i", "W", "l g"):
        advance = sum(widths[codes[ord(letter)]][0] for letter in before)
        right = text(f"{before}H", 5.0).bounds()[2] - text("H", 5.0).bounds()[2]
        assert right == pytest.approx(5.0 * advance / capital, rel=2e-3)


def test_what_cannot_be_engraved_is_refused():
    for label, height in (("", 3.0), ("  ", 3.0), ("leg", 0.0)):
        with pytest.raises(JumpcadError, match="cannot be engraved"):
            text(label, height)
