"""The page of a study, without network: request, best designs, pictures, importances, reasons of rejection.

Its pictures are files too. Its words and marks are templates in `report/study`. The HTML is well-formed XML too. The
same study file gives the same bytes.
"""

import base64
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from jumpcad.arguments import check_arguments
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import fill, templates_folder
from jumpcad.search.explore import LEAST_R_SQUARED, importance
from jumpcad.search.fronts import Cost, described_cost, energy_j, front, hypervolume
from jumpcad.search.methods import FRONTS, LEARNING_PHASES
from jumpcad.search.parameter import SearchParameter
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.report import figures, plots
from jumpcad.search.report.drawings import evenly, history, parallel, slices
from jumpcad.search.report.shown_design import EDGE_MM, LINKS, POSES, box_mm, chart
from jumpcad.search.robust_pick import best_apart
from jumpcad.search.study.result import Result
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import StudySummary, kept_righting, summary
from jumpcad.search.study.trial import Trial, count_rejections
from jumpcad.search.study.variant import Tolerances

SHOWN = 10
"""Number of best designs that are shown if no neighbours were examined and no front was searched."""
MOST_SHOWN = 100
"""Largest number of a front's designs that are shown, evenly chosen along it: each has 5 kB."""
PICTURES = {"acquisition-first": "What the method knew at first", "acquisition": "What the method knew at last"}
"""Pictures that are drawn by matplotlib, and their titles: the page draws the others itself."""
UNSAVED = "F.db"
"""The file in the commands of a study that is kept in memory."""
MOST_LEARNED = 200
"""Largest number of designs from which importances are computed, evenly chosen: the time grows with their cube."""
LEAST_GAIN = 5e-4
"""Share of the score below which a gain is shown as +0.0 %."""


@check_arguments
def write_study_page(store: StudyStore, name: str) -> str:
    """Return the page of a study, also of one that still runs."""
    folder = templates_folder() / "report"
    found, identity = summary(store), store.identity
    cost, is_front = described_cost(identity), identity["method"] in FRONTS
    shown, drawn = _shown(found, cost if is_front else None), study_figures(store, columns=1)
    pictures = {
        PICTURES[name]: (name, base64.b64encode(figures.svg_text(drawn[name]()).encode()).decode())
        for name in PICTURES if name in drawn
    }  # fmt: skip
    values = {
        "name": name, "found": found, "cost": cost, "is_front": is_front, "identity": identity,
        "style": "".join((folder / file).read_text(encoding="ascii") for file in ("style.css", "study.css")),
        "program": (folder / "study.js").read_text(encoding="ascii"),
        "designs": counted(len(found.trials), "design"), "stages": store.recall("stages", []),
        "held": store.trials(), "righting": kept_righting(store, found.winner), "notes": store.notes(),
        "asked": [_asked(parameter, found.winner) for parameter in found.space.parameters],
        "best": best_values(store, found, shown), "history": history(found), "slices": slices(found, shown),
        "parallel": parallel(found, shown), "pictures": pictures, "importance": importances(store, found),
        "rising": rising(found), "rejected": sum(trial.score is None for trial in found.trials),
        "reasons": reason_rows(found), "reason_words": figures.reason_words, "with_unit": figures.with_unit,
        "counted": counted,
        "versions": ", ".join(f"{one} {str(version)[:12]}" for one, version in identity.get("versions", {}).items()),
    }  # fmt: skip
    return allowed(fill("report/study/page.html.j2", values))


def _asked(parameter: SearchParameter, winner: Trial | None) -> list[str]:
    """Return name, meaning, what was searched, and the winner's value."""
    name = parameter.name
    value = figures.with_unit(figures.value_words(winner.variant.value(name), 4), name) if winner else ""
    return [name, figures.meaning_of(name), figures.with_unit(_range(parameter), name), value]


def _range(parameter: SearchParameter) -> str:
    if not parameter.free:
        return f"fixed at {figures.value_words(parameter.value(parameter.lower))}"
    if parameter.choices:
        return "one of " + ", ".join(figures.value_words(parameter.value(choice)) for choice in parameter.choices)
    return f"{parameter.lower:g} … {parameter.upper:g}"


def best_values(store: StudyStore, found: StudySummary, shown: Sequence[Trial]) -> dict[str, Any]:
    """Return the best designs for chart, side views and table; nothing where none is shown."""
    if not shown:
        return {}
    cost, is_front = described_cost(store.identity), store.identity["method"] in FRONTS
    are_candidates = [one.trial for one in found.candidates] == list(shown)
    numbers = [found.numbers[trial.position] for trial in shown]
    drawn = chart(found.trials, shown, numbers, cost, is_front, str(store.path or UNSAVED))
    if is_front:
        area, whole = hypervolume(found.trials, cost=cost), len(front(found.trials, cost))
        drawn |= {"meaning": figures.report_words("pictures")["pareto"], "area": area, "whole": whole}
    for one, trial in zip(drawn["shown"], shown, strict=True):
        values = [figures.value_words(trial.variant.value(parameter.name), 4) for parameter in found.space.free]
        one |= {"energy_j": energy_j(trial.design), "values": values}
    return drawn | {
        "box": box_mm(trial.design for trial in shown),
        # a front ends at its highest score, a ranking starts so
        "first": len(shown) if is_front else 1,
        "candidates": found.candidates if are_candidates else [],
        "making": Tolerances(**store.identity.get("making") or {"length_mm": 0.0}).words,  # none without a pick
        "names": [figures.named(parameter.name).removesuffix(" (ratio)") for parameter in found.space.free],
        "poses": POSES, "links": LINKS, "edge_mm": EDGE_MM,
    }  # fmt: skip


def _shown(found: StudySummary, of_front: Cost | None) -> list[Trial]:
    """Return the designs that are shown: those of a front against a cost, or the best ones."""
    if of_front is not None:
        best = front(found.trials, of_front)
        return [best[place] for place in evenly(len(best), MOST_SHOWN)]
    return [candidate.trial for candidate in found.candidates] or best_apart(found.space, found.trials, SHOWN)


def importances(store: StudyStore, found: StudySummary) -> dict[str, Any]:
    """Return the importance of each free parameter for the score of the search's designs; nothing if all are alike."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    if len({trial.score for trial in feasible}) < 2:
        return {}
    try:
        learned = importance(found.space, feasible[:: -(-len(feasible) // MOST_LEARNED)], store.identity["seed"])
    except JumpcadError:
        return {"learned": None, "jumped": counted(len(feasible), "design")}
    most = max(float(learned.mean.max()), 0.01)
    rows = [
        (
            learned.names[index],
            min(max(float(learned.mean[index]) / most, 0.0), 1.0),
            f"{round(float(learned.mean[index]), 2) + 0.0:.2f} ± {learned.deviation[index]:.2f}",
            "yes" if learned.mean[index] > learned.deviation[index] else "no",
        )
        for index in sorted(range(len(learned.names)), key=lambda index: -round(float(learned.mean[index]), 2))
    ]
    is_known = learned.r_squared >= LEAST_R_SQUARED  # nor is NaN
    return {"learned": learned, "least": LEAST_R_SQUARED, "rows": rows if is_known else []}


def rising(found: StudySummary) -> list[str] | None:
    """Return beyond which bounds the score rises by more than rounding; None where none was examined."""
    score = abs((found.winner.score if found.winner else None) or 0.0)
    examined = {one.name: one.worth for one in found.bounds if one.worth is not None}
    return [name for name, worth in examined.items() if worth > LEAST_GAIN * score] if examined else None


def reason_rows(found: StudySummary) -> list[tuple[str, str, float, str]]:
    """Return the reasons of rejection: name, words, share of the largest count, count; a design may have several."""
    counts = count_rejections(found.trials)
    most = max(counts.values(), default=1)
    return [(reason, figures.reason_words(reason), count / most, str(count)) for reason, count in counts.items()]


@check_arguments
def plot_study(store: StudyStore, folder: str | Path, force: bool = False) -> list[Path]:
    """Write history, slices, parallel coordinates, and what the method adds, into a folder; return the files."""
    return [figures.save_figure(draw(), folder, name, force) for name, draw in study_figures(store).items()]


def study_figures(store: StudyStore, columns: int = 2) -> dict[str, Callable[[], Figure]]:
    """Return functions that draw the pictures of a study, by the pictures' names; see `plots.acquisition`."""
    found, identity = summary(store), store.identity
    trials, space, objective = found.trials, found.space, found.objective
    drawn: dict[str, Callable[[], Figure]] = {}
    if trials:
        drawn["history"] = partial(plots.history, trials, objective)
        drawn["slices"] = partial(plots.slices, space, trials, objective, found.winner)
    if trials and space.dimension > 1:
        drawn["parallel"] = partial(plots.parallel, space, trials)
    if trials and identity["method"] in FRONTS:
        drawn["pareto"] = partial(plots.pareto, trials, objective, described_cost(identity))
    if space.dimension <= 2:
        for name, number, count in _moments(trials):
            posterior = SearchPosterior.from_trials(space, trials[:count], trials[number].proposal["theta"], fit=False)
            drawn[name] = partial(plots.acquisition, space, trials[:count], posterior, objective, columns)
    return drawn


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
    figure, (axes,) = figures.panels(1, 6.4, 3.6)
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
    figures.labels(axes, "designs evaluated by the search", f"{objective.meaning} ({objective.unit})")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    figure.legend(loc="outside upper right", ncols=4)
    return figure
