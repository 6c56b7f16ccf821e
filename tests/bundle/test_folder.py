"""Nothing of a user's is lost when a bundle is written again."""

import os
from pathlib import Path

import pytest
from support.folders import add_mine, has_mine, listed, old

from jumpcad.bundle.folder import change_files, require_unedited, write_folder
from jumpcad.bundle.manifest import open_bundle, verify
from jumpcad.errors import JumpcadError


@pytest.mark.parametrize("force", [False, True])
def test_what_would_be_lost_is_named_and_replaced_only_by_force(tmp_path: Path, force: bool) -> None:
    target = tmp_path / "robot"
    old(target)
    (target / "a.txt").write_text("edited")  # will be written
    (target / "deep" / "b.txt").write_text("edited")  # would go
    (target / "c.txt").write_text("mine")  # added under a name that will be written
    (target / "same.txt").write_text("new")  # nothing is lost
    new = {"a.txt": "new", "c.txt": "new", "same.txt": "new"}.items()
    if force:
        write_folder(target, "robot", {}, new, force=True)
        assert listed(target) == ["a.txt", "c.txt", "manifest.json", "same.txt"]
        return
    with pytest.raises(JumpcadError, match=r"robot: a\.txt, c\.txt, deep/b\.txt: edited or added .* --force$"):
        write_folder(target, "robot", {}, new)
    assert [(target / name).read_text() for name in ("a.txt", "deep/b.txt", "c.txt")] == ["edited", "edited", "mine"]


def test_of_many_files_the_first_are_named(tmp_path: Path) -> None:
    names = [f"{number}.txt" for number in range(9)]
    write_folder(tmp_path / "robot", "robot", {}, ((name, "") for name in names))
    for name in names:
        (tmp_path / "robot" / name).write_text("mine")
    with pytest.raises(JumpcadError, match=r"0\.txt, 1\.txt, 2\.txt and 6 more: edited"):
        old(tmp_path / "robot")


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize("thing", ["link", "folder", "fifo", "folder for a link"])
def test_what_is_no_plain_file_is_never_replaced_or_followed(tmp_path: Path, thing: str, force: bool) -> None:
    target, outside = tmp_path / "robot", tmp_path / "outside"
    old(target)
    outside.mkdir()
    (outside / "b.txt").write_text("old")
    if thing == "folder for a link":
        (target / "deep" / "b.txt").unlink()
        (target / "deep").rmdir()
        (target / "deep").symlink_to("../outside")
    else:
        (target / "a.txt").unlink()
        make = {"link": lambda p: p.symlink_to("../outside/b.txt"), "folder": Path.mkdir, "fifo": os.mkfifo}[thing]
        make(target / "a.txt")
    before = listed(target)
    with pytest.raises(JumpcadError, match=r"is no (plain file|folder), which belongs there; move it away"):
        write_folder(target, "robot", {}, {"a.txt": "new", "deep/b.txt": "new"}.items(), force)
    assert listed(target) == before
    assert (outside / "b.txt").read_text() == "old"


def test_one_bundle_is_not_turned_into_another_unasked(tmp_path: Path) -> None:
    target = tmp_path / "robot"
    write_folder(target, "frog", {"bodies": {}}, {"a.txt": "frog"}.items())
    (target / "notes.txt").write_text("mine")
    for name, facts in (("toad", {"bodies": {}}), ("coupon", {}), ("frog", {})):
        with pytest.raises(JumpcadError, match=r"robot: holds the robot frog, not the .* or replace it with --force"):
            write_folder(target, name, facts, {"a.txt": "other"}.items())
    assert (target / "a.txt").read_text() == "frog"
    write_folder(target, "coupon", {}, {"b.txt": "coupon"}.items(), force=True)
    assert listed(target) == ["b.txt", "manifest.json", "notes.txt"]


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
        write_folder(target, "robot", {}, {"a.txt": "new"}.items(), force)
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
    (target / "deep" / "b.txt").write_text("edited")
    bundle = change_files(open_bundle(target), {"a.txt": "new", "pictures/c.png": b"new"}, {"slicer": "2"})
    assert verify(target) == ["deep/b.txt: changed"]
    assert bundle.files == ("a.txt", "deep/b.txt", "pictures/c.png")
    assert bundle.manifest["versions"]["slicer"] == "2"
    assert (target / "deep" / "b.txt").read_text() == "edited"
    assert has_mine(target)
    with pytest.raises(JumpcadError, match=r"notes\.txt: edited or added"):
        require_unedited(bundle, ["a.txt", "notes.txt"])
    with pytest.raises(JumpcadError, match=r"deep/b\.txt, notes\.txt: edited or added"):
        change_files(bundle, {"notes.txt": "new", "deep/b.txt": "new"}, {})
    assert has_mine(target)
