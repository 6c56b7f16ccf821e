"""The SQLite file of a study: opening it, locking it, and messages for its errors."""

import errno
import io
import os
import shutil
import sqlite3
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files.outputs import require_folder, require_path, require_writable

SUFFIX = ".db"
PATIENCE_S = 5.0
"""Time for which a writer waits for another program."""
JOURNAL = "-journal"
LOCK = ".lock"
SIDES = (JOURNAL, "-wal", "-shm", LOCK)
"""Ends of the names of files beside a database: SQLite's, and the lock."""
LOG_BEGINS, LOG_HEADER, FRAME_HEADER, LOG_MOST = b"\x37\x7f\x06", 32, 24, 2**28
"""First bytes of a log; bytes of its header, and of a frame's (SQLite's file format, 4.1); and the most that is read:
a search writes its log back every 4 MB."""
INDEX_BEGINS = tuple((3007000).to_bytes(4, order) for order in ("little", "big"))
"""First bytes of a log's index, on machines of either order (Walindex format, 2.1)."""
COPIES = 10
"""How often a database that changes meanwhile is copied."""
own_id: Callable[[], int] = getattr(os, "geteuid", int)
"""Returns the number of the user; 0 where files have none."""


def connect(target: str) -> sqlite3.Connection:
    """Return a connection to a path or `file:` URI that does not run functions from the file's schema."""
    connection = sqlite3.connect(target, uri=target.startswith("file:"), isolation_level=None, timeout=PATIENCE_S)
    connection.execute("PRAGMA trusted_schema = OFF")
    return connection


def open_to_read(path: Path, closing: ExitStack) -> sqlite3.Connection:
    """Return a connection to what a file holds, which a stack closes; nothing is written beside the file.

    SQLite itself would play back a journal that lies there, which deletes the file that it names, and write to whatever
    has the names of its own files. A file with a log, as of a search that runs or was killed, is copied with it.
    """
    real = Path(os.path.realpath(path))
    try:
        if not os.path.getsize(real):  # nor are what the kernel shows as files, which may never end
            raise JumpcadError(f"{path}: is not a study file")
        with _log_of(real) or nullcontext() as log:
            target = f"{real.as_uri()}?mode=ro&immutable=1" if log is None else _copied(real, log, closing)
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be read: {error.strerror}") from None
    connection = connect(target)
    closing.callback(connection.close)
    return connection


def _log_of(path: Path) -> io.FileIO | None:
    """Return the open log beside a database; None where there is no plain file of its owner, yours or root's."""
    how = os.O_RDONLY | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"))
    try:
        stream = open(os.open(f"{path}-wal", how), "rb", buffering=0)  # noqa: SIM115  # it changes meanwhile
    except OSError:
        return None
    there = os.fstat(stream.fileno())
    if stat.S_ISREG(there.st_mode) and there.st_uid in (os.stat(path).st_uid, own_id(), 0):
        header = stream.read(LOG_HEADER)
        if header[:3] == LOG_BEGINS and 512 <= int.from_bytes(header[8:12], "big") <= 65536:
            return stream
    stream.close()
    return None


def _copied(path: Path, log: io.FileIO, closing: ExitStack) -> str:
    """Copy a database, then its log, into a folder that a stack removes; return the copy's URI.

    What a checkpoint writes to the database meanwhile is in the log too, unless the log began anew.
    """
    folder = Path(closing.enter_context(tempfile.TemporaryDirectory(prefix="jumpcad-")))
    if shutil.disk_usage(folder).free < os.path.getsize(path):
        raise OSError(errno.ENOSPC, f"{folder} has no room for a copy")
    copy, began = folder / "study.db", b""
    for _ in range(COPIES):
        log.seek(0)
        before = log.read(LOG_HEADER)
        shutil.copyfile(path, copy)
        log.seek(0)
        with open(f"{copy}-wal", "wb") as target:
            began = log.read(LOG_HEADER)
            target.write(began)
            frame = FRAME_HEADER + int.from_bytes(began[8:12], "big")
            # A frame has its page's number, and the log's salt: what follows is older, or empty.
            while len(one := log.read(frame)) == frame and one[8:16] == began[16:24] and any(one[:4]):
                if target.tell() > LOG_MOST:
                    raise OSError(errno.EFBIG, f"the log beside it is larger than {LOG_MOST >> 20} MiB")
                target.write(one)
        if began == before:
            return f"{copy.as_uri()}?mode=rw"
    raise OSError(errno.EBUSY, "it changes all the time; repeat the command")


def require_own_sides(path: Path) -> None:
    """Require, before a study is written, that it has one name, and that the files beside it are its own.

    SQLite, and who locks, write to whatever has their names. By a second name two searches would write a log each.
    """
    real = os.path.realpath(path)
    if os.path.isfile(real) and os.stat(real).st_nlink > 1:
        raise JumpcadError(f"{path}: has another name too, a hard link; remove one, or name another study")
    for end in SIDES:
        try:
            there = os.lstat(f"{real}{end}")
        except (FileNotFoundError, NotADirectoryError):
            continue
        own = stat.S_ISREG(there.st_mode) and there.st_nlink == 1 and there.st_uid == own_id()
        if not own or not _is_side(Path(f"{real}{end}"), end):
            what = "no file of a study" if own else "no plain file of yours, or has another name too"
            raise JumpcadError(f"{real}{end}: is {what}; move it away, or name another study")


def _is_side(file: Path, end: str) -> bool:
    """Tell whether a file is empty, or begins as SQLite's file of this ending."""
    with open(file, "rb") as stream:
        begins = stream.read(4)
    known = {"-wal": begins[:3] == LOG_BEGINS, "-shm": begins in INDEX_BEGINS}
    return end != JOURNAL and (not begins or known.get(end, False))


def require_study(study: Path | None) -> None:
    """Require, before a search, that a file can be its study."""
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
    """Lock a study file, independently of SQLite's own locks, by a file beside it, which goes with the lock."""
    require_path(path)
    lock = _lock(path, 0.2)  # s: `is_written` holds it for a moment
    try:
        require_own_sides(path)
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, 0o644))
        lock.acquire()
        while not os.path.exists(lock.lock_file):  # who held it removed it as it was opened here: it locks nobody out
            lock.release()
            lock.acquire()
    except Timeout:
        raise JumpcadError(f"{path}: is being written by another run; wait for it, or name another file") from None
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be written: {error.strerror}") from None
    try:
        yield
    finally:
        with suppress(OSError):  # Windows removes no open file; the library does it there
            if not os.path.getsize(lock.lock_file):
                os.unlink(lock.lock_file)
        lock.release()


def is_written(path: Path) -> bool:
    """Tell whether a running search has locked a study file."""
    lock = _lock(path)
    try:
        there = os.lstat(lock.lock_file)  # left by a search that was killed, or held
        if stat.S_ISREG(there.st_mode) and there.st_nlink == 1 and not there.st_size:  # who locks a file empties it
            with lock:
                pass
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return False


def _lock(path: Path, patience_s: float = 0.0) -> FileLock:
    return FileLock(os.path.realpath(path) + LOCK, timeout=patience_s, thread_local=False)


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
        name, text = str(getattr(error, "sqlite_errorname", "")), without_controls(str(error))[:200]
        if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
            reason = "is locked by another program; close it there and repeat the command"
        elif name.startswith(("SQLITE_FULL", "SQLITE_IOERR")):
            reason = f"cannot be written ({text}); free some space and repeat the command: it continues from there"
        elif name.startswith(("SQLITE_READONLY", "SQLITE_CANTOPEN")):
            reason = f"cannot be opened ({text})"
        else:
            reason = f"is damaged, or is not a study file ({text})"
        raise JumpcadError(f"{path}: {reason}") from None
