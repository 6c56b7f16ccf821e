"""The designs that a study's page shows: points in a chart of score against a cost, side views, figures, command."""

import math
import shlex
from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy as np

from jumpcad.errors import CannotBuildError
from jumpcad.evaluation import FIGURES
from jumpcad.search.fronts import Cost, energy_j, front
from jumpcad.search.models import PUBLISHED_FIGURES
from jumpcad.search.report.axes import Axes, evenly, scale
from jumpcad.search.report.side_view import joints_mm
from jumpcad.search.report.words import figure_words, value_words, with_unit
from jumpcad.search.study.trial import Trial

HEADLINES = ("ballistic_range_m", "com_rise_m", "mass_kg", "winding_time_s")
"""Figures that are shown at once; the others open on a click."""
MOST_DOTS = 3000
"""Largest number of other designs that are drawn, evenly chosen in the order of the search."""
RADIUS, LEAST_RADIUS = 6.0, 3.5
"""Of a point, and of one that has others near it."""


def chart(
    trials: Sequence[Trial], shown: Sequence[Trial], numbers: Sequence[int], cost: Cost, is_front: bool, file: str
) -> dict[str, Any]:
    """Return the axes of a chart, the paths of other designs and of a front's line, and the shown designs.

    Parameters
    ----------
    trials
        All designs of the search; those that do not jump are left out.
    shown, numbers
        The designs that the page shows, and their numbers as trials of the study.
    cost
        What the score is drawn against.
    is_front
        Whether to draw the line of the front.
    file
        The study, for the command that shows a design again.
    """
    feasible = [trial for trial in trials if trial.score is not None and np.isfinite(cost.of(trial))]

    def place(trial: Trial) -> tuple[float, float]:
        return cost.shown(cost.of(trial)), trial.score or 0.0

    x_values, y_values = zip(*map(place, [*feasible, *shown]), strict=True)
    axes = Axes(scale(list(x_values)), scale(list(y_values)))
    places = [(axes.x(x), axes.y(y)) for x, y in map(place, shown)]
    points = zip(shown, numbers, places, _radii(places), strict=True)
    return {
        "axes": axes,
        "others": axes.dots(place(feasible[index]) for index in evenly(len(feasible), MOST_DOTS)),
        "line": axes.steps([place(trial) for trial in front(feasible, cost)]) if is_front else "",
        "shown": [
            shown_design(trial, of_study, file)
            | {"number": number, "cost": place(trial)[0], "place": at, "radius": radius}
            for number, (trial, of_study, at, radius) in enumerate(points, start=1)
        ],
    }


def _radii(places: Sequence[tuple[float, float]]) -> list[float]:
    """Return the radius of each point: half way to its nearest neighbour, within limits."""
    nearest = [math.inf] * len(places)
    for (i, one), (j, other) in combinations(enumerate(places), 2):
        apart = math.dist(one, other)
        nearest[i], nearest[j] = min(nearest[i], apart), min(nearest[j], apart)
    return [min(max(0.5 * apart, LEAST_RADIUS), RADIUS) for apart in nearest]


def shown_design(trial: Trial, of_study: int, file: str) -> dict[str, Any]:
    """Return score, joints in both poses or why there are none, figures with labels, and command of a design."""
    try:
        poses, impossible = joints_mm(trial.design), ""
    except CannotBuildError as error:
        poses, impossible = {}, str(error)
    first, others = _lines(trial)
    return {
        "of_study": of_study,
        "score": trial.score,
        "poses": poses,
        "impossible": impossible,
        "first": first,
        "others": others,
        "command": f"jumpcad studio {shlex.quote(file)} --trial {of_study}",
    }


def _lines(trial: Trial) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Return label and value of what is shown at once, and of the other figures."""
    design, metrics = trial.design, trial.evaluation.metrics
    values = design.model_dump() | dict(trial.workshop)
    first = [
        (name, value if isinstance(value, str) else with_unit(value_words(value, 5), name))
        for name, value in values.items()
    ]
    lengths = (design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm)
    first.append(("main leg, front link, foot, toe", ", ".join(f"{length:.1f}" for length in lengths) + " mm"))
    first.append(figure_words("spring_energy_j", metrics.get("spring_energy_j", energy_j(design))))
    first += [figure_words(name, metrics[name]) for name in HEADLINES if name in metrics]
    named = {*FIGURES, *PUBLISHED_FIGURES} - {"spring_energy_j", *HEADLINES}  # others are those of estimates
    return first, [figure_words(name, figure) for name, figure in metrics.items() if name in named]
