"""The study file: whole, shared, and never taken for another."""

import os
import signal
import sqlite3
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from support.hills import Hill

from jumpcad.errors import JumpcadError
from jumpcad.search.ledger import Ledger, Row
from jumpcad.search.space import Space

TESTS = [str(Path(__file__).parent), str(Path(__file__).parents[1])]
IDENTITY = {
    "model": {"name": "hill"},
    "objective": "fitness",
    "method": "ga",
    "seed": 1,
    "space": Space.parse(fix=["c_coef=1"]).describe(),
}


def rows(count, phase="ga", step=0):
    points = Space.default().spread(count, np.random.default_rng(step))
    designs = [Space.default().to_design(point) for point in points]
    evaluations = [Hill()(design) for design in designs]
    return [
        Row(
            phase,
            step,
            place,
            design,
            evaluation,
            evaluation.metrics.get("fitness"),
            "m",
            0.1,
            {"theta": {"a": [0.1] * 9}},
        )
        for place, (design, evaluation) in enumerate(zip(designs, evaluations, strict=True))
    ]


def test_rows_come_back_to_the_last_bit_and_in_order(tmp_path):
    first, second = rows(5, "bo"), rows(5, "ga", 1)
    with Ledger.write(tmp_path / "s.db", IDENTITY) as ledger:
        ledger.append(first)
        ledger.append(reversed(second))
    with Ledger.read(tmp_path / "s.db") as ledger:
        assert ledger.rows() == [*second, *first]
        assert ledger.identity == IDENTITY
    assert os.listdir(tmp_path) == ["s.db"]


def test_one_failing_row_undoes_its_batch(tmp_path):
    good = rows(4)
    with Ledger.write(tmp_path / "s.db", IDENTITY) as ledger:
        ledger.append(good[:2])
        with pytest.raises(sqlite3.IntegrityError):
            ledger.append([good[2], good[1]])
        assert ledger.rows() == good[:2]


def test_a_study_is_read_while_it_is_written(tmp_path):
    with Ledger.write(tmp_path / "s.db", IDENTITY) as writer:
        writer.append(rows(3))
        with Ledger.read(tmp_path / "s.db") as reader:
            assert len(reader.rows()) == 3
            writer.append(rows(2, "bo", 1))
            assert len(reader.rows()) == 5
            with pytest.raises(JumpcadError):
                reader.note("readers do not write")


def test_another_study_is_not_overwritten(tmp_path):
    Ledger.write(tmp_path / "s.db", IDENTITY).close()
    before = (tmp_path / "s.db").read_bytes()
    with pytest.raises(JumpcadError, match=r"another study \(seed: 1 there, 2 here\)"):
        Ledger.write(tmp_path / "s.db", IDENTITY | {"seed": 2})
    with pytest.raises(JumpcadError, match=r"space.c_coef.fixed: 1.0 there, 1.1 here"):
        Ledger.write(tmp_path / "s.db", IDENTITY | {"space": Space.parse(fix=["c_coef=1.1"]).describe()})
    assert (tmp_path / "s.db").read_bytes() == before


def test_one_writer_at_a_time(tmp_path):
    with Ledger.write(tmp_path / "s.db", IDENTITY):
        code = textwrap.dedent(f"""
            from pathlib import Path
            from jumpcad.search.ledger import Ledger
            Ledger.write(Path({str(tmp_path / "s.db")!r}), {IDENTITY})
        """)
        other = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert "being written by another run" in other.stderr
    Ledger.write(tmp_path / "s.db", IDENTITY).close()


def test_locked_by_another_program(tmp_path, monkeypatch):
    Ledger.write(tmp_path / "s.db", IDENTITY).close()
    monkeypatch.setattr("jumpcad.search.database.PATIENCE_S", 0.1)
    other = sqlite3.connect(tmp_path / "s.db", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    with (
        pytest.raises(JumpcadError, match="locked by another program"),
        Ledger.write(tmp_path / "s.db", IDENTITY) as it,
    ):
        it.append(rows(1))
    other.close()


def test_killed_writer_leaves_whole_batches(tmp_path):
    code = textwrap.dedent(f"""
        import os, signal, sys
        sys.path[:0] = {TESTS}
        from pathlib import Path
        from test_ledger import rows, IDENTITY
        from jumpcad.search.ledger import Ledger
        ledger = Ledger.write(Path({str(tmp_path / "s.db")!r}), IDENTITY)
        ledger.append(rows(7))
        ledger._connection.execute("BEGIN")
        ledger._connection.execute("DELETE FROM evaluations")
        os.kill(os.getpid(), signal.SIGKILL)
    """)
    done = subprocess.run([sys.executable, "-c", code])
    assert done.returncode == -signal.SIGKILL
    with Ledger.write(tmp_path / "s.db", IDENTITY) as ledger:
        assert ledger.rows() == rows(7)


def test_full_disk_is_one_line_and_keeps_what_was_there(tmp_path):
    code = textwrap.dedent(f"""
        import resource, signal, sys
        sys.path[:0] = {TESTS}
        from pathlib import Path
        from test_ledger import rows, IDENTITY
        from jumpcad.errors import JumpcadError
        from jumpcad.search.ledger import Ledger
        ledger = Ledger.write(Path({str(tmp_path / "s.db")!r}), IDENTITY)
        ledger.append(rows(3))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
        try:
            for step in range(1, 100):
                ledger.append(rows(8, step=step))
        except JumpcadError as error:
            print(error)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "cannot be written" in done.stdout, done.stderr
    assert "repeat the command" in done.stdout
    with Ledger.write(tmp_path / "s.db", IDENTITY) as ledger:
        assert ledger.rows()[:3] == rows(3)


def test_files_that_are_no_studies(tmp_path):
    with pytest.raises(JumpcadError, match="no such study file"):
        Ledger.read(tmp_path / "none.db")
    (tmp_path / "text.db").write_text("not a database, but long enough to look at: " + "x" * 200)
    sqlite3.connect(tmp_path / "other.db").executescript("CREATE TABLE t (a); INSERT INTO t VALUES (1);")
    for name, message in (("text.db", "damaged, or is not a study"), ("other.db", "is not a study file")):
        content = (tmp_path / name).read_bytes()
        with pytest.raises(JumpcadError, match=message):
            Ledger.read(tmp_path / name)
        with pytest.raises(JumpcadError, match=message):
            Ledger.write(tmp_path / name, IDENTITY)
        assert (tmp_path / name).read_bytes() == content
    with pytest.raises(JumpcadError, match="cannot be written"):
        Ledger.write(tmp_path / "missing" / "s.db", IDENTITY)


def test_damaged_study(tmp_path):
    with Ledger.write(tmp_path / "s.db", IDENTITY) as ledger:
        ledger.append(rows(40))
    content = bytearray((tmp_path / "s.db").read_bytes())
    content[4096:12288] = b"\xff" * 8192
    (tmp_path / "s.db").write_bytes(content)
    with pytest.raises(JumpcadError, match="is damaged"):
        Ledger.read(tmp_path / "s.db")


def test_study_of_another_format(tmp_path):
    Ledger.write(tmp_path / "s.db", IDENTITY).close()
    sqlite3.connect(tmp_path / "s.db", isolation_level=None).execute("PRAGMA user_version = 99")
    with pytest.raises(JumpcadError, match="format 99"):
        Ledger.read(tmp_path / "s.db")
