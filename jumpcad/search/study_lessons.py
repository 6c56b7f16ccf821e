"""The sections of a study's page on the importance of parameters, active bounds, and reasons of rejection."""

from collections.abc import Iterator

from jumpcad.errors import JumpcadError
from jumpcad.search.explore import LEAST_R_SQUARED, importance
from jumpcad.search.figures import MEANINGS
from jumpcad.search.page_text import table, written
from jumpcad.search.replay import Known, Replay
from jumpcad.search.robust import ActiveBound
from jumpcad.search.store import StudyStore
from jumpcad.search.trial import count_rejections

MOST_LEARNED = 200
"""Largest number of designs from which importances are computed, evenly chosen: the time grows with their cube."""


def importances(store: StudyStore, found: Known) -> Iterator[str]:
    """Yield the importance of each free parameter for the score of the search's designs."""
    feasible = [trial for trial in found.trials if trial.score is not None]
    if len({trial.score for trial in feasible}) < 2:
        return
    yield "<h2>Importance</h2>"
    try:
        learned = importance(Replay(store), feasible[:: -(-len(feasible) // MOST_LEARNED)], store.identity["seed"])
    except JumpcadError:
        yield f"<p>{len(feasible)} designs that jump are too few to say what is important.</p>"
        return
    if not learned.r_squared >= LEAST_R_SQUARED:  # nor is NaN
        yield f"<p>From {learned.designs} designs the score of others cannot be predicted (R² {learned.r_squared:.2f}, "
        yield f"at least {LEAST_R_SQUARED:g} is asked for): this study does not say what is important.</p>"
        return
    yield f"<p>{written(MEANINGS['importance'])} Learned from {learned.designs} designs; R² on designs held out: "
    yield f"{learned.r_squared:.2f}. The search looked mostly near its best designs: over the whole space, ask "
    yield "<code>jumpcad explore importance</code>.</p>"
    order = sorted(range(len(learned.names)), key=lambda index: (-round(float(learned.mean[index]), 2), index))
    most = max(float(learned.mean.max()), 0.01)
    rows = [
        [
            written(learned.names[index]),
            _bar(float(learned.mean[index]) / most),
            f"{round(float(learned.mean[index]), 2) + 0.0:.2f} ± {float(learned.deviation[index]):.2f}",
        ]
        for index in order
    ]
    yield from table(("parameter", "", "fall of R²"), rows, numbers=(2,), bars=1)


def active(found: Known) -> Iterator[str]:
    """Yield the bounds on which the winner lies, and the change of the score beyond each."""
    if found.winner is None:
        return
    yield "<h2>Active bounds</h2>"
    if not found.bounds:
        yield "<p>The winner lies on no bound of the search that could be widened.</p>"
        return
    yield "<p>The winner lies on these bounds of the search. The last column says how the score changes a twentieth of "
    yield "the range beyond the bound, the other parameters unchanged.</p>"
    rows = [
        [written(one.name), one.side, f"{one.value:g}", f"{one.beyond:g}", written(_cost(one, found.objective.unit))]
        for one in found.bounds
    ]
    yield from table(("parameter", "bound", "at", "examined", "beyond it"), rows, numbers=(2, 3))


def rejections(found: Known) -> Iterator[str]:
    """Yield the reasons of rejection with their counts; a design may have several."""
    counts = count_rejections(found.trials)
    yield "<h2>Why designs were rejected</h2>"
    rejected = sum(trial.score is None for trial in found.trials)
    yield f"<p>{rejected} of {len(found.trials)} designs of the search were rejected; one may have several reasons. "
    yield "<code>jumpcad check</code> tells limit and remedy for a design.</p>"
    if counts:
        most = max(counts.values())
        rows = [[written(reason), _bar(count / most), str(count)] for reason, count in counts.items()]
        yield from table(("reason", "", "designs"), rows, numbers=(2,), bars=1)


def _cost(bound: ActiveBound, unit: str) -> str:
    if bound.worth is not None:
        return f"{bound.worth:+.4g} {unit}"
    return "not examined in this study" if bound.reason.startswith("not examined") else f"rejected: {bound.reason}"


def _bar(share: float) -> str:
    return f'<span class="count"><span style="width: {100.0 * min(max(share, 0.0), 1.0):.0f}%"></span></span>'
