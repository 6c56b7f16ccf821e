"""A folder is replaced as a whole, also by a build that is killed, and keeps what a user added."""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from support.folders import add_mine, has_mine, listed, old

from jumpcad.bundle import place
from jumpcad.bundle.folder import write_folder
from jumpcad.bundle.manifest import unlisted, verify
from jumpcad.bundle.swap import exchanged
from jumpcad.errors import JumpcadError

DIES = """
import os, signal, sys
from pathlib import Path
from jumpcad.bundle import folder
from jumpcad.bundle import place
holder, step, turn = {"write": (Path, "write_bytes", 2), "link": (os, "link", 1), "exchange": (place, "exchanged", 1),
                      "rename": (os, "rename", 1), "clean": (os, "unlink", 2)}[sys.argv[2]]
whole, calls = getattr(holder, step), 0
def dying(*arguments, **options):
    global calls
    calls += 1
    answer = whole(*arguments, **options)
    if calls == turn:
        os.kill(os.getpid(), signal.SIGKILL)
    return answer
setattr(holder, step, dying)
folder.write_folder(sys.argv[1], "robot", {}, {"a.md": "new", "deep/b.md": "new", "c.md": "new"}.items())
"""


def can_exchange(folder: Path) -> bool:
    for name in ("one", "other"):
        (folder / name).mkdir()
        (folder / name / name).write_text(name)
    return exchanged(folder / "one", folder / "other") and (folder / "one" / "other").is_file()


@pytest.mark.skipif(os.name != "posix", reason="processes are killed by a POSIX signal")
@pytest.mark.parametrize(
    ("step", "left"), [("write", "old"), ("link", "old"), ("exchange", "new"), ("rename", "new"), ("clean", "new")]
)
def test_a_build_killed_at_a_step_leaves_a_whole_bundle(step: str, left: str, tmp_path: Path) -> None:
    if not can_exchange(tmp_path):
        pytest.skip("this file system cannot exchange two folders")
    target = tmp_path / "exports" / "robot"
    old(target)
    add_mine(target)
    ended = subprocess.run([sys.executable, "-c", DIES, str(target), step], check=False)
    assert ended.returncode == (0 if step == "rename" else -signal.SIGKILL), "nothing is moved away by a rename"
    assert verify(target) == []
    assert (target / "a.md").read_text() == left
    assert has_mine(target)
    old(target)  # what a killed build left beside it is in nobody's way
    assert verify(target) == []
    assert (target / "a.md").read_text() == "old"
    assert not (target / "c.md").exists()
    assert has_mine(target)


def test_where_folders_cannot_change_places_they_are_renamed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot"
    old(target)
    add_mine(target)
    monkeypatch.setattr(place, "exchanged", lambda *_: False)
    write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    assert listed(target) == ["a.md", "deep", "deep/mine.txt", "empty", "link", "manifest.json", "notes.txt"]
    assert has_mine(target)
    assert [path.name for path in tmp_path.iterdir()] == ["robot"]


def test_a_rename_that_fails_puts_the_old_folder_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot"
    old(target)
    add_mine(target)
    rename = os.rename

    def failing(one: Path, other: Path) -> None:
        if Path(one).name == "new":
            raise OSError(5, "Input/output error")
        rename(one, other)

    monkeypatch.setattr(place, "exchanged", lambda *_: False)
    monkeypatch.setattr(os, "rename", failing)
    with pytest.raises(JumpcadError, match="Input/output error"):
        write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    assert has_mine(target)
    assert [path.name for path in tmp_path.iterdir()] == ["robot"]


def test_what_a_user_added_stays_as_it_is(tmp_path: Path) -> None:
    target = tmp_path / "robot"
    old(target)
    add_mine(target)
    os.mkfifo(target / "pipe")
    (target / "locked").write_text("mine")
    (target / "locked").chmod(0)
    (target / "album").mkdir()
    (target / "album" / "photo.jpg").write_bytes(b"photo")
    (target / "album" / "photo.jpg").chmod(0o640)
    for path in (target / "album" / "photo.jpg", target / "album"):
        os.utime(path, (1e9, 1e9))
    target.chmod(0o750)
    before = {path: (target / path).lstat() for path in ("pipe", "locked", "album/photo.jpg", "link", "notes.txt")}
    write_folder(target, "robot", {}, {"b.md": "new"}.items())
    for path, was in before.items():
        now = (target / path).lstat()
        assert (now.st_mode, now.st_mtime_ns, now.st_size) == (was.st_mode, was.st_mtime_ns, was.st_size)
    assert (target / "album").stat().st_mtime == 1e9
    assert target.stat().st_mode & 0o777 == 0o750
    assert has_mine(target)
    assert sorted({*listed(target)} - {*before}) == [
        "album",
        "b.md",
        "deep",
        "deep/mine.txt",
        "empty",
        "manifest.json",
    ]
    assert unlisted(target) == sorted([*before, "deep/mine.txt", "empty"])


def test_where_there_are_no_hard_links_files_are_copied(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot"
    old(target)
    add_mine(target)
    os.utime(target / "notes.txt", (1e9, 1e9))

    def none(*_: object, **__: object) -> None:
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", none)
    old(target)
    assert has_mine(target)
    assert (target / "notes.txt").stat().st_mtime == 1e9
    os.mkfifo(target / "pipe")
    with pytest.raises(JumpcadError, match="pipe: is no plain file and cannot be kept"):
        old(target)
    assert verify(target) == []
    assert (target / "pipe").is_fifo()
    assert [path.name for path in tmp_path.iterdir()] == ["robot"]


@pytest.mark.parametrize("text", ["edited late", "new"])
def test_what_appears_during_the_write_is_not_lost(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    """Also where the edited file is as long as before."""
    target = tmp_path / "robot"
    old(target)
    whole = place.exchanged

    def late(fresh: Path, there: Path) -> bool:
        (there / "late.txt").write_text("mine")
        (there / "a.md").write_text(text)
        os.utime(there / "a.md", (1e9, 1e9))
        return whole(fresh, there)

    monkeypatch.setattr(place, "exchanged", late)
    with pytest.raises(JumpcadError, match="is written, but what was changed in it meanwhile is in") as error:
        write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    left = Path(str(error.value).split(" is in ")[1])
    assert listed(left) == ["a.md", "late.txt"]
    assert (left / "a.md").read_text() == text


def test_a_folder_is_made_with_its_parents(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside its place, on the same disk, whatever becomes of the system's folder for temporary files."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "gone"))
    write_folder(tmp_path / "a" / "deep" / "robot", "robot", {}, {"b.md": "new"}.items())
    assert verify(tmp_path / "a" / "deep" / "robot") == []
    assert [path.name for path in (tmp_path / "a" / "deep").iterdir()] == ["robot"]
