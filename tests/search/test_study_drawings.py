"""What a study's page says beside its drawings: gains, values and spread, of made-up studies."""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from support.hills import SMALL

from jumpcad.search.objective import Evaluation, find_objective
from jumpcad.search.parameter import SearchParameter
from jumpcad.search.replay import Known
from jumpcad.search.study_drawings import _best, _end, _gain, _line, _spread, history, slices
from jumpcad.search.trial import Trial

NAN = float("nan")


@pytest.mark.parametrize(
    ("scores", "said"),
    [
        ([NAN, NAN], "None jumps."),
        ([1.0, 3.0, NAN], "The best is number 2 of 3."),
        ([NAN] * 8 + [1.0, 2.0], "The best is number 10 of 10."),
        ([1.0] * 8 + [2.0], "The best is number 9 of 9."),
        ([1.0, 3.0] + [2.0] * 8,
         "The best is number 2 of 10. The last fifth of the search found nothing better: going on promises little."),
        ([2.0] * 8 + [2.5, 1.0],
         "The best is number 9 of 10. The last fifth of the search raised the best score by 20.0 %: going on may pay."),
        ([2.0] * 8 + [1.0, 2.0 / 0.992],
         "The best is number 10 of 10. The last fifth of the search raised the best score by 0.8 %: going on promises "
         "little."),
        ([1.0] * 15 + [2.0] + [1.5] * 4,
         "The best is number 16 of 20. The last fifth of the search found nothing better: going on promises little."),
        ([-2.0] * 8 + [-1.0, -3.0],
         "The best is number 9 of 10. The last fifth of the search raised the best score by 100.0 %: going on may "
         "pay."),
    ],
)  # fmt: skip
def test_a_history_tells_what_its_last_fifth_gained(scores: Sequence[float], said: str) -> None:
    """A share of the best score, below 1 % of which going on promises little; of ten designs, the last two."""
    assert _gain(np.array(scores)) == said


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (70.0, "70° at the upper end"), (20.0, "20° at the lower end"), (20.04, "20.04° at the lower end"),
        (20.06, "20.06°"),
    ],
)  # fmt: skip
def test_the_best_value_is_told_with_the_end_that_it_lies_on(number: float, said: str) -> None:
    """To a thousandth of the range, here 0.05°."""
    value, at, end = said.partition(" at ")
    found = _best(SearchParameter("rest_angle_deg", 20.0, 70.0), number)
    assert found == (f"{value}, at {end} of the range" if at else value)
    names = SearchParameter.of_names("bought.battery", ["one", "two"])
    assert (_best(names, 1.0), _end(names, 0.0), _end(SearchParameter("c_coef", 0.8, 1.2), 1.2)) == (
        "two",
        "one",
        "1.2",
    )


def trial(*unit: float) -> Trial:
    """Return a trial at a point of the space of compression ratio, rest angle and stiffness."""
    return Trial("ga", 0, 0, SMALL.to_design(unit), Evaluation("jump"), 1.0, "m", 0.0)


def at(kind: str, page: str) -> list[float]:
    """Return where the marks of a kind begin, outside of legends."""
    drawing = re.sub('<p class="legend">.*?</p>', "", page, flags=re.DOTALL)
    paths = re.findall(f'<path class="{kind}" d="([^"]*)"', drawing)
    return [float(x) for path in paths for x in re.findall(r"M([\d.]+)", path)]


def known(*scores: float | None) -> Known:
    """Return what is known of a study of designs with these scores, whose compression ratio grows."""
    shares = np.linspace(0.1, 0.9, len(scores)).tolist()
    trials = [replace(trial(share, 0.5, 0.5), score=score) for share, score in zip(shares, scores, strict=True)]
    return Known(SMALL, find_objective("fitness"), trials, None, [], [], {})


def test_a_history_has_each_design_above_its_number() -> None:
    """Jumps as dots, what was rejected as ticks: numbers begin at 1."""
    page = "\n".join(history(known(1.0, None, 2.0, 1.5, None)))
    ticks = re.findall(r'<text x="([\d.]+)" y="[\d.]+" text-anchor="middle">(\d)<', page)
    numbers = {label: float(x) for x, label in ticks}
    assert at("dots phase0", page) == [numbers[label] for label in "134"]
    assert at("rejected", page) == [numbers[label] for label in "25"]


def test_dots_of_a_slice_are_as_old_as_the_jumps_before_them() -> None:
    """A fifth of the designs that jump in each colour, whatever was rejected meanwhile."""
    page = "\n".join(slices(known(*[1.0, 2.0, 3.0, 4.0, 5.0], *[None] * 20), ()))
    first = page.split("</figure>")[0]
    places = [at(f"dots age{age}", first) for age in range(5)]
    ages = [age for age in range(5) for _ in places[age]]
    assert ages == [0, 1, 2, 3, 4]
    assert places == sorted(places)


def test_a_line_goes_down_through_the_places_in_the_ranges() -> None:
    """From 16 at the lower end of a range to 624 at its upper one, 54 further down for each parameter."""
    assert _line(SMALL, trial(0.0, 0.5, 1.0)) == "M16 54L320 108 624 162"


def test_the_best_run_together_or_spread_by_their_reach_in_each_range() -> None:
    """Within a tenth they run together, over more than half they spread; of fewer than five nothing is said."""
    best = [trial(0.5 + 0.02 * n, 0.1 + 0.2 * n, 0.5 + 0.07 * n) for n in range(5)]
    assert _spread(SMALL, best) == (
        "Here the best 5 run together, within a tenth of the range, in compression_ratio; they spread over more than "
        "half of the range in rest_angle_deg."
    )
    assert _spread(SMALL, best[:4]) == ""
    middling = [trial(0.1 + 0.07 * n, 0.5 + 0.07 * n, 0.3) for n in range(5)]
    assert _spread(SMALL, middling) == (
        "Here the best 5 run together, within a tenth of the range, in stiffness_nmm_per_deg."
    )
    none = [trial(*[0.5 + 0.07 * n] * 3) for n in range(5)]
    assert _spread(SMALL, none).endswith("neither run together nor spread widely in any parameter.")


@pytest.mark.parametrize(
    ("reach", "said"),
    [(0.098, "run together"), (0.102, "neither"), (0.498, "neither"), (0.502, "spread over more")],
)
def test_a_tenth_of_the_range_is_together_and_more_than_half_apart(reach: float, said: str) -> None:
    best = [trial(0.2 + 0.25 * reach * n, 0.2 + 0.3 * n / 4.0, 0.2 + 0.3 * n / 4.0) for n in range(5)]
    assert said in _spread(SMALL, best)
