"""Output of commands: one JSON document for programs, text for people, one line for errors.

Control characters, which names of files may have, are printed escaped, and no text is read as markup.
"""

import contextlib
import json
import math
import os
import shlex
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from threading import Event, Thread
from typing import TYPE_CHECKING, Annotated, Any, TextIO

import typer

from jumpcad.errors import JumpcadError, without_controls

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

JsonFlag = Annotated[bool, typer.Option("--json", help="Print one JSON document instead of text.")]
ForceFlag = Annotated[bool, typer.Option("--force", help="Replace files that are there and not as jumpcad wrote them.")]

COLOUR = "\x1b\\[[0-9;]*m"
LINE_EVERY_S = 60.0
"""Time between two lines of progress where standard error is no terminal."""
LONGEST_LINE = 2000
"""Characters of an error; a path may have 4096."""


class OutputClosed(Exception):
    """The reader of standard output has closed it."""


def shell_quoted(file: str) -> str:
    """Return a file's name as it is typed in a shell, on one line."""
    return shlex.quote(without_controls(file))


def complain(message: str, exit_code: int) -> int:
    """Print an error as one line on standard error, of a long one beginning and end; return the exit code."""
    text, half = without_controls(message), LONGEST_LINE // 2
    text = text if len(text) <= LONGEST_LINE else f"{text[:half]} … {text[-half:]}"
    if sys.stderr is not None:
        try:
            print(f"jumpcad: {text}", file=sys.stderr, flush=True)
        except (OSError, ValueError):  # standard error is closed too
            _discard(sys.stderr)
    return exit_code


class Output:
    """Standard output for a command, which escapes control characters, except line breaks and tabs.

    So no file name controls the terminal. The colours of tables and of the help are kept if `coloured`.
    """

    def __init__(self, stream: TextIO, coloured: bool) -> None:
        self._stream = stream
        self._kept = f"{COLOUR}|[\n\t]" if coloured else "[\n\t]"

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def coloured(self) -> "Output":
        """Return the same output that keeps colours."""
        return Output(self._stream, coloured=True)

    def write(self, text: str) -> int:
        with self._written():
            self._stream.write(without_controls(text, self._kept))
        return len(text)

    def flush(self) -> None:
        with self._written():
            self._stream.flush()

    @contextlib.contextmanager
    def _written(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            _discard(self._stream)
            if isinstance(error, BrokenPipeError):
                raise OutputClosed from None
            raise JumpcadError(f"standard output cannot be written: {error.strerror}") from None


@contextlib.contextmanager
def standard_output(coloured: bool) -> Iterator[None]:
    """Redirect standard output to `Output`; characters that the terminal's encoding lacks are escaped."""
    _open_streams()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    if sys.stdout is None:  # closed by the caller
        yield
        return
    output = Output(sys.stdout, coloured)
    with contextlib.redirect_stdout(output):
        try:
            yield
        finally:
            output.flush()


def console(**options: Any) -> "Console":
    """Return a console for tables, without markup; text from users must be escaped before it is printed there."""
    from rich.console import Console

    if isinstance(sys.stdout, Output) and "stderr" not in options:
        options["file"] = sys.stdout.coloured()
    return Console(markup=False, emoji=False, **options)


def wrapped(line: str, indent: int) -> str:
    """Return a line as wide as a terminal, 80 characters elsewhere: what is left stands below, indented."""
    width = max(console().width, 2 * indent)
    return textwrap.fill(line, width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False)


def table(*headings: str, wraps: str = "", **options: Any) -> "Table":
    """Return an empty table; a heading with > before it is right-aligned, the column `wraps` alone breaks lines."""
    from rich.table import Table

    made = Table(**{"box": None, "pad_edge": False} | options)
    for heading in headings:
        title = heading.removeprefix(">")
        made.add_column(title, justify="right" if title != heading else "left", no_wrap=bool(wraps) and title != wraps)
    return made


@contextlib.contextmanager
def status(doing: str) -> Iterator[Callable[[str], None]]:
    """Show on standard error what is being done: always on a terminal, else a line a minute
    where it has changed.

    Yields a function that changes the text.
    """
    from rich.text import Text

    if sys.stderr.isatty():
        with console(stderr=True).status(Text(without_controls(doing))) as shown:
            yield lambda text: shown.update(Text(without_controls(text)))
        return
    texts, done = [doing], Event()
    thread = Thread(target=_log, args=(texts, done), daemon=True)
    thread.start()
    try:
        yield lambda text: texts.__setitem__(0, text)
    finally:
        done.set()
        thread.join()


def _log(texts: Sequence[str], done: Event) -> None:
    """Print the text every `LINE_EVERY_S` until all is done, if it is another one."""
    said = ""
    while not done.wait(LINE_EVERY_S):
        if said == texts[0]:
            continue
        said = texts[0]
        with contextlib.suppress(OSError, ValueError):  # standard error is closed
            print(f"jumpcad: {without_controls(said)}", file=sys.stderr, flush=True)


def text_of(name: str, /, **values: Any) -> str:
    """Return a template of `templates/texts` with values in it; each stays on its line."""
    from jumpcad.files.templates import environment

    texts = environment().overlay(finalize=lambda value: without_controls(value) if isinstance(value, str) else value)
    return texts.get_template(f"texts/{name}.txt.j2").render(values)


def print_text(name: str, /, **values: Any) -> None:
    """Print a text; see `text_of`."""
    print(text_of(name, **values), end="")


def answer(as_json: bool, data: Any, tell: Callable[..., object], /, *given: Any, **values: Any) -> None:
    """Print data as JSON, or call what tells people."""
    if as_json:
        print_json(data)
    else:
        tell(*given, **values)


def print_json(data: Any) -> None:
    """Print one JSON document; NaN and infinities become null."""
    print(json.dumps(_plain(data), indent=2, allow_nan=False))


def _plain(data: Any) -> Any:
    """Return data for strict JSON: numpy values become Python's, NaN and infinities become None."""
    if isinstance(data, dict):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_plain(value) for value in data]
    if hasattr(data, "tolist"):
        return _plain(data.tolist())
    if isinstance(data, float) and not math.isfinite(data):
        return None
    return data


def _open_streams() -> None:
    """Open descriptors 0, 1 and 2 if the caller closed them; else libraries would print into a file that gets one."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest number that is free
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115  # until the end


def _discard(stream: TextIO) -> None:
    """Discard a stream's buffer; Python would try to write it again at exit, and print an error."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
