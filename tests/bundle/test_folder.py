"""A build killed at any of its steps leaves a whole bundle under the name, the old one or the new one."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from jumpcad.bundle import folder as folder_module
from jumpcad.bundle.folder import write_folder
from jumpcad.bundle.manifest import verify
from jumpcad.bundle.swap import exchanged

DIES = """
import os, signal, sys
from pathlib import Path
from jumpcad.bundle import folder
holder, step, turn = {"write": (Path, "write_bytes", 2), "exchange": (folder, "exchanged", 1),
                      "rename": (os, "rename", 1), "clean": (folder.shutil, "rmtree", 0)}[sys.argv[2]]
whole, calls = getattr(holder, step), 0
def dying(*arguments, **options):
    global calls
    calls += 1
    if turn == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    answer = whole(*arguments, **options)
    if calls == turn:
        os.kill(os.getpid(), signal.SIGKILL)
    return answer
setattr(holder, step, dying)
folder.write_folder(sys.argv[1], "robot", {}, {"a.txt": "new", "deep/b.txt": "new", "c.txt": "new"}.items())
"""


def old(target: Path) -> None:
    write_folder(target, "robot", {}, {"a.txt": "old", "deep/b.txt": "old"}.items())


def can_exchange(folder: Path) -> bool:
    for name in ("one", "other"):
        (folder / name).mkdir()
        (folder / name / name).write_text(name)
    return exchanged(folder / "one", folder / "other") and (folder / "one" / "other").is_file()


@pytest.mark.skipif(os.name != "posix", reason="processes are killed by a POSIX signal")
@pytest.mark.parametrize(("step", "left"), [("write", "old"), ("exchange", "new"), ("rename", "new"), ("clean", "new")])
def test_a_build_killed_at_a_step_leaves_a_whole_bundle(step: str, left: str, tmp_path: Path) -> None:
    if not can_exchange(tmp_path):
        pytest.skip("this file system cannot exchange two folders")
    target = tmp_path / "exports" / "robot"
    old(target)
    ended = subprocess.run([sys.executable, "-c", DIES, str(target), step], check=False)
    assert ended.returncode == (0 if step == "rename" else -signal.SIGKILL), "nothing is moved away by a rename"
    assert verify(target) == []
    assert (target / "a.txt").read_text() == left
    old(target)  # what a killed build left beside it is in nobody's way
    assert verify(target) == []
    assert (target / "a.txt").read_text() == "old"
    assert not (target / "c.txt").exists()


def test_where_folders_cannot_change_places_they_are_renamed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot"
    old(target)
    monkeypatch.setattr(folder_module, "exchanged", lambda *_: False)
    write_folder(target, "robot", {}, {"a.txt": "new"}.items())
    assert verify(target) == []
    assert sorted(path.name for path in target.iterdir()) == ["a.txt", "manifest.json"]
    assert [path.name for path in tmp_path.iterdir()] == ["robot"]


def test_what_is_not_there_changes_places_with_nothing(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    assert not exchanged(tmp_path / "one", tmp_path / "nothing")
    assert [path.name for path in tmp_path.iterdir()] == ["one"]
