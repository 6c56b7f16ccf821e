"""A bundle's folder is written whole or not at all, also by a build that is killed, and nothing of a user's is lost."""

import ctypes
import errno
import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import pytest

from jumpcad.bundle import atomic_write
from jumpcad.bundle.atomic_write import change_files, require_unedited, write_folder
from jumpcad.bundle.manifest import open_bundle, unlisted, verify
from jumpcad.errors import JumpcadError

DIES = """
import os, signal, sys
from pathlib import Path
from jumpcad.bundle import atomic_write
holder, step, turn = {"write": (Path, "write_bytes", 2), "link": (os, "link", 1), "rename": (os, "rename", 1),
                      "exchange": (atomic_write, "exchanged", 1), "clean": (os, "unlink", 5)}[sys.argv[2]]
whole, calls = getattr(holder, step), 0
def dying(*arguments, **options):
    global calls
    calls += 1
    answer = whole(*arguments, **options)
    if calls == turn:
        os.kill(os.getpid(), signal.SIGKILL)
    return answer
setattr(holder, step, dying)
atomic_write.write_folder(sys.argv[1], "robot", {}, {"a.md": "new", "deep/b.md": "new", "c.md": "new"}.items())
"""


def old(target: Path) -> None:
    """Write a bundle of two files."""
    write_folder(target, "robot", {}, {"a.md": "old", "deep/b.md": "old"}.items())


def add_mine(target: Path) -> None:
    """Add what only a user can have: a file, one between ours, an empty folder, a link to nowhere."""
    (target / "notes.txt").write_text("mine")
    (target / "deep" / "mine.txt").write_text("mine")
    (target / "empty").mkdir()
    (target / "link").symlink_to("nowhere")


def has_mine(target: Path) -> bool:
    """Tell whether what `add_mine` added is there unchanged."""
    kept = [(target / name).read_text() for name in ("notes.txt", "deep/mine.txt")]
    return kept == ["mine", "mine"] and (target / "empty").is_dir() and os.readlink(target / "link") == "nowhere"


def listed(folder: Path) -> list[str]:
    """Return the paths of all that is in a folder, sorted."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


@pytest.fixture
def target(tmp_path: Path) -> Path:
    """A bundle of two files to which a user added some."""
    folder = tmp_path / "exports" / "robot"
    old(folder)
    add_mine(folder)
    return folder


def test_other_versions_that_give_the_same_bytes_leave_the_manifest_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """So Git has nothing to tell where a committed bundle is built on another Python."""
    target = tmp_path / "robot"
    write_folder(target, "robot", {}, [("a.md", "fine")])
    first = (target / "manifest.json").read_bytes()
    monkeypatch.setattr("importlib.metadata.version", lambda _: "99.0")
    write_folder(target, "robot", {}, [("a.md", "fine")])
    assert (target / "manifest.json").read_bytes() == first
    write_folder(target, "robot", {}, [("a.md", "finer")])
    assert json.loads((target / "manifest.json").read_text())["versions"]["numpy"] == "99.0"


@pytest.mark.thorough
def test_a_build_killed_at_any_step_leaves_a_whole_bundle(target: Path) -> None:
    for step, left in {"write": "old", "link": "old", "exchange": "new", "clean": "new", "rename": "new"}.items():
        old(target)  # what a killed build left beside it is in nobody's way
        ended = subprocess.run([sys.executable, "-c", DIES, str(target), step], check=False)
        if step == "exchange" and ended.returncode == 0:
            pytest.skip("this file system cannot exchange two folders")
        assert ended.returncode == (0 if step == "rename" else -signal.SIGKILL), f"{step}: a rename moves nothing away"
        assert verify(target) == [], step
        assert (target / "a.md").read_text() == left, step
        assert has_mine(target), step
    old(target)
    assert not (target / "c.md").exists()


def test_where_folders_cannot_change_places_they_are_renamed(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another system, or a C library that does not know the call; if the second rename fails, the first is undone."""
    with monkeypatch.context() as patch:
        patch.setattr(ctypes, "CDLL", lambda _: object())
        write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    assert listed(target) == ["a.md", "deep", "deep/mine.txt", "empty", "link", "manifest.json", "notes.txt"]
    rename = os.rename

    def failing(one: Path, other: Path) -> None:
        if Path(one).name == "new":
            raise OSError(5, "Input/output error")
        rename(one, other)

    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(os, "rename", failing)
    with pytest.raises(JumpcadError, match="Input/output error"):
        old(target)
    assert (target / "a.md").read_text() == "new"
    assert has_mine(target)
    assert listed(target.parent)[0] == "robot", "nothing is left beside it"


def test_what_a_user_added_stays_as_it_is(target: Path) -> None:
    os.mkfifo(target / "pipe")
    (target / "album").mkdir()
    for name in ("locked", "album/photo.jpg"):
        (target / name).write_text("mine")
        os.utime(target / name, (1e9, 1e9))
    (target / "locked").chmod(0)
    os.utime(target / "album", (1e9, 1e9))
    (target / "album").chmod(0o555)
    target.chmod(0o750)
    mine = ("pipe", "locked", "album", "album/photo.jpg", "link", "notes.txt", "deep/mine.txt", "empty")
    before = {path: (target / path).lstat() for path in mine}
    write_folder(target, "robot", {}, {"b.md": "new"}.items())
    for path, was in before.items():
        now = (target / path).lstat()
        assert (now.st_mode, now.st_mtime_ns) == (was.st_mode, was.st_mtime_ns), path
    assert target.stat().st_mode & 0o777 == 0o750
    assert has_mine(target)
    assert {*listed(target)} == {*mine, "b.md", "deep", "manifest.json"}
    assert unlisted(target) == sorted(set(mine) - {"album"})
    assert [path.name for path in target.parent.iterdir()] == ["robot"]


def test_where_there_are_no_hard_links_files_are_copied(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: object, **__: object) -> None:
        raise OSError(number, "not permitted")

    os.utime(target / "notes.txt", (1e9, 1e9))
    monkeypatch.setattr(os, "link", none)
    number = errno.EXDEV  # it could not be moved away with the rest in one step
    with pytest.raises(JumpcadError, match=r"robot/.* lies on another disk"):
        old(target)
    number = errno.EPERM
    old(target)
    assert has_mine(target)
    assert (target / "notes.txt").stat().st_mtime == 1e9
    os.mkfifo(target / "pipe")
    with pytest.raises(JumpcadError, match=r"pipe: cannot be kept .*move it away"):
        old(target)
    assert verify(target) == []
    assert (target / "pipe").is_fifo()
    assert [path.name for path in target.parent.iterdir()] == ["robot"]


def test_what_appears_during_the_write_is_not_lost(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where an edited file is as long as before."""
    whole = atomic_write.exchanged

    def late(fresh: Path, there: Path) -> bool:
        (there / "late.txt").write_text("mine")
        (there / "a.md").write_text("mew")
        os.utime(there / "a.md", (1e9, 1e9))
        return whole(fresh, there)

    monkeypatch.setattr(atomic_write, "exchanged", late)
    with pytest.raises(JumpcadError, match="is written, but what was changed in it meanwhile is in") as error:
        write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    left = Path(str(error.value).split(" is in ")[1])
    assert (left / "late.txt").read_text() == "mine"
    assert (left / "a.md").read_text() == "mew"


def test_what_appears_under_a_name_that_is_written_is_not_lost(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = atomic_write._replaceable

    def late(*arguments: Any) -> dict[str, atomic_write.Stamp]:
        found = whole(*arguments)
        (target / "c.md").write_text("mine")
        return found

    monkeypatch.setattr(atomic_write, "_replaceable", late)
    with pytest.raises(JumpcadError, match="was changed in it meanwhile is in") as error:
        write_folder(target, "robot", {}, {"c.md": "new"}.items())
    assert Path(str(error.value).split(" is in ")[1], "c.md").read_text() == "mine"


def test_what_would_be_lost_is_named_and_replaced_only_by_force(tmp_path: Path) -> None:
    target = tmp_path / "robot"
    old(target)
    (target / "a.md").write_text("edited")  # will be written
    (target / "deep" / "b.md").write_text("edited")  # would go
    (target / "c.md").write_text("mine")  # added under a name that will be written
    (target / "same.svg").write_text("new")  # nothing is lost
    new = {"a.md": "new", "c.md": "new", "same.svg": "new"}
    with pytest.raises(JumpcadError, match=r"robot: a\.md, c\.md, deep/b\.md: edited or added .* --force$"):
        write_folder(target, "robot", {}, new.items())
    assert [(target / name).read_text() for name in ("a.md", "deep/b.md", "c.md")] == ["edited", "edited", "mine"]
    more = new | {"d1.md": "new", "d2.md": "new"}
    for name in ("d1.md", "d2.md"):
        (target / name).write_text("mine")
    with pytest.raises(JumpcadError, match=r"a\.md, c\.md, d1\.md and 2 more: edited"):
        write_folder(target, "robot", {}, more.items())
    write_folder(target, "robot", {}, new.items(), force=True)
    assert listed(target) == ["a.md", "c.md", "d1.md", "d2.md", "manifest.json", "same.svg"]


def test_what_is_no_plain_file_is_never_replaced_or_followed(tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "b.md").write_text("old")
    things = {"link": lambda p: p.symlink_to("../outside/b.md"), "folder": Path.mkdir, "fifo": os.mkfifo}
    for name, make in things.items():
        target = tmp_path / name
        old(target)
        (target / "a.md").unlink()
        make(target / "a.md")
        refuses(target, {"a.md": "new", "deep/b.md": "new"})
    target = tmp_path / "folder for a link"
    old(target)
    (target / "deep" / "b.md").unlink()
    (target / "deep").rmdir()
    (target / "deep").symlink_to("../outside")
    refuses(target, {"a.md": "new", "deep/b.md": "new"})
    write_folder(target, "robot", {}, {"a.md": "new"}.items())  # not through the link, of which the new one has nothing
    assert (target / "deep").is_symlink()
    assert (outside / "b.md").read_text() == "old"


def refuses(target: Path, new: dict[str, str]) -> None:
    before = listed(target)
    for force in (False, True):
        with pytest.raises(JumpcadError, match=r"must be a (plain file|folder); move it away"):
            write_folder(target, "robot", {}, new.items(), force)
    assert listed(target) == before


def test_what_is_no_bundle_is_not_written_into(tmp_path: Path) -> None:
    forged = '{"format": 1, "name": "x", "versions": {}, "files": {"../a": ""}}'
    for number, text in enumerate(('{"name": "PWA"}', forged, "")):
        target = tmp_path / str(number)
        (target / "src").mkdir(parents=True)
        (target / ("manifest.json" if text else "cat.jpg")).write_text(text)
        (target / "src" / "thesis.md").write_text("years of work")
        before = listed(target)
        for force in (False, True):
            with pytest.raises(JumpcadError, match=r"\d: holds files,? but .* not a bundle"):
                write_folder(target, "robot", {}, {"a.md": "new"}.items(), force)
        assert listed(target) == before


def test_one_bundle_is_not_turned_into_another_unasked(tmp_path: Path) -> None:
    target = tmp_path / "robot"
    write_folder(target, "frog", {"bodies": {}}, {"a.md": "frog"}.items())
    (target / "notes.txt").write_text("mine")
    for name, facts in (("toad", {"bodies": {}}), ("coupon", {}), ("frog", {})):
        with pytest.raises(JumpcadError, match=r"robot: holds the robot frog, not the .* or replace it with --force"):
            write_folder(target, name, facts, {"a.md": "other"}.items())
    assert (target / "a.md").read_text() == "frog"
    write_folder(target, "coupon", {}, {"b.md": "coupon"}.items(), force=True)
    assert listed(target) == ["b.md", "manifest.json", "notes.txt"]


def test_the_current_folder_keeps_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "robot" / "deep").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "robot" / "deep")
    for folder in (".", "..", tmp_path / "robot"):
        with pytest.raises(JumpcadError, match="is or holds the current folder"):
            old(Path(folder))
    assert listed(tmp_path) == ["robot", "robot/deep"]


def test_some_files_are_changed_and_all_others_stay(target: Path) -> None:
    (target / "deep" / "b.md").write_text("edited")
    bundle = change_files(open_bundle(target), {"a.md": "new", "pictures/c.png": b"new"}, {"slicer": "2"})
    assert verify(target) == ["deep/b.md: changed"]
    assert bundle.files == ("a.md", "deep/b.md", "pictures/c.png")
    assert bundle.manifest["versions"]["slicer"] == "2"
    assert (target / "deep" / "b.md").read_text() == "edited"
    assert has_mine(target)
    with pytest.raises(JumpcadError, match=r"deep/b\.md: edited or added"):
        require_unedited(bundle, ["a.md", "deep/b.md"])
    with pytest.raises(JumpcadError, match=r"deep/b\.md: edited or added"):
        change_files(bundle, {"deep/b.md": "new"}, {})
    assert has_mine(target)


def test_what_is_written_can_be_read_again(tmp_path: Path) -> None:
    """A file that no manifest may list is refused, with what an exporter's author does."""
    for path in ("usd/robot.usda", "notes.txt", ".hidden.md", "../outside.md"):
        with pytest.raises(JumpcadError, match=r"SUFFIXES of jumpcad/bundle/manifest\.py"):
            write_folder(tmp_path / "robot", "robot", {}, {"a.md": "fine", path: "new"}.items())
        assert not (tmp_path / "robot").exists(), path


def test_a_manifest_that_lists_what_jumpcad_never_writes_is_none(tmp_path: Path) -> None:
    """A stranger's manifest may know the content of a user's file; it would be removed as one of the old bundle's."""
    target = tmp_path / "robot"
    old(target)
    manifest = json.loads((target / "manifest.json").read_text())
    for path in (".git/HEAD", "src/__init__.py", "LICENSE", "stl/.hidden.stl"):
        mine = target / path
        mine.parent.mkdir(parents=True, exist_ok=True)
        mine.write_bytes(b"")
        files = manifest["files"] | {path: hashlib.sha256(b"").hexdigest()}
        (target / "manifest.json").write_text(json.dumps(manifest | {"files": files}))
        with pytest.raises(JumpcadError, match="manifest"):
            old(target)
        assert mine.exists(), path


def test_a_folder_is_made_with_its_parents(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside its place, on the same disk, whatever becomes of the system's folder for temporary files."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "gone"))
    write_folder(tmp_path / "a" / "deep" / "robot", "robot", {}, {"b/c/d.md": "new", "b/e.md": "new"}.items())
    assert verify(tmp_path / "a" / "deep" / "robot") == []
    assert [path.name for path in (tmp_path / "a" / "deep").iterdir()] == ["robot"]
