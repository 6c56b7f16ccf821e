"""Progress of a search on standard error: a bar on a terminal, otherwise one line per minute."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jumpcad.cli.output import LINE_EVERY_S, console
from jumpcad.plural import counted

if TYPE_CHECKING:
    from jumpcad.search.study.evaluator import Watch
    from jumpcad.search.study.trial import Trial


class Tally:
    """Progress of a search: evaluations done, best score, rate and time left.

    Trials that are read from the study file count as done, but not for the rate. `clock` returns seconds.
    """

    def __init__(self, total: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.total = total
        self.done = 0
        self.phase = "search"
        self.best: float | None = None
        self._clock = clock
        self._start_s = clock()
        self._computed = 0

    def add(self, trial: "Trial", computed: bool) -> None:
        """Count a trial, which was `computed` or read from the study file."""
        from jumpcad.search.phases import SEARCH_PHASES

        self.done += 1
        self.total = max(self.total, self.done)
        searching = trial.phase in SEARCH_PHASES
        self.phase = trial.phase if searching else "robust pick"
        if searching and trial.score is not None:
            self.best = trial.score if self.best is None else max(self.best, trial.score)
        if computed:
            self._computed += 1
        elif not self._computed:
            self._start_s = self._clock()

    def line(self) -> str:
        """Return the progress as one line of text: the rate, and the time for the rest at it, from the first on."""
        elapsed = self._clock() - self._start_s
        rate = self._computed / elapsed if elapsed > 0 else 0.0
        best = "–" if self.best is None else f"{self.best:.4g}"
        left = f", about {duration((self.total - self.done) / rate)} left" if rate else ""
        done = f"{self.done} of {counted(self.total, 'evaluation')}"
        return f"{self.phase}: {done}, best {best}, {rate:.2g}/s{left}"


def duration(seconds: float) -> str:
    """Return a time in seconds, minutes or hours."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


@contextmanager
def watching(total: int, quiet: bool, clock: Callable[[], float] = time.monotonic) -> Iterator["Watch"]:
    """Show the progress of a search while it runs; `total` is the number of evaluations.

    If none of its first designs jumps, print a warning with the numbers of reasons.
    """
    from rich.progress import BarColumn, Progress, TextColumn

    from jumpcad.search.study.run import Hopeless

    terminal = sys.stderr.isatty()
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[line]}"))
    with Progress(*columns, console=console(stderr=True), disable=quiet or not terminal) as progress:
        tally, printed_s, hopeless = Tally(total, clock), clock(), Hopeless()
        task = progress.add_task("search", total=total, line="")

        def watch(trial: "Trial", computed: bool) -> None:
            nonlocal printed_s
            tally.add(trial, computed)
            warning = hopeless.warning(trial)
            if quiet:
                return
            if warning:
                progress.console.print(warning, markup=False) if terminal else _print_line(warning)
            if terminal:
                line = tally.line().removeprefix(f"{tally.phase}: ")
                progress.update(task, completed=tally.done, total=tally.total, description=tally.phase, line=line)
            elif computed and clock() - printed_s >= LINE_EVERY_S:
                printed_s = clock()
                _print_line(tally.line())

        yield watch


def _print_line(line: str) -> None:
    print(f"jumpcad: {line}", file=sys.stderr, flush=True)
