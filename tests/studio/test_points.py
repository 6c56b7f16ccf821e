"""The points of a study: numbered as the study's table is, chosen by number, refused in one line."""

from dataclasses import replace
from pathlib import Path

import pytest
from support import needs
from support.searches import refusal
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.study.store import StudyStore
from jumpcad.studio.points import Points
from jumpcad.workshop import load_workshop

needs.package("viser")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["{study}", "--trial", "5"], "has no trial 5: its trials are 1 to 4"),
        (["{study}", "--trial", "2"], "trial 2 cannot be built: no cam winds"),
        (["kenan-2.0", "--trial", "1"], "--trial 1: kenan-2.0 is no study"),
    ],
    ids=["none", "refused", "no study"],
)
def test_a_wrong_trial_is_one_line(study: Path, arguments: list[str], words: str) -> None:
    assert words in refusal("studio", *(one.format(study=study) for one in arguments))


def test_a_study_without_a_trial_has_no_points(tmp_path: Path) -> None:
    with StudyStore.write(tmp_path / "empty.db", IDENTITY):
        pass
    with pytest.raises(JumpcadError, match="no trial yet"):
        Points(tmp_path / "empty.db")


def test_of_a_study_in_which_nothing_jumps_any_trial_is_opened_by_its_number(tmp_path: Path) -> None:
    made = [replace(one, score=None) for one in trials(3)]
    with StudyStore.write(tmp_path / "none.db", IDENTITY) as store:
        store.append(made)
    points = Points(tmp_path / "none.db")
    assert points.listed == {}
    with pytest.raises(JumpcadError, match="no design of this study jumps; --trial N opens one that does not"):
        _ = points.best
    assert points.trial(3).design == made[2].design


def test_a_workshop_that_is_none_any_more_is_told_with_its_study(tmp_path: Path) -> None:
    """As one of another version."""
    held = load_workshop().model_dump(mode="json") | {"lasers": {"watts": 5}}
    with StudyStore.write(tmp_path / "old.db", IDENTITY | {"model": {"name": "printed", "workshop": held}}) as store:
        store.append(trials(1))
    with pytest.raises(JumpcadError, match=r"old\.db: its workshop cannot be used: .*lasers"):
        _ = Points(tmp_path / "old.db").workshop
