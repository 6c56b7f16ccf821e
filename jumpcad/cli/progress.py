"""Progress of a search on standard error: always on a terminal, otherwise one line per minute."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jumpcad.cli.output import status
from jumpcad.dimensions import counted

if TYPE_CHECKING:
    from jumpcad.search.study.evaluator import Watch
    from jumpcad.search.study.trial import Trial


class Tally:
    """Progress of a search: evaluations done, best score, rate and time left.

    Trials that are read from the study file count as done, but not for the rate.
    """

    def __init__(self, total: int) -> None:
        self._total, self._done, self._computed = total, 0, 0
        self._best: float | None = None
        self._start_s = time.monotonic()

    def add(self, trial: "Trial", computed: bool) -> str:
        """Count a trial, which was `computed` or read from the study file; return the progress as one line of text."""
        from jumpcad.search.phases import SEARCH_PHASES

        self._done += 1
        self._total = max(self._total, self._done)
        searching = trial.phase in SEARCH_PHASES
        if searching and trial.score is not None:
            self._best = trial.score if self._best is None else max(self._best, trial.score)
        self._computed += computed
        if not self._computed:
            self._start_s = time.monotonic()
        elapsed = time.monotonic() - self._start_s
        rate = self._computed / elapsed if elapsed > 0 else 0.0
        best = "–" if self._best is None else f"{self._best:.4g}"
        left = f", about {duration((self._total - self._done) / rate)} left" if rate else ""
        done = f"{self._done} of {counted(self._total, 'evaluation')}"
        return f"{trial.phase if searching else 'robust pick'}: {done}, best {best}, {rate:.2g}/s{left}"


def duration(seconds: float) -> str:
    """Return a time in seconds, minutes or hours."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


@contextmanager
def watching(total: int, quiet: bool) -> Iterator["Watch"]:
    """Show the progress of a search while it runs; `total` is the number of evaluations."""
    if quiet:
        yield lambda trial, computed: None
        return
    tally = Tally(total)
    with status("search …") as tell:
        yield lambda trial, computed: tell(tally.add(trial, computed))
