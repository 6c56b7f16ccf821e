"""Faults while a command runs: full disks, locked folders, interrupts, lost workers, streams that nobody reads."""

import contextlib
import ctypes
import errno
import os
import resource
import shutil
import struct
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from support.sandbox import Sandbox

from hostile.conftest import Originals

SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--workers", "0", "--study")
CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH = 1, 2
WRITERS: dict[str, tuple[str, ...]] = {
    "new": ("new", "r.toml"),
    "build": ("build", "kenan-2.0", "--no-pictures", "-o", "there"),
    "build over": ("build", "kenan-2.0", "--no-pictures", "-o", "robot"),
    "coupon": ("coupon", "-o", "there"),
    "readings": ("coupon", "--measured", "readings.toml", "-o", "w.toml"),
    "trajectory": ("simulate", "kenan-2.0", "--capsule", "--trajectory", "t.csv"),
    "search": (*SEARCH, "s.db"),
    "table": ("study", "study.db", "--export", "t.csv"),
    "pictures": ("study", "study.db", "--plots", "there"),
    "drawings": ("render", "robot", "-o", "there"),
    "times": ("slice", "robot"),
}
"""A command for every kind of file that is written."""
LOCKED = {
    "robot/manifest.json": ("verify", "robot"),
    "robot/design.toml": ("build", "robot", "-o", "there"),
    "robot/urdf": ("simulate", "robot"),
    "readings.toml": WRITERS["readings"],
    "study.db": ("study", "study.db"),
}
"""What cannot be read, and a command that would."""


@pytest.fixture(autouse=True)
def laid(sandbox: Sandbox, originals: Originals) -> None:
    """Lay what the commands read."""
    shutil.copytree(originals.bundle, sandbox.work / "robot")
    shutil.copy(originals.study, sandbox.work / "study.db")
    sandbox.write("readings.toml", "[gauge.PETG]\naxle_press_mm = 0.1\n")


@contextlib.contextmanager
def full_disk(left: int) -> Iterator[None]:
    """Let no file grow beyond some bytes: writing on fails, in every library, as on a full disk."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (left, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


@contextlib.contextmanager
def as_anybody() -> Iterator[None]:
    """Let permissions bind this process, root or not: take its right to override them, for a while."""
    libc = ctypes.CDLL(None, use_errno=True)
    head = struct.pack("Ii", 0x20080522, 0)  # version 3 of capabilities(7), of this thread
    data = ctypes.create_string_buffer(24)
    assert libc.capget(head, data) == 0
    rights = list(struct.unpack("6I", data.raw))
    bound = [rights[0] & ~(1 << CAP_DAC_OVERRIDE | 1 << CAP_DAC_READ_SEARCH), *rights[1:]]
    assert libc.capset(head, struct.pack("6I", *bound)) == 0
    try:
        yield
    finally:
        libc.capset(head, struct.pack("6I", *rights))


FULL = [(name, 4096) for name in WRITERS if name not in ("times", "drawings", "table")] + [
    (name, 160) for name in ("new", "readings", "trajectory", "search", "table", "pictures", "drawings")
]
"""Commands and the bytes to which a file may grow: some, or fewer than any file has."""


@pytest.mark.parametrize(("command", "left"), FULL)
def test_a_full_disk_leaves_all_or_nothing(sandbox: Sandbox, command: str, left: int) -> None:
    small = command == "new" and left == 4096
    logs = [f"{name}.db{log}" for name in ("s", "study") for log in ("-wal", "-shm")]  # SQLite clears them away
    leaves = ["s.db", *logs]  # from which a search goes on
    with full_disk(left):
        sandbox.run(*WRITERS[command], exits=(0,) if small else (2,), writes=["r.toml", "w.toml"], leaves=leaves)


@pytest.mark.parametrize("command", ["new", "build over", "coupon", "readings", "trajectory", "table"])
def test_a_failing_rename_leaves_all_as_it_was(sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    for name in ("replace", "rename", "link"):
        monkeypatch.setattr(os, name, fail)
    sandbox.run(*WRITERS[command], exits=(0, 2), writes=["robot"] if command == "build over" else [])


@pytest.mark.skipif(sys.platform != "linux", reason="rights of root are taken as Linux has them")
@pytest.mark.parametrize("command", WRITERS)
def test_a_locked_folder_is_said(sandbox: Sandbox, command: str) -> None:
    for folder in (sandbox.work, sandbox.work / "robot"):
        folder.chmod(0o555)
    try:
        with as_anybody():
            sandbox.run(*WRITERS[command], exits=(2,))
    finally:
        for folder in (sandbox.work, sandbox.work / "robot"):
            folder.chmod(0o755)


@pytest.mark.skipif(sys.platform != "linux", reason="rights of root are taken as Linux has them")
def test_a_study_in_a_locked_folder_is_read(sandbox: Sandbox) -> None:
    (sandbox.work / "study.db").chmod(0o444)
    sandbox.work.chmod(0o555)
    try:
        with as_anybody():
            assert sandbox.run("study", "study.db", "--json", exits=(0,)).data["evaluations"] == 6
    finally:
        sandbox.work.chmod(0o755)


@pytest.mark.skipif(sys.platform != "linux", reason="rights of root are taken as Linux has them")
@pytest.mark.parametrize("path", LOCKED)
def test_a_locked_file_is_said(sandbox: Sandbox, path: str) -> None:
    mode = (sandbox.work / path).stat().st_mode
    (sandbox.work / path).chmod(0o000)
    try:
        with as_anybody():
            done = sandbox.call(*LOCKED[path])
    finally:
        (sandbox.work / path).chmod(mode)
    sandbox.tries += 1
    assert (done.code, done.err.count("\n")) == (2, 1), done.err[-300:]


def raising(error: BaseException) -> Callable[..., Any]:
    def fail(*_: object, **__: object) -> None:
        raise error

    return fail


@pytest.mark.parametrize("place", ["jumpcad.load_design", "json.dumps", "os.fsync", "hashlib.sha256"])
@pytest.mark.parametrize("command", ["new", "build over"])
def test_an_interrupt_leaves_nothing_half(
    sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch, place: str, command: str
) -> None:
    """Where the command comes by the place at all."""
    with monkeypatch.context() as patch:
        patch.setattr(place, raising(KeyboardInterrupt()))
        done = sandbox.call(*WRITERS[command])
    sandbox.tries += 1
    assert done.code in (0, 130)
    if done.code == 130:
        assert done.err == "jumpcad: interrupted\n"
        assert not [path for path in sandbox.work.iterdir() if path.name.startswith(".")]
        assert sandbox.call("verify", "robot").code == 0


def test_a_lost_worker_is_no_lost_search(sandbox: Sandbox) -> None:
    """Workers find the trap when they load the model, in the file that every Python runs at its start."""
    sandbox.write(
        "trap/sitecustomize.py",
        "import os, signal, sys\n"
        "def hook(event, arguments):\n"
        "    loaded = event == 'import' and arguments[0] == 'jumpcad.mechanism.variants'\n"
        "    if loaded and 'loky' in ' '.join(sys.orig_argv):\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "sys.addaudithook(hook)\n",
    )
    package = Path(__file__).parents[2]
    words = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "2", "--workers", "1", "--study", "s.db")
    sandbox.process(
        *words, "--json", exits=(0, 1, 2), writes=["s.toml"], leaves=["s.db", "s.db-wal", "s.db-shm"],
        environment={"PYTHONPATH": f"{sandbox.work / 'trap'}:{package}"},
    )  # fmt: skip


LONGER = ("optimize", "ga", "--model", "capsule", "--evaluations", "120", "--study", "s.db")
PRESS = "os.kill(os.getpid(), signal.SIGINT)"


def test_a_worker_that_starts_is_not_interrupted(sandbox: Sandbox) -> None:
    """A terminal sends the signal to all processes: here each worker gets it before its first module."""
    sandbox.write(
        "trap/sitecustomize.py",
        f"import os, signal, sys\nif 'loky' in ' '.join(sys.orig_argv) and '--pipe' in sys.orig_argv: {PRESS}\n",
    )
    package = Path(__file__).parents[2]
    done = sandbox.process(
        *LONGER, "--evaluations", "24", "--workers", "1", "--json",
        exits=(0, 1), writes=["s.toml"], leaves=["s.db", "s.db-wal", "s.db-shm"],
        environment={"PYTHONPATH": f"{sandbox.work / 'trap'}:{package}"},
    )  # fmt: skip
    assert "Traceback" not in done.err
    assert "repeated" not in done.out
