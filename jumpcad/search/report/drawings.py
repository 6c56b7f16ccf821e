"""What the history, slices and parallel lines of a study's page show, for their templates in `report/study`.

Drawn there and not by matplotlib: they fit a phone, have the page's colours, and show the chosen design. Those
of 600 designs take 0.1 MB and 0.02 s; matplotlib's take 0.9 MB and 2 s.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from jumpcad.search.parameter import SearchParameter
from jumpcad.search.report.figures import meaning_of, unit_of, value_words, with_unit
from jumpcad.search.space import Space
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import Trial, best_trial, feasible_trials

MOST_DOTS, MOST_SLICED, MOST_LINES = 3000, 1000, 400
"""Largest number of designs in the history and in a slice, evenly chosen; of lines, the best ones."""
AGES = 5
"""Colours of a slice's dots, from the designs tried first to those tried last."""
BEST_SHARE, BEST_LEAST = 0.05, 5
"""What is called the best designs: this share of those that jump, at least so many."""
LITTLE = 0.01
"""Gain of a search's last fifth, over the best score before, below which going on promises little; judgement."""
TOGETHER, APART = 0.1, 0.5
"""Shares of a range within which designs run together, and beyond which they spread; judgement."""
LEFT, RIGHT, ROW = 272.0, 624.0, 54.0
"""Ends of the axes of the parallel lines, beside their names, and their distance."""
Scale = tuple[float, float, list[float]]
"""Lowest and highest value of an axis, and its ticks."""


def scale(values: Sequence[float], ticks: int = 6, whole: bool = False) -> Scale:
    """Return the scale of some values, with a twentieth of their reach on both sides; `whole` numbers as ticks."""
    low, high = min(values, default=0.0), max(values, default=1.0)
    reach = max(high - low, 1e-9 * max(abs(high), 1.0))
    low, high = low - 0.05 * reach, high + 0.05 * reach
    places = [round(float(tick), 12) for tick in MaxNLocator(ticks, integer=whole).tick_values(low, high)]
    return low, high, [tick for tick in places if low <= tick <= high]


@dataclass(frozen=True)
class Axes:
    """Two axes in a picture of some size; the title of `up` stands above its axis, that of `across` below."""

    across: Scale
    up: Scale
    width: float = 640.0
    height: float = 410.0
    left: float = 70.0
    right: float = 14.0
    top: float = 44.0
    foot: float = 62.0
    first: float = 0.0
    """What stands at the tick 0 of `across`."""

    def x(self, value: float) -> float:
        """Return the place of a value of `across`."""
        low, high, _ = self.across
        return self.left + (self.width - self.right - self.left) * (value - low) / (high - low)

    def y(self, value: float) -> float:
        """Return the place of a value of `up`."""
        low, high, _ = self.up
        return self.height - self.foot - (self.height - self.foot - self.top) * (value - low) / (high - low)

    def dots(self, places: Iterable[tuple[float, float]]) -> str:
        """Return the path that has a dot at each pair of values."""
        return "".join(f"M{self.x(x):.1f} {self.y(y):.1f}h0" for x, y in places)

    def steps(self, places: Sequence[tuple[float, float]]) -> str:
        """Return a step function's path: level from each pair of values to the next, and to the end of the axis."""
        if not places:
            return ""
        (x, y), *others = places
        drawn = f"M{self.x(x):.1f} {self.y(y):.1f}" + "".join(f"H{self.x(u):.1f}V{self.y(v):.1f}" for u, v in others)
        end = self.width - self.right if places[-1][0] >= x else self.x(self.across[0])
        return f"{drawn}H{end:g}"


def evenly(count: int, most: int) -> list[int]:
    """Return at most `most` of the indices of `count` things, evenly chosen, the first and the last among them."""
    return [round(place) for place in np.linspace(0, count - 1, min(count, most)).tolist()]


def history(found: StudySummary) -> dict[str, Any]:
    """Return every design's score in their order, and the best one before the last fifth; no axes where none jumps."""
    trials, objective = found.trials, found.objective
    if not trials:
        return {}
    scores = np.array([np.nan if trial.score is None else trial.score for trial in trials])
    feasible = np.flatnonzero(np.isfinite(scores))
    if not len(feasible):
        return {"axes": None}
    axes = Axes(scale([1.0, float(len(trials))], whole=True), scale(scores[feasible].tolist()))
    chosen = [int(feasible[index]) for index in evenly(len(feasible), MOST_DOTS)]
    rejected = np.flatnonzero(np.isnan(scores))
    ticks = (axes.x(rejected[n] + 1) for n in evenly(len(rejected), MOST_DOTS))
    best = np.fmax.accumulate(scores)
    before = best[-1 - len(trials) // 5]
    rises = [n for n in feasible.tolist() if n == feasible[0] or best[n] > best[n - 1]]
    return {
        "axes": axes,
        "number": int(np.nanargmax(scores)) + 1,
        "highest": float(best[-1]),
        "before": None if found.is_explored or len(trials) < 10 or np.isnan(before) else float(before),
        "little": LITTLE,
        "meaning": f"{objective.meaning} ({objective.unit})",
        "phases": {
            phase: axes.dots((n + 1, scores[n]) for n in chosen if trials[n].phase == phase)
            for phase in dict.fromkeys(trial.phase for trial in trials)
        },
        "rejected": "".join(f"M{x:.1f} {axes.height - axes.foot:g}v-9" for x in ticks),
        "best": axes.steps([(n + 1, best[n]) for n in rises]),
    }


def slices(found: StudySummary, shown: Sequence[Trial]) -> list[dict[str, Any]]:
    """Return the score over each free parameter; nothing where no design jumps."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    best = best_trial(feasible)
    if best is None:
        return []
    chosen = [(AGES * index // len(feasible), feasible[index]) for index in evenly(len(feasible), MOST_SLICED)]
    up = scale([trial.score or 0.0 for trial in feasible], ticks=4)
    return [_slice(parameter, chosen, best, shown, up) for parameter in found.space.free]


def _slice(
    parameter: SearchParameter, chosen: Sequence[tuple[int, Trial]], best: Trial, shown: Sequence[Trial], up: Scale
) -> dict[str, Any]:
    def at(trial: Trial) -> tuple[float, float]:
        return parameter.number(trial.variant.value(parameter.name)), trial.score or 0.0

    name, names = parameter.name, parameter.names
    across = scale([parameter.lower, parameter.upper], ticks=3, whole=bool(names))
    number, ends = at(best)[0], (("lower", parameter.lower), ("upper", parameter.upper))
    axes = Axes(across, up, 300.0, 228.0, left=58.0, foot=34.0, top=42.0, first=1.0 if names else 0.0)
    return {
        "name": name,
        "axes": axes,
        "unit": unit_of(name),
        "meaning": meaning_of(name) or ", ".join(f"{n} is {one}" for n, one in enumerate(names, 1)),
        "best": with_unit(value_words(parameter.value(number), 4), name),
        "end": next((end for end, bound in ends if not names and abs(number - bound) <= 1e-3 * parameter.width), ""),
        "ages": [axes.dots(at(trial) for place, trial in chosen if place == age) for age in range(AGES)],
        "top": axes.dots([at(best)]),
        "shown": [(axes.x(x), axes.y(y)) for x, y in map(at, shown)],
    }


def parallel(found: StudySummary, shown: Sequence[Trial]) -> dict[str, Any]:
    """Return a line for each design, down through its parameters; nothing for one parameter, or without a jump."""
    space, feasible = found.space, feasible_trials(found.trials)
    if space.dimension < 2 or not feasible:
        return {}
    best = feasible[: max(BEST_LEAST, round(BEST_SHARE * len(feasible)))]
    reach = np.ptp(np.array([space.to_unit(trial.variant) for trial in best]), axis=0).tolist()
    others = feasible[len(best) : MOST_LINES]
    third = -(-len(others) // 3) or 1
    bundles = [others[2 * third :], others[third : 2 * third], others[:third], best]
    return {
        "together": [one.name for one, share in zip(space.free, reach, strict=True) if share <= TOGETHER],
        "apart": [one.name for one, share in zip(space.free, reach, strict=True) if share > APART],
        "told": len(best) >= BEST_LEAST,
        "best": len(best),
        "others": bool(others),
        "height": ROW * space.dimension + 28.0,
        "left": LEFT,
        "bundles": ["".join(_line(space, trial) for trial in reversed(bundle)) for bundle in bundles],
        "shown": [_line(space, trial) for trial in shown],
        "axes": [(ROW * row, one.name, with_unit(_ends(one), one.name)) for row, one in enumerate(space.free, start=1)],
    }


def _ends(one: SearchParameter) -> str:
    return " … ".join(value_words(one.value(end)) for end in (one.lower, one.upper))


def _line(space: Space, trial: Trial) -> str:
    unit = space.to_unit(trial.variant).tolist()
    places = [f"{LEFT + share * (RIGHT - LEFT):.0f} {ROW * (row + 1):g}" for row, share in enumerate(unit)]
    return f"M{places[0]}L{' '.join(places[1:])}"
