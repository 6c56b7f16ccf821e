"""Outcomes in a study file are read as they were written, those of older versions too."""

import json
import math
import re
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding, at_most
from jumpcad.search import rows as rows_module
from jumpcad.search.objective import Evaluation
from jumpcad.search.store import StudyStore
from jumpcad.search.stored_evaluation import StoredEvaluation, stored_evaluation
from jumpcad.search.trial import Trial

OLD = {"name": "loop", "severity": "info", "margin": 1.5, "unit": "mm", "message": "found", "remedy": "change"}


def record(*findings: dict[str, object]) -> dict[str, bytes]:
    return {"verdict": b"jump", "metrics": b"{}", "findings": json.dumps(findings).encode(), "detail": b""}


def test_findings_come_back_with_value_and_limit_or_without() -> None:
    new = at_most("leg_strength", 10.0, 40.0, "MPa", "found", "change", grows="leg")
    old, again = stored_evaluation(record(OLD, new.to_dict()), {}).findings
    assert old == Finding("loop", "info", 1.5, "mm", "found", "change")
    assert again == new


def test_a_number_in_quotes_is_text() -> None:
    with pytest.raises(JumpcadError, match=r"findings\.0\.margin: Input should be a valid number"):
        stored_evaluation(record({**OLD, "margin": "1.5"}), {})


@pytest.mark.parametrize("figure", ["margin", "value", "limit"])
def test_what_is_not_a_number_is_refused(figure: str) -> None:
    with pytest.raises(JumpcadError, match=f"the {figure} of loop is not a number"):
        stored_evaluation(record({**OLD, figure: math.nan}), {})


def test_a_study_keeps_names_and_margins_without_their_texts(tmp_path: Path) -> None:
    """Margins of six digits, 10 bytes each; names stand once in the file. An infinite margin is one too."""
    names = [f"a_check_of_it_{number}" for number in range(40)]
    findings = tuple(at_most(name, 10.0, 40.0 / 3.0, "MPa", "found " * 20, "change " * 9) for name in names)
    diverged = Finding("audit_energy", "error", -math.inf, "J", "found", "change")
    whole = Evaluation("jump", {}, (*findings, diverged))
    (trial,) = trials(1)
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([replace(trial, evaluation=whole.bare)])
        (again,) = store.trials()
        size = store._connection.execute("SELECT length(findings) FROM evaluations").fetchone()[0]
    assert size < 10 * len(whole.findings) < len(str(whole.findings)) / 16
    assert again.evaluation == whole.bare
    assert [(one.name, one.margin, one.unit) for one in again.evaluation.findings] == [
        (one.name, pytest.approx(one.margin, rel=1e-5), one.unit) for one in whole.findings
    ]
    assert again.evaluation.reasons == whole.reasons == ("audit_energy",)


@pytest.mark.parametrize(
    ("version", "findings"),
    [(1, [OLD]), (2, [["loop", "info", 1.5, "mm"]]), (3, [["loop", "info", 1.5, "mm"]])],
)
def test_a_study_of_a_format_before_is_read(tmp_path: Path, version: int, findings: list[object]) -> None:
    with StudyStore.write(tmp_path / "new.db", IDENTITY) as store:
        store.append(trials(3))
    with closing(sqlite3.connect(tmp_path / "old.db")) as old:
        old.executescript(rows_module._WITHOUT_NAMES if version == 3 else rows_module._WITHOUT_WORKSHOP)
        old.execute("ATTACH ? AS new", (str(tmp_path / "new.db"),))
        columns = ", ".join(name for name in rows_module.COLUMNS if name != "workshop" or version == 3)
        old.execute(f"INSERT INTO evaluations ({columns}) SELECT {columns} FROM new.evaluations")
        old.execute("UPDATE evaluations SET metrics = ?, findings = ?", ('{"fitness":2.5}', json.dumps(findings)))
        old.execute("INSERT INTO study SELECT * FROM new.study")
        old.execute(f"PRAGMA user_version = {version}")
        old.commit()
    with StudyStore.read(tmp_path / "old.db") as store:
        again = store.trials()
    texts = ("found", "change") if version == 1 else ("", "")
    loop = Finding("loop", "info", 1.5, "mm", *texts)
    assert [(one.design, one.score, one.evaluation) for one in again] == [
        (one.design, one.score, replace(one.evaluation, metrics={"fitness": 2.5}, findings=(loop,)))
        for one in trials(3)
    ]


def bare_study(path: Path) -> list[Trial]:
    """Write three trials with bare findings, as a search does, and return them."""
    written = [replace(trial, evaluation=trial.evaluation.bare) for trial in trials(3)]
    with StudyStore.write(path, IDENTITY) as store:
        store.append(written)
    return written


def test_rows_share_their_names(tmp_path: Path) -> None:
    """Two lists, of figures and of limits, for all rows."""
    written = bare_study(tmp_path / "s.db")
    with StudyStore.read(tmp_path / "s.db") as store:
        assert store.trials() == written
        assert store._connection.execute("SELECT count(*) FROM names").fetchone() == (2,)


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("DELETE FROM names", "metrics: number 1 of the names is not that of"),
        ("UPDATE names SET names = '[]' WHERE number = 2", "findings: number 2 of the names is not that of"),
        ("UPDATE names SET names = '5' WHERE number = 2", "names.list[str]: Input should be a valid array"),
        ('UPDATE names SET names = \'[["=1+1", "mm"]]\' WHERE number = 2', "'=1+1' is not the name of a verdict"),
        ("UPDATE evaluations SET findings = '[1,\"i\",[1.0]]'", "findings: number 1 of the names is not that of"),
        ("UPDATE evaluations SET findings = '[1,\"ii\",[1.0,1.0]]'", "number 1 of the names is not that of 2 findings"),
        ("UPDATE evaluations SET metrics = '[2,[1.0]]'", "metrics: number 2 of the names is not that of 1 metrics"),
        ("UPDATE evaluations SET findings = '[2,\"x\",[1.0]]'", "findings: 'x' are not the severities of 1 findings"),
        ("UPDATE evaluations SET findings = '[2,\"ii\",[1.0]]'", "findings: 'ii' are not the severities"),
        ("UPDATE evaluations SET findings = '[2,\"i\",[NaN]]'", "the margin of loop is not a number"),
        ("UPDATE evaluations SET metrics = '[9,[1.0]]'", "metrics: number 9 of the names is not that of 1 metrics"),
        ("UPDATE evaluations SET metrics = '[1,[\"1.0\"]]'", "metrics.1.0: Input should be a valid number"),
        ("UPDATE evaluations SET metrics = '[1.0,[1.0]]'", "metrics.0: Input should be a valid integer"),
        ('UPDATE evaluations SET findings = \'[2,"i",["1.0"]]\'', "findings.2.0: Input should be a valid number"),
        ("UPDATE evaluations SET findings = '[2,5,[1.0]]'", "findings.1: Input should be a valid string"),
        ("UPDATE names SET names = '[5]' WHERE number = 1", "names.list[str].0: Input should be a valid string"),
    ],
)
def test_damaged_names_are_said(tmp_path: Path, statement: str, message: str) -> None:
    bare_study(tmp_path / "s.db")
    with closing(sqlite3.connect(tmp_path / "s.db", isolation_level=None)) as file:
        file.execute(statement)
    with StudyStore.read(tmp_path / "s.db") as store, pytest.raises(JumpcadError, match=re.escape(message)):
        store.trials()


@pytest.mark.parametrize(
    ("figure", "told"),
    [
        ("1e12", ""),
        ("-1e12", ""),
        ("1.1e12", "mass_kg = 1.1e+12 is not"),
        ("NaN", "mass_kg = nan"),
        ("Infinity", "inf"),
        ('"2.0"', "metrics.mass_kg: Input should be a valid number"),
    ],
)
def test_figures_are_numbers_below_a_million_million(figure: str, told: str) -> None:
    row = record() | {"metrics": f'{{"mass_kg": {figure}}}'.encode()}
    if told:
        with pytest.raises(JumpcadError, match=re.escape(told)):
            stored_evaluation(row, {})
    else:
        assert stored_evaluation(row, {}).metrics == {"mass_kg": float(figure)}


@pytest.mark.parametrize("place", ["verdict", "figure", "finding"])
def test_names_are_words(place: str) -> None:
    """A table of a study may be opened by a program that takes =1+1 for a formula."""
    row = record(OLD | ({"name": "=1+1"} if place == "finding" else {}))
    row |= {"verdict": b"=1+1"} if place == "verdict" else {}
    row |= {"metrics": b'{"=1+1": 2.0}'} if place == "figure" else {}
    with pytest.raises(JumpcadError, match=re.escape("'=1+1' is not the name of a verdict, a finding or a figure")):
        stored_evaluation(row, {})


def test_a_stored_evaluation_is_what_was_written_also_where_it_is_kept_packed() -> None:
    """Severity, margin and unit of each finding, also where names repeat; what follows from them; its plain form."""
    findings = tuple(
        Finding(name, severity, margin, unit, "", "")
        for name, severity, margin, unit in (
            ("axle", "info", 2.5, "mm"), ("axle", "error", -1.25, "mm"), ("room", "warning", -0.5, "°"),
        )
    )  # fmt: skip
    whole = Evaluation("jump", {"b": 2.0, "evaluations": 11.0, "a": 1.5}, findings, "why")
    again = StoredEvaluation(whole)
    assert (again, again.findings, dict(again.metrics)) == (whole, findings, dict(whole.metrics))
    assert list(again.metrics) == ["b", "evaluations", "a"]
    assert (again.verdict, again.detail) == ("jump", "why")
    assert (again.feasible, again.reasons, again.margins, again.missed) == (
        False, ("axle",), {"axle": -1.25, "room": -0.5}, {"axle"},
    )  # fmt: skip
    assert StoredEvaluation(Evaluation("jump")).feasible
    assert type(again.bare) is Evaluation
    assert again.bare == whole.bare
    for other in (
        replace(whole, detail=""), replace(whole, verdict="tips"), replace(whole, metrics={"b": 2.0}),
        replace(whole, findings=findings[:2]),
    ):  # fmt: skip
        assert again != other
