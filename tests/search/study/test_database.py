"""The SQLite file of a study: one writer, locks of other programs, what is not a file."""

import errno
import os
import shutil
import sqlite3
import subprocess
import sys
import textwrap
from threading import Timer

import pytest
from filelock import FileLock
from support.each import each
from support.studies import IDENTITY, trials

from jumpcad.errors import JumpcadError
from jumpcad.search.study.database import SIDES, is_written, locked, require_study
from jumpcad.search.study.store import StudyStore


def test_a_lock_that_was_let_go_while_it_was_opened_locks_others_out_too(tmp_path, monkeypatch):
    """The first to hold it removes its file between another's opening and locking."""
    acquire, opened = FileLock.acquire, []

    def late(lock):
        acquire(lock)
        opened.append(lock)
        if len(opened) == 1:
            os.unlink(lock.lock_file)

    monkeypatch.setattr(FileLock, "acquire", late)
    refused = pytest.raises(JumpcadError, match="is being written by another run")
    with locked(tmp_path / "s.db"), refused, locked(tmp_path / "s.db"):
        pass
    assert os.listdir(tmp_path) == ["s.db"]


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
    assert [one.name for one in tmp_path.iterdir()] == ["s.db"]


def test_who_looks_whether_a_study_is_written_keeps_no_search_out(tmp_path):
    looks = FileLock(f"{tmp_path / 's.db'}.lock", thread_local=False)
    looks.acquire()
    Timer(0.05, looks.release).start()
    with locked(tmp_path / "s.db"):
        assert is_written(tmp_path / "s.db")


def test_a_name_that_leaves_no_room_for_the_files_beside_it_is_one_line(tmp_path):
    longest = os.pathconf(tmp_path, "PC_NAME_MAX")
    for length in range(longest - 12, longest + 3):
        name = "x" * (length - 3) + ".db"
        if length + len("-journal") <= longest:
            StudyStore.write(tmp_path / name, IDENTITY).close()
        else:
            with pytest.raises(JumpcadError, match=r"cannot be written: File name too long$"):
                StudyStore.write(tmp_path / name, IDENTITY)
            assert name not in os.listdir(tmp_path)


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


def contents(folder):
    """Return what a folder holds: bytes of files, kinds of all else."""
    return {one.name: one.read_bytes() if one.is_file() else one.lstat().st_mode for one in folder.iterdir()}


def lay(path, kind, victim):
    """Lay something of a kind at a path."""
    if kind == "journal":  # a hot one: SQLite plays it back, and deletes it
        path.write_bytes(bytes.fromhex("d9d505f920a163d7") + bytes(504) + b"more")
    elif kind == "mine":
        path.write_bytes(b"notes\n" * 1000)
    elif kind == "another's":
        path.write_bytes(b"theirs")
        os.chown(path, 12345, 12345)
    else:
        {"link": path.hardlink_to, "symlink": path.symlink_to, "pipe": lambda _: os.mkfifo(path),
         "folder": lambda _: path.mkdir()}[kind](victim)  # fmt: skip


KINDS = [
    "link",
    "symlink",
    *(["pipe"] if hasattr(os, "mkfifo") else []),
    "folder",
    "mine",
    *(["another's"] if hasattr(os, "getuid") and os.getuid() == 0 else []),
]


@each("end, kind", [("-journal", "journal"), *((end, kind) for end in SIDES for kind in KINDS)])
def test_nothing_beside_a_study_is_trusted_or_written(tmp_path_factory, end, kind):
    """Nor is it by a writer, who refuses it, also beside what a link of another name leads to."""
    folder, found = tmp_path_factory.mktemp("study"), trials(1)
    (folder / "victim").write_text("precious")
    with StudyStore.write(folder / "s.db", IDENTITY) as store:
        store.append(found)
    lay(folder / f"s.db{end}", kind, folder / "victim")
    (folder / "other.db").symlink_to("s.db")
    before = contents(folder)
    for name in ("s.db", "other.db"):
        with StudyStore.read(folder / name) as store:
            assert store.trials() == found
        with pytest.raises(JumpcadError, match=f"{end}: is .*; move it away"):
            StudyStore.write(folder / name, IDENTITY)
    assert contents(folder) == before


def test_a_study_is_written_by_one_search_whatever_it_is_called(tmp_path):
    with StudyStore.write(tmp_path / "s.db", IDENTITY):
        (tmp_path / "soft.db").symlink_to("s.db")
        assert is_written(tmp_path / "soft.db")
        with pytest.raises(JumpcadError, match="is being written by another run"):
            StudyStore.write(tmp_path / "soft.db", IDENTITY)
        (tmp_path / "hard.db").hardlink_to(tmp_path / "s.db")
        with pytest.raises(JumpcadError, match="has another name too, a hard link"):
            StudyStore.write(tmp_path / "hard.db", IDENTITY)


def test_a_log_is_read_with_its_study_also_where_it_begins_anew_meanwhile(tmp_path, monkeypatch):
    path, copy, more = tmp_path / "s.db", shutil.copyfile, [trials(4, step=step) for step in (1, 2)]
    with StudyStore.write(path, IDENTITY) as writer:
        writer.append(trials(3))

        def copied_while_written(source, target):
            if more:  # what was in the log goes to the study, half of it after it was copied
                copy(source, target)
                writer.append(more.pop())
                writer._connection.execute("PRAGMA wal_checkpoint(RESTART)")
                writer.append(more.pop())
            else:
                before.update(contents(tmp_path))
                copy(source, target)

        before = {}
        monkeypatch.setattr(shutil, "copyfile", copied_while_written)
        with StudyStore.read(path) as reader:
            found = reader.trials()
        assert contents(tmp_path) == before
        assert len(found) == 11
        assert found == writer.trials()


def test_a_study_that_is_refused_is_left_as_it_is(tmp_path):
    """With the log of a search that was killed; what may have no end, or no room for a copy, is refused too."""
    with StudyStore.write(tmp_path / "s.db", IDENTITY) as store:
        store.append(trials(3))
        for name in ("s.db", "s.db-wal"):
            shutil.copy(tmp_path / name, tmp_path / name.replace("s.", "killed."))
    with pytest.raises(JumpcadError, match="holds another study"):
        StudyStore.write(tmp_path / "killed.db", IDENTITY | {"seed": 9})
    assert sorted(contents(tmp_path)) == ["killed.db", "killed.db-wal", "s.db"]
    with StudyStore.read(tmp_path / "killed.db") as store:
        assert len(store.trials()) == 3
    with open(tmp_path / "killed.db", "ab") as stream:
        stream.truncate(10**13)  # of holes
    with pytest.raises(JumpcadError, match=r"killed\.db: cannot be read: .* has no room for a copy"):
        StudyStore.read(tmp_path / "killed.db")
    if os.path.exists("/proc/kmsg"):
        with pytest.raises(JumpcadError, match="is not a study file"):
            StudyStore.read("/proc/kmsg")
