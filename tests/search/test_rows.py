"""A trial as a row of a study file and back; which rows need what."""

import json
import sqlite3
from dataclasses import replace
from typing import Any

import pytest
from support.studies import trials

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding, is_bare
from jumpcad.search.methods import METHODS, STEPS
from jumpcad.search.rows import APPLICATION_ID, COLUMNS, FORMAT, FORMATS, SCHEMA, TEXTS, own_tables, read_trial, to_row
from jumpcad.search.stored_evaluation import stored_names
from jumpcad.search.trial import Trial

MADE = {"made.spring_factor": 0.9, "made.friction_factor": 1.1}


def again(trial: Trial, keys: tuple[str, ...] = (), **changes: Any) -> Trial:
    """Return a trial from the row that it is written as, texts as SQLite gives them; `changes` are other columns."""
    lists: list[str] = []

    def number_of(names: str) -> int:
        if names not in lists:
            lists.append(names)
        return lists.index(names) + 1

    record = dict(zip(COLUMNS, to_row(trial, number_of), strict=True)) | changes
    record |= {name: record[name].encode() for name in TEXTS}
    names = {number: stored_names(text.encode()) for number, text in enumerate(lists, start=1)}
    return read_trial(record, len(PARAMETERS), keys, names)


@pytest.fixture
def trial() -> Trial:
    return next(trial for trial in trials(8, "bo", 1) if trial.score is not None)


@pytest.mark.parametrize("bare", [True, False])
def test_a_trial_reads_back_as_it_was_written(trial: Trial, bare: bool) -> None:
    """Findings with their texts, or as numbers and letters; a rejected one has no score."""
    rejected = next(one for one in trials(64, "ga", 3) if one.score is None)
    for one in (trial, rejected):
        written = replace(one, evaluation=one.evaluation.bare if bare else one.evaluation, duration_s=0.25)
        assert all(map(is_bare, written.evaluation.findings)) == bare
        assert again(written) == written


def test_severities_and_margins_keep_their_order(trial: Trial) -> None:
    findings = tuple(
        Finding(f"check_{number}", severity, margin, "mm", "", "")
        for number, (severity, margin) in enumerate((("error", -1.5), ("info", 2.0), ("warning", 0.25), ("info", 0.5)))
    )
    evaluation = replace(trial.evaluation, findings=findings, metrics={"b": 2.0, "a": 1.0})
    found = again(replace(trial, evaluation=evaluation)).evaluation
    assert found.findings == findings
    assert list(found.metrics.items()) == [("b", 2.0), ("a", 1.0)]


@pytest.mark.parametrize("phase", ["bo", "ga", "margin", "bounds", "robust", "sample"])
@pytest.mark.parametrize("step", [0, 1, STEPS, STEPS + 1])
def test_a_step_that_starts_from_the_one_before_has_its_hyperparameters(trial: Trial, phase: str, step: int) -> None:
    """Of a method that learns; its first designs, also those of its next run, are drawn and have none."""
    without = replace(trial, phase=phase, step=step, proposal={})
    learns = phase in METHODS and METHODS[phase].learns
    if learns and step in (1, STEPS + 1):
        with pytest.raises(JumpcadError, match=rf"row '{phase}' {step} {trial.place}: proposal.theta: missing"):
            again(without)
    else:
        assert again(without) == without
    assert again(replace(without, proposal=trial.proposal)).proposal == trial.proposal


def test_only_neighbours_of_the_pick_are_made_otherwise_than_designed(trial: Trial) -> None:
    robust = replace(trial, phase="robust", workshop=MADE)
    assert again(robust) == robust
    with pytest.raises(JumpcadError, match=r"row 'ga'.*made\.spring_factor"):
        again(replace(robust, phase="ga"))
    for wrong, said in (({"made.spring_factor": 0.9}, "missing"), (MADE | {"made.spring_factor": 1e3}, "0.01 to 100")):
        with pytest.raises(JumpcadError, match=rf"row 'robust'.*made\..*{said}"):
            again(replace(robust, workshop=wrong))
    varied = replace(trial, workshop={"body.plate_mm": 2.0})
    assert again(varied, ("body.plate_mm",)) == varied
    for keys in ((), ("body.stop_deg",)):
        with pytest.raises(JumpcadError, match="workshop"):
            again(varied, keys)


def test_a_row_of_no_phase_is_named(trial: Trial) -> None:
    with pytest.raises(JumpcadError, match=r"row 'moon' 1 .*: phase = 'moon' is none of sample, sweep, "):
        again(trial, phase="moon")


def test_each_format_has_its_tables() -> None:
    """SQLite's reading of the schema: from the third a workshop's values, from the fourth lists of names."""
    connection = sqlite3.connect(":memory:")
    connection.executescript(SCHEMA)
    assert connection.execute("PRAGMA user_version").fetchone() == (FORMAT,)
    assert connection.execute("PRAGMA application_id").fetchone() == (int.from_bytes(b"JUMP"),)
    assert int.from_bytes(b"JUMP") == APPLICATION_ID
    columns = [row[1] for row in connection.execute("PRAGMA table_info(evaluations)")]
    assert columns == list(COLUMNS)
    assert tuple(range(1, FORMAT + 1)) == FORMATS
    held = {version: {name: text for _, name, text in own_tables(version)} for version in FORMATS}
    assert ["names" in held[version] for version in FORMATS] == [False, False, False, True]
    assert ["workshop" in held[version]["evaluations"] for version in FORMATS] == [False, False, True, True]
    assert held[1] == held[2]


def test_texts_of_a_row_are_plain_json(trial: Trial) -> None:
    row = dict(zip(COLUMNS, to_row(trial, lambda _: 7), strict=True))
    assert json.loads(row["metrics"]) == [7, list(trial.evaluation.metrics.values())]
    assert json.loads(row["proposal"]) == trial.proposal
    assert (row["phase"], row["step"], row["place"]) == ("bo", 1, trial.place)
    assert [row[name] for name in PARAMETERS] == trial.design.to_vector()


def test_each_column_comes_back_in_its_own_place(trial: Trial) -> None:
    """Numbers and texts of their own everywhere."""
    told = replace(
        trial, phase="bo", step=12, place=34, score=5.5, model="digest", duration_s=6.25,
        evaluation=replace(trial.evaluation, detail="why", metrics={"fitness": 7.5, "mass_kg": 8.0}),
        proposal={"log_improvement": -1.5, "theta": {"score": [0.5, 0.25, 0.125]}, "tried": [[0.1, 0.2]]},
        workshop={"body.plate_mm": 2.0, "bought.spring": "x"},
    )  # fmt: skip
    keys = ("body.plate_mm", "bought.spring")
    found = again(told, keys)
    assert found == told
    assert (found.evaluation.detail, found.model, found.duration_s, found.score) == ("why", "digest", 6.25, 5.5)
    assert (dict(found.proposal), dict(found.workshop)) == (told.proposal, told.workshop)
