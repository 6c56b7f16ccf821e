"""The study file: one SQLite file in which every trial is a row, whose columns are of `record`.

A batch of trials is one transaction in write-ahead mode: the file stays valid if the writer is killed, and others may
read it meanwhile. Rows are identified by where the search proposed them (phase, run, step, place in the step), so the
same search fills the same rows, whatever computes them and however often it is interrupted.
"""

import json
import os
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, closing, contextmanager
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files.outputs import require_path
from jumpcad.search.fronts import SPRING_ENERGY
from jumpcad.search.methods import SEARCH_PHASES
from jumpcad.search.study.database import connect, locked, open_to_read, plain_errors
from jumpcad.search.study.record import COLUMNS, REMEMBERED, read_trial, to_row, validated
from jumpcad.search.study.trial import Position, Trial, in_order

APPLICATION_ID = 0x4A554D50
FORMAT = 6
"""Of the file; no other is read."""
SCHEMA = f"""
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE notes (text TEXT NOT NULL);
CREATE TABLE trials (
  phase TEXT NOT NULL, run INTEGER NOT NULL, step INTEGER NOT NULL, place INTEGER NOT NULL,
  score REAL, record TEXT NOT NULL, PRIMARY KEY (phase, run, step, place)
);
PRAGMA application_id = {APPLICATION_ID};
PRAGMA user_version = {FORMAT};
"""
TRIALS = f"SELECT {', '.join(COLUMNS)} FROM trials"
ENDED = "ended"
"""Key under which a study remembers what ended its search; None while it runs, and where it was interrupted."""
MOST_NOTES, LONGEST_NOTE = 200, 1000
"""Notes that are read, and characters of each: a run has a few, a stranger's file may have any number."""


class StudyStore(AbstractContextManager["StudyStore"]):
    """An open study file; `StudyStore.write` and `StudyStore.read` open one."""

    _connection: sqlite3.Connection

    def __init__(self, path: Path | None, made: bool = False) -> None:
        self.path = path
        self._made = made
        self._useless = False
        self._closing = ExitStack()

    def __repr__(self) -> str:
        return f"<StudyStore {str(self.path)[-120:] if self.path else 'in memory'}>"

    @classmethod
    @check_arguments
    def write(cls, path: str | Path | None, identity: Mapping[str, Any]) -> "StudyStore":
        """Create a study, or continue the one in `path` if it has the same identity; None keeps it in memory."""
        path = None if path is None else Path(path)
        store = cls(path, path is not None and not os.path.lexists(path))
        if path is not None:
            store._closing.enter_context(locked(path))
            store._made = store._made and not os.path.getsize(path)
            store._closing.callback(store._clear)
        with ExitStack() as on_error, plain_errors(path):
            on_error.push(store)
            if path is not None and os.path.getsize(path):  # what is refused stays as it is
                with cls(path) as there:
                    there._connection = open_to_read(path, there._closing)
                    there._require_same(identity)
            store._connection = connect(":memory:" if path is None else os.path.abspath(path))
            store._closing.callback(store._connection.close)
            store._prepare(identity)
            on_error.pop_all()
        return store

    @classmethod
    @check_arguments
    def read(cls, path: str | Path) -> "StudyStore":
        """Open a study for reading, as it is now: also while it is being written, and in a folder that is not."""
        path = Path(path)
        require_path(path)
        if not os.path.isfile(path):  # unlike Path.is_file, False for a name that is too long
            reason = "is a folder, a pipe or a device, not a study file"
            try:
                os.stat(path)
            except PermissionError:
                reason = "may not be read (permission denied)"
            except OSError:
                reason = "no such study file"
            raise JumpcadError(f"{path}: {reason}")
        store = cls(path)
        with ExitStack() as on_error, plain_errors(path):
            on_error.push(store)
            store._connection = open_to_read(path, store._closing)
            store._check_format()
            _ = store.identity
            store._connection.execute("PRAGMA query_only = ON")
            on_error.pop_all()
        return store

    def close(self) -> None:
        self._closing.close()

    def __exit__(self, kind: object, error: BaseException | None, _: object) -> None:
        """Close the file; remove it if it was made for a request that is wrong, and holds no score."""
        self._useless = self._made and isinstance(error, JumpcadError) and self._has_no_score()
        self.close()

    def _clear(self) -> None:
        """Remove what nobody needs, once it is closed and before another may write."""
        if self._useless and self.path is not None:
            for end in ("", "-wal", "-shm"):
                self.path.with_name(f"{self.path.name}{end}").unlink(missing_ok=True)

    @property
    def identity(self) -> Any:
        """What the study is about, as plain data: space, model, objective, method, seed, versions."""
        return self.recall("identity")

    def recall(self, key: str, default: Any = None, kind: TypeAdapter[Any] | None = None) -> Any:
        """Return what was remembered under a key: of a kind that is given, else plain data of that in `REMEMBERED`."""
        with plain_errors(self.path):
            found = self._connection.execute("SELECT value FROM study WHERE key = ?", (key,)).fetchone()
        if found is None and key != "identity":
            return default
        try:
            known = self._checked(key, found[0] if found else "", kind)
            return known if kind else json.loads(found[0])
        except (JumpcadError, ValueError) as error:
            raise JumpcadError(f"{self.path}: is damaged: {error}") from None

    def remember(self, key: str, value: Any, kind: TypeAdapter[Any] | None = None) -> None:
        """Keep something of a kind, or plain data, under a key; `recall` reads it."""
        text = json.dumps(kind.dump_python(value) if kind else value)
        with _readable():
            self._checked(key, text, kind)
        with self._transaction():
            self._connection.execute("INSERT OR REPLACE INTO study VALUES (?, ?)", (key, text))

    def _checked(self, key: str, text: Any, kind: TypeAdapter[Any] | None) -> Any:
        """Return what the text of what a study remembers says, if it is of its kind; raises `JumpcadError` else."""
        found = kind or REMEMBERED.get(key)
        return found and validated(partial(found.validate_json, context=self), key, text)

    def trial(self, position: Position) -> Trial:
        with plain_errors(self.path):
            rows = self._connection.execute(f"{TRIALS} WHERE (phase, run, step, place) = (?, ?, ?, ?)", position)
            for row in rows:
                return self._reader(row)
        raise JumpcadError(f"a trial at {' '.join(map(str, position))} is none of its trials")

    def trials(self) -> list[Trial]:
        """Return all trials in the order of their study."""
        with plain_errors(self.path):
            try:
                return in_order(map(self._reader, self._connection.execute(TRIALS)))
            except JumpcadError as error:
                raise JumpcadError(f"{self.path}: is damaged: {error}") from None

    @cached_property
    def _reader(self) -> Callable[[Sequence[Any]], Trial]:
        """What makes a trial of a row, in the space of this study."""
        space = self.identity.get("space", {})
        choices = [part.get("choices", ()) for part in space.values() if "fixed" not in part]
        free = sum(sum(isinstance(one, str) for one in some) or 1 for some in choices)
        return partial(read_trial, free=free, keys=[name for name in space if "." in name])

    def progress(self) -> tuple[dict[str, int], float | None]:
        """Return the number of trials by phase, and the best score; quick, whatever the number of rows."""
        with plain_errors(self.path):
            rows = self._connection.execute("SELECT phase, count(*), max(score) FROM trials GROUP BY phase").fetchall()
        scores = [best for phase, _, best in rows if best is not None and phase in SEARCH_PHASES]
        return {phase: count for phase, count, _ in rows}, max(scores, default=None)

    def append(self, trials: Iterable[Trial]) -> list[Trial]:
        """Add trials, all or none; return them as they are read again."""
        rows = [to_row(trial) for trial in trials]
        with _readable():
            kept = list(map(self._reader, rows))
        with self._transaction():
            self._connection.executemany("INSERT INTO trials VALUES (?, ?, ?, ?, ?, ?)", rows)
        return kept

    def _has_no_score(self) -> bool:
        try:
            scored = self._connection.execute("SELECT EXISTS (SELECT 1 FROM trials WHERE score IS NOT NULL)")
            return not scored.fetchone()[0]
        except (AttributeError, sqlite3.Error):  # it could not be opened, or there was no space for its tables
            return True

    def note(self, text: str, once: bool = False) -> None:
        """Keep a line about the run: a lost worker, a quarantined design; `once`, unless it is there already."""
        unless = "WHERE NOT (? AND EXISTS (SELECT 1 FROM notes WHERE text = ?))"
        with self._transaction():
            self._connection.execute(f"INSERT INTO notes SELECT ? {unless}", (text, once, text))

    def notes(self) -> list[str]:
        """Return the lines about the run; of very many, how many there are and then the newest."""
        with plain_errors(self.path):
            (count,) = self._connection.execute("SELECT count(*) FROM notes").fetchone()
            newest = self._connection.execute(
                "SELECT substr(text, 1, ?) FROM notes ORDER BY rowid DESC LIMIT ?", (LONGEST_NOTE, MOST_NOTES)
            ).fetchall()
        notes = [without_controls(str(text)) for (text,) in reversed(newest)]
        return notes if count <= MOST_NOTES else [f"{count - MOST_NOTES} earlier notes", *notes]

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with plain_errors(self.path):
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise

    @property
    def _is_new(self) -> bool:
        return not self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]

    def _prepare(self, identity: Mapping[str, Any]) -> None:
        if self._is_new:
            text = json.dumps(identity)
            with _readable():
                self._checked("identity", text, None)
            self._connection.execute("PRAGMA journal_mode = WAL")
            with self._transaction():
                for statement in filter(str.strip, SCHEMA.split(";")):
                    self._connection.execute(statement)
                self._connection.execute("INSERT INTO study VALUES ('identity', ?)", (text,))
        # A commit does not wait for the disk: the file stays valid, and only a power cut can lose the last batches.
        self._connection.execute("PRAGMA synchronous = NORMAL")

    def _require_same(self, identity: Mapping[str, Any]) -> None:
        """Require that the file holds the study of an identity, or nothing yet."""
        if self._is_new:
            return
        self._check_format()
        held = self.identity
        asked = json.loads(json.dumps(identity))
        differs = difference(held, asked)
        if differs.startswith("space."):  # the usual bounds are another program's
            differs = difference(held.get("versions"), asked.get("versions"), "versions") or differs
        said = f"holds another study ({differs}); repeat its own request or name another file"
        if differs.startswith("versions."):
            said = (
                f"was made by another program ({differs}), whose trials do not mix with this one's; go on with that "
                f"program, or name another file (`--from-study {self.path}` learns from this one)"
            )
        elif differs.startswith("objective_code: ") and held.get("objective_code"):
            said = (
                f"holds another study (the code of {identity['objective']}, or of what it uses, was changed): put it "
                f"back, or name another file (`--from-study {self.path}` scores its designs by the new code)"
            )
        elif differs.startswith("against: "):
            theirs, ours = (one.get("against", SPRING_ENERGY.name) for one in (held, identity))
            said = f"holds a front against {theirs}, not {ours}: say --against {theirs}, or name another file"
        if differs:
            raise JumpcadError(f"{self.path}: {said}")

    def _check_format(self) -> None:
        application, version = (
            self._connection.execute(f"PRAGMA {name}").fetchone()[0] for name in ("application_id", "user_version")
        )
        if application != APPLICATION_ID:
            raise JumpcadError(f"{self.path}: is not a study file")
        if version != FORMAT:
            raise JumpcadError(
                f"{self.path}: is a study of format {version}; this version of jumpcad reads format {FORMAT}: "
                "repeat its search with another file"
            )
        with closing(sqlite3.connect(":memory:")) as own:
            own.executescript(SCHEMA)
            known = _tables(own)
        if _tables(self._connection) != known:
            raise JumpcadError(f"{self.path}: is damaged, or was changed by another program: unknown tables")
        if self._connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise sqlite3.DatabaseError("damaged")


@contextmanager
def _readable() -> Iterator[None]:
    """Stop before something is written that could not be read again: a fault of the program, not of a request."""
    try:
        yield
    except JumpcadError as error:
        raise AssertionError(f"what is to be written could not be read again: {error}") from error


def _tables(connection: sqlite3.Connection) -> list[tuple[str, str, str]]:
    """Return type, name and definition of everything that a database holds."""
    return connection.execute("SELECT type, name, sql FROM sqlite_master ORDER BY name").fetchall()


def difference(there: Any, here: Any, name: str = "") -> str:
    """Name the first value in which two identities differ."""
    if isinstance(there, dict) and isinstance(here, dict):
        for key in [*there, *(key for key in here if key not in there)]:
            found = difference(there.get(key), here.get(key), f"{name}.{key}" if name else key)
            if found:
                return found
        return ""
    if there == here:
        return ""
    return f"{without_controls(name)}: {json.dumps(there)[:200]} there, {json.dumps(here)[:200]} here"
