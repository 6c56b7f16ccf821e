"""What is written is whole or not there, and nothing of a user's is replaced unasked."""

import errno
import io
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image
from support.each import each
from support.elsewhere import environment

from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import (
    real_path,
    require_free,
    require_path,
    require_target,
    require_writable,
    sealed,
    sealed_png,
    write_atomically,
    write_files,
)


def test_text_and_bytes_are_written_as_they_are(tmp_path: Path) -> None:
    write_atomically(tmp_path / "text", "é\r\n")
    write_atomically(tmp_path / "bytes", b"\x00\r\n")
    assert (tmp_path / "text").read_bytes() == b"\xc3\xa9\r\n"
    assert (tmp_path / "bytes").read_bytes() == b"\x00\r\n"
    assert sorted(os.listdir(tmp_path)) == ["bytes", "text"]


@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_is_as_open_as_the_umask_says(tmp_path: Path, mask: int, mode: int) -> None:
    before = os.umask(mask)
    try:
        write_atomically(tmp_path / "p.toml", "")
    finally:
        os.umask(before)
    assert (tmp_path / "p.toml").stat().st_mode & 0o777 == mode


FULL = """
import resource, signal, sys
from pathlib import Path
from jumpcad.errors import JumpcadError
from jumpcad.files.outputs import write_atomically, write_files
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
for write in (lambda: write_atomically(Path("old"), "new" * 1000),
              lambda: write_files(Path("there"), {"old": b"n", "big": b"n" * 3000, "new": b"n"}),
              lambda: write_files(Path("fresh"), {"small": b"n", "big": b"n" * 3000})):
    try:
        write()
    except JumpcadError as error:
        print(error)
"""


@pytest.mark.skipif(os.name != "posix", reason="the size of files is limited as POSIX has it")
def test_a_full_disk_leaves_the_old_files_and_nothing_else(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    for name in ("old", "there/old"):
        (tmp_path / name).write_text("old")
    path = os.pathsep.join(sys.path)
    done = subprocess.run(
        [sys.executable, "-c", FULL], cwd=tmp_path, capture_output=True, text=True, env=environment(PYTHONPATH=path)
    )
    assert [line.split(":")[0] for line in done.stdout.splitlines()] == ["old", "there/big", "fresh/big"], done.stderr
    left = {str(file.relative_to(tmp_path)): file.read_text() for file in tmp_path.rglob("*") if file.is_file()}
    assert left == {"old": "old", "there/old": "old"}
    assert not (tmp_path / "fresh").exists()


def test_an_interrupt_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "link", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_atomically(tmp_path / "new" / "newer" / "p.toml", "new\n")
    assert os.listdir(tmp_path) == []


@each("links", [True, False])
@each("second", ["old", "new", "newer"])
def test_all_files_are_written_or_none(tmp_path: Path, second: str, links: bool) -> None:
    """Also where the last of them cannot be put in its place, or was made by the user meanwhile."""
    before = {"a": sealed("a\n"), "old": sealed("b\n")}
    folder = tmp_path / f"{second}{links}"
    write_files(folder, before)

    def refused(*_: object) -> None:
        raise OSError(errno.EIO, "Input/output error")

    def replace(source: Path, target: Path) -> None:
        if target.name == second and source.read_bytes() == b"z":
            refused()
        os.rename(source, target)

    def link(source: Path, target: Path) -> None:
        if target.name == "newer":
            target.write_text("mine")
        if not links or (target.name == second and second != "newer"):
            refused()
        real_link(source, target)

    real_link = os.link
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "link", link)
        patch.setattr(os, "replace", replace)
        with pytest.raises(JumpcadError, match="File exists" if second == "newer" else "Input/output error"):
            write_files(folder, {"a": "y", "fresh": "y", second: "z"})
    left = {file.name: file.read_text() for file in folder.iterdir()}
    assert left == before | ({"newer": "mine"} if second == "newer" else {})


def test_files_of_users_are_not_replaced_unasked(tmp_path: Path) -> None:
    file, link, folder = (tmp_path / f"{name}.toml" for name in ("file", "link", "folder"))
    require_free(file)
    file.write_text("mine")
    link.symlink_to("file.toml")
    folder.mkdir()
    with pytest.raises(JumpcadError, match=r"file\.toml: exists already; choose another name, or replace it with --f"):
        require_free(file)
    require_free(file, force=True)
    for path in (link, folder):
        with pytest.raises(JumpcadError, match="is no plain file; choose another name"):
            require_free(path, force=True)


@pytest.mark.parametrize("comment", ["# {}", "<!-- {} -->"])
def test_a_sealed_file_is_known_until_it_is_edited(tmp_path: Path, comment: str) -> None:
    file = tmp_path / "best.toml"
    text = sealed("a = 1\nb = 2\n", comment)
    file.write_text(text)
    require_free(file)
    for edited in (text.replace("1", "3", 1), text + "c = 3\n", "c = 3\n" + text, "a = 1\nb = 2\n", ""):
        assert edited != text
        file.write_text(edited)
        with pytest.raises(JumpcadError, match="exists already"):
            require_free(file)


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(JumpcadError, match="file: cannot be written"):
        write_files(tmp_path / "file", {"a": b""})


@pytest.mark.skipif(sys.platform != "linux", reason="nobody, not even root, makes a file in /proc")
def test_a_folder_that_takes_no_file_is_known_beforehand(tmp_path: Path) -> None:
    for folder in ("/proc", "/proc/new/newer"):
        with pytest.raises(JumpcadError, match=f"^{folder}: cannot be written: no file can be made in /proc "):
            require_writable(Path(folder))
    with pytest.raises(JumpcadError, match="no file can be made in /proc "):
        require_target(Path("/proc/x.toml"), (".toml",))
    (tmp_path / "file").write_text("mine")
    with pytest.raises(JumpcadError, match=r"no file can be made in .*file \(Not a directory\)"):
        require_writable(tmp_path / "file")
    (tmp_path / "nowhere").symlink_to("gone")  # no folder can be made in its place
    with pytest.raises(JumpcadError, match=r"no file can be made in .*nowhere \("):
        require_writable(tmp_path / "nowhere" / "new")
    require_writable(tmp_path / "new" / "newer")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "nowhere"]


def test_a_sealed_png_is_a_png_and_is_replaced_until_somebody_edits_it(tmp_path: Path) -> None:
    stream = io.BytesIO()
    Image.new("RGB", (8, 8), "red").save(stream, "PNG")
    path = tmp_path / "a.png"
    path.write_bytes(sealed_png(stream.getvalue()))
    read = Image.open(path)
    read.load()
    assert read.getpixel((0, 0)) == (255, 0, 0)
    require_free(path)
    path.write_bytes(sealed_png(sealed_png(stream.getvalue())))  # a picture that jumpcad took and wrote again
    require_free(path)
    for mine in (stream.getvalue(), path.read_bytes().replace(b"IDAT", b"IDAt", 1), b"", b"mine"):
        path.write_bytes(mine)
        with pytest.raises(JumpcadError, match="exists already"):
            require_free(path)


def test_a_path_that_no_file_can_have_is_refused_in_words(tmp_path: Path) -> None:
    """Too long a name as the system says it, without a number or the name once more; a NUL in our own words."""
    for path, words in {
        "a\ud800.toml": "U+D800 cannot be part of a file's name",
        "\udfff/b.toml": "U+DFFF cannot be part of a file's name",
        "\0": "it has a NUL",
        "folder/\0.toml": "it has a NUL",
        "f/" * 300: "it has more than 200 folders",
        "CON": "CON is a device on Windows; choose another name",
        "nul.x/robot.toml": "nul.x is a device on Windows; choose another name",
    }.items():
        with pytest.raises(JumpcadError, match=f"cannot be a path: {re.escape(words)}$"):
            require_path(Path(path))
    assert real_path(tmp_path / "a" / ".." / "b") == tmp_path.resolve() / "b"
    for path, words in {"x" * 300: "^x{300}: cannot be a path: File name too long$", "a\0b": "it has a NUL$"}.items():
        with pytest.raises(JumpcadError, match=words):
            real_path(path)
