"""What a study's page says of the importance of parameters, active bounds, and reasons of rejection."""

from typing import Any

from jumpcad.errors import JumpcadError
from jumpcad.plural import counted
from jumpcad.search.explore import LEAST_R_SQUARED, importance
from jumpcad.search.report.words import reason_words
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
    return {
        "learned": learned,
        "least": LEAST_R_SQUARED,
        "rows": rows if is_known else [],
    }


def rising(found: StudySummary) -> list[str] | None:
    """Return beyond which bounds the score rises by more than rounding; None where none was examined."""
    score = abs((found.winner.score if found.winner else None) or 0.0)
    examined = {one.name: one.worth for one in found.bounds if one.worth is not None}
    return [name for name, worth in examined.items() if worth > LEAST_GAIN * score] if examined else None


def reason_rows(found: StudySummary) -> list[tuple[str, str, float, str]]:
    """Return the reasons of rejection: name, words, share of the largest count, count; a design may have several."""
    counts = count_rejections(found.trials)
    most = max(counts.values(), default=1)
    return [(reason, reason_words(reason), count / most, str(count)) for reason, count in counts.items()]
