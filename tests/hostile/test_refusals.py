"""A wrong request, however late it shows: nothing on standard output, nothing written; and very large study files."""

import sqlite3
import tracemalloc
import unicodedata
from pathlib import Path

import pytest
from support.each import each
from support.sandbox import Sandbox

from jumpcad.design import load_design
from jumpcad.search.study.store import LONGEST_NOTE, MOST_NOTES, StudyStore

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


def test_of_very_many_notes_the_newest_are_read(sandbox: Sandbox, study: Path) -> None:
    connection = sqlite3.connect(study)
    connection.executemany("INSERT INTO notes VALUES (?)", ((f"{n} {'x' * 2000}",) for n in range(20_000)))
    connection.commit()
    connection.close()
    notes = sandbox.run("study", "study.db", "--json", exits=(0,)).data["notes"]
    assert len(notes) == MOST_NOTES + 1
    assert notes[0] == f"{20_000 - MOST_NOTES} earlier notes"
    assert notes[-1].startswith("19999 x")
    assert max(map(len, notes)) == LONGEST_NOTE
    with StudyStore.read(study) as there:
        tracemalloc.start()
        assert there.notes() == notes
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert peak < 2 * MOST_NOTES * LONGEST_NOTE  # bytes; all notes are 40 MB


def test_a_note_is_kept_once(tmp_path: Path, study: Path) -> None:
    with StudyStore.read(study) as there:
        identity = there.identity
    with StudyStore.write(study, identity) as store:
        store.note_once("a line")
        store.note_once("a line")
        assert store.notes().count("a line") == 1


DECOMPOSED = {"a": "a\u0301rbol", "composed": "árbol"}


@pytest.mark.parametrize("name", DECOMPOSED.values())
def test_a_decomposed_name_is_the_composed_one(sandbox: Sandbox, name: str) -> None:
    composed = unicodedata.normalize("NFC", name)
    sandbox.write(f"{name}.toml", load_design("kenan-2.0").to_toml())
    sandbox.run("build", f"{name}.toml", "--no-pictures", "--json", exits=(0,), writes=["exports"])
    assert (sandbox.work / "exports" / composed / "urdf" / f"{composed}.urdf").is_file()
    sandbox.run("verify", f"exports/{composed}", exits=(0,))
    sandbox.run("simulate", f"exports/{composed}", "--json", exits=(0,))


def test_a_letter_that_cannot_be_composed_is_named(sandbox: Sandbox) -> None:
    sandbox.write("x\u0301.toml", load_design("kenan-2.0").to_toml())
    assert "U+0301" in sandbox.run("build", "x\u0301.toml", exits=(2,)).err
