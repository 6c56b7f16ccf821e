"""The study file: complete, readable while it is written, and never mistaken for another."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
import textwrap
from contextlib import closing
from dataclasses import replace

import pytest
from support.places import TESTS
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation
from jumpcad.search.study.store import ENDED, FORMAT, MOST_NOTES, StudyStore


def test_rows_come_back_to_the_last_bit_and_in_order(tmp_path):
    first, second = trials(5, "bo"), trials(5, "ga", 1)
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append(first)
        store.append(reversed(second))
    with StudyStore.read(tmp_path / "s.db") as store:
        assert store.trials() == [*second, *first]
        assert store.identity == IDENTITY
    assert os.listdir(tmp_path) == ["s.db"]


EARLIER = (
    "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL)",
    "CREATE TABLE notes (text TEXT NOT NULL)",
    "CREATE TABLE trials (\n  phase TEXT NOT NULL, run INTEGER NOT NULL, step INTEGER NOT NULL, "
    "place INTEGER NOT NULL,\n  score REAL, record TEXT NOT NULL, PRIMARY KEY (phase, run, step, place)\n)",
    "PRAGMA application_id = 1247104336",
    "PRAGMA user_version = 6",
    """INSERT INTO trials VALUES ('ga', 0, 0, 4, 0.8532087977914693, '{"phase":"ga","step":0,"place":4,"design":
    {"carrying_link_mm":139.5239838399,"c_coef":1.1588129409,"d_coef":0.7242377173,"e_coef":1.2317109637,
    "compression_ratio":0.4680879167,"rest_angle_deg":66.0827657022,"stiffness_nmm_per_deg":22.4955519615,
    "ground_link_angle_deg":22.8371130209},"evaluation":{"verdict":"jump","metrics":{"fitness":0.8532087977914693},
    "findings":[["audit_loop","info",0.486909,"mm"],["com_rise_m>=0.05","info",0.00734566,""]],"detail":""},
    "score":0.8532087977914693,"model":"m","duration_s":0.0132,"proposal":{},"workshop":{},"run":0}')""",
)
"""What an earlier version wrote for `--require "com_rise_m>=0.05"`, and could not read."""


def test_a_study_of_an_earlier_version_is_read(tmp_path):
    identity = json.dumps(IDENTITY | {"model": {"name": "capsule", "require": ["0.05<=com_rise_m"]}})
    with closing(sqlite3.connect(tmp_path / "s.db")) as connection, connection:
        for statement in EARLIER:
            connection.execute(statement)
        connection.execute("INSERT INTO study VALUES ('identity', ?)", (identity,))
    with StudyStore.read(tmp_path / "s.db") as store:
        (found,) = store.trials()
    assert found.evaluation.margins == {"audit_loop": 0.486909, "com_rise_m>=0.05": 0.00734566}
    assert (found.score, found.design.c_coef, found.position) == (0.8532087977914693, 1.1588129409, ("ga", 0, 0, 4))


def test_what_no_reader_takes_is_not_written(tmp_path):
    """A fault of the program: it ends with its traceback, and the study stays what it was."""
    (one, *_), wrong = trials(2), Evaluation("no verdict")
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append([one])
        for write in (
            lambda: store.append([replace(one, place=9, evaluation=wrong)]),
            lambda: store.remember(ENDED, 5),
        ):
            with pytest.raises(AssertionError, match="could not be read again"):
                write()
        assert (store.trials(), store.recall(ENDED)) == ([one], None)


def test_one_failing_row_undoes_its_batch(tmp_path):
    good = trials(4)
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append(good[:2])
        with pytest.raises(sqlite3.IntegrityError):
            store.append([good[2], good[1]])
        assert store.trials() == good[:2]


def test_a_study_is_read_while_it_is_written(tmp_path):
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as writer:
        writer.append(trials(3))
        with StudyStore.read(tmp_path / "s.db") as reader:
            assert len(reader.trials()) == 3
            writer.append(trials(2, "bo", 1))
            assert len(reader.trials()) == 3  # as it was
            with StudyStore.read(tmp_path / "s.db") as later:
                assert len(later.trials()) == 5
            with pytest.raises(JumpcadError):
                reader.note("readers do not write")


def test_another_study_is_not_overwritten_and_how_one_goes_on_is_said(tmp_path):
    """A front that names no figure is against the energy in the springs."""
    path, of_numpy = tmp_path / "s.db", [{"versions": {"numpy": number}} for number in ("1.26.4", "2.1.0")]
    front = "holds a front against {}, not {}: say --against {}, or name another file$"
    for there, here, said in (
        ({}, {"seed": 2}, r"holds another study \(seed: 1 there, 2 here\)"),
        ({}, {"space": Space.parse(fix=["c_coef=1.1"]).describe()}, r"space.c_coef.fixed: 1.0 there, 1.1 here"),
        (*of_numpy, r"was made by another program \(versions.numpy: \"1.26.4\" there, .*`--from-study .*s\.db`"),
        (of_numpy[0], of_numpy[1] | {"space": Space.parse().describe()}, "was made by another program .*from-study"),
        (of_numpy[0], of_numpy[1] | {"seed": 2}, r"holds another study \(seed: 1 there, 2 here\)"),
        ({}, {"against": "mass"}, front.format("spring-energy", "mass", "spring-energy")),
        ({"against": "mass"}, {}, front.format("mass", "spring-energy", "mass")),
    ):
        StudyStore.write(path, IDENTITY | there).close()
        before = path.read_bytes()
        with pytest.raises(JumpcadError, match=said):
            StudyStore.write(path, IDENTITY | here)
        assert path.read_bytes() == before
        path.unlink()


@pytest.mark.thorough
def test_killed_writer_leaves_whole_batches(tmp_path):
    code = textwrap.dedent(f"""
        import os, signal, sys
        sys.path.insert(0, {str(TESTS)!r})
        from pathlib import Path
        from support.studies import trials, IDENTITY
        from jumpcad.search.study.store import StudyStore
        store = StudyStore.write(Path({str(tmp_path / "s.db")!r}), IDENTITY)
        store.append(trials(7))
        store._connection.execute("BEGIN")
        store._connection.execute("DELETE FROM trials")
        os.kill(os.getpid(), signal.SIGKILL)
    """)
    done = subprocess.run([sys.executable, "-c", code])
    assert done.returncode == -signal.SIGKILL
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        assert store.trials() == trials(7)


@pytest.mark.thorough
def test_full_disk_is_one_line_and_keeps_what_was_there(tmp_path):
    code = textwrap.dedent(f"""
        import resource, signal, sys
        sys.path.insert(0, {str(TESTS)!r})
        from pathlib import Path
        from support.studies import trials, IDENTITY
        from jumpcad.errors import JumpcadError
        from jumpcad.search.study.store import StudyStore
        store = StudyStore.write(Path({str(tmp_path / "s.db")!r}), IDENTITY)
        store.append(trials(3))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
        try:
            for step in range(1, 100):
                store.append(trials(8, step=step))
        except JumpcadError as error:
            print(error)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "cannot be written" in done.stdout, done.stderr
    assert "repeat the command" in done.stdout
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        assert store.trials()[:3] == trials(3)


def test_files_that_are_no_studies(tmp_path):
    with pytest.raises(JumpcadError, match="no such study file"):
        StudyStore.read(tmp_path / "none.db")
    (tmp_path / "text.db").write_text("not a database, but long enough to look at: " + "x" * 200)
    sqlite3.connect(tmp_path / "other.db").executescript("CREATE TABLE t (a); INSERT INTO t VALUES (1);")
    for name, message in (("text.db", "damaged, or is not a study"), ("other.db", "is not a study file")):
        content = (tmp_path / name).read_bytes()
        with pytest.raises(JumpcadError, match=message):
            StudyStore.read(tmp_path / name)
        with pytest.raises(JumpcadError, match=message):
            StudyStore.write(tmp_path / name, IDENTITY)
        assert (tmp_path / name).read_bytes() == content
    with pytest.raises(JumpcadError, match="cannot be written"):
        StudyStore.write(tmp_path / "missing" / "s.db", IDENTITY)


def edited(path, *statements):
    """Make a study of trials of two phases, then change it as another program would."""
    with StudyStore.write(path, IDENTITY) as store:
        store.remember("stages", [{"method": "ga", "evaluations": 9, "initial": 0}])
        store.append([*trials(5), *trials(4, "bo", 1)])
    connection = sqlite3.connect(path)
    for statement in statements:
        connection.execute(statement)
    connection.commit()
    connection.close()
    return path


def read_all(path):
    """Read everything that a study holds; its search has not ended."""
    with StudyStore.read(path) as store:
        assert store.recall(ENDED) is None
        return store.trials(), store.recall("stages"), store.notes()


def test_a_study_that_another_program_changed_is_refused_in_a_line(tmp_path):
    where = "WHERE phase = 'ga' AND place = 2"
    endless = "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n FROM r) SELECT n FROM r"
    for statement, reason in (
        (f"UPDATE trials SET phase = 'x' {where}", "row 'x' 0 0 2: record: is that of another row"),
        (f"UPDATE trials SET phase = CAST(x'ff' AS TEXT) {where}", "is damaged"),
        (f"UPDATE trials SET record = '{{' {where}", "row 'ga' 0 0 2: record: Invalid JSON"),
        (f"UPDATE trials SET record = CAST(x'7bff' AS TEXT) {where}", "is damaged"),
        ("UPDATE trials SET record = replace(record, '\"jump\"', 'char(27)')", "record: Invalid JSON"),
        (f"UPDATE trials SET phase = x'6761', place = 1 {where}", "row b'ga' 0 0 1: record"),  # a key of its own
        ("DELETE FROM study WHERE key = 'identity'", "identity"),
        ("UPDATE study SET value = '{' WHERE key = 'stages'", "stages: Invalid JSON"),
        ("INSERT INTO study VALUES ('ended', x'ff')", "ended: Invalid JSON"),
        (f"CREATE VIEW endless AS {endless}", "tables"),
        ("CREATE TRIGGER t AFTER INSERT ON notes BEGIN DELETE FROM trials; END", "unknown tables"),
        ("ALTER TABLE trials RENAME COLUMN record TO r", "unknown tables"),
        ("DROP TABLE notes", "unknown tables"),
    ):
        path = edited(tmp_path / "s.db", statement)
        with pytest.raises(JumpcadError, match=reason) as caught:
            read_all(path)
        assert str(caught.value).isprintable(), statement
        path.unlink()


def test_a_study_of_another_format_is_refused(tmp_path):
    for number in (0, FORMAT - 1, FORMAT + 1):
        path = edited(tmp_path / "s.db", f"PRAGMA user_version = {number}")
        for open_it in (StudyStore.read, lambda file: StudyStore.write(file, IDENTITY)):
            with pytest.raises(JumpcadError, match=f"of format {number}; this version of jumpcad reads format"):
                open_it(path)
        path.unlink()


def test_a_file_that_was_made_for_a_wrong_request_is_gone_again_unless_it_holds_a_score(tmp_path):
    """What was there before stays, as does what another fault leaves."""

    def attempt(path, error, found):
        with StudyStore.write(path, IDENTITY) as store:
            store.append(found)
            raise error

    def left(path, error, found=()):
        with pytest.raises(type(error)):
            attempt(path, error, found)
        return sorted(one.name for one in path.parent.iterdir() if one.name.startswith(path.name))

    wrong = JumpcadError("wrong")
    assert left(tmp_path / "a.db", wrong) == []
    assert left(tmp_path / "b.db", wrong, trials(2)) == ["b.db"]
    assert (
        left(tmp_path / "d.db", wrong, [replace(one, score=None) for one in trials(2)]) == []
    )  # of rejected designs alone
    assert left(tmp_path / "c.db", ValueError("a fault")) == ["c.db"]
    assert left(tmp_path / "c.db", wrong) == ["c.db"]  # of before
    with pytest.raises(JumpcadError), StudyStore.read(tmp_path / "c.db"):
        raise wrong
    assert (tmp_path / "c.db").exists()
    with StudyStore.read(tmp_path / "b.db") as store:
        assert len(store.trials()) == 2


def test_progress_counts_phases_and_has_the_best_of_what_the_search_proposed(tmp_path):
    """Neighbours of the pick and designs beyond the bounds may be better; they are not what was searched."""
    found = [replace(one, score=float(place)) for place, one in enumerate(trials(6))]
    found[3] = replace(found[3], score=None)
    around = [replace(one, phase="robust", score=50.0) for one in trials(3, "robust", 1)]
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        assert store.progress() == ({}, None)
        store.append(around)
        assert store.progress() == ({"robust": 3}, None)
        store.append(found)
        assert store.progress() == ({"ga": 6, "robust": 3}, 5.0)


def test_of_very_many_notes_the_newest_are_read_in_their_order(tmp_path):
    with StudyStore.write(None, IDENTITY) as store:
        for number in range(MOST_NOTES + 3):
            store.note(f"note {number}")
        notes = store.notes()
    assert notes[0] == "3 earlier notes"
    assert notes[1:] == [f"note {number}" for number in range(3, MOST_NOTES + 3)]
    with StudyStore.write(None, IDENTITY) as store:
        store.note("first")
        store.note("x" * 5000)
        assert store.notes() == ["first", "x" * 1000]
