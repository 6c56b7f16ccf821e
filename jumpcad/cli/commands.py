"""All commands, and how their errors are reported. Commands import most modules only when they run."""

import errno
import logging
import os
import sys
import traceback
from collections.abc import Sequence
from functools import cache
from importlib import import_module
from itertools import pairwise
from typing import Annotated, Any

import typer
from typer.completion import shell_complete
from typer.exceptions import TyperException

from jumpcad.cli.output import OutputClosed, complain, print_json, standard_output
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.face import __version__
from jumpcad.process import raise_if_seen

WRONG_REQUEST, BUG = 2, 3
OUTPUT_CLOSED = 141
"""Exit code that a shell gives a program ended by SIGPIPE (128 + 13)."""

_parser: Any = cache(typer.main.get_command)

COMPLETE = "_JUMPCAD_COMPLETE"
"""Variable by which a shell asks for completions."""
HELP = ["--help", "-h"]

app = typer.Typer(no_args_is_help=True, pretty_exceptions_enable=False, context_settings={"help_option_names": HELP})
COMMANDS = (
    "listing.list_names designs.new bundle.build bundle.render bundle.verify report.report check.check report.compare "
    "printing.slice_command printing.coupon simulate.simulate designs.cage designs.variants calibrate.calibrate "
    "literature.validate literature.reproduce explore.explore optimize.optimize study.study studio.studio"
)
"""Modules and functions in the order in which the help lists them; what follows a _ is no part of a command's name."""
EXAMPLES = {
    "new": "my-robot.toml --from kenan-2.0",
    "build": "my-robot.toml -o my-bundle",
    "check": "my-robot.toml --all",
    "simulate": "my-robot.toml --uncertain",
    "optimize": "--seed 0 --study jump.db -o winner.toml",
}
for module, function in (place.split(".") for place in COMMANDS.split()):
    name = function.split("_")[0]
    example = f"Example: jumpcad {name} {EXAMPLES[name]}" if name in EXAMPLES else None
    app.command(name, epilog=example)(getattr(import_module(f"jumpcad.cli.{module}"), function))


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"jumpcad {__version__}")
        raise typer.Exit


@app.callback()
def jumpcad(
    version: Annotated[
        bool, typer.Option("--version", help="Show the version and exit.", callback=_print_version, is_eager=True)
    ] = False,
) -> None:
    """From eight numbers to a jumping robot that can be printed, simulated and trusted."""


def run(arguments: Sequence[str]) -> int:
    """Run a command; return its exit code.

    0: done. A user's error is one line on standard error: 2 for a wrong request, 1 if the answer is no. Any other
    exception is a bug: 3, with its traceback. 141: the reader closed the output (`| head`).
    """
    if os.path.expanduser("~") == "~":  # a user without a home, as in containers, of whom ezdxf asks for one
        os.environ["HOME"] = os.devnull
    os.environ["MPLBACKEND"] = "agg"  # a user's may not be installed
    for name in ("COLUMNS", "LINES", "TERMINAL_WIDTH"):  # Rich fills lines up to their ends
        if len(os.environ.get(name, "")) > 3:
            os.environ[name] = "999"
    for name in ("matplotlib", "ezdxf"):
        logging.getLogger(name).setLevel(logging.ERROR)  # they warn where they cannot write a cache
    try:
        with standard_output(coloured=any(word in arguments for word in HELP)):
            return _carry_out(list(arguments))
    except OutputClosed:
        return OUTPUT_CLOSED
    except TyperException as error:
        usage = _usage(error)
        return complain(f"{usage} (see jumpcad --help)", WRONG_REQUEST) if usage else 0
    except JumpcadError as error:
        return complain(str(error), error.exit_code)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # exceptions of compiled libraries may not be derived from Exception
        raise_if_seen()  # else it is no bug
        if isinstance(error, OSError) and error.errno in (errno.EMFILE, errno.ENFILE):
            return complain("too many files are open at once: raise the limit, as with ulimit -n 256", WRONG_REQUEST)
        if isinstance(error, PermissionError) and error.filename:  # Python asks for rights also to tell what is there
            return complain(f"{os.fsdecode(error.filename)}: may not be used (permission denied)", WRONG_REQUEST)
        print(traceback.format_exc(), end="", file=sys.stderr)
        return BUG


def _usage(error: TyperException) -> str:
    """Return the error in the arguments, with the wrong value; empty if there were none and the help was printed."""
    from pydantic import ValidationError  # takes 0.05 s

    usage = error.format_message().rstrip(".")
    if isinstance(error.__cause__, ValidationError):
        return f"{usage}, not {error.__cause__.errors()[0]['input']!r}"
    return usage


def _carry_out(arguments: list[str]) -> int:
    """Parse and run; not with `app()`, which has other exit codes for interrupts and closed outputs."""
    try:
        os.getcwd()
    except OSError:
        raise JumpcadError("the current folder was deleted, or may not be entered: change into another one") from None
    command = _parser(app)
    if asked := os.environ.get(COMPLETE):
        return shell_complete(command, {}, "jumpcad", COMPLETE, asked)
    for option, value in pairwise(arguments):
        if option.startswith("-") and not value:  # else it would be the current folder, or as if not given
            raise JumpcadError(f"{option} '': its value is empty: give one, or leave {option} out")
    try:
        try:
            context = command.make_context("jumpcad", arguments)
        except SystemExit as end:  # the options of completion end the program themselves
            return int(end.code or 0)
        with context:
            command.invoke(context)
    except typer.Exit as end:
        return end.exit_code
    except CannotBuildError as error:
        if "--json" in arguments:
            refused = {"limit": error.limit, "margin": error.margin, "unit": error.unit}
            print_json({"verdict": "cannot_build", "message": str(error)} | (refused if error.limit else {}))
        raise
    return 0
