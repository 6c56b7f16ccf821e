"""A wrong request, however late it shows: nothing on standard output, nothing written; and very large study files."""

import sqlite3
from pathlib import Path

from support.each import each
from support.sandbox import Sandbox

SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "2", "--workers", "0", "--study")
SWEEP = ("explore", "sweep", "--model", "capsule", "--points", "2", "--workers", "0", "--study", "s.db")
REFUSED = {
    "no time": ("optimize", "--model", "capsule", "--limit", "1e-9", "--workers", "1", "--study", "s.db"),
    "no such figure": ("optimize", "nsga2", "--model", "published", "--objective", "rise", "--evaluations", "2",
                       "--workers", "0", "--study", "s.db"),
    "no such prior": (*SEARCH, "s.db", "--from-study", "no.db"),
    "no such parameter": ("explore", "feasibility", "--over", "foo,bar", *SWEEP[2:]),
    "one parameter twice": ("explore", "feasibility", "--over", "c_coef,c_coef", *SWEEP[2:]),
    "no such engine": (*SEARCH, "s.db", "--engine", "unity"),
    "centre outside": (*SWEEP, "--fix", "c_coef=7"),
}  # fmt: skip


@each("case", REFUSED)
def test_nothing_is_said_or_written_of_a_wrong_request(sandbox: Sandbox, case: str) -> None:
    assert sandbox.run(*REFUSED[case], exits=(2,)).out == ""


FOREIGN = {
    "a trigger": "CREATE TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM notes; END",
    "a table": "CREATE TABLE more (x)",
    "a view": "CREATE VIEW more AS SELECT * FROM notes",
    "another identity": "UPDATE study SET value = json_set(value, '$.seed', 99) WHERE key = 'identity'",
    "no identity": "DELETE FROM study",
    "stages of nothing": "INSERT OR REPLACE INTO study VALUES ('stages', '[]')",
    "a row of another": "UPDATE trials SET record = '[' WHERE rowid = 1",
}


@each("case", FOREIGN)
def test_nothing_is_said_of_a_study_that_is_refused(sandbox: Sandbox, study: Path, case: str) -> None:
    connection = sqlite3.connect(study)
    connection.execute(FOREIGN[case])
    connection.commit()
    connection.close()
    words = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "6", "--workers", "0", "--study", "study.db")
    assert sandbox.run(*words, exits=(2,), leaves=["study.db", "study.db-wal", "study.db-shm"]).out == ""
