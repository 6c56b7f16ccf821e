"""`jumpcad new`: a copy of a template, and nothing replaced unasked."""

import os
from pathlib import Path

from support.commands import Run

from jumpcad.design import load_design


def test_new_writes_a_copy_that_can_be_loaded(run: Run, tmp_path: Path) -> None:
    code, out, err = run("new", "frog.toml", "--from", "best-bo")
    assert (code, err) == (0, "")
    assert out.startswith("frog.toml: a copy of best-bo")
    assert load_design(tmp_path / "frog.toml") == load_design("best-bo")


def test_new_keeps_what_is_there(run: Run, tmp_path: Path) -> None:
    (tmp_path / "frog.toml").write_text("mine")
    code, _, err = run("new", "frog.toml")
    assert code == 2
    assert "exists already" in err
    assert (tmp_path / "frog.toml").read_text() == "mine"


def test_a_new_file_is_as_open_as_the_umask_says(run: Run, tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        assert run("new", tmp_path / "a.toml")[0] == 0
    finally:
        os.umask(before)
    assert (tmp_path / "a.toml").stat().st_mode & 0o777 == 0o640
    (tmp_path / "a.toml").write_text("mine")
    assert "a.toml: exists already" in run("new", tmp_path / "a.toml")[2]
    assert (tmp_path / "a.toml").read_text() == "mine"
    assert run("new", tmp_path / "a.toml", "--force")[0] == 0
