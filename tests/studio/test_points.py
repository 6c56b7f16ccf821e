"""The points of a study: numbered as the study's table is, chosen by number, refused in one line."""

from dataclasses import replace
from pathlib import Path

import pytest
from support import needs
from support.searches import refusal
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.table import write_table
from jumpcad.studio.points import Points
from jumpcad.workshop import load_workshop, varied

needs.package("viser")


def test_a_trials_number_is_its_line_in_the_exported_table(study: Path, tmp_path: Path) -> None:
    points = Points(study)
    write_table(points.trials, tmp_path / "all.csv")
    heading, *lines = (tmp_path / "all.csv").read_text().splitlines()
    column = heading.split(",").index("carrying_link_mm")
    for number, line in enumerate(lines, start=1):
        assert float(line.split(",")[column]) == points.trial(number).design.carrying_link_mm


def test_best_and_front_are_listed(study: Path) -> None:
    """Trial 1 has the best score; 4 has weaker springs, 1 and 3 the same: 3 is beaten with the same energy."""
    listed = Points(study).listed
    best, front = [[number for text, number in listed.items() if text.startswith(word)] for word in ("best", "front")]
    assert best == [1, 3, 4]
    assert front == [4, 1]
    assert Points(study).best == 1
    for text, number in listed.items():
        design = Points(study).trial(number).design
        assert text.startswith((f"front, {design.spring_energy_j:.4g} J: ", "best "))


def test_ten_of_many_are_listed_as_best(tmp_path: Path) -> None:
    """The best first, whatever their order in the study; what neighbours of a pick score is not among them."""
    made = [replace(one, score=1.0 + (7 * place) % 12) for place, one in enumerate(trials(12))]
    around = [replace(one, score=50.0) for one in trials(1, "robust", 1)]
    with StudyStore.write(tmp_path / "many.db", IDENTITY) as store:
        store.append([*made, *around])
    points = Points(tmp_path / "many.db")
    best = {text: number for text, number in points.listed.items() if text.startswith("best")}
    assert [points.trial(number).score for number in best.values()] == [float(12 - place) for place in range(10)]
    assert [text.partition(":")[0] for text in best] == [f"best {place}" for place in range(1, 11)]
    assert points.best == 1 + [one.score for one in made].index(12.0)
    front = [points.trial(number) for text, number in points.listed.items() if text.startswith("front")]
    assert front
    assert {one.phase for one in front} == {made[0].phase}


def test_a_front_that_seeks_more_of_both_is_listed_by_the_figures_themselves(tmp_path: Path) -> None:
    """Three trials that rise less the better their score is."""
    file = tmp_path / "rise.db"
    made = [
        replace(one, evaluation=Evaluation("jump", {"fitness": score, "com_rise_m": 0.5 / score}), score=score)
        for one, score in zip(trials(3), (1.0, 2.0, 4.0), strict=True)
    ]
    with StudyStore.write(file, IDENTITY | {"method": "nsga2", "against": "rise"}) as store:
        store.append(made)
    front = [text.partition(":")[0] for text in Points(file).listed if text.startswith("front")]
    assert front == ["front, 0.5 m", "front, 0.25 m", "front, 0.125 m"]


def test_the_workshop_is_that_of_the_study_with_the_trials_values(tmp_path: Path) -> None:
    fine, file = load_workshop("fine"), tmp_path / "w.db"
    identity = IDENTITY | {"model": {"name": "printed", "workshop": fine.model_dump(mode="json")}}
    with StudyStore.write(file, identity) as store:
        store.append(trials(1))
    points = Points(file)
    assert points.workshop == fine
    one = points.trial(1)
    assert points.workshop_of(one) == fine
    object.__setattr__(one, "workshop", {"body.plate_mm": 4.0})
    assert points.workshop_of(one).body.plate_mm == 4.0
    assert points.workshop_of(one).printer == fine.printer


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


def test_a_point_is_told_with_its_place_and_score_or_why_it_has_none(study: Path) -> None:
    points = Points(study)
    assert points.to_text(3) == "trial 3 of 4 (ga 0.2): 1.5 body lengths"
    assert points.to_text(2) == "trial 2 of 4 (ga 0.1): rejected: cannot_build"
    assert list(points.listed.items())[:2] == [
        ("best 1: 2 body lengths (trial 1)", 1), ("best 2: 1.5 body lengths (trial 3)", 3)
    ]  # fmt: skip
    assert points.listed_as(4, "") == "best 3: 1 body lengths (trial 4)"
    assert points.listed_as(2, "by its number") == "by its number"
    for number in (0, 5):
        with pytest.raises(JumpcadError, match=f"has no trial {number}: its trials are 1 to 4"):
            points.trial(number)


def test_a_trials_robot_is_built_in_its_workshop_with_the_name_of_its_study(
    study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name that cannot be engraved is refused before the studio opens."""
    points, asked = Points(study), []
    monkeypatch.setattr("jumpcad.studio.points.build", lambda *given: asked.append(given))
    thick = varied(load_workshop(), {"body.plate_mm": 4.0})
    for workshop, values in ((load_workshop(), {}), (thick, {"body.plate_mm": 4.0})):
        monkeypatch.setattr(points, "trials", [replace(trial, workshop=values) for trial in points.trials])
        points.require_built(4)
        assert asked.pop() == (points.trial(4).design, workshop, study.stem)


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
