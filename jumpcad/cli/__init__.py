"""The command line: parses, calls, prints. Each command imports what it needs when it runs."""

import sys

import typer
from typer.exceptions import TyperException

from jumpcad.cli import bundle, check, coupon, designs, explore, optimize, reproduce, simulate, slicing, study
from jumpcad.errors import JumpcadError

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False)
for module in (designs, bundle, check, slicing, coupon, simulate, reproduce, explore, optimize, study):
    module.register(app)


@app.callback()
def jumpcad() -> None:
    """From eight numbers to a jumping robot that can be printed, simulated and trusted."""


def main() -> None:
    """Run the command line.

    Errors of the user end in one line on standard error with exit code 2 (1 where the answer is no), an interrupt in
    130; anything else is a bug and keeps its traceback.
    """
    try:
        code = app(standalone_mode=False, prog_name="jumpcad")
        sys.exit(_refuse("interrupted", 130) if code == 130 else code)  # typer turns an interrupt into 130 in silence
    except TyperException as error:
        usage = error.format_message()
        sys.exit(_refuse(f"{usage.rstrip('.')} (see jumpcad --help)", 2) if usage else 0)
    except JumpcadError as error:
        sys.exit(_refuse(str(error), error.exit_code))
    except (KeyboardInterrupt, typer.Abort):
        sys.exit(_refuse("interrupted", 130))


def _refuse(message: str, exit_code: int) -> int:
    print(f"jumpcad: {message}", file=sys.stderr)
    return exit_code
