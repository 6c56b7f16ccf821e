"""The pictures of a study, and that of searches with many seeds."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from jumpcad.arguments import check_arguments
from jumpcad.search.fronts import described_cost
from jumpcad.search.phases import FRONTS, LEARNING_PHASES
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.report import plots
from jumpcad.search.report.figures import labels, panels, save_figure
from jumpcad.search.study.result import Result
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import summary
from jumpcad.search.study.trial import Trial


@check_arguments
def plot_study(store: StudyStore, folder: str | Path, force: bool = False) -> list[Path]:
    """Write history, slices, parallel coordinates, and what the method adds, into a folder; return the files."""
    return [save_figure(draw(), folder, name, force) for name, draw in study_figures(store).items()]


def study_figures(store: StudyStore, columns: int = 2) -> dict[str, Callable[[], Figure]]:
    """Return functions that draw the pictures of a study, by the pictures' names; see `plots.acquisition`."""
    found, identity = summary(store), store.identity
    trials, space, objective = found.trials, found.space, found.objective
    figures: dict[str, Callable[[], Figure]] = {}
    if trials:
        figures["history"] = partial(plots.history, trials, objective)
        figures["slices"] = partial(plots.slices, space, trials, objective, found.winner)
    if trials and space.dimension > 1:
        figures["parallel"] = partial(plots.parallel, space, trials)
    if trials and identity["method"] in FRONTS:
        figures["pareto"] = partial(plots.pareto, trials, objective, described_cost(identity))
    if space.dimension <= 2:
        for name, number, count in _moments(trials):
            posterior = SearchPosterior.from_trials(space, trials[:count], trials[number].proposal["theta"], fit=False)
            figures[name] = partial(plots.acquisition, space, trials[:count], posterior, objective, columns)
    return figures


def _moments(trials: Sequence[Trial]) -> list[tuple[str, int, int]]:
    """Return the first and the last proposal of a Bayesian search.

    Of each: the picture's name, the trial whose hyperparameters are drawn, and how many trials are.
    """
    proposed = [
        number for number, trial in enumerate(trials) if "theta" in trial.proposal and trial.phase in LEARNING_PHASES
    ]
    if not proposed:
        return []
    return [("acquisition-first", proposed[0], proposed[0]), ("acquisition", proposed[-1], len(trials))]


def best_so_far(results: Sequence[Result]) -> Figure:
    """Draw the best score so far against evaluations: median and range of each method's searches.

    A search that ended keeps its best. One without a jump so far counts as the worst, and has no place in the picture;
    until the last one jumps, the median is dotted.
    """
    figure, (axes,) = panels(1, 6.4, 3.6)
    for colour, method in zip(plots.COLOURS, dict.fromkeys(one.request.method for one in results), strict=False):
        searches = [one.trials for one in results if one.request.method == method]
        scores = np.full((len(searches), max(map(len, searches))), -np.inf)
        for row, trials in zip(scores, searches, strict=True):
            row[: len(trials)] = [-np.inf if trial.score is None else trial.score for trial in trials]
        best = np.maximum.accumulate(scores, axis=1)
        low, middle, high = (np.where(np.isfinite(one), one, np.nan) for one in
                             (best.min(axis=0), np.median(best, axis=0), best.max(axis=0)))  # fmt: skip
        number = np.arange(1, scores.shape[1] + 1)
        axes.fill_between(number, low, high, color=colour, alpha=0.2, lw=0, step="post")
        axes.plot(number, middle, ":", color=colour, drawstyle="steps-post")
        whole = np.where(np.isfinite(low), middle, np.nan)
        axes.plot(number, whole, color=colour, drawstyle="steps-post", label=f"{method}, {len(searches)} searches")
    objective = results[0].request.aim
    labels(axes, "designs evaluated by the search", f"{objective.meaning} ({objective.unit})")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    figure.legend(loc="outside upper right", ncols=4)
    return figure
