"""A study's history, slices and parallel lines as SVG inside its page, each with what is seen in it.

Drawn for the page and not by matplotlib: they fit a phone, have the page's colours, and show the chosen design. Those
of 600 designs take 0.1 MB and 0.02 s; matplotlib's take 0.9 MB and 2 s.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from jumpcad.search.parameter import SearchParameter
from jumpcad.search.report.axes import Axes, evenly, scale
from jumpcad.search.report.text import broken, escape_html
from jumpcad.search.report.words import meaning_of, named, unit_of, with_unit
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Objective
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
LEFT, RIGHT, ROW = 16.0, 624.0, 54.0
"""Ends of the axes of the parallel lines, and their distance."""


def history(found: StudySummary) -> Iterator[str]:
    """Yield the section of every design's score in the order of the search."""
    trials, objective = found.trials, found.objective
    if not trials:
        return
    scores = np.array([np.nan if trial.score is None else trial.score for trial in trials])
    feasible = np.flatnonzero(np.isfinite(scores))
    yield "<h2>History</h2>"
    yield "<p>Every design in the order in which it was tried; the line is the best score so far, and the ticks at "
    yield f"the bottom are designs that were rejected. {_gain(scores, found.is_explored)}</p>"
    if not len(feasible):
        return
    axes = Axes(scale([1.0, float(len(trials))], whole=True), scale(scores[feasible].tolist()))
    meaning = f"{objective.meaning} ({objective.unit})"
    yield f'<svg class="drawn" viewBox="0 0 {axes.width:g} {axes.height:g}" role="img" '
    yield f'aria-label="{escape_html(meaning)} of every design in the order of the search">'
    yield from axes.drawn("number of the design in the search", meaning)
    phases = list(dict.fromkeys(trial.phase for trial in trials))
    chosen = [int(feasible[index]) for index in evenly(len(feasible), MOST_DOTS)]
    for number, phase in enumerate(phases):
        yield axes.dots([(n + 1, scores[n]) for n in chosen if trials[n].phase == phase], f"phase{number % 4}")
    rejected = np.flatnonzero(np.isnan(scores))
    ticks = "".join(
        f"M{axes.x(rejected[n] + 1):.1f} {axes.height - axes.foot:g}v-9" for n in evenly(len(rejected), MOST_DOTS)
    )
    yield f'<path class="rejected" d="{ticks}" />'
    best = np.fmax.accumulate(scores)
    rises = [n for n in feasible.tolist() if n == feasible[0] or best[n] > best[n - 1]]
    yield axes.steps([(n + 1, best[n]) for n in rises], "best")
    yield "</svg>"
    keys = [(f"dot phase{number % 4}", f"tried by {phase}") for number, phase in enumerate(phases)]
    yield from _legend(
        [*keys, ("line best", "best so far"), *([("tick rejected", "rejected")] if len(rejected) else [])]
    )


def _gain(scores: np.ndarray, is_explored: bool = False) -> str:
    """Return when the best design was found, and what the last fifth of a search gained."""
    if not np.isfinite(scores).any():
        return "None jumps."
    number, best = int(np.nanargmax(scores)), float(np.nanmax(scores))
    said = f"The best is number {number + 1} of {len(scores)}."
    before = scores[: len(scores) - len(scores) // 5]
    if is_explored or len(scores) < 10 or not np.isfinite(before).any():
        return said
    last = float(np.nanmax(before))
    if best <= last:
        return f"{said} The last fifth of the search found nothing better: going on promises little."
    share = (best - last) / abs(last) if last else np.inf
    means = "going on promises little" if share < LITTLE else "going on may pay"
    rise = f"by {100.0 * share:.1f} %" if last else f"from 0 to {best:.4g}"
    return f"{said} The last fifth of the search raised the best score {rise}: {means}."


def slices(found: StudySummary, shown: Sequence[Trial]) -> Iterator[str]:
    """Yield the section of the score over each free parameter."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    best = best_trial(feasible)
    if best is None:
        return
    objective = found.objective
    yield "<h2>Slices</h2>"
    yield f"<p>The score, {escape_html(f'{objective.meaning} ({objective.unit})')}, over one parameter at a time; "
    yield "every dot is a design that jumps, the others of its parameters are what they were. Where the upper edge of "
    yield "the dots falls to both sides of the best design, its value is the right one; where it still rises at an "
    yield "end of the range, look beyond it.</p>"
    ages = [(f"dot age{age}", f"tried {word}") for age, word in ((0, "first"), (2, "half way"), (AGES - 1, "last"))]
    yield from _legend([*ages, ("dot top", "highest score"), ("dot of", "chosen design")])
    chosen = [(AGES * index // len(feasible), feasible[index]) for index in evenly(len(feasible), MOST_SLICED)]
    up = scale([trial.score or 0.0 for trial in feasible], ticks=4)
    yield '<div class="slices">'
    for parameter in found.space.free:
        yield from _slice(parameter, objective, chosen, best, shown, up)
    yield "</div>"


def _slice(
    parameter: SearchParameter,
    objective: Objective,
    chosen: Sequence[tuple[int, Trial]],
    best: Trial,
    shown: Sequence[Trial],
    up: tuple[float, float, list[float]],
) -> Iterator[str]:
    def at(trial: Trial) -> tuple[float, float]:
        return parameter.number(trial.variant.value(parameter.name)), trial.score or 0.0

    across = scale([parameter.lower, parameter.upper], ticks=3, whole=bool(parameter.names))
    first = 1.0 if parameter.names else 0.0
    axes = Axes(across, up, 300.0, 228.0, left=58.0, foot=34.0, top=42.0, first=first)
    unit = unit_of(parameter.name)
    yield f'<figure><svg class="drawn" viewBox="0 0 {axes.width:g} {axes.height:g}" role="img" '
    yield f'aria-label="score over {escape_html(parameter.name)}">'
    yield from axes.drawn("", f"score ({objective.unit})")
    for age in range(AGES):
        yield axes.dots([at(trial) for place, trial in chosen if place == age], f"age{age}")
    yield axes.dots([at(best)], "top")
    for number, trial in enumerate(shown, start=1):
        x, y = at(trial)
        yield f'<circle class="of" data-of="{number}" cx="{axes.x(x):.1f}" cy="{axes.y(y):.1f}" r="7" />'
    meaning = meaning_of(parameter.name) or ", ".join(f"{n} is {name}" for n, name in enumerate(parameter.names, 1))
    said = f"{f' ({escape_html(unit)})' if unit else ''}{f': {escape_html(meaning)}' if meaning else ''}"
    best_at = _best(parameter, at(best)[0])
    yield f"</svg><figcaption><b>{broken(parameter.name)}</b>{said}. Best: {best_at}.</figcaption></figure>"


def _best(parameter: SearchParameter, number: float) -> str:
    """Return a parameter's value in the best design, and where it lies in its range."""
    value = parameter.value(number)
    if isinstance(value, str):
        return escape_html(value)
    ends = {"at the lower end of the range": parameter.lower, "at the upper end of the range": parameter.upper}
    at = next((f", {words}" for words, end in ends.items() if abs(number - end) <= 1e-3 * parameter.width), "")
    return f"{with_unit(f'{value:.4g}', parameter.name)}{at}"


def parallel(found: StudySummary, shown: Sequence[Trial]) -> Iterator[str]:
    """Yield the section that has a line for each design, down through its parameters."""
    space, feasible = found.space, feasible_trials(found.trials)
    if space.dimension < 2 or not feasible:
        return
    best = feasible[: max(BEST_LEAST, round(BEST_SHARE * len(feasible)))]
    yield "<h2>Parallel lines</h2>"
    yield "<p>One line for each design that jumps, down through its parameters: each axis goes from the lower end of "
    yield "the parameter's range, left, to the upper end, right. Where the best lines run together, a parameter is "
    yield f"decided; where they spread, it matters little, or others make up for it. {_spread(space, best)}</p>"
    others = feasible[len(best) : MOST_LINES]
    rest = [("line bundle2", "the others, the better the stronger")] if others else []
    yield from _legend([("line bundle3", f"the best {len(best)}"), *rest, ("line of", "chosen design")])
    height = ROW * space.dimension + 6.0
    yield f'<svg class="drawn lines" viewBox="0 0 640 {height:g}" role="img" '
    yield 'aria-label="every design as a line through its parameters">'
    third = -(-len(others) // 3) or 1
    bundles = [others[2 * third :], others[third : 2 * third], others[:third], best]
    for number, bundle in enumerate(bundles):
        if bundle:
            drawn = "".join(_line(space, trial) for trial in reversed(bundle))
            yield f'<path class="bundle{number}" d="{drawn}" />'
    for number, trial in enumerate(shown, start=1):
        yield f'<path class="of" data-of="{number}" d="{_line(space, trial)}" />'
    for row, parameter in enumerate(space.free):
        y = ROW * (row + 1)
        yield f'<path class="grid" d="M{LEFT:g} {y:g}H{RIGHT:g}" />'
        middle = (LEFT + RIGHT) / 2.0
        for x, anchor, text in (
            (LEFT, "start", _end(parameter, parameter.lower)),
            (middle, "middle", named(parameter.name)),
            (RIGHT, "end", _end(parameter, parameter.upper)),
        ):
            yield f'<text x="{x:g}" y="{y - 8:g}" text-anchor="{anchor}">{escape_html(text)}</text>'
    yield "</svg>"


def _line(space: Space, trial: Trial) -> str:
    unit = space.to_unit(trial.variant).tolist()
    places = [f"{LEFT + share * (RIGHT - LEFT):.0f} {ROW * (row + 1):g}" for row, share in enumerate(unit)]
    return f"M{places[0]}L{' '.join(places[1:])}"


def _spread(space: Space, best: Sequence[Trial]) -> str:
    """Return in which parameters the best designs run together, and in which they spread."""
    if len(best) < BEST_LEAST:
        return ""
    reach = np.ptp(np.array([space.to_unit(trial.variant) for trial in best]), axis=0)
    names = [parameter.name for parameter in space.free]
    together = [name for name, share in zip(names, reach.tolist(), strict=True) if share <= TOGETHER]
    apart = [name for name, share in zip(names, reach.tolist(), strict=True) if share > APART]
    said = [
        f"run together, within a tenth of the range, in {', '.join(together)}" if together else "",
        f"spread over more than half of the range in {', '.join(apart)}" if apart else "",
    ]
    words = "; they ".join(part for part in said if part)
    return (
        f"Here the best {len(best)} {escape_html(words or 'neither run together nor spread widely in any parameter')}."
    )


def _end(parameter: SearchParameter, number: float) -> str:
    value = parameter.value(number)
    return value if isinstance(value, str) else f"{value:g}"


def _legend(keys: Sequence[tuple[str, str]]) -> Iterator[str]:
    """Yield the legend of a picture: kind of the mark, as its style has it, and words."""
    yield '<p class="legend">'
    for kind, words in keys:
        mark, name = kind.split()
        drawn = {"line": "M1 7h16", "tick": "M9 12v-9", "dot": "M9 7h0"}[mark]
        shape = f'<path class="{"dots " * (mark == "dot")}{name}" d="{drawn}" />'
        if kind == "dot of":
            shape = '<circle class="of" cx="9" cy="7" r="5" />'
        yield f'<span><svg class="drawn mark lines" viewBox="0 0 18 14" aria-hidden="true">{shape}</svg>'
        yield f"{escape_html(words)}</span>"
    yield "</p>"
