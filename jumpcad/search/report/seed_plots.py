"""The picture of searches with many seeds."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from jumpcad.search.report.figures import labels, panels
from jumpcad.search.report.plots import COLOURS
from jumpcad.search.study.result import Result


def best_so_far(results: Sequence[Result]) -> Figure:
    """Draw the best score so far against evaluations: median and range of each method's searches.

    A search that ended keeps its best. One without a jump so far counts as the worst, and has no place in the picture.
    """
    figure, (axes,) = panels(1, 6.4, 3.6)
    for colour, method in zip(COLOURS, dict.fromkeys(one.request.method for one in results), strict=False):
        searches = [one.trials for one in results if one.request.method == method]
        scores = np.full((len(searches), max(map(len, searches))), -np.inf)
        for row, trials in zip(scores, searches, strict=True):
            row[: len(trials)] = [-np.inf if trial.score is None else trial.score for trial in trials]
        best = np.maximum.accumulate(scores, axis=1)
        low, middle, high = (np.where(np.isfinite(one), one, np.nan) for one in
                             (best.min(axis=0), np.median(best, axis=0), best.max(axis=0)))  # fmt: skip
        number = np.arange(1, scores.shape[1] + 1)
        axes.fill_between(number, low, high, color=colour, alpha=0.2, lw=0)
        axes.plot(number, middle, color=colour, label=f"{method}, {len(searches)} searches")
    objective = results[0].request.aim
    labels(axes, "designs evaluated by the search", f"{objective.meaning} ({objective.unit})")
    axes.legend(loc="upper left")
    return figure
