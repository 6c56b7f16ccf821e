"""What a finished study knows of the robust pick and of active bounds, read again from its file.

Which neighbours belong to which candidate follows from the seed, so the pick is run again on an evaluator that reads
the study and computes nothing.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from jumpcad.design import Design
from jumpcad.search.evaluator import Evaluator, ignore
from jumpcad.search.fronts import described_cost, front
from jumpcad.search.methods import FRONTS
from jumpcad.search.objective import Evaluation, Objective, described_objective
from jumpcad.search.pick.robust import MOST_PICK, ROUNDS, ActiveBound, Candidate, active_bounds, rank_candidates
from jumpcad.search.pick.tolerances import Making
from jumpcad.search.space import Space
from jumpcad.search.store import StudyStore
from jumpcad.search.trial import Trial, best_trial, searched, trial_numbers
from jumpcad.search.variant import Key, Variant

EXPLORED = ("sample", "sweep")
"""Phases of a view."""


class Replay(Evaluator):
    """An evaluator that gives the trials of a study, and None where the study has none."""

    def __init__(self, store: StudyStore) -> None:
        identity = store.identity
        held = store.trials()
        self.space, self.objective = Space.from_record(store.space), described_objective(identity)
        self.store = store
        self._watch = ignore
        self._finished = {trial.key: trial for trial in held}
        self._seen = {trial.key: trial for trial in searched(held)}

    def finished(self, phase: str, step: int, count: int) -> list[Trial]:
        """Return the trials of a step, also where there are fewer than `count`."""
        held = [trial for trial in self._finished.values() if (trial.phase, trial.step) == (phase, step)]
        for trial in held:
            self._add(trial, computed=False)
        return held

    def evaluate(
        self,
        designs: Sequence[Design | Variant],
        phase: str,
        step: int,
        limit: int | None = None,
        proposals: Sequence[Mapping[str, Any]] | None = None,
        left_out: Mapping[Key, Evaluation] | None = None,
    ) -> list[Trial | None]:
        """Return the trials of designs, None for those that the study does not hold."""
        found = [self._finished.get(Variant.of(design).key) for design in designs]
        for trial in found:
            if trial is not None:
                self._add(trial, computed=False)
        return found


@dataclass(frozen=True)
class Known:
    """What a study knows.

    Parameters
    ----------
    space, objective
        What was searched for, and where.
    trials
        All designs that the search proposed, in order.
    winner
        The most robust of the best designs, or the best where neighbours were not examined; None if no design jumps.
    candidates
        The best designs with the scores of their neighbours, most robust first; none where the pick has not run.
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
    numbers: Mapping[tuple[int, int, int], int]

    @property
    def is_explored(self) -> bool:
        """Whether the designs are a view's, whose order means nothing, and not proposals of a search."""
        return bool(self.trials) and all(trial.phase in EXPLORED for trial in self.trials)


def known(store: StudyStore) -> Known:
    """Return what a study knows, also while it runs."""
    replay = Replay(store)
    held, trials, best = store.trials(), replay.trials, best_trial(replay.trials)
    share = _share(held, len(trials))
    candidates: list[Candidate] = []
    if share and best is not None:
        identity = store.identity
        among = front(trials, described_cost(identity)) if identity["method"] in FRONTS else None
        candidates = rank_candidates(replay, trials, identity["seed"], Making.of(identity), share, among)
    winner = candidates[0].trial if candidates else best
    bounds = [] if winner is None else active_bounds(replay, winner, 0)
    return Known(replay.space, replay.objective, trials, winner, candidates, bounds, trial_numbers(held))


def _share(trials: Sequence[Trial], proposed: int) -> int:
    """Return with how many evaluations candidates were ranked, 0 if they were not; see the steps of the pick."""
    last = max((trial.step for trial in trials if trial.phase == "robust"), default=0)
    share = last // ROUNDS - (MOST_PICK + 1) * proposed
    return share if 0 < share <= MOST_PICK else 0
