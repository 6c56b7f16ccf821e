"""Sliders: how far they reach, and in which steps."""

import math
from types import SimpleNamespace
from typing import Any

import pytest

from jumpcad.design import SEARCH_BOUNDS, limits_of
from jumpcad.studio.inputs import slider_ends, slider_step, when_changed


@pytest.mark.parametrize("key", SEARCH_BOUNDS)
def test_a_slider_is_twice_as_long_as_the_searched_range_within_what_can_be(key: str) -> None:
    """Half of the range more on either side; a value beyond is on it too, at its end."""
    bounds, (lowest, highest) = SEARCH_BOUNDS[key], limits_of(key)
    half = (bounds.upper - bounds.lower) / 2.0
    middle = (bounds.lower + bounds.upper) / 2.0
    ends = max(lowest, middle - 2.0 * half), min(highest, middle + 2.0 * half)
    assert slider_ends(key, middle) == pytest.approx(ends, abs=5e-5)
    assert slider_ends(key, ends[0] - 0.3)[0] == pytest.approx(max(lowest, ends[0] - 0.3), abs=5e-5)
    assert slider_ends(key, ends[1] + 0.3)[1] == pytest.approx(min(highest, ends[1] + 0.3), abs=5e-5)
    assert slider_ends("c_coef", 1.55554321)[1] == 1.5555


@pytest.mark.parametrize("span", [0.04, 0.5, 0.8, 4.9, 5.1, 100.0, 499.0, 500.0, 2000.0])
def test_a_slider_has_five_hundred_steps_and_not_ten_times_as_many(span: float) -> None:
    """Of a power of ten, at most 1."""
    step = slider_step(span)
    assert math.log10(step) == pytest.approx(round(math.log10(step)), abs=1e-9)
    assert step <= span / 500.0 * (1.0 + 1e-9)
    assert step == 1.0 or 10.0 * step > span / 500.0


def test_only_a_person_s_changes_are_acted_on() -> None:
    acts: list[Any] = []
    seen: list[int] = []
    when_changed(SimpleNamespace(on_update=acts.append), lambda: seen.append(1))
    (changed,) = acts
    changed(SimpleNamespace(client=None))
    assert seen == []
    changed(SimpleNamespace(client="a browser"))
    assert seen == [1]
