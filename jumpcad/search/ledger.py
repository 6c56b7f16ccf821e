"""The study ledger: one SQLite file in which every evaluation is a row.

A batch of rows is one transaction in write-ahead mode, so the file is whole whenever the writer is killed, and others
may read it meanwhile. A row's place is where the search proposed it (phase, step, place in the step), so the same
search fills the same places, whoever computes them and however often it is interrupted.
"""

import json
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.findings import Finding
from jumpcad.search.objective import Evaluation

APPLICATION_ID = 0x4A554D50
FORMAT = 1
PATIENCE_S = 5.0
"""How long a reader or writer waits for another one to finish."""
PHASES = ("ga", "bo", "pareto", "nsga2", "sample", "sweep", "margin", "bounds", "robust")
"""All phases, in the order in which a study goes through them; the last three look around the best."""
SEARCH_PHASES = PHASES[:-3]

_SCHEMA = f"""
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
PRAGMA user_version = {FORMAT};
"""
_COLUMNS = (
    "phase", "step", "place", *PARAMETERS,
    "model", "verdict", "score", "metrics", "findings", "detail", "proposal", "duration_s",
)  # fmt: skip

Key = tuple[float, ...]


@dataclass(frozen=True)
class Row:
    """One finished evaluation: where the search proposed it and why, the design, the outcome, and its score.

    ``score`` is None where the design is refused; ``proposal`` is what the optimiser thought of it beforehand.
    """

    phase: str
    step: int
    place: int
    design: Design
    evaluation: Evaluation
    score: float | None
    model: str
    duration_s: float
    proposal: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def key(self) -> Key:
        """What identifies the design: its vector."""
        return tuple(self.design.to_vector())

    @property
    def position(self) -> tuple[int, int, int]:
        """Where the row stands in its study."""
        return PHASES.index(self.phase), self.step, self.place


class Ledger:
    """An open study file; made by `Ledger.write` or `Ledger.read`."""

    def __init__(self, path: Path | None, connection: sqlite3.Connection, lock: int | None = None) -> None:
        self.path = path
        self._connection = connection
        self._lock = lock

    @classmethod
    def write(cls, path: Path | None, identity: Mapping[str, Any]) -> "Ledger":
        """Create a study, or continue the one in `path` if it has the same identity; None keeps it in memory.

        Raises
        ------
        JumpcadError
            If the file holds another study, is no study, is damaged, or is being written by another run.
        """
        lock = None if path is None else _lock(path)
        try:
            with _plain_errors(path):
                ledger = cls(path, _connect(":memory:" if path is None else os.path.abspath(path)), lock)
                ledger._prepare(identity)
            return ledger
        except BaseException:
            if lock is not None:
                os.close(lock)
            raise

    @classmethod
    def read(cls, path: Path) -> "Ledger":
        """Open a study for reading, also while it is being written."""
        if not path.is_file():
            raise JumpcadError(f"{path}: no such study file")
        with _plain_errors(path):
            # Not mode=ro: that would leave the log beside the file, which the last one to close should fold in.
            ledger = cls(path, _connect(f"{path.absolute().as_uri()}?mode=rw"))
            ledger._check_format()
            ledger._connection.execute("PRAGMA query_only = ON")
        return ledger

    def close(self) -> None:
        """Close the file."""
        self._connection.close()
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def __enter__(self) -> "Ledger":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def identity(self) -> dict[str, Any]:
        """What the study is about: space, model, objective, method, seed, versions."""
        return self.recall("identity")

    def recall(self, key: str, default: Any = None) -> Any:
        """Return what was remembered under a key."""
        with _plain_errors(self.path):
            found = self._connection.execute("SELECT value FROM study WHERE key = ?", (key,)).fetchone()
        return default if found is None else json.loads(found[0])

    def remember(self, key: str, value: Any) -> None:
        """Keep plain data under a key."""
        with self._transaction():
            self._connection.execute("INSERT OR REPLACE INTO study VALUES (?, ?)", (key, json.dumps(value)))

    def rows(self) -> list[Row]:
        """Return all rows in the order of their study."""
        with _plain_errors(self.path):
            records = self._connection.execute(f"SELECT {', '.join(_COLUMNS)} FROM evaluations").fetchall()
        return sorted((_row(dict(zip(_COLUMNS, record, strict=True))) for record in records), key=lambda r: r.position)

    def append(self, rows: Iterable[Row]) -> None:
        """Add rows, all or none."""
        marks = ", ".join("?" * len(_COLUMNS))
        with self._transaction():
            self._connection.executemany(f"INSERT INTO evaluations VALUES ({marks})", [_record(row) for row in rows])

    def note(self, text: str) -> None:
        """Keep a line about what happened to the run: lost workers, quarantined designs."""
        with self._transaction():
            self._connection.execute("INSERT INTO notes VALUES (?)", (text,))

    def notes(self) -> list[str]:
        """Return the lines about what happened to the run."""
        with _plain_errors(self.path):
            return [text for (text,) in self._connection.execute("SELECT text FROM notes ORDER BY rowid")]

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with _plain_errors(self.path):
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise

    def _prepare(self, identity: Mapping[str, Any]) -> None:
        if self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0] == 0:
            self._connection.execute("PRAGMA journal_mode = WAL")
            value = json.dumps(identity).replace("'", "''")
            self._connection.executescript(
                f"BEGIN IMMEDIATE; {_SCHEMA} INSERT INTO study VALUES ('identity', '{value}'); COMMIT;"
            )
        self._check_format()
        # A commit need not wait for the disk: the file stays whole, and only a power cut can take the last batches.
        self._connection.execute("PRAGMA synchronous = NORMAL")
        difference = _difference(self.identity, json.loads(json.dumps(identity)))
        if difference.startswith("versions."):
            raise JumpcadError(
                f"{self.path}: was made by another program ({difference}), whose rows do not mix with this one's; "
                f"go on with that program, or name another file (`optimize --from {self.path}` learns from this one)"
            )
        if difference:
            raise JumpcadError(
                f"{self.path}: holds another study ({difference}); repeat its own request or name another file"
            )

    def _check_format(self) -> None:
        application = self._connection.execute("PRAGMA application_id").fetchone()[0]
        version = self._connection.execute("PRAGMA user_version").fetchone()[0]
        if application != APPLICATION_ID:
            raise JumpcadError(f"{self.path}: is not a study file")
        if version != FORMAT:
            raise JumpcadError(f"{self.path}: is a study of format {version}; this version of jumpcad reads {FORMAT}")
        if self._connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise sqlite3.DatabaseError("damaged")


def _connect(target: str) -> sqlite3.Connection:
    return sqlite3.connect(target, uri=target.startswith("file:"), isolation_level=None, timeout=PATIENCE_S)


def _lock(path: Path) -> int:
    """Claim a study file for this process until the returned descriptor is closed, or the process ends.

    This kind of lock is apart from those by which SQLite lets readers and a writer take turns.
    """
    import fcntl

    try:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be written: {error.strerror}") from None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        raise JumpcadError(f"{path}: is being written by another run; wait for it, or name another file") from None
    return descriptor


@contextmanager
def _plain_errors(path: Path | None) -> Iterator[None]:
    """Turn what SQLite says into one line about the file."""
    try:
        yield
    except sqlite3.IntegrityError:
        raise
    except sqlite3.DatabaseError as error:
        text = str(error)
        if "locked" in text or "busy" in text:
            reason = "is locked by another program; close it there and repeat the command"
        elif "full" in text or "I/O error" in text:
            reason = f"cannot be written ({text}); free some space and repeat the command: it goes on where it was"
        elif "readonly" in text or "unable to open" in text:
            reason = f"cannot be opened ({text})"
        else:
            reason = f"is damaged, or is not a study file ({text})"
        raise JumpcadError(f"{path}: {reason}") from None


def _difference(there: Any, here: Any, name: str = "") -> str:
    """Name the first value in which two identities differ."""
    if isinstance(there, dict) and isinstance(here, dict):
        for key in [*there, *(key for key in here if key not in there)]:
            found = _difference(there.get(key), here.get(key), f"{name}.{key}" if name else key)
            if found:
                return found
        return ""
    return "" if there == here else f"{name}: {json.dumps(there)} there, {json.dumps(here)} here"


def _record(row: Row) -> tuple[Any, ...]:
    evaluation = row.evaluation
    return (
        row.phase, row.step, row.place, *row.key, row.model, evaluation.verdict, row.score,
        _text(dict(evaluation.metrics)), _text([finding.to_dict() for finding in evaluation.findings]),
        evaluation.detail, _text(dict(row.proposal)), row.duration_s,
    )  # fmt: skip


_text = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), check_circular=False).encode


def _row(record: dict[str, Any]) -> Row:
    findings = tuple(Finding(**finding) for finding in json.loads(record["findings"]))
    evaluation = Evaluation(record["verdict"], json.loads(record["metrics"]), findings, record["detail"])
    return Row(
        record["phase"], record["step"], record["place"],
        Design.from_vector([record[name] for name in PARAMETERS]), evaluation,
        record["score"], record["model"], record["duration_s"], json.loads(record["proposal"]),
    )  # fmt: skip
