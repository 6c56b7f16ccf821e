"""The page of a study, without network: request, best designs, pictures, importances, reasons of rejection.

The HTML is well-formed XML too. The same study file gives the same bytes.
"""

import base64
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import Any

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.files.templates import templates_folder
from jumpcad.plural import counted
from jumpcad.search.fronts import Cost, described_cost, energy_j, front, hypervolume
from jumpcad.search.phases import FRONTS
from jumpcad.search.pick.robust import best_apart
from jumpcad.search.pick.tolerances import Tolerances
from jumpcad.search.report.chart import chart
from jumpcad.search.report.drawings import history, parallel, slices
from jumpcad.search.report.figures import MEANINGS, svg_text
from jumpcad.search.report.lessons import active, importances, rejections
from jumpcad.search.report.shown_design import shown_designs
from jumpcad.search.report.study_plots import study_figures
from jumpcad.search.report.text import broken, escape_html, table
from jumpcad.search.report.words import meaning_of, named, with_unit
from jumpcad.search.study.objective import Objective
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import StudySummary, summary
from jumpcad.search.study.trial import Trial, feasible_trials
from jumpcad.workshop.varied import Value

SHOWN = 10
"""Number of best designs that are shown if no neighbours were examined and no front was searched."""
MOST_SHOWN = 100
"""Largest number of a front's designs that are shown, evenly chosen along it: each has 5 kB."""
PICTURES = {"acquisition-first": "What the method knew at first", "acquisition": "What the method knew at last"}
"""Pictures that are drawn by matplotlib, and their titles: the page draws the others itself."""
ACQUISITION = (
    "From the designs that it had tried, dots, Bayesian optimisation predicts the score of all others (surrogate). It "
    "tries next where the acquisition is highest: the gain that it expects (EI, expected improvement) times the "
    "probability that the design jumps, as a power of ten."
)
UNSAVED = "F.db"
"""The file in the commands of a study that is kept in memory."""
CANDIDATE_HEAD = ("±1 %", "as made", "rejected")


@check_arguments
def write_study_page(store: StudyStore, name: str) -> str:
    """Return the page of a study, also of one that still runs.

    Raises
    ------
    JumpcadError
        If the study file is damaged.
    """
    folder = templates_folder() / "report"
    style = "".join((folder / file).read_text(encoding="ascii") for file in ("style.css", "study.css"))
    program = (folder / "study.js").read_text(encoding="ascii")
    found, title = summary(store), escape_html(name)
    shown = _shown(found, described_cost(store.identity) if store.identity["method"] in FRONTS else None)
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            '<head><meta charset="utf-8" /><meta name="viewport" content="width=device-width, initial-scale=1" />',
            f"<title>{title}</title><style>{style}</style></head>",
            "<body>",
            f"<h1>{title}</h1>",
            *_verdict(store, found),
            *_asked(store, found),
            *_best(store, found, shown),
            *history(found),
            *slices(found, shown),
            *parallel(found, shown),
            *_pictures(store),
            *importances(store, found),
            *active(found),
            *rejections(found),
            *_notes(store),
            f"<script>//<![CDATA[\n{program}\n//]]></script>",
            "</body>",
            "</html>",
            "",
        ]
    )


def _verdict(store: StudyStore, found: StudySummary) -> Iterator[str]:
    """Yield the best score in a sentence, and the study's main data as cards."""
    identity, trials = store.identity, store.trials()
    objective = found.objective
    jumped = len(feasible_trials(found.trials))
    if found.winner is None:
        yield f'<p class="error">None of {counted(len(found.trials), "design")} jumps.</p>'
    else:
        which = (
            "most robust of the best designs" if found.candidates else f"best of {counted(len(found.trials), 'design')}"
        )
        yield (
            f'<p class="verdict">The {which}: {escape_html(objective.meaning)} '
            f"{found.winner.score:.4g} {escape_html(objective.unit)}.</p>"
        )
    planned = sum(stage["evaluations"] for stage in store.recall("stages", []))
    cards = [
        ("method", identity["method"]),
        ("robot", identity["model"]["name"]),
        ("designs of the search", f"{len(found.trials)}" + (f" of {planned}" if planned > len(found.trials) else "")),
        ("of them jump", str(jumped)),
        ("designs around the best", str(len(trials) - len(found.trials))),
        ("seed", str(identity["seed"])),
        ("time of all evaluations", f"{sum(trial.duration_s for trial in trials):.0f} s"),
    ]
    yield '<dl class="cards">'
    yield from (f"<div><dt>{escape_html(term)}</dt><dd>{escape_html(value)}</dd></div>" for term, value in cards)
    yield "</dl>"


def _asked(store: StudyStore, found: StudySummary) -> Iterator[str]:
    """Yield the objective, the stages, and the space with the winner's values."""
    identity, objective = store.identity, found.objective
    method = identity["method"]
    stages = [f"{stage['method']}, {counted(stage['evaluations'], 'design')}" for stage in store.recall("stages", [])]
    yield "<h2>What was asked</h2>"
    yield (
        f"<p>The highest {escape_html(identity['objective'])} "
        f"({escape_html(objective.meaning)}, {escape_html(objective.unit)})"
        f"{f' against {described_cost(identity).figure.meaning}' if method in FRONTS else ''}, "
        f"{'evaluated' if found.is_explored else 'searched'} by {escape_html(', then '.join(stages) or method)}.</p>"
    )
    rows = []
    for parameter in found.space.parameters:
        value = "" if found.winner is None else _value(found.winner.variant.value(parameter.name))
        searched = with_unit(_range(parameter.describe()), parameter.name)
        meaning, name = escape_html(meaning_of(parameter.name)), parameter.name
        rows.append([broken(name), meaning, escape_html(searched), with_unit(value, name) if value else ""])
    whose = "best" if found.is_explored else "highest" if method in FRONTS and not found.candidates else "winner"
    yield from table(
        ("parameter", "meaning", "searched", whose),
        rows,
        numbers=(3,),
    )


def _range(record: Mapping[str, Any]) -> str:
    if "fixed" in record:
        return f"fixed at {_plain(record['fixed'])}"
    if "choices" in record:
        return "one of " + ", ".join(map(_plain, record["choices"]))
    return f"{record['lower']:g} … {record['upper']:g}"


def _plain(value: Value) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _best(store: StudyStore, found: StudySummary, shown: Sequence[Trial]) -> Iterator[str]:
    """Yield the best designs: chart, side views, table."""
    objective, is_front, cost = found.objective, store.identity["method"] in FRONTS, described_cost(store.identity)
    if not shown:
        return
    yield f"<h2>{'The front' if is_front else 'The best designs'}</h2>"
    if is_front:
        area, unit = hypervolume(found.trials, cost=cost), escape_html(cost.figure.unit)
        end = f"{'up' if cost.less_is_better else 'down'} to {cost.shown(cost.reference):g} {unit}"
        yield f"<p>{MEANINGS['pareto']} {escape_html(_reach(shown, objective, cost))} The area below its line, {end}, "
        yield f"is {area:.4g} {escape_html(objective.unit)}·{unit} (hypervolume); of two searches, the better one has "
        yield "more.</p>"
        if len(shown) < (whole := len(front(found.trials, cost))):
            yield f"<p>{len(shown)} of its {whole} designs are shown, evenly chosen along it.</p>"
    else:
        yield "<p>Score against the energy in the springs: the rings are the designs of the table below, the small "
        yield "dots all other designs that jump.</p>"
    yield "<p>Click a point, or go to it with Tab and the arrow keys, to see its robot; where points lie on each "
    yield "other, each further click shows the next one. The pictures below mark the chosen design too. "
    numbers = [found.numbers[trial.position] for trial in shown]
    first = _first(shown, is_front)
    which = (
        "the most robust of the best"
        if _are_candidates(found, shown) and not is_front
        else "the one with the highest score"
    )
    yield f"The page opens on design {first} (trial {numbers[first - 1]}), {which}; the number of a trial is that of "
    yield "<code>jumpcad study</code> and <code>jumpcad studio</code>.</p>"
    yield '<div class="map">'
    yield chart(found.trials, shown, numbers, objective, cost, is_front)
    yield f'<div id="robots" data-first="{first}" aria-live="polite">'
    yield '<p id="turn" hidden="hidden"><button type="button" id="before">Previous'
    yield '</button> <button type="button" id="after">Next</button></p>'
    yield from shown_designs(shown, numbers, objective, str(store.path or UNSAVED))
    yield "</div></div>"
    yield from _designs(found, shown, numbers, Tolerances.of(store.identity))


def _shown(found: StudySummary, of_front: Cost | None) -> list[Trial]:
    """Return the designs that are shown: those of a front against a cost, or the best ones."""
    if of_front is not None:
        best = front(found.trials, of_front)
        places = np.linspace(0, len(best) - 1, min(len(best), MOST_SHOWN))
        return [best[round(place)] for place in places.tolist()]
    return [candidate.trial for candidate in found.candidates] or best_apart(found.space, found.trials, SHOWN)


def _are_candidates(found: StudySummary, shown: Sequence[Trial]) -> bool:
    """Return whether the shown designs are those whose neighbours were examined."""
    return [one.trial for one in found.candidates] == list(shown)


def _first(shown: Sequence[Trial], is_front: bool) -> int:
    """Return the number of the design that is seen first: a front ends at its highest score, a ranking starts so."""
    return len(shown) if is_front else 1


def _reach(shown: Sequence[Trial], objective: Objective, cost: Cost) -> str:
    """Return from where to where a front goes, in words."""
    low, high = shown[0], shown[-1]

    def spent(trial: Trial) -> str:
        return f"{cost.shown(cost.of(trial)):.3g} {cost.figure.unit}"

    ends = [f"{one.score:.3g} {objective.unit} with {spent(one)}" for one in (low, high)]
    said, highest = f"Here it goes from {ends[0]} to {ends[1]}", high.score or 0.0
    if highest <= 0.0:
        return f"{said}."
    half = next(trial for trial in shown if (trial.score or 0.0) >= 0.5 * highest)
    return f"{said}; half of the highest score comes with {spent(half)}."


def _designs(found: StudySummary, shown: Sequence[Trial], numbers: Sequence[int], making: Tolerances) -> Iterator[str]:
    """Yield the table of the shown designs, with the scores of their neighbours if they were examined."""
    if _are_candidates(found, shown):
        neighbours = [
            [
                f"{one.parameters_score:.4g}",
                f"{one.print_score:.4g}",
                f"{sum(one.rejections.values())} of {one.neighbours}",
            ]
            for one in found.candidates
        ]
        head: tuple[str, ...] = CANDIDATE_HEAD
        yield "<p>Most robust first. ±1 % and as made: the score that nine of ten neighbours reach when every "
        yield f"parameter varies by ±1 %, and within what may be made otherwise ({escape_html(making.words)}); "
        yield "how many of the neighbours were rejected.</p>"
    else:
        neighbours, head = [[] for _ in shown], ()
    rows = [
        [
            f'<a href="#design-{number}" data-design="{number}">{number}</a>',
            str(of_study),
            f"{trial.score:.4g}",
            *cells,
            f"{energy_j(trial.design):.4f}",
            *(_value(trial.variant.value(parameter.name)) for parameter in found.space.free),
        ]
        for number, (trial, of_study, cells) in enumerate(zip(shown, numbers, neighbours, strict=True), start=1)
    ]
    score = f"score ({found.objective.unit})"
    titles = ["design", "trial", score, *head, "springs (J)"]
    first_extra = len(titles) - bool(head)  # a phone has no room for the springs beside the neighbours
    titles += [_headed(parameter.name) for parameter in found.space.free]
    yield from table(titles, rows, numbers=range(1, len(titles)), extra=range(first_extra, len(titles)))
    yield '<p class="narrow"><small>A wider screen shows more in this table; here, a click on a number shows all of '
    yield "its design.</small></p>"


def _headed(parameter: str) -> str:
    """Return a parameter's name with its unit; ratios have none."""
    return named(parameter).removesuffix(" (ratio)")


def _value(value: Value) -> str:
    """Return a parameter's value: a number with four digits, or a name."""
    return f"{value:.4g}" if isinstance(value, float) else escape(value)


def _pictures(store: StudyStore) -> Iterator[str]:
    for name, draw in study_figures(store, columns=1).items():
        if name not in PICTURES:
            continue
        data = base64.b64encode(svg_text(draw()).encode()).decode()
        yield f"<h2>{PICTURES[name]}</h2>"
        yield f'<figure class="picture"><img alt="{name}" src="data:image/svg+xml;base64,{data}" />'
        yield f"<figcaption>{ACQUISITION}</figcaption></figure>"


def _notes(store: StudyStore) -> Iterator[str]:
    if notes := store.notes():
        yield f"<h2>Notes of the run</h2><ul>{''.join(f'<li>{escape_html(note)}</li>' for note in notes)}</ul>"
    versions = store.identity.get("versions", {})
    if isinstance(versions, dict) and versions:
        told = ", ".join(f"{name} {str(version)[:12]}" for name, version in versions.items())
        yield f"<p>Evaluated with {escape_html(told)}.</p>"
