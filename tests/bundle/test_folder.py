"""Nothing of a user's is lost when a bundle is written again."""

import hashlib
import json
import os
from pathlib import Path

import pytest
from support.folders import add_mine, has_mine, listed, old

from jumpcad.bundle.folder import change_files, require_unedited, write_folder
from jumpcad.bundle.manifest import open_bundle, verify
from jumpcad.errors import JumpcadError


@pytest.mark.parametrize("path", ["usd/robot.usda", "notes.txt", ".hidden.md", "../outside.md"])
def test_what_is_written_can_be_read_again(path: str, tmp_path: Path) -> None:
    """So a file that no manifest may list is refused, with what an exporter's author does."""
    with pytest.raises(JumpcadError, match=r"SUFFIXES of jumpcad/bundle/manifest\.py"):
        write_folder(tmp_path / "robot", "robot", {}, {"a.md": "fine", path: "new"}.items())
    assert not (tmp_path / "robot").exists()


@pytest.mark.parametrize("force", [False, True])
def test_what_would_be_lost_is_named_and_replaced_only_by_force(tmp_path: Path, force: bool) -> None:
    target = tmp_path / "robot"
    old(target)
    (target / "a.md").write_text("edited")  # will be written
    (target / "deep" / "b.md").write_text("edited")  # would go
    (target / "c.md").write_text("mine")  # added under a name that will be written
    (target / "same.svg").write_text("new")  # nothing is lost
    new = {"a.md": "new", "c.md": "new", "same.svg": "new"}.items()
    if force:
        write_folder(target, "robot", {}, new, force=True)
        assert listed(target) == ["a.md", "c.md", "manifest.json", "same.svg"]
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
    with pytest.raises(JumpcadError, match=r"must be a (plain file|folder); move it away"):
        write_folder(target, "robot", {}, {"a.md": "new", "deep/b.md": "new"}.items(), force)
    assert listed(target) == before
    assert (outside / "b.md").read_text() == "old"


@pytest.mark.parametrize("force", [False, True])
def test_a_folder_of_other_things_is_not_written_into(tmp_path: Path, force: bool) -> None:
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_text("meow")
    with pytest.raises(JumpcadError, match=r"photos: holds files but no manifest\.json, so it is not a bundle"):
        write_folder(tmp_path / "photos", "robot", {}, {"a.md": "new"}.items(), force=force)
    assert listed(tmp_path / "photos") == ["cat.jpg"]


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


def test_a_file_lies_as_deep_as_its_name_says(tmp_path: Path) -> None:
    write_folder(tmp_path / "robot", "robot", {}, {"a/b/c/d.md": "deep", "a/e.md": "new"}.items())
    assert (tmp_path / "robot" / "a" / "b" / "c" / "d.md").read_text() == "deep"
    assert verify(tmp_path / "robot") == []
