"""Nothing of a user's is lost when a bundle is written again, finished or killed at any of its steps."""

import hashlib
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from jumpcad.bundle import place
from jumpcad.bundle.folder import change_files, require_unedited, write_folder
from jumpcad.bundle.manifest import open_bundle, unlisted, verify
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


def old(target: Path) -> None:
    write_folder(target, "robot", {}, {"a.md": "old", "deep/b.md": "old"}.items())


def add_mine(target: Path) -> None:
    """Add what only a user can have: a file, one between ours, an empty folder, a link to nowhere."""
    (target / "notes.txt").write_text("mine")
    (target / "deep" / "mine.txt").write_text("mine")
    (target / "empty").mkdir()
    (target / "link").symlink_to("nowhere")


def has_mine(target: Path) -> bool:
    kept = [(target / name).read_text() for name in ("notes.txt", "deep/mine.txt")]
    return kept == ["mine", "mine"] and (target / "empty").is_dir() and os.readlink(target / "link") == "nowhere"


def listed(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


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


@pytest.mark.parametrize("force", [False, True])
def test_what_would_be_lost_is_named_and_replaced_only_by_force(tmp_path: Path, force: bool) -> None:
    target = tmp_path / "robot"
    old(target)
    (target / "a.md").write_text("edited")  # will be written
    (target / "deep" / "b.md").write_text("edited")  # would go
    (target / "c.md").write_text("mine")  # added under a name that will be written
    (target / "same.txt").write_text("new")  # nothing is lost
    new = {"a.md": "new", "c.md": "new", "same.txt": "new"}.items()
    if force:
        write_folder(target, "robot", {}, new, force=True)
        assert listed(target) == ["a.md", "c.md", "manifest.json", "same.txt"]
        return
    with pytest.raises(JumpcadError, match=r"robot: a\.md, c\.md, deep/b\.md: edited or added .* --force$"):
        write_folder(target, "robot", {}, new)
    assert [(target / name).read_text() for name in ("a.md", "deep/b.md", "c.md")] == ["edited", "edited", "mine"]


def test_of_many_files_the_first_are_named(tmp_path: Path) -> None:
    names = [f"{number}.md" for number in range(9)]
    write_folder(tmp_path / "robot", "robot", {}, ((name, "") for name in names))
    for name in names:
        (tmp_path / "robot" / name).write_text("mine")
    with pytest.raises(JumpcadError, match=r"0\.md, 1\.md, 2\.md and 6 more: edited"):
        old(tmp_path / "robot")


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize("thing", ["link", "folder", "fifo", "folder for a link"])
def test_what_is_no_plain_file_is_never_replaced_or_followed(tmp_path: Path, thing: str, force: bool) -> None:
    target, outside = tmp_path / "robot", tmp_path / "outside"
    old(target)
    outside.mkdir()
    (outside / "b.md").write_text("old")
    if thing == "folder for a link":
        (target / "deep" / "b.md").unlink()
        (target / "deep").rmdir()
        (target / "deep").symlink_to("../outside")
    else:
        (target / "a.md").unlink()
        make = {"link": lambda p: p.symlink_to("../outside/b.md"), "folder": Path.mkdir, "fifo": os.mkfifo}[thing]
        make(target / "a.md")
    before = listed(target)
    with pytest.raises(JumpcadError, match=r"is no (plain file|folder), which belongs there; move it away"):
        write_folder(target, "robot", {}, {"a.md": "new", "deep/b.md": "new"}.items(), force)
    assert listed(target) == before
    assert (outside / "b.md").read_text() == "old"


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


@pytest.mark.parametrize(
    "text", ['{"name": "PWA"}', '{"format": 1, "name": "x", "versions": {}, "files": {"../a": ""}}']
)
@pytest.mark.parametrize("force", [False, True])
def test_a_manifest_of_something_else_makes_no_bundle(tmp_path: Path, text: str, force: bool) -> None:
    target = tmp_path / "site"
    (target / "src").mkdir(parents=True)
    (target / "manifest.json").write_text(text)
    (target / "src" / "thesis.md").write_text("years of work")
    with pytest.raises(JumpcadError, match="site: holds files, but is not a bundle"):
        write_folder(target, "robot", {}, {"a.md": "new"}.items(), force)
    assert listed(target) == ["manifest.json", "src", "src/thesis.md"]


def test_the_current_folder_keeps_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "robot" / "deep").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "robot" / "deep")
    for folder in (".", "..", tmp_path / "robot"):
        with pytest.raises(JumpcadError, match="is or holds the current folder"):
            old(Path(folder))
    assert listed(tmp_path) == ["robot", "robot/deep"]


def test_what_appears_during_the_write_is_not_lost(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot"
    old(target)
    whole = place.exchanged

    def late(fresh: Path, there: Path) -> bool:
        (there / "late.txt").write_text("mine")
        (there / "a.md").write_text("edited late")
        return whole(fresh, there)

    monkeypatch.setattr(place, "exchanged", late)
    with pytest.raises(JumpcadError, match="is written, but what was changed in it meanwhile is in") as error:
        write_folder(target, "robot", {}, {"a.md": "new"}.items())
    assert verify(target) == []
    left = Path(str(error.value).split(" is in ")[1])
    assert listed(left) == ["a.md", "late.txt"]
    assert (left / "a.md").read_text() == "edited late"


def test_some_files_are_changed_and_all_others_stay(tmp_path: Path) -> None:
    target = tmp_path / "robot"
    old(target)
    add_mine(target)
    (target / "deep" / "b.md").write_text("edited")
    bundle = change_files(open_bundle(target), {"a.md": "new", "pictures/c.png": b"new"}, {"slicer": "2"})
    assert verify(target) == ["deep/b.md: changed"]
    assert bundle.files == ("a.md", "deep/b.md", "pictures/c.png")
    assert bundle.manifest["versions"]["slicer"] == "2"
    assert (target / "deep" / "b.md").read_text() == "edited"
    assert has_mine(target)
    with pytest.raises(JumpcadError, match=r"notes\.txt: edited or added"):
        require_unedited(bundle, ["a.md", "notes.txt"])
    with pytest.raises(JumpcadError, match=r"deep/b\.md, notes\.txt: edited or added"):
        change_files(bundle, {"notes.txt": "new", "deep/b.md": "new"}, {})
    assert has_mine(target)


def test_what_is_not_there_changes_places_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    assert not exchanged(tmp_path / "one", tmp_path / "nothing")
    assert [path.name for path in tmp_path.iterdir()] == ["one"]


@pytest.mark.parametrize("path", [".git/HEAD", "src/__init__.py", "LICENSE", "stl/.hidden.stl"])
def test_a_manifest_that_lists_what_jumpcad_never_writes_is_none(path: str, tmp_path: Path) -> None:
    """A stranger's manifest may know the content of a user's file; it would be removed as one of the old bundle's."""
    target = tmp_path / "robot"
    old(target)
    mine = target / path
    mine.parent.mkdir(parents=True, exist_ok=True)
    mine.write_bytes(b"")
    manifest = json.loads((target / "manifest.json").read_text())
    manifest["files"][path] = hashlib.sha256(b"").hexdigest()
    (target / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(JumpcadError, match="manifest"):
        old(target)
    assert mine.exists()
