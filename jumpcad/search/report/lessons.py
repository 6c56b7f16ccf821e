"""The sections of a study's page on the importance of parameters, active bounds, and reasons of rejection."""

from collections.abc import Iterator

from jumpcad.errors import JumpcadError
from jumpcad.plural import counted
from jumpcad.search.explore import LEAST_R_SQUARED, Importance, importance_in
from jumpcad.search.pick.robust import ActiveBound
from jumpcad.search.report.text import broken, escape_html, table
from jumpcad.search.report.words import reason_words, with_unit
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import count_rejections

MOST_LEARNED = 200
"""Largest number of designs from which importances are computed, evenly chosen: the time grows with their cube."""
LEAST_GAIN = 5e-4
"""Share of the score below which a gain is shown as +0.0 %."""


def importances(store: StudyStore, found: StudySummary) -> Iterator[str]:
    """Yield the importance of each free parameter for the score of the search's designs."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    if len({trial.score for trial in feasible}) < 2:
        return
    yield "<h2>Importance</h2>"
    try:
        learned = importance_in(found.space, feasible[:: -(-len(feasible) // MOST_LEARNED)], store.identity["seed"])
    except JumpcadError:
        yield f"<p>{counted(len(feasible), 'design')} that jumped: too few to say what is important.</p>"
        return
    if not learned.r_squared >= LEAST_R_SQUARED:  # nor is NaN
        yield f"<p>From {learned.designs} designs the score of others cannot be predicted (R² {learned.r_squared:.2f}, "
        yield f"at least {LEAST_R_SQUARED:g} is asked for): this study does not say what is important.</p>"
        return
    yield "<p>How much worse the score of a design is predicted when the values of one parameter are exchanged among "
    yield "the designs: R² is 1 for a perfect prediction, 0 for a guess, and falls by the length of the bar. "
    yield f"{escape_html(_matters(learned))} Learned from {learned.designs} designs; R² on designs held out: "
    yield f"{learned.r_squared:.2f}. The search looked mostly near its best designs: over the whole space, ask "
    yield "<code>jumpcad explore importance</code>.</p>"
    order = sorted(range(len(learned.names)), key=lambda index: (-round(float(learned.mean[index]), 2), index))
    most = max(float(learned.mean.max()), 0.01)
    rows = [
        [
            escape_html(learned.names[index]),
            _bar(float(learned.mean[index]) / most),
            f"{round(float(learned.mean[index]), 2) + 0.0:.2f} ± {float(learned.deviation[index]):.2f}",
            "yes" if _is_clear(learned, index) else "no",
        ]
        for index in order
    ]
    yield from table(("parameter", "", "fall of R²", "beyond its error"), rows, numbers=(2,), bars=1)


def _matters(learned: Importance) -> str:
    """Return which parameters matter most, and which not more than the error of their bar."""
    order = sorted(range(len(learned.names)), key=lambda index: -round(float(learned.mean[index]), 2))
    clear = [learned.names[index] for index in order if _is_clear(learned, index)]
    rest = [learned.names[index] for index in order if not _is_clear(learned, index)]
    among = "Of those beyond their error, " if rest else ""
    most = f"{among}{', then '.join(clear[:3])} matter{'s' * (len(clear[:3]) == 1)} most." if clear else ""
    none = f"No more than their error, so perhaps nothing: {', '.join(rest)}." if rest else ""
    return f"{most} {none}".strip()


def _is_clear(learned: Importance, index: int) -> bool:
    """Return whether the bar of a parameter is longer than its error."""
    return bool(learned.mean[index] > learned.deviation[index])


def active(found: StudySummary) -> Iterator[str]:
    """Yield the bounds on which the winner lies, and the change of the score beyond each."""
    if found.winner is None:
        return
    yield "<h2>Active bounds</h2>"
    if not found.bounds:
        yield "<p>The winner lies on no bound of the search that could be widened.</p>"
        return
    unit = found.objective.unit
    yield "<p>The winner lies on these ends of what was searched. The last column says what each of them costs: how "
    yield "the score changes a twentieth of the range beyond it, the other parameters unchanged. Where it rises, "
    yield "a wider range (<code>--bound</code>) may find a better design. "
    yield f"{_gains(found)}</p>"
    rows = [
        [
            escape_html(one.name),
            one.side,
            escape_html(with_unit(f"{one.value:g}", one.name)),
            escape_html(with_unit(f"{one.beyond:g}", one.name)),
            escape_html(_cost(one, unit, found.winner.score or 0.0)),
        ]
        for one in found.bounds
    ]
    yield from table(("parameter", "end of its range", "at", "examined at", "score beyond it"), rows, numbers=(2, 3))


def _gains(found: StudySummary) -> str:
    """Return beyond which bounds the score rises by more than rounding, in words."""
    score = abs(found.winner.score or 0.0) if found.winner else 0.0
    rising = [one.name for one in found.bounds if one.worth is not None and one.worth > LEAST_GAIN * score]
    if rising:
        return f"Here it rises beyond that of {escape_html(', '.join(rising))}."
    if any(one.worth is not None for one in found.bounds):
        return "Here it rises beyond none that was examined."
    return "This search did not examine them: one that picks a robust design does (method ga or bo)."


def rejections(found: StudySummary) -> Iterator[str]:
    """Yield the reasons of rejection with their counts; a design may have several."""
    counts = count_rejections(found.trials)
    yield "<h2>Why designs were rejected</h2>"
    rejected = sum(trial.score is None for trial in found.trials)
    yield f"<p>Rejected: {rejected} of {counted(len(found.trials), 'design of the search')}; one may have several "
    yield "reasons. "
    yield "<code>jumpcad check</code> tells limit and remedy for a design.</p>"
    if counts:
        most, first = max(counts.values()), next(iter(counts))
        meaning = reason_words(first)
        said = f": {escape_html(meaning)}" if meaning else ""
        yield f"<p>The most frequent reason is {broken(first)}, of {counted(counts[first], 'design')}{said}.</p>"
        rows = [
            [broken(reason), escape_html(reason_words(reason)), _bar(count / most), str(count)]
            for reason, count in counts.items()
        ]
        yield from table(("reason", "what it means", "", "designs"), rows, numbers=(3,), bars=2)


def _cost(bound: ActiveBound, unit: str, score: float) -> str:
    if bound.worth is not None:
        share = f" ({100.0 * bound.worth / abs(score):+.1f} %)" if score else ""
        return f"{bound.worth:+.4g} {unit}{share}"
    if bound.unknown:
        return "not examined in this study"
    means = "; ".join(filter(None, map(reason_words, bound.reason.split(", "))))
    return f"rejected, {bound.reason}{f': {means}' if means else ''}"


def _bar(share: float) -> str:
    return f'<span class="count"><span style="width: {100.0 * min(max(share, 0.0), 1.0):.0f}%"></span></span>'
