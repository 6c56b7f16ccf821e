"""The SQLite file of a study: opening it, locking it, and messages for its errors."""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files.outputs import require_folder, require_path, require_writable

SUFFIX = ".db"
PATIENCE_S = 5.0
"""Time for which a reader or writer waits for another one."""


def connect(target: str) -> sqlite3.Connection:
    """Return a connection to a path or `file:` URI that does not run functions from the file's schema."""
    connection = sqlite3.connect(target, uri=target.startswith("file:"), isolation_level=None, timeout=PATIENCE_S)
    connection.execute("PRAGMA trusted_schema = OFF")
    return connection


def open_to_read(path: Path) -> sqlite3.Connection:
    """Return a connection to a file that may be read.

    It is opened for writing if that is permitted: the last program to close it then merges the log beside the file into
    it. A file without this permission is read with its log, or, without a log, as a file that does not change.
    """
    log = path.with_name(f"{path.name}-wal")
    ways = ["mode=rw", "mode=ro"]
    if not (log.exists() and log.stat().st_size):
        ways.append("mode=ro&immutable=1")
    for way in ways:
        connection = connect(f"{path.absolute().as_uri()}?{way}")
        try:
            connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
            return connection
        except sqlite3.OperationalError as error:
            connection.close()
            if way == ways[-1] or not _name(error).startswith(("SQLITE_CANTOPEN", "SQLITE_READONLY")):
                raise
    raise AssertionError


def require_study(study: Path | None) -> None:
    """Require, before a search, that a file can be its study.

    Raises
    ------
    JumpcadError
        If it does not end in .db, its folder is missing or cannot be written, or it is no file.
    """
    if study is None:
        return
    if study.suffix != SUFFIX:
        raise JumpcadError(f"{study}: a study file must end in {SUFFIX}")
    require_path(study)
    require_folder(study)
    if os.path.lexists(study) and not os.path.isfile(study):
        raise JumpcadError(f"{study}: is there already and is no file; choose another name")
    if not os.path.lexists(study):
        require_writable(study.parent)


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Lock a study file for this process.

    SQLite's own locks, for readers and a writer, are independent of this one.

    Raises
    ------
    JumpcadError
        If the file cannot be written, or is locked by another process.
    """
    import fcntl

    require_path(path)
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be written: {error.strerror}") from None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        raise JumpcadError(f"{path}: is being written by another run; wait for it, or name another file") from None
    try:
        yield
    finally:
        os.close(descriptor)


def is_written(path: Path) -> bool:
    """Tell whether a running search has locked a study file."""
    import fcntl

    try:
        descriptor = os.open(path, os.O_RDONLY)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(descriptor)
    return False


@contextmanager
def plain_errors(path: Path | None) -> Iterator[None]:
    """Raise `JumpcadError` of one line for an error of SQLite."""
    try:
        yield
    except sqlite3.IntegrityError:
        raise
    except UnicodeDecodeError:  # from SQLite's message about a damaged file
        raise JumpcadError(f"{path}: is damaged, or is not a study file (invalid text)") from None
    except sqlite3.DatabaseError as error:
        name, text = _name(error), without_controls(str(error))[:200]
        if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
            reason = "is locked by another program; close it there and repeat the command"
        elif name.startswith(("SQLITE_FULL", "SQLITE_IOERR")):
            reason = f"cannot be written ({text}); free some space and repeat the command: it continues from there"
        elif name.startswith(("SQLITE_READONLY", "SQLITE_CANTOPEN")):
            reason = f"cannot be opened ({text})"
        else:
            reason = f"is damaged, or is not a study file ({text})"
        raise JumpcadError(f"{path}: {reason}") from None


def _name(error: sqlite3.Error) -> str:
    """Return SQLite's name of an error; empty for other errors."""
    return str(getattr(error, "sqlite_errorname", ""))
