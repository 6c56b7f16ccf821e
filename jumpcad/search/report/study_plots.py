"""The pictures of a study."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from jumpcad.arguments import check_arguments
from jumpcad.search.fronts import described_cost
from jumpcad.search.phases import FRONTS, LEARNING_PHASES
from jumpcad.search.propose.posterior import SearchPosterior
from jumpcad.search.report import plots
from jumpcad.search.report.figures import save_figure
from jumpcad.search.space import Space
from jumpcad.search.study.objective import described_objective
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial, searched


@check_arguments
def plot_study(store: StudyStore, folder: str | Path) -> list[Path]:
    """Write history, slices, parallel coordinates, and what the method adds, into a folder; return the files."""
    return [save_figure(draw(), folder, name) for name, draw in study_figures(store).items()]


def study_figures(store: StudyStore, columns: int = 2) -> dict[str, Callable[[], Figure]]:
    """Return functions that draw the pictures of a study, by the pictures' names; see `plots.acquisition`."""
    trials, identity = searched(store.trials()), store.identity
    space, objective = Space.from_record(identity["space"]), described_objective(identity)
    figures: dict[str, Callable[[], Figure]] = {}
    if trials:
        figures["history"] = partial(plots.history, trials, objective)
        figures["slices"] = partial(plots.slices, space, trials, objective)
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
