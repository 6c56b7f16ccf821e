"""Only jumpcad's own manifests are accepted; no path in one leads out of its folder."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from jumpcad.bundle.folder import write_folder
from jumpcad.bundle.manifest import Bundle, open_bundle, unlisted, verify
from jumpcad.errors import JumpcadError

SHA = "0" * 64
GOOD = {"format": 1, "name": "frog", "versions": {"jumpcad": "0.1.0"}, "files": {"a/b.md": SHA}}
LINE = {"kind": "printed", "name": "foot", "quantity": 1, "material": "PLA", "mass_kg": 0.1, "source": "printed"}


def refused(folder: Path, text: str | bytes) -> str:
    """Return the one line that rejects a manifest."""
    (folder / "manifest.json").write_bytes(text.encode() if isinstance(text, str) else text)
    with pytest.raises(JumpcadError, match=r"manifest\.json") as error:
        open_bundle(folder)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_a_manifest_of_ours_is_read_and_may_say_more(tmp_path: Path) -> None:
    (tmp_path / "manifest.json").write_text(json.dumps(GOOD | {"masses": [LINE], "drive": {"springs": []}}))
    assert open_bundle(tmp_path).files == ("a/b.md",)


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "{}", "null", "3", '"x"', "{", b"\xff\xfe", "[" * 100_000, '{"format": ' + "9" * 6000 + "}",
        json.dumps(GOOD).replace("1,", "NaN,", 1), json.dumps(GOOD) + " " * 17_000_000,
    ],
    ids=lambda text: repr(text[:20]),
)  # fmt: skip
def test_what_is_no_manifest_is_refused_in_one_line(tmp_path: Path, text: str | bytes) -> None:
    refused(tmp_path, text)


@pytest.mark.parametrize(
    "change",
    [
        {"format": True}, {"format": "1"}, {"format": 1.0}, {"name": ""}, {"name": 3}, {"name": "../up"},
        {"name": ".."}, {"name": "a/b"}, {"name": "a\nb"}, {"versions": None}, {"versions": {"numpy": 2}},
        {"files": []}, {"files": {"a.md": "sha"}}, {"files": {"a.md": SHA.upper() + "g"}}, {"files": {"a.md": None}},
        {"masses": 3}, {"masses": [{}]}, {"masses": [LINE | {"mass_kg": -1.0}]}, {"masses": [LINE | {"quantity": 0}]},
        {"masses": [LINE | {"name": None}]},
    ],
    ids=str,
)  # fmt: skip
def test_a_value_that_cannot_be_makes_it_none(tmp_path: Path, change: dict[str, Any]) -> None:
    refused(tmp_path, json.dumps(GOOD | change))


@pytest.mark.parametrize("text", ['"\\ud800"', "1e999", "-1e999", "NaN", '["\\udc00x"]', '{"\\ud800": 1}'])
def test_what_no_reader_of_json_has_makes_it_none_wherever_it_stands(tmp_path: Path, text: str) -> None:
    """Half of a character, a number beyond all numbers; a whole character and a large number are read."""
    refused(tmp_path, json.dumps(GOOD)[:-1] + f', "note": {text}}}')
    (tmp_path / "manifest.json").write_text(json.dumps(GOOD | {"note": ["\U0001f438", 1e300]}))
    assert open_bundle(tmp_path).manifest["note"] == ["\U0001f438", 1e300]


def test_a_file_that_cannot_be_read_is_wrong(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a damaged disk."""
    write_folder(tmp_path / "b", "frog", {}, [("a.md", "a"), ("b.md", "b")], False)

    def unchanged(bundle: Bundle, path: str) -> bool:
        if path == "a.md":
            raise OSError(5, "Input/output error")
        return True

    monkeypatch.setattr(Bundle, "is_unchanged", unchanged)
    assert verify(tmp_path / "b") == ["a.md: cannot be read (Input/output error)"]


def test_another_format_is_named(tmp_path: Path) -> None:
    assert "format 2; this version reads 1" in refused(tmp_path, json.dumps(GOOD | {"format": 2}))


@pytest.mark.parametrize(
    "path",
    [
        "", "/etc/a.md", "..", "../a.md", "a/../../b.md", "a/..", ".", "./a.md", "a//b.md", "a/",
        "a\\..\\b.md", "C:a.md",
        "a\nb.md", "a\x1b[2Jb.md", "a\x00b.md", "a\ud800.md", "manifest.json", "a/b.md/c.md",
        ".git/HEAD", "a/.b.md", "a",
    ],
    ids=repr,
)  # fmt: skip
def test_a_path_that_leads_out_makes_it_none(tmp_path: Path, path: str) -> None:
    refused(tmp_path, json.dumps(GOOD | {"files": GOOD["files"] | {path: SHA}}))


@pytest.mark.parametrize("paths", [("a/b.md", "a/b.md/c.md"), ("a/b.md/c.md", "a/b.md")])
def test_no_file_is_the_folder_of_another_whichever_is_named_first(tmp_path: Path, paths: tuple[str, ...]) -> None:
    refused(tmp_path, json.dumps(GOOD | {"files": dict.fromkeys(paths, SHA)}))


@pytest.mark.parametrize(
    ("facts", "content"),
    [
        ({"bodies": {}}, "the robot frog"),
        ({"masses": [LINE]}, "the frog"),
        ({"masses": [], "bodies": {}}, "the robot frog"),
    ],
)
def test_a_robot_has_bodies_and_a_coupon_has_masses_alone(facts: dict[str, Any], content: str) -> None:
    assert Bundle(Path("b"), GOOD | facts).content == content


@pytest.mark.parametrize("lost", ["urdf/frog.urdf", "urdf/frog.loop.json"])
def test_a_robot_without_its_loop_is_none(tmp_path: Path, lost: str) -> None:
    """The URDF file is a tree; the leg's loop is closed by the other file."""
    paths = ("urdf/frog.urdf", "urdf/frog.loop.json")
    bundle = write_folder(tmp_path / "b", "frog", {}, ((path, "x") for path in paths))
    assert bundle.urdf == tmp_path / "b" / "urdf" / "frog.urdf"
    (tmp_path / "b" / lost).unlink()
    with pytest.raises(JumpcadError, match=f"{lost}: missing; build the bundle again"):
        _ = bundle.urdf


def test_what_is_no_plain_file_is_not_opened(tmp_path: Path) -> None:
    manifest = tmp_path / "manifest.json"
    for make in (os.mkfifo, Path.mkdir, lambda path: path.symlink_to("/dev/zero"), lambda path: path.symlink_to(path)):
        make(manifest)
        with pytest.raises(JumpcadError, match="a bundle has one"):
            open_bundle(tmp_path)
        (Path.rmdir if manifest.is_dir() else Path.unlink)(manifest)
    with pytest.raises(JumpcadError, match=r"nowhere/manifest\.json: missing; a bundle has one"):
        open_bundle(tmp_path / "nowhere")


def test_files_that_are_not_plain_are_named_and_not_opened(tmp_path: Path) -> None:
    names = ["deep/file.md", "fifo.md", "folder.md", "good.md", "link.md", "zero.md"]
    bundle = write_folder(tmp_path / "b", "frog", {}, ((name, "x") for name in names))
    (tmp_path / "outside").mkdir()
    for name in ("file.md", "link.md"):
        (tmp_path / "outside" / name).write_text("x")
    for name in ("fifo.md", "folder.md", "link.md", "zero.md", "deep/file.md"):
        (bundle.folder / name).unlink()
    os.mkfifo(bundle.folder / "fifo.md")
    (bundle.folder / "folder.md").mkdir()
    (bundle.folder / "link.md").symlink_to("../outside/link.md")
    (bundle.folder / "zero.md").symlink_to("/dev/zero")
    (bundle.folder / "deep").rmdir()
    (bundle.folder / "deep").symlink_to("../outside")
    wrong = {
        "deep/file.md": "behind a link", "fifo.md": "not a plain file", "folder.md": "not a plain file",
        "link.md": "a link",
        "zero.md": "a link",
    }  # fmt: skip
    assert verify(bundle.folder) == [f"{path}: {reason}" for path, reason in wrong.items()]
    for path, reason in {**wrong, "other": "not in the manifest"}.items():
        with pytest.raises(JumpcadError, match=f"b: {path}: {reason}; build the bundle again"):
            bundle.file(path)
    assert bundle.file("good.md").read_text() == "x"


def test_what_was_added_is_named_apart_and_printable(tmp_path: Path) -> None:
    folder = write_folder(tmp_path / "b", "frog", {}, [("deep/a.md", "x")]).folder
    (folder / "deep" / "notes.txt").write_text("mine")
    (folder / "album" / "empty").mkdir(parents=True)
    (folder / "\x1b[2J").write_text("mine")
    (folder / "link").symlink_to("/")
    assert verify(folder) == []
    assert unlisted(folder) == ["\\x1b[2J", "album/empty", "deep/notes.txt", "link"]
    for name in ("a.md", "notes.txt"):
        (folder / "deep" / name).unlink()
    assert unlisted(folder) == ["\\x1b[2J", "album/empty", "link"]  # an empty folder of the bundle is its own
