"""Rows of a study file: its tables, a trial as a row, and a row as a trial."""

import json
import sqlite3
import sys
from collections.abc import Sequence
from functools import cache
from typing import Any

from jumpcad.design import PARAMETERS
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.findings import Finding, is_bare
from jumpcad.search.methods import STEPS
from jumpcad.search.stored import (
    stored_count,
    stored_design,
    stored_evaluation,
    stored_figure,
    stored_proposal,
    stored_text,
    stored_workshop,
)
from jumpcad.search.tolerances import MADE, require_made
from jumpcad.search.trial import LEARNING_PHASES, PHASES, Trial

APPLICATION_ID = 0x4A554D50
FORMAT = 3
FORMATS = (1, 2, 3)
"""Formats that are read; in the first one, every finding has its texts, in the first two a search has no workshop's
values."""

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
SCHEMA = (
    _WITHOUT_WORKSHOP.replace("  model TEXT", "  workshop TEXT NOT NULL, model TEXT").replace(
        f"{PARAMETERS[-1]})", f"{PARAMETERS[-1]}, workshop)"
    )
    + f"PRAGMA user_version = {FORMAT};"
)
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
    connection.executescript(SCHEMA if version == FORMAT else _WITHOUT_WORKSHOP)
    return tables(connection)


def read_trial(record: dict[str, Any], free: int, keys: Sequence[str]) -> Trial:
    """Return a trial as it was written in a search of `free` parameters and these keys of the workshop.

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
            stored_evaluation(record), score, sys.intern(stored_text(record, "model")),
            stored_figure(record, "duration_s"), proposal, workshop,
        )  # fmt: skip
    except JumpcadError as error:
        name = " ".join(shown(record[key]).removeprefix("b") for key in ("phase", "step", "place"))
        raise JumpcadError(f"row {name}: {error}") from None


def to_row(trial: Trial) -> tuple[Any, ...]:
    evaluation = trial.evaluation
    return (
        trial.phase, trial.step, trial.place, *trial.design.to_vector(), _text(dict(trial.workshop)),
        trial.model, evaluation.verdict, trial.score,
        _text(dict(evaluation.metrics)), _text([_finding(one) for one in evaluation.findings]),
        evaluation.detail, _text(dict(trial.proposal)), trial.duration_s,
    )  # fmt: skip


def _finding(finding: Finding) -> Any:
    """Return a bare finding as a list, any other one as a mapping."""
    few = [finding.name, finding.severity, finding.margin, finding.unit]
    return few if is_bare(finding) else finding.to_dict()


_text = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), check_circular=False).encode
