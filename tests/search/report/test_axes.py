"""Axes of a page's drawings: values to places, and back by the axes' own words."""

import re
from typing import Any
from xml.etree import ElementTree

import pytest

from jumpcad.files.rendering import environment
from jumpcad.search.report.axes import Axes, evenly, scale

LEFT, RIGHT, TOP, FOOT = 70.0, 640.0 - 14.0, 44.0, 410.0 - 62.0


def test_an_axis_reaches_from_margin_to_margin() -> None:
    """Five per cent beyond the values on both sides; upwards in the picture is more."""
    low, high, ticks = across = scale([2.0, 4.0, 3.0])
    axes = Axes(across, across)
    assert (low, high) == pytest.approx((1.9, 4.1))
    assert ticks == sorted(ticks)
    assert low <= ticks[0] < ticks[-1] <= high
    assert len(ticks) >= 4
    assert [axes.x(value) for value in (low, 3.0, high)] == pytest.approx([LEFT, (LEFT + RIGHT) / 2.0, RIGHT])
    assert [axes.y(value) for value in (low, 3.0, high)] == pytest.approx([FOOT, (FOOT + TOP) / 2.0, TOP])
    assert all(tick == round(tick) for tick in scale([1.0, 9.0], whole=True)[2])


def test_an_axis_of_one_value_or_none_has_a_length() -> None:
    for values in ([], [0.0], [5.0, 5.0]):
        low, high, _ = scale(values)
        assert low < high
        assert all(low <= value <= high for value in values)


def test_lines_and_words_of_an_axis_stand_at_their_values() -> None:
    axes = Axes(scale([0.1, 0.5]), scale([10.0, 30.0]), first=1.0)
    macros: Any = environment().get_template("report/study/macros.html.j2").module
    root = ElementTree.fromstring(f"<svg>{macros.axes_drawn(axes, 'energy (J)', 'range (mm)')}</svg>")
    lines = [re.findall(r"[\d.]+", one.get("d") or "") for one in root.iter("path")]
    words = [(float(one.get("x") or 0), float(one.get("y") or 0), one.text) for one in root.iter("text")]
    count = len(axes.across[2])
    assert len(lines) == count + len(axes.up[2])
    assert len(words) == len(lines) + 2
    for (at, top, foot), (x, y, said), value in zip(lines, words, axes.across[2], strict=False):
        assert float(at) == pytest.approx(axes.x(value), abs=0.051)
        assert (float(top), float(foot)) == (TOP, FOOT)
        assert (x, float(said or "nan")) == (float(at), pytest.approx(value + 1.0))
        assert FOOT < y < 410.0
    for (left, at, right), (x, y, said), value in zip(lines[count:], words[count:], axes.up[2], strict=False):
        assert float(at) == pytest.approx(axes.y(value), abs=0.051)
        assert (float(left), float(right)) == (LEFT, RIGHT)
        assert float(said or "nan") == value
        assert x < LEFT
        assert y == pytest.approx(float(at) + 5.0, abs=0.11)  # the middle of small letters on the line
    assert [said for *_, said in words[-2:]] == ["energy (J)", "range (mm)"]
    assert words[-2][0] == pytest.approx((LEFT + RIGHT) / 2.0)
    assert words[-1][1] < TOP


def test_a_front_goes_level_to_the_next_design_and_then_up() -> None:
    """A robot with more energy may always be one with less: the score holds to the right."""
    axes = Axes((0.0, 1.0, []), (0.0, 1.0, []))
    path = axes.steps([(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)])
    middle = f"{(LEFT + RIGHT) / 2.0:.1f}", f"{(TOP + FOOT) / 2.0:.1f}"
    assert path == f"M{LEFT:.1f} {FOOT:.1f}H{middle[0]}V{middle[1]}H{RIGHT:.1f}V{TOP:.1f}H{RIGHT:g}"
    assert axes.steps([]) == ""
    assert axes.dots([(0.0, 1.0)]) == f"M{LEFT:.1f} {TOP:.1f}h0"


def test_of_many_things_some_are_chosen_evenly_with_both_ends() -> None:
    assert evenly(9, 3) == [0, 4, 8]
    assert evenly(3, 9) == [0, 1, 2]


def test_steps_that_go_to_the_left_end_at_the_begin_of_the_axis():
    """Of two figures of which more is better: what has the best score has the least of the other, and so has less."""
    axes = Axes(scale([2.0, 3.0, 4.0]), scale([1.0, 2.0, 3.0]))
    left, right = axes.steps([(4.0, 1.0), (3.0, 2.0), (2.0, 3.0)]), axes.steps([(2.0, 1.0), (3.0, 2.0), (4.0, 3.0)])
    assert float(left.rpartition("H")[2]) == pytest.approx(axes.x(axes.across[0]), abs=0.05)
    assert float(right.rpartition("H")[2]) == axes.width - axes.right
