"""Sockets of a leg's bar, by hand."""

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import CannotBuildError
from jumpcad.robot.leg.bars import bar_place

STRIP = load_catalogue().bars["carbon-strip-3x6"]


def test_the_bending_socket_is_five_heights_and_the_other_8_mm() -> None:
    """A strip of 6 mm height: from 10 to 40 mm, and from 92 to 100 mm; the bar is 0.2 mm shorter at both ends."""
    place = bar_place("main leg", STRIP, 10.0, 0.0, 100.0, bends=True)
    assert (place.floor_mm, place.mouth_mm, place.far_mouth_mm, place.far_floor_mm) == (10.0, 40.0, 92.0, 100.0)
    assert place.length_mm == pytest.approx(89.6)
    assert place.middle_mm == 55.0
    assert bar_place("front link", STRIP, 10.0, 0.0, 100.0, bends=False).mouth_mm == 18.0
    assert bar_place("main leg", STRIP, 10.0, 45.0, 100.0, bends=True).mouth_mm == 45.0


def test_five_millimetres_between_the_sockets_are_enough() -> None:
    assert bar_place("main leg", STRIP, 10.0, 0.0, 53.0, bends=True).far_mouth_mm == 45.0
    with pytest.raises(CannotBuildError, match=r": 4\.0 mm of the main leg are free") as refused:
        bar_place("main leg", STRIP, 10.0, 0.0, 52.0, bends=True)
    assert refused.value.margin == pytest.approx(-1.0)
