"""A bundle's folder: which of its files jumpcad replaces, and which belong to the user.

Files with the manifest's sha256 are replaced. All others belong to the user and are kept; if one cannot be kept,
`JumpcadError` is raised before anything is written.
"""

import hashlib
import importlib.metadata
import json
import os
import stat
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from jumpcad.bundle.manifest import (
    FORMAT,
    KEEP_LINE_ENDS,
    LINE_ENDS,
    MANIFEST,
    Bundle,
    open_bundle,
    require_ours,
)
from jumpcad.bundle.place import write_in_place
from jumpcad.bundle.tree import Tree, above, few, shown, tree
from jumpcad.errors import JumpcadError
from jumpcad.files import real_path
from jumpcad.files.outputs import require_writable
from jumpcad.version import __version__

LIBRARIES = ("manifold3d", "numpy", "trimesh")
"""Libraries on whose versions the shapes may depend."""


def write_folder(
    folder: str | Path,
    name: str,
    facts: Mapping[str, Any],
    contents: Iterable[tuple[str, str | bytes]],
    force: bool = False,
) -> Bundle:
    """Write files and the manifest that lists them, in place of those of an older bundle.

    Parameters
    ----------
    folder
        Is made, with its parents; may be empty or hold a bundle; files that a user added to it stay.
    name, facts
        Entries of the manifest, in addition to the versions and the sha256 of every file.
    contents
        Path and content of every file, except the manifest.
    force
        Whether to replace another bundle too, and files that a user edited, or added under a path of the bundle.

    Raises
    ------
    JumpcadError
        If the folder holds anything else, a user's file would be lost, the folder cannot be written, or a file is none
        that a bundle may have.
    """
    target = _writable_folder(folder)
    manifest = {
        "format": FORMAT,
        "name": name,
        "versions": {"jumpcad": __version__} | {lib: importlib.metadata.version(lib) for lib in LIBRARIES},
        **facts,
    }
    old, new = _bundle_in(target), Bundle(target, manifest)
    if old and old.content != new.content and not force:
        raise JumpcadError(
            f"{target}: holds {old.content}, not {new.content}; choose another folder with -o, "
            "or replace it with --force"
        )
    files = {path: data.encode() if isinstance(data, str) else data for path, data in contents}
    return _put(new, old, files, set(old.files) if old else set(), force)


def require_place(folder: str | Path) -> None:
    """Require, before a bundle is made, that it can be written to a folder: `write_folder` looks again.

    Raises
    ------
    JumpcadError
        If the folder holds anything but a bundle, is or holds the current folder, or cannot be written.
    """
    target = _writable_folder(folder)
    _bundle_in(target)
    require_writable(target.parent)


def change_files(
    bundle: Bundle, contents: Mapping[str, str | bytes], versions: Mapping[str, str], force: bool = False
) -> Bundle:
    """Write files of a bundle, old or new ones; the manifest then lists them, and `versions` of what made them.

    Raises
    ------
    JumpcadError
        If a user's file would be lost, or the folder cannot be read or written.
    """
    target = _writable_folder(bundle.folder)
    manifest = {**bundle.manifest, "versions": {**bundle.manifest["versions"], **versions}}
    files = {path: data.encode() if isinstance(data, str) else data for path, data in contents.items()}
    return _put(Bundle(target, manifest), bundle, files, set(files), force)


def require_unedited(bundle: Bundle, paths: Iterable[str], force: bool = False) -> None:
    """Require that a user has not edited files: `change_files` would reject them, but only after they were made.

    Raises
    ------
    JumpcadError
        If some were edited; it names them. Or if the bundle's folder cannot be replaced.
    """
    with _plain_errors(bundle.folder):
        _kept(bundle, tree(bundle.folder), dict.fromkeys(paths, b""), set(), force)
    require_writable(real_path(bundle.folder).parent)


def _put(new: Bundle, old: Bundle | None, files: Mapping[str, bytes], gone: set[str], force: bool) -> Bundle:
    """Write files in place of `gone` ones; the manifest lists the sha256 of these and of the old bundle's others."""
    stays = {} if old is None else {path: digest for path, digest in old.manifest["files"].items() if path not in gone}
    digests = stays | {path: hashlib.sha256(data).hexdigest() for path, data in files.items()}
    manifest = {**new.manifest, "files": dict(sorted(digests.items()))}
    text = json.dumps(manifest, indent=2, allow_nan=False) + "\n"
    with _plain_errors(new.folder):
        there = tree(new.folder) if old else {}
        kept = _kept(old, there, files, gone, force) if old else {}
        require_ours(files)
        write_in_place(new.folder, {**files, MANIFEST: text.encode()}, there, kept)
    return Bundle(new.folder, manifest)


def _writable_folder(folder: str | Path) -> Path:
    """Return the real path of a folder.

    Raises
    ------
    JumpcadError
        If it is or contains the working directory, which would be removed.
    """
    target = real_path(folder)
    try:
        here = Path.cwd().resolve()
    except OSError:  # the working directory no longer exists
        return target
    if target == here or target in here.parents:
        raise JumpcadError(
            f"{target}: is or holds the current folder; choose another folder with -o, or leave it first"
        )
    return target


def _bundle_in(target: Path) -> Bundle | None:
    """Return the bundle in a folder, or None if the folder is missing or empty.

    Raises
    ------
    JumpcadError
        If the folder holds anything else.
    """
    if not os.path.lexists(target):
        return None
    if not target.is_dir():
        raise JumpcadError(f"{target}: is a file; choose another folder with -o")
    with _plain_errors(target):
        names = os.listdir(target)
    if not names:
        return None
    if MANIFEST not in names:
        raise JumpcadError(f"{target}: holds files but no {MANIFEST}, so it is not a bundle; choose another with -o")
    try:
        return open_bundle(target)
    except JumpcadError as error:
        raise JumpcadError(f"{target}: holds files, but is not a bundle; choose another with -o ({error})") from None


def _kept(old: Bundle, there: Tree, files: Mapping[str, bytes], gone: set[str], force: bool) -> Tree:
    """Return the user's part of `there`, which stays in a bundle's folder when `files` replace those of `gone`.

    Raises
    ------
    JumpcadError
        If a user's file is in the way: an edited or added one under a path of the bundle, unless `force`; anything
        that is no plain file in any case.
    """
    touched = there.keys() & {MANIFEST, *gone, *files}
    solid = {path for path, status in there.items() if path not in touched and not stat.S_ISDIR(status.st_mode)}
    for path in sorted(touched):
        if not stat.S_ISREG(there[path].st_mode):
            raise JumpcadError(f"{old.folder}: {shown(path)}: must be a plain file; move it away")
    folders = {folder for path in files for folder in above(path)}
    for path in sorted(folders & solid):
        raise JumpcadError(f"{old.folder}: {shown(path)}: must be a folder; move it away")
    lost = [path for path in sorted(touched - {MANIFEST}) if not force and not old.is_unchanged(path)]
    lost = [path for path in lost if (old.folder / path).read_bytes() != files.get(path)]
    if lost and all(map(old.has_other_line_ends, lost)):
        raise JumpcadError(f"{old.folder}: {few(lost)}: {LINE_ENDS}; {KEEP_LINE_ENDS}")
    if lost:
        raise JumpcadError(
            f"{old.folder}: {few(lost)}: edited or added since the bundle was written; "
            "keep a copy elsewhere, or replace with --force"
        )
    ours = {folder for path in old.files for folder in above(path)}
    needed = {folder for path in solid for folder in above(path)}
    return {path: status for path, status in there.items() if path in solid | needed or path not in touched | ours}


@contextmanager
def _plain_errors(folder: str | Path) -> Iterator[None]:
    """Raise `JumpcadError` of one line for an `OSError`."""
    try:
        yield
    except OSError as error:
        raise JumpcadError(f"{folder}: cannot be written: {error.strerror}") from None
