"""A bundle that Git with `core.autocrlf`, its default on Windows, has checked out."""

import shutil
import subprocess
from pathlib import Path

import pytest
import typer
from support.places import ROOT

from jumpcad.bundle.atomic_write import write_folder
from jumpcad.bundle.manifest import verify
from jumpcad.cli.bundle import verify as verify_command
from jumpcad.errors import JumpcadError

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
