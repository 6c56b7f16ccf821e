"""The chart of a study's page: values to places, and back by its own axis."""

import re
from xml.etree import ElementTree

import pytest

from jumpcad.search import study_chart
from jumpcad.search.study_chart import BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH


def test_an_axis_reaches_from_margin_to_margin() -> None:
    """Five per cent beyond the values on both sides; upwards in the picture is more."""
    low, high, ticks = scale = study_chart._scale([2.0, 4.0, 3.0])
    assert (low, high) == pytest.approx((1.9, 4.1))
    assert ticks == sorted(ticks)
    assert low <= ticks[0] < ticks[-1] <= high
    assert len(ticks) >= 4
    assert (study_chart._along(low, scale), study_chart._along(high, scale)) == pytest.approx((LEFT, WIDTH - RIGHT))
    assert (study_chart._up(low, scale), study_chart._up(high, scale)) == pytest.approx((HEIGHT - BOTTOM, TOP))
    assert study_chart._along(3.0, scale) == pytest.approx((LEFT + WIDTH - RIGHT) / 2.0)
    assert study_chart._up(3.0, scale) == pytest.approx((HEIGHT - BOTTOM + TOP) / 2.0)


@pytest.mark.parametrize("values", [[], [0.0], [5.0, 5.0]])
def test_an_axis_of_one_value_or_none_has_a_length(values: list[float]) -> None:
    low, high, _ = study_chart._scale(values)
    assert low < high
    assert all(low <= value <= high for value in values)


def test_lines_and_words_of_an_axis_stand_at_their_values() -> None:
    across, up = study_chart._scale([0.1, 0.5]), study_chart._scale([10.0, 30.0])
    root = ElementTree.fromstring(f"<svg>{''.join(study_chart._axes(across, up, 'range (mm)'))}</svg>")
    lines = [re.findall(r"[\d.]+", one.get("d")) for one in root.iter("path")]
    words = [(float(one.get("x")), float(one.get("y")), one.text) for one in root.iter("text")]
    for (at, top, foot), (x, y, said), value in zip(lines, words, across[2], strict=False):
        assert float(at) == pytest.approx(study_chart._along(value, across), abs=0.051)
        assert (float(top), float(foot)) == (TOP, HEIGHT - BOTTOM)
        assert (x, float(said)) == (float(at), value)
        assert HEIGHT - BOTTOM < y < HEIGHT
    beside, said_beside = lines[len(across[2]) :], words[len(across[2]) :]
    for (left, at, right), (x, y, said), value in zip(beside, said_beside, up[2], strict=False):
        assert float(at) == pytest.approx(study_chart._up(value, up), abs=0.051)
        assert (float(left), float(right)) == (LEFT, WIDTH - RIGHT)
        assert float(said) == value
        assert x < LEFT
        assert y == pytest.approx(float(at) + 4.0, abs=0.11)  # the middle of small letters on the line
    assert [said for *_, said in words[-2:]] == ["energy of the springs (J)", "range (mm)"]
    assert words[-2][0] == pytest.approx((LEFT + WIDTH - RIGHT) / 2.0)
    assert words[-1][1] == pytest.approx((TOP + HEIGHT - BOTTOM) / 2.0)


def test_a_front_goes_level_to_the_next_design_and_then_up() -> None:
    """A robot with more energy may always be one with less: the score holds to the right."""
    path = study_chart._steps([(100.0, 300.0), (200.0, 250.0), (300.0, 100.0)])
    assert path == f"M100.0 300.0H200.0V250.0H300.0V100.0H{WIDTH - RIGHT:g}"
    assert study_chart._steps([]) == ""
