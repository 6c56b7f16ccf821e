"""Score against a cost as SVG inside a page: every point of a shown design is a link to its robot."""

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from jumpcad.search.fronts import Cost, front
from jumpcad.search.report.axes import Axes, evenly, scale
from jumpcad.search.report.text import escape_html
from jumpcad.search.study.objective import Objective
from jumpcad.search.study.trial import Trial

MOST_DOTS = 3000
"""Largest number of other designs that are drawn, evenly chosen in the order of the search."""
RADIUS, LEAST_RADIUS, TOUCHED = 6.0, 3.5, 13.0
"""Of a point, of one that has others near it, and of the area that a finger meets."""


def chart(
    trials: Sequence[Trial],
    shown: Sequence[Trial],
    numbers: Sequence[int],
    objective: Objective,
    cost: Cost,
    is_front: bool,
) -> str:
    """Return the chart.

    Parameters
    ----------
    trials
        All designs of the search; those that do not jump are left out.
    shown
        The designs that the page shows, in the order of their numbers 1, 2, …
    numbers
        Their numbers as trials of the study.
    objective
        The score's objective.
    cost
        What the score is drawn against.
    is_front
        Whether to draw the line of the front.
    """
    feasible = [trial for trial in trials if trial.score is not None and np.isfinite(cost.of(trial))]

    def place(trial: Trial) -> tuple[float, float]:
        return cost.shown(cost.of(trial)), trial.score or 0.0

    x_values, y_values = zip(*map(place, [*feasible, *shown]), strict=True)
    axes = Axes(scale(list(x_values)), scale(list(y_values)))
    meaning = f"{objective.meaning} ({objective.unit})"
    others = [place(feasible[index]) for index in evenly(len(feasible), MOST_DOTS)]
    lines = [
        f'<svg class="chart" viewBox="0 0 {axes.width:g} {axes.height:g}" role="group" '
        f'aria-label="{escape_html(meaning)} over {escape_html(cost.figure.meaning)}">',
        *axes.drawn(f"{cost.figure.meaning} ({cost.figure.unit})", meaning),
        axes.dots(others, "other"),
    ]
    if is_front:
        lines.append(axes.steps([place(trial) for trial in front(feasible, cost)], "front"))
    places = [(axes.x(x), axes.y(y)) for x, y in map(place, shown)]
    for number, ((x, y), radius, trial, of_study) in enumerate(
        zip(places, _radii(places), shown, numbers, strict=True), start=1
    ):
        figures = f"{trial.score:.4g} {objective.unit} with {cost.shown(cost.of(trial)):.3f} {cost.figure.unit}"
        said = escape_html(f"design {number} (trial {of_study}): {figures}")
        at = f'cx="{x:.1f}" cy="{y:.1f}"'
        lines.append(
            f'<a href="#design-{number}" data-design="{number}" aria-label="{said}"><title>{said}</title>'
            f'<circle class="touch" {at} r="{TOUCHED:g}" /><circle {at} r="{radius:.1f}" /></a>'
        )
    for number, (x, y) in enumerate(places, start=1):  # above all points, so that the chosen one is seen among others
        lines.append(f'<circle class="of" data-of="{number}" cx="{x:.1f}" cy="{y:.1f}" r="9" />')
    return "\n".join([*lines, "</svg>"])


def _radii(places: Sequence[tuple[float, float]]) -> list[float]:
    """Return the radius of each point: half way to its nearest neighbour, within limits."""
    nearest = [math.inf] * len(places)
    for (i, one), (j, other) in combinations(enumerate(places), 2):
        apart = math.dist(one, other)
        nearest[i], nearest[j] = min(nearest[i], apart), min(nearest[j], apart)
    return [min(max(0.5 * apart, LEAST_RADIUS), RADIUS) for apart in nearest]
