"""The robust picks of a study: one run for each length of the search and of the pick, and what it found."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from pydantic import TypeAdapter

from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.search.pick.robust import ActiveBound, Candidate
from jumpcad.search.study.objective import Figure, Word
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Count, Phase, Trial

KEY = "picks"
"""Key under which a study remembers its picks."""


class _Candidate(TomlTable):
    trial: tuple[Phase, Count, Count, Count]
    parameters_score: Figure
    print_score: Figure
    rejections: dict[Word, Count]
    neighbours: Count
    fails: bool = False


class _Pick(TomlTable):
    designs: Count
    evaluations: Count
    candidates: list[_Candidate] | None = None
    bounds: list[ActiveBound] | None = None


_KIND = TypeAdapter(list[_Pick])


def _recall(store: StudyStore) -> list[dict[str, Any]]:
    picks: list[dict[str, Any]] = store.recall(KEY, [], _KIND)
    return picks


def pick_run(store: StudyStore, designs: int, evaluations: int) -> int:
    """Return the number of the pick, with so many evaluations, of a search of so many designs; a new one if need be."""
    asked, picks = {"designs": designs, "evaluations": evaluations}, _recall(store)
    runs = [run for run, pick in enumerate(picks) if asked.items() <= pick.items()]
    if not runs:
        store.remember(KEY, [*picks, asked])
    return runs[0] if runs else len(picks)


def keep_pick(store: StudyStore, run: int, candidates: Sequence[Candidate], bounds: Sequence[ActiveBound]) -> None:
    """Keep what a pick found."""
    picks = _recall(store)
    found = [vars(one) | {"trial": one.trial.position} for one in candidates]
    picks[run] |= {"candidates": found, "bounds": [asdict(bound) for bound in bounds]}
    store.remember(KEY, picks)


def read_pick(store: StudyStore, trials: Sequence[Trial], designs: int) -> tuple[list[Candidate], list[ActiveBound]]:
    """Return what the last pick of a search of so many designs found; nothing where none has ended.

    Raises
    ------
    JumpcadError
        If a candidate is none of the study's trials.
    """
    ended = [pick for pick in _recall(store) if pick["designs"] == designs and pick.get("candidates")]
    if not ended:
        return [], []
    held = {trial.position: trial for trial in trials}
    try:
        found = [Candidate(**one | {"trial": held[tuple(one["trial"])]}) for one in ended[-1]["candidates"]]
    except KeyError:
        raise JumpcadError(f"{store.path}: is damaged: a candidate of its pick is none of its trials") from None
    return found, [ActiveBound(**bound) for bound in ended[-1]["bounds"]]
