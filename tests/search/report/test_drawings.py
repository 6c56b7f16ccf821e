"""What a study's page says beside its drawings: gains, values and spread, of made-up studies."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from support.hills import FIXED, SMALL

from jumpcad.files.templates import environment, fill
from jumpcad.search.report.drawings import Axes, _line, evenly, history, parallel, scale, slices
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import Trial

NAN = float("nan")
LEFT, RIGHT, TOP, FOOT = 70.0, 640.0 - 14.0, 44.0, 410.0 - 62.0


GAINS = (
        ([NAN, NAN], "None jumps."),
        ([1.0, 3.0, NAN], "The best is number 2 of 3."),
        ([NAN] * 8 + [1.0, 2.0], "The best is number 10 of 10."),
        ([1.0] * 8 + [2.0], "The best is number 9 of 9."),
        ([1.0, 3.0] + [2.0] * 8,
         "The best is number 2 of 10. The last fifth of the search found nothing better: going on promises little."),
        ([2.0] * 8 + [2.5, 1.0],
         "The best is number 9 of 10. The last fifth of the search raised the best score by 25.0 %: going on may pay."),
        ([2.0] * 8 + [1.0, 2.0 * 1.008],
         "The best is number 10 of 10. The last fifth of the search raised the best score by 0.8 %: going on promises "
         "little."),
        ([2.0] * 8 + [1.0, 2.0 * 1.012],
         "The best is number 10 of 10. The last fifth of the search raised the best score by 1.2 %: going on may pay."),
        ([1.0] * 4 + [NAN] * 4 + [2.0, 1.0],
         "The best is number 9 of 10. The last fifth of the search raised the best score by 100.0 %: going on may "
         "pay."),
        ([1.0] * 15 + [2.0] + [1.5] * 4,
         "The best is number 16 of 20. The last fifth of the search found nothing better: going on promises little."),
        ([-2.0] * 8 + [-1.0, -3.0],
         "The best is number 9 of 10. The last fifth of the search raised the best score by 50.0 %: going on may pay."),
        ([0.0] * 8 + [0.5, 0.2],
         "The best is number 9 of 10. The last fifth of the search raised the best score from 0 to 0.5: going on may "
         "pay."),
)  # fmt: skip


def trial(*unit: float) -> Trial:
    """Return a trial at a point of the space of compression ratio, rest angle and stiffness."""
    return Trial("ga", 0, 0, SMALL.to_design(unit), Evaluation("jump"), 1.0, "m", 0.0)


def drawn(found: StudySummary, name: str, shown: Sequence[Trial] = ()) -> str:
    """Return a section of the page with its picture."""
    values = {"history": history(found), "slices": slices(found, shown), "parallel": parallel(found, shown)}
    return fill(f"report/study/{name}.html.j2", {"found": found, **values})


def known(*scores: float | None) -> StudySummary:
    """Return what is known of a study of designs with these scores, whose compression ratio grows."""
    shares = np.linspace(0.1, 0.9, len(scores)).tolist()
    trials = [replace(trial(share, 0.5, 0.5), score=score) for share, score in zip(shares, scores, strict=True)]
    return StudySummary(SMALL, find_objective("fitness"), trials, None, [], [], {})


def test_a_history_tells_what_its_last_fifth_gained() -> None:
    """A share of the best score before it, of which 1 % is little; of ten designs, the last two. Nothing of a sweep."""
    for scores, said in GAINS:
        found = known(*(None if np.isnan(score) else score for score in scores))
        swept = replace(found, trials=[replace(one, phase="sweep") for one in found.trials])
        for one, words in ((found, said), (swept, said.partition(" The last fifth")[0])):
            assert f"designs that were rejected. {words}</p>" in drawn(one, "history").replace("\n", " ")


def test_the_best_run_together_or_spread_by_their_reach_in_each_range() -> None:
    """Within a tenth they run together, over more than half they spread; of fewer than five nothing is said."""
    best = [trial(0.5 + 0.02 * n, 0.1 + 0.2 * n, 0.5 + 0.07 * n) for n in range(5)]
    for trials, said in (
        (best, " Here the best 5 run together, within a tenth of the range, in compression_ratio; they spread over "
         "more than half of the range in rest_angle_deg."),
        (best[:4], " "),
        ([trial(0.1 + 0.07 * n, 0.5 + 0.07 * n, 0.3) for n in range(5)],
         " Here the best 5 run together, within a tenth of the range, in stiffness_nmm_per_deg."),
        ([trial(0.5 + 0.07 * n, 0.1 + 0.2 * n, 0.5 + 0.07 * n) for n in range(5)],
         " Here the best 5 spread over more than half of the range in rest_angle_deg."),
        ([trial(*[0.5 + 0.07 * n] * 3) for n in range(5)],
         " Here the best 5 neither run together nor spread widely in any parameter."),
    ):  # fmt: skip
        assert f"or others make up for it.{said}</p>" in drawn(replace(known(), trials=trials), "parallel")


def box(page: str) -> tuple[float, float]:
    """Return width and height of a drawing."""
    (found,) = re.findall(r'class="drawn[^"]*" viewBox="0 0 ([\d.]+) ([\d.]+)" role', page)
    return float(found[0]), float(found[1])


def read(page: str) -> Callable[[float, float], tuple[float, float]]:
    """Return a function that reads values at a place of a drawing by the words of its axes."""
    across, up = (
        np.array(
            re.findall(rf'<text x="([\d.]+)" y="([\d.]+)" text-anchor="{side}">(-?[\d.]+)</text>', page), dtype=float
        )
        for side in ("middle", "end")
    )
    x, y = np.polyfit(across[:, 0], across[:, 2], 1), np.polyfit(up[:, 1] - 5.0, up[:, 2], 1)  # on a letter's middle
    return lambda at, height: (float(np.polyval(x, at)), float(np.polyval(y, height)))


def dots(kind: str, page: str) -> list[tuple[float, float]]:
    """Return the values at which the dots of a kind are, legends left out."""
    drawing, values = re.sub('<p class="legend">.*?</p>', "", page, flags=re.DOTALL), read(page)
    paths = re.findall(f'<path class="dots {kind}" d="([^"]*)"', drawing)
    places = [place for path in paths for place in re.findall(r"M([\d.]+) ([\d.]+)h0", path)]
    return [values(float(x), float(y)) for x, y in places]


def test_a_history_reads_as_the_scores_and_the_best_of_them_so_far() -> None:
    """The line rises where a design is better than all before; it is level to the end."""
    page = drawn(known(1.0, None, 2.0, 1.5, None), "history")
    assert dots("phase0", page) == [pytest.approx(one, abs=0.01) for one in ((1.0, 1.0), (3.0, 2.0), (4.0, 1.5))]
    (x, y, across, up, end), values = (
        re.findall(r'class="best" d="M([\d.]+) ([\d.]+)H([\d.]+)V([\d.]+)H([\d.]+)"', page)[0],
        read(page),
    )
    assert values(float(x), float(y)) == pytest.approx((1.0, 1.0), abs=0.01)
    assert values(float(across), float(up)) == pytest.approx((3.0, 2.0), abs=0.01)
    assert float(across) < float(end) < box(page)[0]
    assert history(known()) == {}
    assert "<svg" not in drawn(known(None, None), "history")


def test_each_slice_has_every_jump_at_its_value_and_score_and_the_best_and_the_shown_ones_marked() -> None:
    """All of it within the drawing."""
    found = known(1.0, None, 2.0, 3.0, 1.5)
    jumped, shown = [one for one in found.trials if one.score is not None], found.trials[:3:2]
    figures = drawn(found, "slices", shown).split("</figure>")[:-1]
    assert len(figures) == len(SMALL.free)
    for page, parameter in zip(figures, SMALL.free, strict=True):
        places = [(getattr(one.design, parameter.name), one.score) for one in jumped]
        near = {"abs": 0.01 * max(parameter.width, 2.0)}
        seen = sorted(place for age in range(5) for place in dots(f"age{age}", page))
        for one, place in zip(seen, sorted(places), strict=True):
            assert one == pytest.approx(place, **near)
        assert dots("top", page) == [pytest.approx(places[2], **near)]
        rings = re.findall(r'<circle class="of" data-of="(\d)" cx="([\d.]+)" cy="([\d.]+)"', page)
        assert [number for number, *_ in rings] == ["1", "2"]
        for (_, x, y), one in zip(rings, shown, strict=True):
            assert read(page)(float(x), float(y)) == pytest.approx(
                (getattr(one.design, parameter.name), one.score), **near
            )
        assert f"Best: {places[2][0]:.4g}" in page
        assert read(page)(0.0, 50.0)[1] > read(page)(0.0, 150.0)[1]  # more is higher up
        width, height = box(page)
        words = [(float(x), float(y)) for x, y in re.findall(r'<text x="([\d.]+)" y="([-\d.]+)"', page)]
        assert all(0.0 < x < width and 0.0 < y < height for x, y in words)
    assert slices(known(None), ()) == []


def test_parallel_lines_are_the_stronger_the_better_and_lie_on_axes_with_their_ends_named() -> None:
    """Of fourteen the best five, and the others in thirds; nothing of one parameter alone, or without a jump."""
    found = known(*range(1, 15), None)
    page = drawn(found, "parallel", found.trials[:2])
    ranked = [_line(SMALL, one) for one in found.trials[:14][::-1]]
    bundles = {
        name: re.findall("M[^M]+", path) for name, path in re.findall(r'<path class="(bundle\d)" d="([^"]*)"', page)
    }
    assert bundles == {
        "bundle3": ranked[:5][::-1], "bundle2": ranked[5:8][::-1], "bundle1": ranked[8:11][::-1],
        "bundle0": ranked[11:][::-1],
    }  # fmt: skip
    assert re.findall(r'<path class="of" data-of="(\d)" d="([^"]*)"', page) == [("1", ranked[-1]), ("2", ranked[-2])]
    grid = [tuple(map(float, one)) for one in re.findall(r'class="grid" d="M([\d.]+) ([\d.]+)H([\d.]+)"', page)]
    assert [(y, right) for _, y, right in grid] == [(54.0 * row, 624.0) for row in (1, 2, 3)]
    words = re.findall(r'<text x="([\d.]+)" y="([\d.]+)">(.*?)</text>', page)
    assert words[:2] == [("4", "50", "compression_ratio"), ("4", "72", "0.1 … 0.8")]
    across = [float(x) for line in ranked for x, _ in re.findall(r"([\d.]+) ([\d.]+)", line)]
    assert min(across) >= grid[0][0] > 250.0  # no line goes through a name
    width, height = box(page)
    assert width == 640.0
    assert 162.0 < height < 162.0 + 54.0
    assert all(0.0 < float(y) < height for _, y, *_ in words)
    line = Space.parse(fix=[*FIXED, "rest_angle_deg=50", "stiffness_nmm_per_deg=20"])
    assert parallel(replace(found, space=line), ()) == parallel(known(None), ()) == {}


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


def test_of_many_things_some_are_chosen_evenly_with_both_ends() -> None:
    assert evenly(9, 3) == [0, 4, 8]
    assert evenly(3, 9) == [0, 1, 2]


def test_steps_that_go_to_the_left_end_at_the_begin_of_the_axis():
    """Of two figures of which more is better: what has the best score has the least of the other, and so has less."""
    axes = Axes(scale([2.0, 3.0, 4.0]), scale([1.0, 2.0, 3.0]))
    left, right = axes.steps([(4.0, 1.0), (3.0, 2.0), (2.0, 3.0)]), axes.steps([(2.0, 1.0), (3.0, 2.0), (4.0, 3.0)])
    assert float(left.rpartition("H")[2]) == pytest.approx(axes.x(axes.across[0]), abs=0.05)
    assert float(right.rpartition("H")[2]) == axes.width - axes.right
