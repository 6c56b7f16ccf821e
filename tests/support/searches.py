"""Searches on the command line, with the capsule robot."""

import contextlib
import io
import json

from typer.testing import CliRunner

from jumpcad.cli import commands
from jumpcad.cli.commands import app

QUICK = ["--model", "capsule", "--workers", "0", "--settings", "screening"]
FIXED = ("carrying_link_mm=100", "c_coef=1", "d_coef=0.833", "e_coef=0.934", "ground_link_angle_deg=40")
NARROW = [word for one in FIXED for word in ("--fix", one)]
"""Three free parameters are left: pictures have a panel for each."""


def run(*arguments, code=0):
    """Return what a command prints, which must end with an exit code."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments], catch_exceptions=True)
    assert result.exit_code == code, result.output + repr(result.exception)
    return result.stdout


def data(*arguments, code=0):
    """Return the JSON document of a command."""
    return json.loads(run(*arguments, "--json", code=code))


def refusal(*arguments):
    """Return the one line on standard error with which a wrong request ends."""
    with contextlib.redirect_stderr(io.StringIO()) as said:
        assert commands.run([str(argument) for argument in arguments]) == 2
    (line,) = said.getvalue().splitlines()
    return line
