"""Study files from strangers, and those that an accident has spoilt: values, tables, bytes, and what is no file."""

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

from support.each import each
from support.mutations import DOCUMENTS, JSON_VALUES, Spoil, accidents, places, spoilt_value, with_value
from support.sandbox import ANY, Sandbox, lay_odd

COLUMNS = ("phase", "run", "step", "score", "record")
FIELDS = (
    "phase", "run", "design", "workshop", "model", "evaluation", "evaluation.verdict", "evaluation.metrics",
    "evaluation.findings", "evaluation.detail", "proposal", "duration_s",
)  # fmt: skip
VALUES = {
    "text": "'x'",
    "empty": "''",
    "bytes": "x'00ff00'",
    "infinity": "9e999",
    "minus": "-1",
    "huge": "9223372036854775807",
    "null-json": "'null'",
    "list": "'[]'",
    "nan-json": '\'{"fitness": NaN, "x": Infinity}\'',
    "deep": "'" + JSON_VALUES["deep"] + "'",
    "formula": "'=HYPERLINK(\"http://x\")'",
    "escape": "char(27) || '[31m' || char(10) || '[/x]'",
    "million": "hex(zeroblob(500000))",
}
SCHEMES = {
    "no-study": "DROP TABLE study",
    "no-evaluations": "DROP TABLE trials",
    "no-notes": "DROP TABLE notes",
    "no-rows": "DELETE FROM trials",
    "no-identity": "DELETE FROM study WHERE key = 'identity'",
    "no-stages": "DELETE FROM study WHERE key = 'stages'",
    "renamed": "ALTER TABLE trials RENAME TO e",
    "renamed-column": "ALTER TABLE trials RENAME COLUMN score TO points",
    "more-columns": "ALTER TABLE trials ADD COLUMN more TEXT",
    "view": "ALTER TABLE trials RENAME TO e; CREATE VIEW trials AS SELECT * FROM e",
    "view-of-a-file": "DROP TABLE notes; CREATE VIEW notes AS SELECT readfile('/etc/passwd') AS text",
    "trigger": "CREATE TRIGGER t AFTER INSERT ON notes BEGIN DELETE FROM trials; END",
    "other-application": "PRAGMA application_id = 1",
    "other-format": "PRAGMA user_version = 99",
    "format-zero": "PRAGMA user_version = 0",
    "notes-of-bytes": "INSERT INTO notes VALUES (x'ff00')",
    "notes-of-a-terminal": "INSERT INTO notes VALUES (char(27) || '[2J' || char(10) || char(155))",
    "no-picks": "DELETE FROM study WHERE key = 'picks'",
    "other-picks": "UPDATE study SET value = replace(value, '[', '{') WHERE key = 'picks'",
    "utf-16": "VACUUM",
}


def spoil(study: Path, statements: str) -> None:
    """Change a study as any SQLite client can."""
    with closing(sqlite3.connect(study)) as connection:
        connection.executescript(statements)
    for more in ("-wal", "-shm"):
        study.with_name(study.name + more).unlink(missing_ok=True)


def ask(sandbox: Sandbox, exits: tuple[int, ...] = ANY) -> None:
    """Read a study in every way that is cheap."""
    sandbox.run("study", "study.db", exits=exits)
    sandbox.run("study", "study.db", "--export", "rows.csv", "--json", exits=exits, writes=["rows.csv"])


@each("name", [*COLUMNS, *(f"record.{field}" for field in FIELDS)])
def test_a_strange_value_is_borne_or_refused(sandbox: Sandbox, study: Path, name: str) -> None:
    good = study.read_bytes()
    with closing(sqlite3.connect(study)) as connection:
        record = json.loads(connection.execute("SELECT record FROM trials WHERE rowid = 1").fetchone()[0])
    for value, text in (VALUES if name in COLUMNS else JSON_VALUES).items():
        sandbox.case = f"{name} = {value}"
        study.write_bytes(good)
        changed = f"{name} = {text}"
        if name not in COLUMNS:
            place = tuple(name.split(".")[1:])
            changed = "record = '" + with_value(record, place, text).replace("'", "''") + "'"
        spoil(study, f"UPDATE trials SET {changed} WHERE rowid = 1")
        ask(sandbox)


@each("number", range(30))
@each("key", ["identity", "stages"])
def test_a_strange_description_is_borne_or_refused(sandbox: Sandbox, study: Path, key: str, number: int) -> None:
    with closing(sqlite3.connect(study)) as connection:
        good = json.loads(connection.execute("SELECT value FROM study WHERE key = ?", (key,)).fetchone()[0])
    sandbox.case, text = spoilt_value(good, list(places(good)), number)
    text = text.replace("'", "''")
    spoil(study, f"UPDATE study SET value = '{text}' WHERE key = '{key}'")
    ask(sandbox)


@each("case", SCHEMES)
def test_a_strange_scheme_is_borne_or_refused(sandbox: Sandbox, study: Path, case: str) -> None:
    spoil(study, SCHEMES[case])
    ask(sandbox)


@each("case", [*DOCUMENTS, *accidents(60, 10)])
def test_an_accident_is_borne_or_refused(sandbox: Sandbox, study: Path, case: str) -> None:
    spoils: dict[str, Spoil] = DOCUMENTS | accidents(60, 10)
    study.write_bytes(spoils[case](study.read_bytes()))
    ask(sandbox)


@each("seed", range(12))
def test_an_accident_in_the_last_page_is_borne_or_refused(sandbox: Sandbox, study: Path, seed: int) -> None:
    """Texts fill the last pages, and SQLite does not check them."""
    data = study.read_bytes()
    spoilt = accidents(12, 0)[f"flip-{seed}"](data[len(data) // 2 :])
    study.write_bytes(data[: len(data) // 2] + spoilt)
    ask(sandbox)


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
    spoil(study, FOREIGN[case])
    words = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "6", "--workers", "0", "--study", "study.db")
    assert sandbox.run(*words, exits=(2,), leaves=["study.db"]).out == ""


def test_a_view_without_end_is_refused(sandbox: Sandbox, study: Path) -> None:
    endless = "WITH RECURSIVE n(text) AS (SELECT 'x' UNION ALL SELECT text FROM n) SELECT text FROM n"
    spoil(study, f"DROP TABLE notes; CREATE VIEW notes AS {endless}")
    sandbox.process("study", "study.db", "--json", exits=(2,))


@each("command", ["study", "from", "continue"])
@each("kind", ["folder", "pipe", "loop", "dangling", "device", "nothing", "empty", "foreign"])
def test_what_is_no_study_is_refused_and_kept(sandbox: Sandbox, kind: str, command: str) -> None:
    path = sandbox.work / "study.db"
    if kind == "empty":
        path.touch()
    elif kind == "foreign":
        with closing(sqlite3.connect(path)) as connection:
            connection.executescript("CREATE TABLE photos (x); INSERT INTO photos VALUES (1)")
    elif kind != "nothing":
        lay_odd(path, kind)
    search = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--workers", "0", "--json")
    if command == "study":
        sandbox.run("study", "study.db", "--json", exits=(2,))
    elif command == "from":
        sandbox.run(*search, "--from", "study.db", "--study", "new.db", exits=(2,))
    elif kind in ("nothing", "empty"):
        sandbox.run(*search, "--study", "study.db", exits=(0, 1), writes=["study.db", "study.toml"])
    else:
        sandbox.run(*search, "--study", "study.db", exits=(2,))


@each("name", ["a?mode=memory.db", "a#b.db", "a%00b.db", "file:x.db", "機械.db", "a b.db", "-a.db"])
def test_a_study_may_have_any_name(sandbox: Sandbox, study: Path, name: str) -> None:
    shutil.move(study, sandbox.work / name)
    sandbox.run("study", "--json", "--", name, exits=(0,))


def test_a_log_of_another_study_beside_it_does_no_harm(sandbox: Sandbox, study: Path) -> None:
    sandbox.write("study.db-wal", b"\x37\x7f\x06\x82" + bytes(4096))
    sandbox.run("study", "study.db", "--json")
