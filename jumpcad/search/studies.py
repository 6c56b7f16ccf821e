"""All pictures of a study."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from jumpcad.search import plots
from jumpcad.search.figures import save
from jumpcad.search.objective import find_objective
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore, Trial
from jumpcad.search.study import FRONTS, search_rows
from jumpcad.search.surrogate import Posterior


def plot_study(store: StudyStore, folder: Path) -> list[Path]:
    """Write history, slices, parallel coordinates, and what the method adds, into a folder; return the files."""
    rows, identity = search_rows(store.rows()), store.identity
    space, objective = Space.from_record(identity["space"]), find_objective(identity["objective"])
    figures: dict[str, Callable[[], Figure]] = {}
    if rows:
        figures["history"] = partial(plots.history, rows, objective)
        figures["slices"] = partial(plots.slices, space, rows, objective)
    if rows and space.dimension > 1:
        figures["parallel"] = partial(plots.parallel, space, rows)
    if rows and identity["method"] in FRONTS:
        figures["pareto"] = partial(plots.pareto, rows, objective)
    if space.dimension <= 2:
        for name, number, count in _moments(rows):
            posterior = Posterior.from_rows(space, rows[:count], rows[number].proposal["theta"], fit=())
            figures[name] = partial(plots.acquisition, space, rows[:count], posterior, objective)
    return [save(draw(), folder, name) for name, draw in figures.items()]


def _moments(rows: Sequence[Trial]) -> list[tuple[str, int, int]]:
    """Return two moments of a Bayesian search: picture's name, the row with the hyperparameters, and how many rows.

    Before the first proposal there is much to learn; in the end, little.
    """
    proposed = [number for number, row in enumerate(rows) if "theta" in row.proposal]
    if not proposed:
        return []
    return [("acquisition-first", proposed[0], proposed[0]), ("acquisition", proposed[-1], len(rows))]
