"""The command line as a program: it ends at once, with its exit code and all that it has written."""

import subprocess
import sys
from pathlib import Path

import pytest

LEAK = (
    "import atexit, ctypes, sys; from manifold3d import CrossSection; "
    "ctypes.pythonapi.Py_IncRef(ctypes.py_object(CrossSection.square((1, 1))))"
)
CALL = "from jumpcad.cli import {entry}; sys.argv = ['jumpcad', *{arguments!r}]; {entry}()"


def called(entry: str, *arguments: str, before: str = "") -> subprocess.CompletedProcess[str]:
    code = f"{before or 'import sys'}; {CALL.format(entry=entry, arguments=arguments)}"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "arguments", [("--version",), ("simulate", "--help"), ("simulate", "no-such-design"), ("fly",)]
)
def test_a_program_writes_and_returns_what_main_does(arguments: tuple[str, ...]) -> None:
    program, main = called("program", *arguments), called("main", *arguments)
    assert (program.returncode, program.stdout, program.stderr) == (main.returncode, main.stdout, main.stderr)
    assert program.stdout or program.stderr


def test_libraries_count_no_leaks_at_the_end() -> None:
    assert "nanobind: leaked" in called("main", "--version", before=LEAK).stderr
    ended = called("program", "--version", before=f"{LEAK}; atexit.register(print, 'ended')")
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout.splitlines()[1:] == ["ended"]  # what others ask for at the end is done


def test_an_output_that_cannot_be_written_is_told_by_python() -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("no /dev/full on this system")
    before = "import atexit, sys; atexit.register(print, 'after all', end='')"
    code = f"{before}; {CALL.format(entry='program', arguments=['--version'])}"
    with full.open("w") as output, subprocess.Popen(
        [sys.executable, "-c", code], stdout=output, stderr=subprocess.PIPE, text=True
    ) as process:  # fmt: skip
        _, errors = process.communicate()
    assert process.returncode != 0
    assert "No space left" in errors
