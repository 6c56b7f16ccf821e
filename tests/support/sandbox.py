"""A user's folders with a command running in them, and the rules that hold for all arguments.

Rules: a known exit code; one line on standard error where it is 2, and nothing changed; no traceback, no control
character; strict JSON; no file made, changed or removed except where the command may write; no hang.
"""

import contextlib
import gc
import io
import logging
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import traceback
import warnings
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from support.commands import exit_code_of
from support.outputs import CONTROL, Snapshot, changes, file_faults, snapshot, strict_json

ANY = (0, 1, 2)
"""Exit codes of a request that may be good or bad; a bug's 3 is never among them."""
LONGEST = 4000
"""Largest number of characters of a message: ten clauses of a path, a key, a value and a reason."""
ALARM_S = 60
"""Time after which a command counts as hanging; none takes a tenth of it."""
MEMORY = 2**30
"""Bytes that a command may take in addition to this process's; a separate process may have four times as many."""
DECOYS = {
    "home/.bashrc": "alias ll='ls -l'\n",
    "home/.config/settings.json": "{}\n",
    "outside/precious.txt": "a user's only copy\n",
    "outside/folder/chapter.md": "# One\n",
    "report": "decoy above the current folder\n",
    "report.toml": "decoy = true\n",
    "bom.csv": "decoy\n",
    "work/notes.txt": "mine\n",
    "work/thesis/chapter.md": "# Two\n",
    "tmp/other": "of another program\n",
}


def lay_odd(path: Path, kind: str) -> None:
    """Lay a folder, a pipe, or a link to a device, to memory, to nothing or to itself where a file is looked for."""
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    else:
        target = {"device": "/dev/zero", "memory": "/proc/self/mem", "dangling": "nowhere", "loop": path.name}[kind]
        path.symlink_to(target)


class Hang(BaseException):
    """A command ran past the alarm."""


@dataclass(frozen=True)
class Outcome:
    """Exit code and output of a command."""

    code: int
    out: str
    err: str

    @property
    def data(self) -> Any:
        """What it printed, as JSON."""
        return strict_json(self.out)


class Sandbox:
    """Folders `work` (the current one), `home`, `outside` and `tmp`, each with files that nobody may touch.

    `tries` counts the commands and calls that were checked; `case` is named if one of them breaks a rule.
    """

    def __init__(self, root: Path, patch: pytest.MonkeyPatch, capture: pytest.CaptureFixture[str]) -> None:
        self.root, self.work = root, root / "work"
        self.home, self.outside, self.tmp = root / "home", root / "outside", root / "tmp"
        self.tries, self.case = 0, ""
        self._capture = capture
        self._originals: dict[str, Path] = {}
        self.furnish()
        patch.setenv("HOME", str(self.home))
        patch.setenv("TMPDIR", str(self.tmp))
        patch.setattr(tempfile, "tempdir", None)
        patch.setattr(sys, "dont_write_bytecode", True)  # on a full disk Python leaves half a file, and reads it later
        patch.setattr(logging.root, "handlers", [])  # as in a program: warnings go to standard error
        patch.chdir(self.work)

    def furnish(self) -> None:
        """Put the folders as they were at first, with copies of what was `put` there."""
        for folder in self.root.iterdir() if self.root.exists() else ():
            for old in folder.iterdir() if folder == self.work else [folder]:  # the current folder stays
                shutil.rmtree(old) if old.is_dir() and not old.is_symlink() else old.unlink()
        for name, text in DECOYS.items():
            self.write(self.root / name, text)
        for name, original in self._originals.items():
            self.put(original, name)

    def put(self, original: Path, name: str) -> Path:
        """Copy a file or folder into `work`."""
        self._originals[name] = original
        copy = shutil.copytree if original.is_dir() else shutil.copy
        return Path(copy(original, self.work / name))

    def write(self, name: str | Path, content: str | bytes) -> Path:
        """Write a file of the user, with its folders; relative names are in `work`."""
        path = self.work / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape"))
        return path

    def call(self, *arguments: str, encoding: str = "utf-8") -> Outcome:
        """Run `jumpcad ARGUMENTS` in this process, with streams as strict as a program's."""
        self._capture.readouterr()
        out, err = _stream(1, encoding, "strict"), _stream(2, encoding, "backslashreplace")
        with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings():
            patch.setattr(sys, "stdout", out)
            patch.setattr(sys, "stderr", err)
            patch.setattr(warnings, "showwarning", _show_warning)
            warnings.resetwarnings()
            warnings.simplefilter("ignore", DeprecationWarning)
            warnings.simplefilter("ignore", ResourceWarning)
            try:
                code = exit_code_of(*arguments)
            except Hang:
                raise
            except BaseException:
                code = 1  # as Python ends with what nobody caught
                traceback.print_exc(file=err)
        with contextlib.suppress(OSError, ValueError):
            out.close()
            err.close()
        said = self._capture.readouterr()
        return Outcome(code, said.out, said.err)

    def run(
        self,
        *arguments: str,
        exits: Collection[int] = ANY,
        writes: Collection[str] = (),
        keeps: Collection[str] = (),
        leaves: Collection[str] = (),
        encoding: str = "utf-8",
    ) -> Outcome:
        """Run a command in this process and check it.

        Parameters
        ----------
        exits
            Exit codes that are right.
        writes
            Files and folders in `work` that it may make or change.
        keeps
            Files and folders within those that it may not change.
        leaves
            Files and folders that it may make or change even if its exit code is 2.
        encoding
            Encoding of standard output and standard error.
        """
        with self._judged(arguments, exits, writes, keeps, leaves) as judge, bounded():
            return judge(self.call(*arguments, encoding=encoding))

    def process(
        self,
        *arguments: str,
        exits: Collection[int] = ANY,
        writes: Collection[str] = (),
        leaves: Collection[str] = (),
        program: str = "import jumpcad.__main__",
        prepare: Callable[[], None] | None = None,
        environment: dict[str, str] | None = None,
        **streams: Any,
    ) -> Outcome:
        """Run a command in a separate process and check it; `prepare` runs in it beforehand."""

        def start() -> None:
            resource.setrlimit(resource.RLIMIT_AS, (4 * MEMORY, 4 * MEMORY))
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # also where the tests run with & or nohup, which ignore it
            if prepare is not None:
                prepare()

        package = Path(__file__).parents[2]
        here = {"PYTHONPATH": str(package), "OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}
        variables = {**os.environ, **here, **(environment or {})}
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | streams
        with self._judged(arguments, exits, writes, (), leaves) as judge:
            command = [sys.executable, "-c", program, *arguments]
            done = subprocess.run(
                command, preexec_fn=start, env=variables, timeout=ALARM_S, stdin=subprocess.DEVNULL, **streams
            )
            out, err = ((said or b"").decode("utf-8", "replace") for said in (done.stdout, done.stderr))
            return judge(Outcome(done.returncode, out, err))

    @contextlib.contextmanager
    def untouched(self, writes: Collection[str] = ()) -> Iterator[None]:
        """Count what is called within as one try, and assert that it changes no file."""
        self.tries += 1
        before = snapshot(self.root)
        with bounded():
            yield
        wrong = list(changes(before, snapshot(self.root), self._places(writes), ()))
        assert not wrong, "\n".join(_shortened(wrong))

    @contextlib.contextmanager
    def _judged(
        self,
        arguments: tuple[str, ...],
        exits: Collection[int],
        writes: Collection[str],
        keeps: Collection[str],
        leaves: Collection[str],
    ) -> Iterator[Callable[[Outcome], Outcome]]:
        """Count a try, and yield a function that asserts that its outcome obeys the rules."""
        self.tries += 1
        before = snapshot(self.root)

        def judge(outcome: Outcome) -> Outcome:
            allowed = self._places([*leaves] if outcome.code == 2 else [*writes, *leaves])
            kept = self._places(keeps)
            after = snapshot(self.root)
            for generation in (1, 2):  # closes what the end of the process would close; what is young is soon seen
                if not any(changes(before, after, allowed, kept)):
                    break
                gc.collect(generation)
                after = snapshot(self.root)
            wrong = [
                *stream_faults(outcome, exits, arguments),
                *changes(before, after, allowed, kept),
                *self._fault_of_files(before, after, allowed),
            ]
            about = f"{self.case!a:.200} jumpcad {' '.join(arguments)!a:.200}:"
            assert not wrong, "\n".join([about, *_shortened(wrong)])
            return outcome

        yield judge

    def _places(self, names: Collection[str]) -> tuple[str, ...]:
        return tuple(os.path.relpath(self.work / name, self.root) for name in names)

    def _fault_of_files(self, before: Snapshot, after: Snapshot, allowed: tuple[str, ...]) -> Iterator[str]:
        """Yield what is wrong with the contents of files that were written."""
        for name, state in after.items():
            if allowed and isinstance(state.content, bytes) and before.get(name) != state:
                yield from (f"wrote {name!a}: {fault}" for fault in file_faults(Path(name).suffix, state.content))


def stream_faults(outcome: Outcome, exits: Collection[int], arguments: tuple[str, ...]) -> Iterator[str]:
    """Yield what breaks the rules in exit code and output, which may quote the arguments."""
    code, out, err = outcome.code, outcome.out, outcome.err
    lines, asked, as_json = err.splitlines(), sum(map(len, arguments)), "--json" in arguments
    if code not in exits:
        yield f"exit code {code}, not {' or '.join(map(str, exits))}: {err[-300:]!a}"
    if "Traceback" in err and code != 3:
        yield f"a traceback: {lines[-1][:200]!a}"
    elif len(lines) > 1 and code != 3:
        yield f"{len(lines)} lines on standard error: {err[:300]!a}"
    if code == 2 and not (err.startswith("jumpcad: ") and err.endswith("\n")):
        yield f"not a line of jumpcad: {err[:200]!a}"
    if len(err) > LONGEST + 2 * asked and code != 3:
        yield f"{len(err)} characters on standard error"
    for name, text in (("output", out), ("error", err)):
        if found := CONTROL.search(text):
            yield f"control character {found[0]!a} on standard {name}: {text[max(0, found.start() - 60) :][:120]!a}"
    if as_json and code in (0, 1) and (out or code == 0):
        try:
            strict_json(out)
        except ValueError as error:
            yield f"not strict JSON: {str(error)[:200]}"


@contextlib.contextmanager
def bounded() -> Iterator[None]:
    """Fail if the block hangs, and limit its memory."""

    def ring(*_: object) -> None:
        raise Hang(f"still running after {ALARM_S} s")

    limits = resource.getrlimit(resource.RLIMIT_AS)
    pages = Path("/proc/self/statm")
    if pages.exists():
        used = int(pages.read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, limits[1]))
    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(ALARM_S)
    try:
        yield
    except Hang as hang:
        raise AssertionError(str(hang)) from None
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, limits)


def _shortened(lines: list[str], count: int = 12) -> list[str]:
    return lines if len(lines) <= count else [*lines[:count], f"and {len(lines) - count} more"]


def _stream(descriptor: int, encoding: str, errors: str) -> io.TextIOWrapper:
    return io.TextIOWrapper(os.fdopen(descriptor, "wb", closefd=False), encoding, errors, write_through=True)


def _show_warning(message: Any, category: type[Warning], *_: object, **__: object) -> None:
    """Print a warning in one line."""
    print(f"{category.__name__}: {message}", file=sys.stderr)
