"""What a study's page says of the importance of parameters, active bounds, and reasons of rejection."""

from typing import Any

from jumpcad.errors import JumpcadError
from jumpcad.plural import counted
from jumpcad.search.explore import LEAST_R_SQUARED, Importance, importance_in
from jumpcad.search.pick.robust import ActiveBound
from jumpcad.search.report.words import reason_words, with_unit
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import count_rejections

MOST_LEARNED = 200
"""Largest number of designs from which importances are computed, evenly chosen: the time grows with their cube."""
LEAST_GAIN = 5e-4
"""Share of the score below which a gain is shown as +0.0 %."""


def importances(store: StudyStore, found: StudySummary) -> dict[str, Any]:
    """Return the importance of each free parameter for the score of the search's designs; nothing if all are alike."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    if len({trial.score for trial in feasible}) < 2:
        return {}
    try:
        learned = importance_in(found.space, feasible[:: -(-len(feasible) // MOST_LEARNED)], store.identity["seed"])
    except JumpcadError:
        return {"learned": None, "jumped": counted(len(feasible), "design")}
    most = max(float(learned.mean.max()), 0.01)
    rows = [
        (
            learned.names[index],
            min(max(float(learned.mean[index]) / most, 0.0), 1.0),
            f"{round(float(learned.mean[index]), 2) + 0.0:.2f} ± {learned.deviation[index]:.2f}",
            "yes" if _is_clear(learned, index) else "no",
        )
        for index in _largest_first(learned)
    ]
    is_known = learned.r_squared >= LEAST_R_SQUARED  # nor is NaN
    return {
        "learned": learned,
        "least": LEAST_R_SQUARED,
        "rows": rows if is_known else [],
        "matters": _matters(learned),
    }


def _largest_first(learned: Importance) -> list[int]:
    return sorted(range(len(learned.names)), key=lambda index: -round(float(learned.mean[index]), 2))


def _matters(learned: Importance) -> str:
    """Return which parameters matter most, and which not more than the error of their bar."""
    order = _largest_first(learned)
    clear = [learned.names[index] for index in order if _is_clear(learned, index)]
    rest = [learned.names[index] for index in order if not _is_clear(learned, index)]
    among = "Of those beyond their error, " if rest else ""
    most = f"{among}{', then '.join(clear[:3])} matter{'s' * (len(clear[:3]) == 1)} most." if clear else ""
    none = f"No more than their error, so perhaps nothing: {', '.join(rest)}." if rest else ""
    return f"{most} {none}".strip()


def _is_clear(learned: Importance, index: int) -> bool:
    """Return whether the bar of a parameter is longer than its error."""
    return bool(learned.mean[index] > learned.deviation[index])


def bound_rows(found: StudySummary) -> list[tuple[str, ...]]:
    """Return the bounds on which the winner lies, and the change of the score beyond each."""
    score = (found.winner.score if found.winner else None) or 0.0
    return [
        (
            one.name,
            one.side,
            with_unit(f"{one.value:g}", one.name),
            with_unit(f"{one.beyond:g}", one.name),
            _cost(one, found.objective.unit, score),
        )
        for one in found.bounds
    ]


def gains(found: StudySummary) -> str:
    """Return beyond which bounds the score rises by more than rounding, in words."""
    score = abs(found.winner.score or 0.0) if found.winner else 0.0
    rising = [one.name for one in found.bounds if one.worth is not None and one.worth > LEAST_GAIN * score]
    if rising:
        return f"Here it rises beyond that of {', '.join(rising)}."
    if any(one.worth is not None for one in found.bounds):
        return "Here it rises beyond none that was examined."
    return "This search did not examine them: one that picks a robust design does (method ga or bo)."


def reason_rows(found: StudySummary) -> list[tuple[str, str, float, str]]:
    """Return the reasons of rejection: name, words, share of the largest count, count; a design may have several."""
    counts = count_rejections(found.trials)
    most = max(counts.values(), default=1)
    return [(reason, reason_words(reason), count / most, str(count)) for reason, count in counts.items()]


def _cost(bound: ActiveBound, unit: str, score: float) -> str:
    if bound.worth is not None:
        share = f" ({100.0 * bound.worth / abs(score):+.1f} %)" if score else ""
        return f"{bound.worth:+.4g} {unit}{share}"
    if bound.unknown:
        return "not examined in this study"
    means = "; ".join(filter(None, map(reason_words, bound.reason.split(", "))))
    return f"rejected, {bound.reason}{f': {means}' if means else ''}"
