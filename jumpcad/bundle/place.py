"""Replaces a folder atomically: all of it or nothing.

The new folder is written beside the old one and exchanged with it in one step: whenever a build is killed, the name
is that of a complete folder, old or new, and at most a hidden folder is left over beside it. Where the system cannot
exchange two folders (see `jumpcad.bundle.swap`) there are two renames, between which no folder has the name.

Files that are kept are linked into the new folder before the exchange, so that it is never incomplete.
"""

import os
import shutil
import stat
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path, PurePosixPath

from jumpcad.bundle.swap import exchanged
from jumpcad.bundle.tree import Tree
from jumpcad.errors import JumpcadError


def write_in_place(target: Path, files: Mapping[str, bytes], there: Tree, kept: Tree) -> None:
    """Write files, and those that are kept, to a folder beside the target, and exchange the two.

    Parameters
    ----------
    target
        The folder; is made, with its parents.
    files
        Path and content of all files that are written.
    there, kept
        What the folder holds, and the part of it that is kept: linked, not copied, with its date and permissions.

    Raises
    ------
    OSError, JumpcadError
        If the folder cannot be written, or something cannot be kept: nothing is changed then. `JumpcadError` also if a
        file was changed during the exchange: the message says where it is.
    """
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name[:32]}."))
    try:
        fresh = temporary / "new"
        _fill(fresh, files, target, kept)
        _copy_modes(target, fresh, there, kept)
        left = _exchange(fresh, target, temporary / "old")
    except BaseException:
        shutil.rmtree(temporary, ignore_errors=True)  # the target still has everything
        raise
    _clear(left, there)
    try:
        temporary.rmdir()
    except OSError:
        raise JumpcadError(f"{target}: is written, but what was changed in it meanwhile is in {left}") from None


def _fill(fresh: Path, files: Mapping[str, bytes], target: Path, kept: Tree) -> None:
    """Write files into a new folder and link the target's kept files into it."""
    fresh.mkdir()
    for path, data in files.items():
        file = fresh / PurePosixPath(path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    for path, status in kept.items():
        if stat.S_ISDIR(status.st_mode):
            (fresh / path).mkdir(exist_ok=True)
        else:
            _link(target / path, fresh / path)


def _link(file: Path, place: Path) -> None:
    """Make a hard link to a file or symbolic link; copy it if the file system has no hard links.

    Raises
    ------
    JumpcadError
        If it is neither a file nor a link, or cannot be copied.
    """
    try:
        os.link(file, place, follow_symlinks=False)
    except (OSError, NotImplementedError):
        try:
            if not (file.is_symlink() or file.is_file()):
                raise JumpcadError(f"{file}: is no plain file and cannot be kept; move it away") from None
            shutil.copy2(file, place, follow_symlinks=False)
        except OSError as error:
            raise JumpcadError(f"{file}: cannot be kept ({error.strerror}); move it away") from None


def _copy_modes(target: Path, fresh: Path, there: Tree, kept: Tree) -> None:
    """Give the new folders the permissions of the old ones; a user's folders keep their dates too."""
    for path in reversed([path for path, status in there.items() if stat.S_ISDIR(status.st_mode)]):
        if (fresh / path).is_dir():
            (shutil.copystat if path in kept else shutil.copymode)(target / path, fresh / path)
    if target.exists():
        shutil.copymode(target, fresh)


def _exchange(fresh: Path, target: Path, aside: Path) -> Path:
    """Put a new folder in the target's place; return the path of the old one then."""
    if not os.path.lexists(target):
        os.rename(fresh, target)
        return fresh
    if exchanged(fresh, target):
        return fresh
    try:
        os.rename(target, aside)
        os.rename(fresh, target)
    except BaseException:
        if aside.exists() and not target.exists():
            os.rename(aside, target)
        raise
    return aside


def _clear(folder: Path, known: Tree) -> None:
    """Remove the known and unchanged files of a folder, and the folder if nothing else is in it."""
    with suppress(OSError):
        for place in (folder, *(folder / path for path, before in known.items() if stat.S_ISDIR(before.st_mode))):
            place.chmod(stat.S_IRWXU)
    for path, before in reversed(known.items()):
        with suppress(OSError):
            now = os.lstat(folder / path)
            if stat.S_ISDIR(now.st_mode):
                os.rmdir(folder / path)
            elif (now.st_ino, now.st_size, now.st_mtime_ns) == (before.st_ino, before.st_size, before.st_mtime_ns):
                os.unlink(folder / path)
    with suppress(OSError):
        folder.rmdir()
