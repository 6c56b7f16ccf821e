"""`jumpcad study`, with the capsule robot."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from support.searches import QUICK, data, refusal, run
from support.studies import IDENTITY, trials

from jumpcad.cli import study
from jumpcad.design import load_design
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.store import StudyStore


def test_studies_compare_and_export(folder, monkeypatch):
    for seed in (0, 1):
        run("optimize", "ga", *QUICK, "--evaluations", 20, "--seed", seed, "--study", f"{seed}.db")
    assert len(run("study", "0.db", "1.db").strip().splitlines()) == 2
    assert [one["identity"]["seed"] for one in data("study", "0.db", "1.db")["studies"]] == [0, 1]
    run("study", "0.db", "--export", "t.csv")
    rows = (folder / "t.csv").read_text().count("\n") - 1
    assert rows >= 20
    summary = data("study", "0.db")
    assert summary["evaluations"] + summary["other_evaluations"] == rows
    ranks = re.findall(r"^ *(\d+)\. ", run("study", "0.db", "--list", 3), re.M)
    assert ranks == ["1", "2", "3"]
    for option, place in (("--export", "u.csv"), ("--plots", "u")):
        assert "--export and --plots are for one study" in refusal("study", "0.db", "1.db", option, place)
    drawn = []
    monkeypatch.setattr(
        "jumpcad.search.report.study_plots.plot_study", lambda store, pics: drawn.append(pics) or [pics / "a"]
    )
    assert data("study", "0.db", "--plots", "pics") == summary | {"pictures": ["pics/a"]}
    assert "pictures" not in summary
    assert drawn == [Path("pics")]


def test_a_summary_counts_what_was_searched_apart_from_what_lies_around_the_best():
    """The best is the best that was searched; its neighbours may score more. Trials are numbered as they stand."""
    lost = Evaluation("quarantined", detail="its worker was lost")
    *searched, last = trials(17)
    searched.append(replace(last, evaluation=lost, score=None))
    around = [replace(trial, score=99.0) for trial in trials(3, "robust", 1)]
    rejected = next(trial.evaluation for trial in searched if trial.evaluation.reasons)
    around[-1] = replace(around[-1], evaluation=rejected, score=None)
    with StudyStore.write(None, IDENTITY) as store:
        store.append([*searched, *around])
        store.remember("stages", [{"method": "ga", "evaluations": 14}, {"method": "bo", "evaluations": 7}])
        summary = study._summary(Path("s.db"), store, 2)
    scores = sorted((trial.score for trial in searched if trial.score is not None), reverse=True)
    assert 2 < len(scores) < 16
    assert (summary["evaluations"], summary["other_evaluations"], summary["planned"]) == (17, 3, 21)
    assert summary["refused"] == {"loop": 16 - len(scores), "quarantined": 1}
    assert summary["evaluation_time_s"] == pytest.approx(20 * 0.1)
    assert summary["best"]["score"] == scores[0]
    assert [one["score"] for one in summary["top"]] == scores[:2]
    for one in summary["top"]:
        assert searched[one["trial"] - 1].score == one["score"]
    assert [one["design"] for one in summary["quarantined"]] == [last.design.model_dump()]


def summary(**changes: object) -> dict[str, object]:
    """Return a made-up summary with a number of its own in every place."""
    design = load_design("best-ga")
    top = [
        {"trial": 7, "score": 2.5, "phase": "bo", "design": design.model_dump(),
         "workshop": {"body.plate_mm": 2.0, "bought.spring": "x"}},
        {"trial": 3, "score": 1.25, "phase": "ga", "design": design.model_dump()},
    ]  # fmt: skip
    identity = {"method": "ga+bo", "model": {"name": "capsule"}, "objective": "range", "seed": 5}
    plain = {
        "study": "s.db", "identity": identity, "planned": 40, "evaluations": 31, "other_evaluations": 12,
        "ended": None, "refused": {"tips": 6, "loop": 2}, "evaluation_time_s": 9.0, "best": top[0],
        "top": top, "notes": ["a note"],
    }  # fmt: skip
    return plain | changes
