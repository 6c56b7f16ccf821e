"""The command line as a program: it ends at once, with its exit code and all that it has written."""

import subprocess
import sys

import pytest

LEAK = (
    "import atexit, ctypes, sys; from manifold3d import CrossSection; "
    "ctypes.pythonapi.Py_IncRef(ctypes.py_object(CrossSection.square((1, 1))))"
)
CALL = "from jumpcad.cli import {entry}; sys.argv = ['jumpcad', *{arguments!r}]; {entry}()"


def called(entry: str, *arguments: str, before: str = "") -> subprocess.CompletedProcess[str]:
    code = f"{before or 'import sys'}; {CALL.format(entry=entry, arguments=arguments)}"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("code", "arguments"),
    [(0, ("--version",)), (0, ("simulate", "--help")), (2, ("simulate", "no-such-design")), (2, ("fly",))],
)
def test_a_program_writes_and_returns_what_main_does(code: int, arguments: tuple[str, ...]) -> None:
    program, main = called("program", *arguments), called("main", *arguments)
    assert (program.returncode, program.stdout, program.stderr) == (main.returncode, main.stdout, main.stderr)
    assert program.returncode == code
    assert program.stdout or program.stderr


def test_libraries_count_no_leaks_at_the_end() -> None:
    assert "nanobind: leaked" in called("main", "--version", before=LEAK).stderr
    assert called("program", "--version", before=LEAK).stderr == ""


SWALLOWED = """
from jumpcad.cli import commands, main
from jumpcad.interrupts import seen
commands.run = lambda arguments: seen.append(2) or 0
try:
    main()
except SystemExit as end:
    print(end.code, seen)
"""


def test_an_interrupt_counts_for_its_own_command_only() -> None:
    """Also one that a library took for its own; what the process does next is not interrupted by it."""
    done = subprocess.run([sys.executable, "-c", SWALLOWED], capture_output=True, text=True, check=True)
    assert done.stdout == "130 []\n"
    assert "interrupted" in done.stderr
