"""Score against energy of the springs as SVG inside a page: every point of a shown design is a link to its robot."""

from collections.abc import Sequence

import numpy as np
from matplotlib.ticker import MaxNLocator

from jumpcad.search.fronts import energy_j, front
from jumpcad.search.objective import Objective
from jumpcad.search.page_text import written
from jumpcad.search.trial import Trial

WIDTH, HEIGHT = 640.0, 380.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 12.0, 14.0, 46.0
MOST_DOTS = 3000
"""Largest number of other designs that are drawn, evenly chosen in the order of the search."""

Scale = tuple[float, float, list[float]]
"""Lowest and highest value of an axis, and its ticks."""


def chart(trials: Sequence[Trial], shown: Sequence[Trial], objective: Objective, is_front: bool) -> str:
    """Return the chart.

    Parameters
    ----------
    trials
        All designs of the search; those that do not jump are left out.
    shown
        The designs that the page shows, in the order of their numbers 1, 2, …
    objective
        The score's objective.
    is_front
        Whether to draw the line of the front.
    """
    feasible = [trial for trial in trials if trial.score is not None and np.isfinite(energy_j(trial.design))]
    across = _scale([energy_j(trial.design) for trial in (*feasible, *shown)])
    up = _scale([trial.score or 0.0 for trial in (*feasible, *shown)])

    def place(trial: Trial) -> tuple[float, float]:
        return _along(energy_j(trial.design), across), _up(trial.score or 0.0, up)

    meaning = written(f"{objective.meaning} ({objective.unit})")
    dots = "".join(
        "M{:.1f} {:.1f}h0".format(*place(trial)) for trial in feasible[:: -(-len(feasible) // MOST_DOTS) or 1]
    )
    lines = [
        f'<svg class="chart" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="group" '
        f'aria-label="{meaning} over spring energy">',
        *_axes(across, up, meaning),
        f'<path class="dots" d="{dots}" />',
    ]
    if is_front:
        lines.append(f'<path class="front" d="{_steps([place(trial) for trial in front(feasible)])}" />')
    for number, trial in enumerate(shown, start=1):
        x, y = place(trial)
        said = written(f"design {number}: {trial.score:.4g} {objective.unit} with {energy_j(trial.design):.3f} J")
        lines.append(
            f'<a href="#design-{number}" data-design="{number}" aria-label="{said}"><title>{said}</title>'
            f'<circle class="touch" cx="{x:.1f}" cy="{y:.1f}" r="13" /><circle cx="{x:.1f}" cy="{y:.1f}" r="6" /></a>'
        )
    return "\n".join([*lines, "</svg>"])


def _axes(across: Scale, up: Scale, meaning: str) -> list[str]:
    right, foot = WIDTH - RIGHT, HEIGHT - BOTTOM
    lines = []
    for value in across[2]:
        x = _along(value, across)
        lines.append(f'<path class="grid" d="M{x:.1f} {TOP:g}V{foot:g}" />')
        lines.append(f'<text x="{x:.1f}" y="{foot + 17:g}" text-anchor="middle">{value:g}</text>')
    for value in up[2]:
        y = _up(value, up)
        lines.append(f'<path class="grid" d="M{LEFT:g} {y:.1f}H{right:g}" />')
        lines.append(f'<text x="{LEFT - 6:g}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>')
    middle = (TOP + foot) / 2.0
    lines.append(
        f'<text x="{(LEFT + right) / 2:g}" y="{HEIGHT - 8:g}" text-anchor="middle">energy of the springs (J)</text>'
    )
    lines.append(
        f'<text x="14" y="{middle:g}" text-anchor="middle" transform="rotate(-90 14 {middle:g})">{meaning}</text>'
    )
    return lines


def _steps(places: Sequence[tuple[float, float]]) -> str:
    """Return a step function as an SVG path: level from each point to the next."""
    if not places:
        return ""
    (x, y), *others = places
    return f"M{x:.1f} {y:.1f}" + "".join(f"H{u:.1f}V{v:.1f}" for u, v in others) + f"H{WIDTH - RIGHT:g}"


def _scale(values: Sequence[float]) -> Scale:
    low, high = min(values, default=0.0), max(values, default=1.0)
    reach = max(high - low, 1e-9 * max(abs(high), 1.0))
    low, high = low - 0.05 * reach, high + 0.05 * reach
    ticks = [round(float(tick), 12) for tick in MaxNLocator(6).tick_values(low, high)]
    return low, high, [tick for tick in ticks if low <= tick <= high]


def _along(value: float, scale: Scale) -> float:
    return LEFT + (WIDTH - RIGHT - LEFT) * (value - scale[0]) / (scale[1] - scale[0])


def _up(value: float, scale: Scale) -> float:
    return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * (value - scale[0]) / (scale[1] - scale[0])
