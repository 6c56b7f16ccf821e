"""`StudySummary`: what a study file knows of its search, of the robust pick and of active bounds."""

from collections.abc import Mapping
from dataclasses import dataclass

from jumpcad.search.phases import EXPLORED, FRONTS, NAMES
from jumpcad.search.pick.robust import ActiveBound, Candidate, named_bounds
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Objective, described_objective
from jumpcad.search.study.picks import read_pick
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Position, Trial, best_trial, is_flat, searched, trial_numbers


@dataclass(frozen=True)
class StudySummary:
    """What a study knows.

    Parameters
    ----------
    space, objective
        What was searched for, and where.
    trials
        All designs that the search proposed, in order.
    winner
        The most robust of the best designs, or the best where neighbours were not examined; None if no design jumps,
        and of a search for one design whose scores are all alike.
    candidates
        The best designs with the scores of their neighbours, most robust first; none where the pick has not ended.
    bounds
        The bounds of the search on which the winner lies.
    numbers
        The numbers of the study's trials, by position.
    """

    space: Space
    objective: Objective
    trials: list[Trial]
    winner: Trial | None
    candidates: list[Candidate]
    bounds: list[ActiveBound]
    numbers: Mapping[Position, int]

    @property
    def is_explored(self) -> bool:
        """Whether the designs are a view's, whose order means nothing, and not proposals of a search."""
        return bool(self.trials) and all(trial.phase in EXPLORED for trial in self.trials)

    @property
    def scored(self) -> bool:
        """Whether some design jumps."""
        return best_trial(self.trials) is not None


def summary(store: StudyStore) -> StudySummary:
    """Return what a study knows, also while it runs."""
    held, identity = store.trials(), store.identity
    space = Space.from_record(identity["space"])
    trials = searched(held)
    candidates, bounds = read_pick(store, held, len(trials))
    seeks_one = identity["method"] in NAMES and identity["method"] not in FRONTS
    best = None if seeks_one and is_flat(trials) else best_trial(trials)
    winner = candidates[0].trial if candidates else best
    if winner is not None and not bounds:  # of a front, and where no pick has ended
        bounds = named_bounds(space, winner)
    return StudySummary(space, described_objective(identity), trials, winner, candidates, bounds, trial_numbers(held))
