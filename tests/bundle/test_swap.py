"""Two folders are exchanged, or nothing is done."""

import ctypes
import os
import sys
import tempfile
from pathlib import Path

import pytest

from jumpcad.bundle.swap import exchanged


def test_what_is_not_there_changes_places_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    assert not exchanged(tmp_path / "one", tmp_path / "nothing")
    assert [path.name for path in tmp_path.iterdir()] == ["one"]


def test_two_folders_change_places_or_stay(tmp_path: Path) -> None:
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / name).write_text("")
    inside = ["other", "one"] if exchanged(tmp_path / "one", tmp_path / "other") else ["one", "other"]
    assert [path.name for folder in ("one", "other") for path in (tmp_path / folder).iterdir()] == inside


def test_names_are_relative_to_the_working_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in ("apart", "here"):
        for name in ("one", "other"):
            (tmp_path / folder / name / name).mkdir(parents=True)
    whole = exchanged(tmp_path / "apart" / "one", tmp_path / "apart" / "other")
    monkeypatch.chdir(tmp_path / "here")
    assert exchanged(Path("one"), Path("other")) == whole
    assert Path("one/other").exists() == whole


@pytest.mark.skipif(not os.access("/dev/shm", os.W_OK), reason="no folder in memory, as Linux has it")
def test_in_linux_memory_two_folders_change_places() -> None:
    """A tmpfs, which can exchange two since Linux 3.15."""
    with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
        for name in ("one", "other"):
            (Path(folder) / name / name).mkdir(parents=True)
        assert exchanged(Path(folder) / "one", Path(folder) / "other")
        assert (Path(folder) / "one" / "other").is_dir()
        assert (Path(folder) / "other" / "one").is_dir()


def test_where_the_system_cannot_exchange_nothing_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another system, or a C library that does not know the call."""
    for name in ("one", "other"):
        (tmp_path / name / name).mkdir(parents=True)
    with monkeypatch.context() as patch:
        patch.setattr(ctypes, "CDLL", lambda _: object())
        assert not exchanged(tmp_path / "one", tmp_path / "other")
    with monkeypatch.context() as patch:
        patch.setattr(sys, "platform", "darwin")
        assert not exchanged(tmp_path / "one", tmp_path / "other")
    assert (tmp_path / "one" / "one").is_dir()
