"""Rows of a study file: its tables, a trial as a row, and a row as a trial."""

import json
import sqlite3
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.findings import SEVERITIES, is_bare
from jumpcad.search.methods import STEPS
from jumpcad.search.objective import Evaluation
from jumpcad.search.pick.tolerances import MADE, require_made
from jumpcad.search.stored import (
    stored_count,
    stored_design,
    stored_figure,
    stored_proposal,
    stored_text,
    stored_workshop,
)
from jumpcad.search.stored_evaluation import LETTERS, stored_evaluation
from jumpcad.search.trial import LEARNING_PHASES, PHASES, Trial

APPLICATION_ID = 0x4A554D50
FORMAT = 4
FORMATS = (1, 2, 3, 4)
"""Formats that are read; in the first one, every finding has its texts, in the first two a search has no workshop's
values, in the first three every row has the names of its figures and limits."""

_WITHOUT_WORKSHOP = f"""
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE notes (text TEXT NOT NULL);
CREATE TABLE evaluations (
  phase TEXT NOT NULL, step INTEGER NOT NULL, place INTEGER NOT NULL,
  {", ".join(f"{name} REAL NOT NULL" for name in PARAMETERS)},
  model TEXT NOT NULL, verdict TEXT NOT NULL, score REAL, metrics TEXT NOT NULL, findings TEXT NOT NULL,
  detail TEXT NOT NULL, proposal TEXT NOT NULL, duration_s REAL NOT NULL,
  PRIMARY KEY (phase, step, place), UNIQUE ({", ".join(PARAMETERS)})
);
PRAGMA application_id = {APPLICATION_ID};
"""
_WITHOUT_NAMES = _WITHOUT_WORKSHOP.replace("  model TEXT", "  workshop TEXT NOT NULL, model TEXT").replace(
    f"{PARAMETERS[-1]})", f"{PARAMETERS[-1]}, workshop)"
)
SCHEMA = f"""{_WITHOUT_NAMES}
CREATE TABLE names (number INTEGER PRIMARY KEY, names TEXT NOT NULL UNIQUE);
PRAGMA user_version = {FORMAT};
"""
COLUMNS = (
    "phase", "step", "place", *PARAMETERS, "workshop",
    "model", "verdict", "score", "metrics", "findings", "detail", "proposal", "duration_s",
)  # fmt: skip
TEXTS = ("phase", "workshop", "model", "verdict", "metrics", "findings", "detail", "proposal")
"""Columns that are read as bytes: the row that holds damaged text can then be named."""


def tables(connection: sqlite3.Connection) -> list[tuple[str, str, str]]:
    """Return type, name and definition of everything that a database holds."""
    return connection.execute("SELECT type, name, sql FROM sqlite_master ORDER BY name").fetchall()


@cache
def own_tables(version: int) -> list[tuple[str, str, str]]:
    connection = sqlite3.connect(":memory:")
    connection.executescript({FORMAT: SCHEMA, 3: _WITHOUT_NAMES}.get(version, _WITHOUT_WORKSHOP))
    return tables(connection)


def read_trial(record: dict[str, Any], free: int, keys: Sequence[str], names: Mapping[int, Any]) -> Trial:
    """Return a trial as it was written in a search of `free` parameters and these keys of the workshop.

    `names` are the lists of names that rows share, by their numbers.

    Raises
    ------
    JumpcadError
        Naming the row, if it is not one that was written.
    """
    try:
        phase = stored_text(record, "phase")
        if phase not in PHASES:
            raise JumpcadError(f"phase = {shown(phase)} is none of {', '.join(PHASES)}")
        score = None if record["score"] is None else stored_figure(record, "score")
        step, proposal = stored_count(record, "step"), stored_proposal(record, free)
        if phase in LEARNING_PHASES and step % STEPS and "theta" not in proposal:
            raise JumpcadError("proposal.theta: missing")
        workshop = stored_workshop(record, keys, MADE if phase == "robust" else ())
        require_made(workshop)
        return Trial(
            phase, step, stored_count(record, "place"), stored_design(record),
            stored_evaluation(record, names), score, sys.intern(stored_text(record, "model")),
            stored_figure(record, "duration_s"), proposal, workshop,
        )  # fmt: skip
    except JumpcadError as error:
        name = " ".join(shown(record[key]).removeprefix("b") for key in ("phase", "step", "place"))
        raise JumpcadError(f"row {name}: {error}") from None


def to_row(trial: Trial, number_of: Callable[[str], int]) -> tuple[Any, ...]:
    """Return the columns of a trial; `number_of` keeps a list of names, as text, and returns its number."""
    evaluation = trial.evaluation
    return (
        trial.phase, trial.step, trial.place, *trial.design.to_vector(), _text(dict(trial.workshop)),
        trial.model, evaluation.verdict, trial.score,
        _metrics(evaluation, number_of), _findings(evaluation, number_of),
        evaluation.detail, _text(dict(trial.proposal)), trial.duration_s,
    )  # fmt: skip


def _metrics(evaluation: Evaluation, number_of: Callable[[str], int]) -> str:
    """Return the figures as the number of their names, and their values."""
    return _text([number_of(_text(list(evaluation.metrics))), list(evaluation.metrics.values())])


def _findings(evaluation: Evaluation, number_of: Callable[[str], int]) -> str:
    """Return bare findings as the number of their names and units, their severities' letters, and their margins."""
    findings = evaluation.findings
    if not all(map(is_bare, findings)):
        return _text([one.to_dict() for one in findings])
    letters = "".join(LETTERS[SEVERITIES.index(one.severity)] for one in findings)
    number = number_of(_text([[one.name, one.unit] for one in findings]))
    return _text([number, letters, [one.margin for one in findings]])


_text = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), check_circular=False).encode
