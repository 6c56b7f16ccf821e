"""Only jumpcad's own manifests are accepted; no path in one leads out of its folder, and no link is followed."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
import typer
from support.places import ROOT

from jumpcad.bundle.atomic_write import write_folder
from jumpcad.bundle.manifest import Bundle, kept_design, kept_workshop, open_bundle, unlisted, verify
from jumpcad.cli.bundle import verify as verify_command
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop

SHA = "0" * 64
GOOD = {"format": 1, "name": "frog", "versions": {"jumpcad": "0.1.0"}, "files": {"a/b.md": SHA}}
LINE = {"kind": "printed", "name": "foot", "quantity": 1, "material": "PLA", "mass_kg": 0.1, "source": "printed"}


def refused(folder: Path, text: str | bytes) -> str:
    """Return the one line that rejects a manifest."""
    (folder / "manifest.json").write_bytes(text.encode() if isinstance(text, str) else text)
    with pytest.raises(JumpcadError, match=r"manifest\.json") as error:
        pytest.fail(f"accepted: {text[:200]!r} {open_bundle(folder)}")
    assert "\n" not in str(error.value)
    return str(error.value)


def test_a_manifest_of_ours_is_read_and_may_say_more(tmp_path: Path) -> None:
    more = {"masses": [LINE], "drive": {"springs": []}, "note": ["\U0001f438", 1e300]}
    (tmp_path / "manifest.json").write_text(json.dumps(GOOD | more))
    assert open_bundle(tmp_path).files == ("a/b.md",)
    assert open_bundle(tmp_path).manifest["note"] == ["\U0001f438", 1e300]
    long = {"name": "x" * 5000, "files": {"x" * 5000 + ".md": SHA, "a/" * 1500 + "b.md": SHA}}
    (tmp_path / "manifest.json").write_text(json.dumps(GOOD | long))
    assert len(verify(tmp_path)) == 2


def test_what_is_no_manifest_is_refused_in_one_line(tmp_path: Path) -> None:
    for text in (
        "", "[]", "{}", "null", "3", '"x"', "{", b"\xff\xfe", "[" * 100_000, '{"format": ' + "9" * 6000 + "}",
        json.dumps(GOOD).replace("1,", "NaN,", 1), json.dumps(GOOD) + " " * 17_000_000,
    ):  # fmt: skip
        refused(tmp_path, text)
    for change in (
        {"format": True}, {"format": "1"}, {"format": 1.0}, {"name": ""}, {"name": 3}, {"name": "../up"},
        {"name": ".."}, {"name": "a/b"}, {"name": "a\nb"}, {"name": "/dev/null"}, {"name": "\x1b[31mred"},
        {"name": "a\0b"}, {"versions": None}, {"versions": {"numpy": 2}},
        {"files": []}, {"files": {"a.md": "sha"}}, {"files": {"a.md": SHA.upper() + "g"}}, {"files": {"a.md": None}},
        {"masses": 3}, {"masses": [{}]}, {"masses": [LINE | {"mass_kg": -1.0}]}, {"masses": [LINE | {"quantity": 0}]},
        {"masses": [LINE | {"name": None}]},
    ):  # fmt: skip
        refused(tmp_path, json.dumps(GOOD | change))
    for half in ('"\\ud800"', "1e999", "-1e999", "NaN", '["\\udc00x"]', '{"\\ud800": 1}'):
        refused(tmp_path, json.dumps(GOOD)[:-1] + f', "note": {half}}}')
    assert "format 2; this version reads 1" in refused(tmp_path, json.dumps(GOOD | {"format": 2}))


def test_a_path_that_leads_out_on_any_system_or_is_none_of_ours_makes_it_none(tmp_path: Path) -> None:
    for path in (
        "", "/etc/a.md", "..", "../a.md", "a/../../b.md", "a/..", ".", "./a.md", "a//b.md", "a/",
        "a\\..\\b.md", "C:a.md", "a\nb.md", "a\x1b[2Jb.md", "a\x00b.md", "a\ud800.md", "manifest.json",
        ".git/HEAD", "a/.b.md", "a", "~/.bashrc",
    ):  # fmt: skip
        refused(tmp_path, json.dumps(GOOD | {"files": GOOD["files"] | {path: SHA}}))


def test_a_robot_without_its_loop_is_none(tmp_path: Path) -> None:
    """The URDF file is a tree; the leg's loop is closed by the other file."""
    paths = ("urdf/frog.urdf", "urdf/frog.loop.json")
    for lost in paths:
        bundle = write_folder(tmp_path / "b", "frog", {}, ((path, "x") for path in paths))
        assert bundle.urdf == tmp_path / "b" / "urdf" / "frog.urdf"
        (tmp_path / "b" / lost).unlink()
        with pytest.raises(JumpcadError, match=f"{lost}: missing; build the bundle again"):
            _ = bundle.urdf


def test_files_that_are_not_plain_are_named_and_not_opened(tmp_path: Path) -> None:
    names = ["deep/file.md", "fifo.md", "file/x.md", "folder.md", "good.md", "link.md", "none.md", "zero.md"]
    bundle = write_folder(tmp_path / "b", "frog", {}, ((name, "x") for name in names))
    (tmp_path / "outside").mkdir()
    for name in ("file.md", "link.md"):
        (tmp_path / "outside" / name).write_text("x")
    for name in set(names) - {"good.md"}:
        (bundle.folder / name).unlink()
    os.mkfifo(bundle.folder / "fifo.md")
    (bundle.folder / "folder.md").mkdir()
    (bundle.folder / "link.md").symlink_to("../outside/link.md")
    (bundle.folder / "zero.md").symlink_to("/dev/zero")
    for folder in ("deep", "file"):
        (bundle.folder / folder).rmdir()
    (bundle.folder / "deep").symlink_to("../outside")
    (bundle.folder / "file").write_text("x")
    wrong = {
        "deep/file.md": "behind a link", "fifo.md": "not a plain file", "file/x.md": "missing",
        "folder.md": "not a plain file", "link.md": "a link", "none.md": "missing", "zero.md": "a link",
    }  # fmt: skip
    assert verify(bundle.folder) == [f"{path}: {reason}" for path, reason in wrong.items()]
    for path, reason in {**wrong, "other": "not in the manifest"}.items():
        with pytest.raises(JumpcadError, match=f"b: {path}: {reason}; build the bundle again"):
            bundle.file(path)
    assert bundle.file("good.md").read_text() == "x"


def test_a_manifest_that_is_no_plain_file_is_not_opened(tmp_path: Path) -> None:
    manifest = tmp_path / "manifest.json"
    for make in (os.mkfifo, Path.mkdir, lambda path: path.symlink_to("/dev/zero"), lambda path: path.symlink_to(path)):
        make(manifest)
        with pytest.raises(JumpcadError, match="a bundle has one"):
            open_bundle(tmp_path)
        (Path.rmdir if manifest.is_dir() else Path.unlink)(manifest)
    with pytest.raises(JumpcadError, match=r"nowhere/manifest\.json: missing; a bundle has one"):
        open_bundle(tmp_path / "nowhere")


def test_a_file_that_cannot_be_read_is_wrong(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a damaged disk."""
    write_folder(tmp_path / "b", "frog", {}, [("a.md", "a"), ("b.md", "b")], False)

    def damaged(bundle: Bundle, path: str) -> str:
        if path == "a.md":
            raise OSError(5, "Input/output error")
        return ""

    monkeypatch.setattr(Bundle, "difference", damaged)
    assert verify(tmp_path / "b") == ["a.md: cannot be read (Input/output error)"]


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


def test_the_inputs_of_a_bundle_lie_in_it(tmp_path: Path) -> None:
    whole = load_workshop("default").to_toml()
    folder = write_folder(tmp_path / "b", "frog", {}, [("workshop.toml", whole), ("design.toml", "")]).folder
    assert kept_workshop(open_bundle(folder)) == load_workshop("default")
    (tmp_path / "secret.toml").write_text("x = 1")
    for line in (f'base = "{tmp_path}/secret.toml"', 'base = "../secret.toml"', 'printer = "../secret.toml"'):
        (folder / "workshop.toml").write_text(line)
        with pytest.raises(JumpcadError, match="a bundle's workshop is complete and names no other file"):
            kept_workshop(open_bundle(folder))
    (folder / "design.toml").unlink()
    (folder / "design.toml").symlink_to("../secret.toml")
    with pytest.raises(JumpcadError, match=r"design\.toml: a link"):
        kept_design(open_bundle(folder))


FILES = {"a.md": "one\ntwo\n", "deep/b.csv": "1,2\n", "c.stl": b"\0\1\n", "d.toml": "x = 1\n"}


def cloned(folder: Path, attributes: bool) -> Path:
    """Return a bundle in a clone as Git for Windows makes it, of a repository with or without our `.gitattributes`."""

    def git(*words: str) -> None:
        subprocess.run(["git", "-c", "user.name=A", "-c", "user.email=a@b", *words], check=True, cwd=folder)

    write_folder(folder / "here" / "exports" / "frog", "frog", {"bodies": {}}, FILES.items())
    if attributes:
        shutil.copy(ROOT / ".gitattributes", folder / "here")
    git("init", "-q", "here")
    git("-C", "here", "add", ".")
    git("-C", "here", "commit", "-qm", "bundle")
    git("-c", "core.autocrlf=true", "clone", "-q", "here", "there")
    return folder / "there" / "exports" / "frog"


@pytest.mark.skipif(not shutil.which("git"), reason="git is not installed")
def test_a_clone_on_windows_has_the_bundle_byte_for_byte(tmp_path: Path) -> None:
    bundle = cloned(tmp_path, attributes=True)
    assert verify(bundle) == []
    write_folder(bundle, "frog", {"bodies": {}}, {"a.md": "new"}.items())


@pytest.mark.skipif(not shutil.which("git"), reason="git is not installed")
def test_where_git_changed_line_ends_one_line_says_so_and_what_to_do(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bundle = cloned(tmp_path, attributes=False)
    with pytest.raises(typer.Exit):
        verify_command(bundle)
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("3 files: other line ends, nothing else; Git writes such line ends with core.autocrlf")
    with pytest.raises(JumpcadError, match=r"frog: a\.md, d\.toml, deep/b\.csv: other line ends.*--force$"):
        write_folder(bundle, "frog", {"bodies": {}}, {"a.md": "new"}.items())
    (bundle / "a.md").write_bytes(b"one\r\nthree\r\n")
    assert verify(bundle) == [
        "a.md: changed", "d.toml: other line ends, nothing else", "deep/b.csv: other line ends, nothing else",
    ]  # fmt: skip
    with pytest.raises(JumpcadError, match=r"a\.md.*edited or added"):
        write_folder(bundle, "frog", {"bodies": {}}, {"a.md": "new"}.items())
    write_folder(bundle, "frog", {"bodies": {}}, {"a.md": "new"}.items(), force=True)
    assert verify(bundle) == []
