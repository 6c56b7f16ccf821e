"""Lists a folder's contents. No link is followed, no file is opened."""

import os
import stat
from collections.abc import Sequence
from pathlib import Path

from jumpcad.errors import JumpcadError

NAMED = 3
"""Files that an error names; the others are counted."""
Tree = dict[str, os.stat_result]
"""The `lstat` of everything below a folder by its path, written with '/'; a folder comes before its contents."""


def tree(folder: Path) -> Tree:
    """Return everything below a folder; links are not followed.

    Raises
    ------
    OSError
        If a folder cannot be read.
    JumpcadError
        If something is on another file system than the folder.
    """
    found: Tree = {}
    disk, waiting = folder.stat().st_dev, [""]
    while waiting:
        inside = waiting.pop()
        with os.scandir(folder / inside) as entries:
            listed = sorted(entries, key=lambda entry: entry.name)
        for entry in listed:
            path = f"{inside}/{entry.name}" if inside else entry.name
            found[path] = entry.stat(follow_symlinks=False)
            if found[path].st_dev != disk:
                raise JumpcadError(f"{folder}: {shown(path)} lies on another disk; choose another folder with -o")
            if stat.S_ISDIR(found[path].st_mode):
                waiting.append(path)
    return found


def trouble(folder: Path, path: str) -> str:
    """Return why a path is not a plain file below a folder; empty if it is one."""
    place, mode = folder, stat.S_IFDIR
    for name in path.split("/"):
        place /= name
        if not stat.S_ISDIR(mode):
            return "missing"
        try:
            mode = os.lstat(place).st_mode
        except (FileNotFoundError, NotADirectoryError):
            return "missing"
        except OSError as error:
            return str(error.strerror)
        if stat.S_ISLNK(mode):
            return "a link" if place == folder / path else "behind a link"
    return "" if stat.S_ISREG(mode) else "not a plain file"


def is_safe(path: str) -> bool:
    """Tell whether a path, written with '/', stays below the folder that it is relative to, on every system."""
    return path.isprintable() and not any(
        name in ("", ".", "..") or ":" in name or "\\" in name for name in path.split("/")
    )


def above(path: str) -> list[str]:
    """Return the folders of a path, the outermost first: `a/b/c` has `a` and `a/b`."""
    names = path.split("/")
    return ["/".join(names[:count]) for count in range(1, len(names))]


def few(things: Sequence[str]) -> str:
    """Return the first paths of several as text, and how many more there are."""
    more = f" and {len(things) - NAMED} more" if len(things) > NAMED else ""
    return ", ".join(map(shown, things[:NAMED])) + more


def shown(path: str) -> str:
    """Return a path as text; with escapes if it has characters that cannot be printed."""
    return path if path.isprintable() else ascii(path)[1:-1]
