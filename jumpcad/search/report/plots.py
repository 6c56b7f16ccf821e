"""Pictures of a search: each function takes data and returns a figure."""

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from jumpcad.arguments import check_arguments
from jumpcad.design import PARAMETERS, Design
from jumpcad.dimensions import counted
from jumpcad.search.explore import Components, FeasibilityMap, Importance, Sweep
from jumpcad.search.fronts import SPRING_ENERGY, Cost, front
from jumpcad.search.parameter import SearchParameter
from jumpcad.search.propose.posterior import SearchPosterior, unwarped, warped
from jumpcad.search.report.figures import BLUE, GREY, ORANGE, RED, labels, panels, value_words
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Objective
from jumpcad.search.study.trial import Trial, best_trial, feasible_trials
from jumpcad.transforms import Array

COLOURS = (BLUE, ORANGE, "#4f9d69", "#8d5fa8", "#c2b23e", RED, "#5bb5c4", GREY, "#6b4a2f", "#d47fa6")
ACQUISITION = "log10 of EI × P(feasible)"
MOST_DRAWN = 2000
"""Largest number of trials that are drawn as single shapes; more are drawn as one image, or only the best."""
BEST: dict[str, Any] = {"marker": "*", "ms": 10, "mfc": RED, "mec": "white", "mew": 0.6, "ls": "", "label": "best"}
CENTRE: dict[str, Any] = {
    "marker": "o", "ms": 9, "mfc": "none", "mec": "black", "mew": 1.2, "ls": "", "label": "centre design",
}  # fmt: skip
MARGIN = 0.03
"""Of a parameter's range, shown beyond its ends."""
DECADES = 6.0
"""The acquisition is drawn down to this many decades below its maximum."""


@check_arguments
def history(trials: Sequence[Trial], objective: Objective) -> Figure:
    """Draw the score of every evaluation, and the best so far."""
    figure, (axes,) = panels(1, 6.4, 3.6)
    scores = _scores(trials)
    number, many = np.arange(1, len(trials) + 1), len(trials) > MOST_DRAWN
    for colour, phase in zip(COLOURS, dict.fromkeys(trial.phase for trial in trials), strict=False):
        of_phase = np.array([trial.phase == phase for trial in trials])
        axes.plot(number[of_phase], scores[of_phase], ".", ms=4, color=colour, label=phase, rasterized=many)
    best = np.fmax.accumulate(scores)
    axes.plot(number, best, "-", drawstyle="steps-post", lw=1.2, color="black", label="best so far")
    rejected = number[np.isnan(scores)]
    _at_the_foot(axes, rejected, "|", color=GREY, label="rejected", rasterized=many)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    labels(axes, "evaluation", f"{objective.meaning} ({objective.unit})")
    axes.legend()
    return figure


@check_arguments
def slices(space: Space, trials: Sequence[Trial], objective: Objective, winner: Trial | None = None) -> Figure:
    """Draw the score over each free parameter, with a star at the design that the search chose, else the best one."""
    figure, all_axes = panels(space.dimension)
    feasible = [trial for trial in trials if trial.score is not None]
    order = np.arange(len(feasible))
    for axes, parameter in zip(all_axes, space.free, strict=True):
        _name_ticks(axes, parameter.names)
        values, many = _values(parameter, feasible), len(feasible) > MOST_DRAWN
        dots = axes.scatter(values, _scores(feasible), c=order, cmap="viridis", s=8, rasterized=many)
        if best := winner or best_trial(feasible):
            axes.plot(*_values(parameter, [best]), best.score or 0.0, **BEST)
        low, high = axes.get_xlim() if feasible else (parameter.lower, parameter.upper)
        reach = MARGIN * parameter.width
        axes.set_xlim(min(low, parameter.lower - reach), max(high, parameter.upper + reach))
        labels(axes, parameter.name, _named(objective))
    bar = figure.colorbar(dots, ax=all_axes, shrink=0.6)
    bar.set_ticks([0, max(len(feasible) - 1, 0)], labels=["first", "last"])
    return figure


@check_arguments
def parallel(space: Space, trials: Sequence[Trial]) -> Figure:
    """Draw the best feasible designs, at most `MOST_DRAWN`, as lines over the free parameters, better ones darker."""
    figure, (axes,) = panels(1, 1.2 + 1.2 * space.dimension, 3.6)
    feasible = feasible_trials(trials)[:MOST_DRAWN][::-1]
    ranks = np.linspace(0.0, 1.0, len(feasible))
    ranks[-1:] = 1.0  # also of one alone
    for rank, trial in zip(ranks, feasible, strict=True):
        colour = (BLUE if rank < 0.95 else RED, 0.05 + 0.9 * rank**4)
        axes.plot(range(space.dimension), space.to_unit(trial.variant), "-", lw=0.8, color=colour)
    ticks = [f"{p.name}\n{' … '.join(value_words(p.value(end)) for end in (p.lower, p.upper))}" for p in space.free]
    axes.set_xticks(range(space.dimension), ticks, rotation=30, ha="right", fontsize=7)
    colours = {"best twentieth": RED, "the others, the better the darker": BLUE}
    handles = [Line2D([], [], color=colour, label=label) for label, colour in colours.items()]
    figure.legend(handles=handles, loc="outside upper right", ncols=2)
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -MARGIN), max(high, 1.0 + MARGIN))
    labels(axes, "", "place in its range")
    return figure


@check_arguments
def pareto(trials: Sequence[Trial], objective: Objective, cost: Cost = SPRING_ENERGY) -> Figure:
    """Draw the score against a cost, and the front."""
    figure, (axes,) = panels(1, 6.4, 3.6)
    feasible = [trial for trial in trials if trial.score is not None]

    def costs(drawn: Sequence[Trial]) -> list[float]:
        return [cost.shown(cost.of(trial)) for trial in drawn]

    axes.plot(costs(feasible), _scores(feasible), ".", ms=4, color=GREY, label="other designs")
    best = front(trials, cost)
    axes.plot(costs(best), _scores(best), ".-", color=BLUE, drawstyle="steps-post", label="front")
    labels(axes, f"{cost.figure.meaning} ({cost.figure.unit})", f"{objective.meaning} ({objective.unit})")
    axes.legend()
    return figure


@check_arguments
def importance(found: Importance) -> Figure:
    """Draw permutation importances, largest at the top."""
    figure, (axes,) = panels(1, 6.4, 3.2)
    order = np.argsort(found.mean)
    axes.barh([found.names[i] for i in order], found.mean[order], xerr=found.deviation[order], color=BLUE)
    labels(axes, "fall of R² when shuffled", "", f"R² on designs held out: {found.r_squared:.2f}")
    return figure


@check_arguments
def sweeps(found: Sequence[Sweep], objective: Objective, centre: Design | None = None) -> Figure:
    """Draw the score over each parameter varied alone; crosses where the design is rejected.

    A dashed line is at the value of the centre: it says no score, as the centre itself may not have been evaluated.
    """
    figure, all_axes = panels(len(found))
    for axes, one in zip(all_axes, found, strict=True):
        scores = _scores(one.trials)
        axes.plot(one.values, scores, "." if one.names else ".-", color=BLUE, label="jumps")
        _name_ticks(axes, one.names)
        _at_the_foot(axes, one.values[np.isnan(scores)], "x", color=RED, ms=4, label="rejected")
        if centre is not None and one.parameter in PARAMETERS:
            axes.axvline(getattr(centre, one.parameter), ls="--", lw=1.0, color="black", label=CENTRE["label"])
        labels(axes, one.parameter, _named(objective))
    scores = np.concatenate([_scores(one.trials) for one in found])
    if np.isfinite(scores).any():  # one scale, to compare what the parameters do; crosses below it
        low, high = np.nanmin(scores), np.nanmax(scores)
        reach = (high - low) or abs(high) or 1.0
        for axes in all_axes:
            axes.set_ylim(low - 0.15 * reach, high + 0.05 * reach)
    handles, names = all_axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper right", ncols=len(names))
    return figure


@check_arguments
def components(views: Mapping[str, Components]) -> Figure:
    """Draw the shares of variance of principal components, one panel each for sampled designs and the elite."""
    figure, all_axes = panels(len(views), 4.0, 3.0)
    for axes, (name, view) in zip(all_axes, views.items(), strict=True):
        axes.bar(np.arange(1, len(view.shares) + 1), view.shares, color=BLUE)
        axes.axhline(1.0 / len(view.shares), color=GREY, lw=1, ls="--", label="equal shares")
        axes.legend()
        labels(axes, "component", "share of variance", f"{name}: {counted(view.designs, 'design')}")
    return figure


@check_arguments
def feasibility(found: FeasibilityMap, centre: Design | None = None) -> Figure:
    """Draw why designs are rejected, over a grid of two parameters, with a ring at the centre design."""
    figure, (axes,) = panels(1, 6.4, 4.2)
    reasons = [[" ".join(trial.evaluation.reasons[:1]) or "jump" for trial in line] for line in found.trials]
    names = sorted({reason for line in reasons for reason in line}, key=lambda name: (name != "jump", name))
    codes = np.array([[names.index(reason) for reason in line] for line in reasons])
    colours = ["#dfe9f5", *COLOURS[1:]] if names[0] == "jump" else list(COLOURS[1:])
    palette = [colours[index % len(colours)] for index in range(len(names))]
    norm = BoundaryNorm(np.arange(-0.5, len(names)), len(names))
    axes.pcolormesh(
        found.x, found.y, codes, shading="nearest", cmap=ListedColormap(palette), norm=norm, rasterized=True
    )
    axes.grid(False)
    handles: list[Patch | Line2D] = [
        Patch(color=colour, label=name) for colour, name in zip(palette, names, strict=True)
    ]
    if centre is not None and {found.x_name, found.y_name} <= set(PARAMETERS):
        handles += axes.plot(getattr(centre, found.x_name), getattr(centre, found.y_name), **CENTRE)
    figure.legend(handles=handles, loc="outside right upper")
    labels(axes, found.x_name, found.y_name)
    _name_ticks(axes, found.x_names)
    if found.y_names:
        axes.set_yticks(range(len(found.y_names)), found.y_names, fontsize=7)
    return figure


@check_arguments
def acquisition(
    space: Space, trials: Sequence[Trial], posterior: SearchPosterior, objective: Objective, columns: int = 2
) -> Figure:
    """Draw surrogate and expected improvement over the one or two free parameters of a Bayesian search.

    Of two parameters, they stand beside each other; with one column, which is narrow, below each other.
    """
    best = max((trial.score for trial in trials if trial.score is not None), default=0.0)
    if space.dimension > 1:
        return _two(space, trials, posterior, objective, best, columns)
    figure, (above, below) = panels(2, 6.4 if columns > 1 else 4.6, 2.6, columns=1)
    unit = np.linspace(0.0, 1.0, 401)
    points, parameter = unit[:, None], space.free[0]
    x = parameter.lower + unit * parameter.width
    if posterior.score is not None:
        mean, deviation = posterior.score.predict(points)
        low, high = unwarped(mean - 2 * deviation), unwarped(mean + 2 * deviation)
        above.fill_between(x, low, high, color=BLUE, alpha=0.2, lw=0, label="± 2 σ")
        above.plot(x, unwarped(mean), color=BLUE, label="surrogate")
    feasible = [trial for trial in trials if trial.score is not None]
    _name_ticks(below, parameter.names)
    above.plot(_values(parameter, feasible), _scores(feasible), "o", ms=4, color="black", label="evaluated")
    above.legend()
    labels(above, "", _named(objective))
    below.plot(x, _log_acquisition(posterior, points, best), color=ORANGE)
    labels(below, parameter.name, ACQUISITION)
    return figure


def _two(
    space: Space, trials: Sequence[Trial], posterior: SearchPosterior, objective: Objective, best: float, columns: int
) -> Figure:
    figure, (left, right) = panels(2, 4.6, 3.8, columns)
    unit = np.linspace(0.0, 1.0, 61)
    points = np.stack(np.meshgrid(unit, unit), axis=-1).reshape(-1, 2)
    first, second = space.free
    x, y = first.lower + unit * first.width, second.lower + unit * second.width
    mean = np.full(len(points), warped(best)) if posterior.score is None else posterior.score.predict(points)[0]
    for axes, title, values, label in (
        (left, "surrogate", unwarped(mean), _named(objective)),
        (right, "acquisition", _log_acquisition(posterior, points, best), ACQUISITION),
    ):
        image = axes.pcolormesh(x, y, values.reshape(61, 61), shading="nearest", cmap="viridis", rasterized=True)
        axes.grid(False)
        figure.colorbar(image, ax=axes, label=label)
        for colour, chosen in (("white", True), (RED, False)):
            shown = [trial for trial in trials if (trial.score is not None) == chosen]
            axes.plot(_values(first, shown), _values(second, shown), ".", ms=7, mec="black", mew=0.4, color=colour)
        labels(axes, first.name, second.name, f"{title}; rejected designs in red")
    return figure


def _log_acquisition(posterior: SearchPosterior, points: Array, best: float) -> Array:
    """Return the decimal logarithm of the acquisition (m,), no lower than `DECADES` below its maximum."""
    value = (posterior.log_improvement(points, best) + posterior.log_feasible(points)) / np.log(10.0)
    return np.asarray(np.maximum(value, value.max() - DECADES))


def _at_the_foot(axes: Axes, x: npt.NDArray[Any], marker: str, **how: Any) -> None:
    """Draw marks at the foot of the axes, whose heights say nothing."""
    axes.plot(x, np.full(len(x), 0.03), marker, transform=axes.get_xaxis_transform(), **how)


def _name_ticks(axes: Axes, names: Sequence[str]) -> None:
    if names:
        axes.set_xticks(range(len(names)), names, rotation=30, ha="right", fontsize=7)


def _named(objective: Objective) -> str:
    """Return the score's name with its unit, in lines that fit the height of a small panel."""
    return fill(f"{objective.meaning} ({objective.unit})", 26)


def _values(parameter: SearchParameter, trials: Sequence[Trial]) -> list[float]:
    """Return the values of a parameter (n,), of names their indices."""
    return [parameter.number(trial.variant.value(parameter.name)) for trial in trials]


def _scores(trials: Sequence[Trial]) -> Array:
    """Return the scores (n,); NaN where a design is rejected."""
    return np.array([np.nan if trial.score is None else trial.score for trial in trials])
