"""`StudySummary`: what a study file knows of its search; its robust picks, and how its winner rights itself."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from pydantic import ConfigDict, TypeAdapter

from jumpcad.building import build
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.landing.landing import land
from jumpcad.search.methods import EXPLORED, FRONTS, NAMES
from jumpcad.search.models import RIGHTS_ITSELF, PrintedModel, RobotModel
from jumpcad.search.robust_pick import ActiveBound, Candidate, named_bounds
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Objective, described_objective
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Count, Position, Share, Trial, best_trial, is_flat, searched, trial_numbers

PICKS, RIGHTING = "picks", "righting"
"""Keys under which a study remembers its robust picks, one for each length of the search and of the pick, and how its
winner rights itself."""
TRIES = 50
"""Drops in any attitude, and landings of own jumps; they take half a minute."""


@dataclass(frozen=True)
class _Pick:
    """Of a search of so many designs, with so many evaluations, and what it found once it has ended."""

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    designs: Count
    evaluations: Count
    candidates: list[Candidate] | None = None
    bounds: list[ActiveBound] | None = None


class _Shares(TomlTable):
    tries: float
    drops: Share
    landings: Share


class _Righting(TomlTable):
    trial: Position
    shares: _Shares


_PICKS, _RIGHTING = TypeAdapter(list[_Pick]), TypeAdapter(_Righting)


def pick_run(store: StudyStore, designs: int, evaluations: int) -> int:
    """Return the number of the pick, with so many evaluations, of a search of so many designs; a new one if need be."""
    picks = store.recall(PICKS, [], _PICKS)
    for run, one in enumerate(picks):
        if (one.designs, one.evaluations) == (designs, evaluations):
            return run
    store.remember(PICKS, [*picks, _Pick(designs, evaluations)], _PICKS)
    return len(picks)


def keep_pick(store: StudyStore, run: int, candidates: list[Candidate], bounds: list[ActiveBound]) -> None:
    picks = store.recall(PICKS, [], _PICKS)
    picks[run] = replace(picks[run], candidates=candidates, bounds=bounds)
    store.remember(PICKS, picks, _PICKS)


def simulated_righting(model: RobotModel, store: StudyStore, winner: Trial | None) -> dict[str, float]:
    """Return the shares of drops and of own landings after which the winner stands, and keep them in the study.

    Empty where nobody asked, or there is no winner or no MuJoCo.
    """
    if winner is None or not isinstance(model, PrintedModel) or not model.requires(RIGHTS_ITSELF):
        return {}
    if kept := kept_righting(store, winner):
        return kept
    try:
        varied = model.varied(winner.workshop) if winner.workshop else model
        found = land(build(winner.design, varied.workshop, name=""), TRIES, settings=model.settings)
    except JumpcadError as error:
        store.note(f"{RIGHTS_ITSELF}: not simulated: {error}", once=True)
        return {}
    shares = {"tries": float(TRIES), "drops": found.drops_righted, "landings": found.share_righted}
    store.remember(RIGHTING, _Righting(trial=winner.position, shares=_Shares(**shares)), _RIGHTING)
    return shares


def kept_righting(store: StudyStore, winner: Trial | None) -> dict[str, float]:
    """Return what a study keeps of the righting of this winner; empty where it was not simulated."""
    kept = store.recall(RIGHTING, None, _RIGHTING)
    return kept.shares.model_dump() if kept and winner and kept.trial == winner.position else {}


@dataclass(frozen=True)
class StudySummary:
    """What a study knows: the trials that the search proposed, in order, and the winner.

    That is the most robust of the best designs, or the best where neighbours were not examined; None if none jumps, or
    one is sought and all score alike. `candidates` are the best designs, most robust first, none where the pick has not
    ended; `bounds` those on which the winner lies; `numbers` those of all trials, by position.
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
        return best_trial(self.trials) is not None


def summary(store: StudyStore) -> StudySummary:
    """Return what a study knows, also while it runs."""
    held, identity = store.trials(), store.identity
    space = Space.from_record(identity["space"])
    trials = searched(held)
    ended = [pick for pick in store.recall(PICKS, [], _PICKS) if pick.designs == len(trials) and pick.candidates]
    candidates, bounds = (ended[-1].candidates, ended[-1].bounds or []) if ended else ([], [])
    seeks_one = identity["method"] in NAMES and identity["method"] not in FRONTS
    best = None if seeks_one and is_flat(trials) else best_trial(trials)
    winner = candidates[0].trial if candidates else best
    if winner is not None and not bounds:  # of a front, and where no pick has ended
        bounds = named_bounds(space, winner)
    return StudySummary(space, described_objective(identity), trials, winner, candidates, bounds, trial_numbers(held))
