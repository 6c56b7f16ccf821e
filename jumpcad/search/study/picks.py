"""The robust picks of a study: one run for each length of the search and of the pick, and what it found."""

from collections.abc import Sequence
from dataclasses import asdict

from jumpcad.errors import JumpcadError
from jumpcad.search.pick.robust import ActiveBound, Candidate
from jumpcad.search.study.store import PICKS, StudyStore
from jumpcad.search.study.trial import Trial


def pick_run(store: StudyStore, designs: int, evaluations: int) -> int:
    """Return the number of the pick, with so many evaluations, of a search of so many designs; a new one if need be."""
    asked, picks = {"designs": designs, "evaluations": evaluations}, store.recall(PICKS, [])
    runs = [run for run, pick in enumerate(picks) if asked.items() <= pick.items()]
    if not runs:
        store.remember(PICKS, [*picks, asked])
    return runs[0] if runs else len(picks)


def keep_pick(store: StudyStore, run: int, candidates: Sequence[Candidate], bounds: Sequence[ActiveBound]) -> None:
    """Keep what a pick found."""
    picks = store.recall(PICKS)
    found = [vars(one) | {"trial": one.trial.position} for one in candidates]
    picks[run] |= {"candidates": found, "bounds": [asdict(bound) for bound in bounds]}
    store.remember(PICKS, picks)


def read_pick(store: StudyStore, trials: Sequence[Trial], designs: int) -> tuple[list[Candidate], list[ActiveBound]]:
    """Return what the last pick of a search of so many designs found; nothing where none has ended.

    Raises
    ------
    JumpcadError
        If a candidate is none of the study's trials.
    """
    ended = [pick for pick in store.recall(PICKS, []) if pick["designs"] == designs and pick.get("candidates")]
    if not ended:
        return [], []
    held = {trial.position: trial for trial in trials}
    try:
        found = [Candidate(**one | {"trial": held[tuple(one["trial"])]}) for one in ended[-1]["candidates"]]
    except KeyError:
        raise JumpcadError(f"{store.path}: is damaged: a candidate of its pick is none of its trials") from None
    return found, [ActiveBound(**bound) for bound in ended[-1]["bounds"]]
