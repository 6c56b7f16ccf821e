"""Rows of a study file are read as they were written, those of older versions too."""

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
from jumpcad.search.stored import stored_evaluation

OLD = {"name": "loop", "severity": "info", "margin": 1.5, "unit": "mm", "message": "found", "remedy": "change"}


def record(*findings: dict[str, object]) -> dict[str, bytes]:
    return {"verdict": b"jump", "metrics": b"{}", "findings": json.dumps(findings).encode(), "detail": b""}


def test_findings_come_back_with_value_and_limit_or_without() -> None:
    new = at_most("leg_strength", 10.0, 40.0, "MPa", "found", "change", grows="leg")
    old, again = stored_evaluation(record(OLD, new.to_dict())).findings
    assert old == Finding("loop", "info", 1.5, "mm", "found", "change")
    assert again == new


@pytest.mark.parametrize("figure", ["margin", "value", "limit"])
def test_what_is_not_a_number_is_refused(figure: str) -> None:
    with pytest.raises(JumpcadError, match=f"the {figure} of loop is not a number"):
        stored_evaluation(record({**OLD, figure: math.nan}))


def test_a_study_keeps_names_and_margins_without_their_texts(tmp_path: Path) -> None:
    """About 40 bytes each, margins of six digits; an infinite margin is one too."""
    names = [f"a_check_of_it_{number}" for number in range(40)]
    findings = tuple(at_most(name, 10.0, 40.0 / 3.0, "MPa", "found " * 20, "change " * 9) for name in names)
    diverged = Finding("audit_energy", "error", -math.inf, "J", "found", "change")
    whole = Evaluation("jump", {}, (*findings, diverged))
    (trial,) = trials(1)
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([replace(trial, evaluation=whole.bare)])
        (again,) = store.trials()
        size = store._connection.execute("SELECT length(findings) FROM evaluations").fetchone()[0]
    assert size < 45 * len(whole.findings) < len(str(whole.findings)) / 4
    assert again.evaluation == whole.bare
    assert [(one.name, one.margin, one.unit) for one in again.evaluation.findings] == [
        (one.name, pytest.approx(one.margin, rel=1e-5), one.unit) for one in whole.findings
    ]
    assert again.evaluation.reasons == whole.reasons == ("audit_energy",)


@pytest.mark.parametrize("version", [1, 2])
def test_a_study_of_a_format_before_is_read(tmp_path: Path, version: int) -> None:
    with StudyStore.write(tmp_path / "new.db", IDENTITY) as store:
        store.append(trials(3))
    with closing(sqlite3.connect(tmp_path / "old.db")) as old:
        old.executescript(rows_module._WITHOUT_WORKSHOP)
        old.execute("ATTACH ? AS new", (str(tmp_path / "new.db"),))
        columns = ", ".join(name for name in rows_module.COLUMNS if name != "workshop")
        old.execute(f"INSERT INTO evaluations ({columns}) SELECT {columns} FROM new.evaluations")
        old.execute("INSERT INTO study SELECT * FROM new.study")
        old.execute(f"PRAGMA user_version = {version}")
        old.commit()
    with StudyStore.read(tmp_path / "old.db") as store:
        assert store.trials() == trials(3)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        ({"made.spring_factor": 1e300, "made.friction_factor": 1.0}, "must be a number of 0.01 to 100"),
        ({"made.spring_factor": -1.0, "made.friction_factor": 1.0}, "made.spring_factor = -1"),
        ({"made.spring_factor": 1.0, "made.friction_factor": "x"}, "made.friction_factor = 'x'"),
        ({"made.spring_factor": 1.0}, "made.friction_factor: missing"),
        ({"made.carrying_link_mm": 1e300}, "made.carrying_link_mm = 1e+300"),
        ({"made.stiffness_nmm_per_deg": "x"}, "made.stiffness_nmm_per_deg = 'x'"),
    ],
)
def test_what_cannot_be_made_is_a_damaged_row(tmp_path: Path, made: dict[str, object], message: str) -> None:
    (trial,) = trials(1, phase="robust")
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([replace(trial, workshop=made)])
        with pytest.raises(JumpcadError, match=f"is damaged: row 'robust' 0 0: .*{re.escape(message)}"):
            store.trials()
