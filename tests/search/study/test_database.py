"""The SQLite file of a study: one writer, locks of other programs, what is not a file."""

import errno
import os
import sqlite3
import subprocess
import sys
import textwrap

import pytest
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.study.database import is_written, locked, require_study
from jumpcad.search.study.store import StudyStore


@pytest.mark.thorough
def test_one_writer_at_a_time(tmp_path):
    with StudyStore.write(tmp_path / "s.db", IDENTITY):
        code = textwrap.dedent(f"""
            from pathlib import Path
            from jumpcad.search.study.store import StudyStore
            StudyStore.write(Path({str(tmp_path / "s.db")!r}), {IDENTITY})
        """)
        other = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert "being written by another run" in other.stderr
    StudyStore.write(tmp_path / "s.db", IDENTITY).close()


def test_locked_by_another_program(tmp_path, monkeypatch):
    StudyStore.write(tmp_path / "s.db", IDENTITY).close()
    monkeypatch.setattr("jumpcad.search.study.database.PATIENCE_S", 0.1)
    other = sqlite3.connect(tmp_path / "s.db", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    with (
        pytest.raises(JumpcadError, match="locked by another program"),
        StudyStore.write(tmp_path / "s.db", IDENTITY) as it,
    ):
        it.append(trials(1))
    other.close()


def test_a_study_is_written_while_its_lock_is_held(tmp_path):
    assert not is_written(tmp_path / "none.db")
    others = os.umask(0o022)
    with locked(tmp_path / "s.db"):
        os.umask(others)
        assert (tmp_path / "s.db").stat().st_mode & 0o777 == 0o644  # others may read what is searched
        assert is_written(tmp_path / "s.db")
        with pytest.raises(JumpcadError, match="is being written by another run"), locked(tmp_path / "s.db"):
            pass
    assert not is_written(tmp_path / "s.db")


def test_a_study_is_a_file_or_will_be_one_in_a_folder_that_is_there(tmp_path):
    (tmp_path / "old.db").touch()
    for fine in (None, tmp_path / "new.db", tmp_path / "old.db"):
        require_study(fine)
    (tmp_path / "folder.db").mkdir()
    (tmp_path / "nowhere.db").symlink_to(tmp_path / "gone" / "s.db")
    for wrong, said in (
        ("s.sqlite", "must end in .db"), ("none/s.db", "there is no folder"),
        ("folder.db", "is there already and is no file"), ("nowhere.db", "is there already and is no file"),
        ("a\0b.db", "cannot be a path: it has a NUL"),
    ):  # fmt: skip
        with pytest.raises(JumpcadError, match=said):
            require_study(tmp_path / wrong)


def test_before_a_search_it_is_tried_whether_its_folder_takes_a_new_study(tmp_path, monkeypatch):
    """One that is there already is written in place; nothing is left of the trial."""
    (tmp_path / "old.db").touch()
    require_study(tmp_path / "new.db")
    assert [path.name for path in tmp_path.iterdir()] == ["old.db"]

    def read_only(*_):
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(os, "open", read_only)
    require_study(tmp_path / "old.db")
    with pytest.raises(JumpcadError, match="no file can be made in"):
        require_study(tmp_path / "new.db")
