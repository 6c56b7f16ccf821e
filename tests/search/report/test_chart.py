"""A study's chart: points at their values, links to their robots, and rings that do not cover each other."""

import re

import pytest

from jumpcad.design import load_design
from jumpcad.search.fronts import SPRING_ENERGY, find_cost
from jumpcad.search.report.axes import Axes, scale
from jumpcad.search.report.chart import _radii, chart
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.trial import Trial

DESIGN = load_design("best-ga")


def trial(score: float | None, ratio: float) -> Trial:
    design = DESIGN.model_copy(update={"compression_ratio": ratio})
    return Trial("ga", 0, 0, design, Evaluation("tips" if score is None else "jump"), score, "m", 0.0)


def test_points_are_as_large_as_their_neighbours_leave_them() -> None:
    """Half way to the nearest, from 3.5 to 6."""
    assert _radii([(0.0, 0.0), (10.0, 0.0), (100.0, 0.0), (100.0, 8.0), (200.0, 1.0), (203.0, 5.0)]) == [
        5.0, 5.0, 4.0, 4.0, 3.5, 3.5
    ]  # fmt: skip
    assert _radii([(0.0, 0.0)]) == _radii([(0.0, 0.0), (30.0, 40.0)])[:1] == [6.0]


@pytest.mark.parametrize("is_front", [True, False])
def test_every_shown_design_is_a_link_at_its_energy_and_score(is_front: bool) -> None:
    trials = [trial(1.0, 0.3), trial(None, 0.4), trial(0.5, 0.5), trial(4.0, 0.6)]
    shown, numbers = [trials[0], trials[3]], [7, 12]
    page = chart(trials, shown, numbers, find_objective("range"), SPRING_ENERGY, is_front)
    energies = [one.design.spring_energy_j for one in (trials[0], trials[2], trials[3])]
    axes = Axes(scale([*energies, energies[0], energies[2]]), scale([1.0, 0.5, 4.0, 1.0, 4.0]))
    places = [(axes.x(energy), axes.y(score)) for energy, score in zip(energies, (1.0, 0.5, 4.0), strict=True)]
    dots = re.findall(r"M([\d.]+) ([\d.]+)h0", page)
    assert [(float(x), float(y)) for x, y in dots] == [pytest.approx(one, abs=0.051) for one in places]
    links = re.findall(r'<a href="#design-(\d)".*?aria-label="(.*?)".*?cx="([\d.]+)" cy="([\d.]+)"', page)
    for (number, said, x, y), of_study, score, energy, place in zip(
        links, numbers, (1.0, 4.0), (energies[0], energies[2]), (places[0], places[2]), strict=True
    ):
        assert said == f"design {number} (trial {of_study}): {score:g} m with {energy:.3f} J"
        assert (float(x), float(y)) == pytest.approx(place, abs=0.051)
    assert [number for number, *_ in links] == ["1", "2"]
    assert ('class="front"' in page) == is_front
    assert page.count('data-of="') == 2


def test_a_chart_of_more_of_both_has_the_figure_itself() -> None:
    """Rises to the right of 0, and the design that rises most farthest to the right."""
    rises, scores = (0.5, 0.125, 0.25), (1.0, 3.0, 2.0)
    trials = [
        Trial("nsga2", 0, place, DESIGN, Evaluation("jump", {"com_rise_m": rise}), score, "m", 0.0)
        for place, (rise, score) in enumerate(zip(rises, scores, strict=True))
    ]
    page = chart(trials, trials, [1, 2, 3], find_objective("range"), find_cost("rise"), True)
    links = re.findall(r'<a href="#design-\d".*?aria-label="(.*?)".*?cx="([\d.]+)" cy="[\d.]+"', page)
    assert [said for said, _ in links] == [
        "design 1 (trial 1): 1 m with 0.500 m", "design 2 (trial 2): 3 m with 0.125 m",
        "design 3 (trial 3): 2 m with 0.250 m",
    ]  # fmt: skip
    axes = Axes(scale([*rises, *rises]), scale([*scores, *scores]))
    assert [float(x) for _, x in links] == pytest.approx([axes.x(rise) for rise in rises], abs=0.051)
    assert axes.x(0.5) > axes.x(0.125)
