"""Writes or replaces a bundle's folder: whole or not at all, and never over a user's file.

Files with the manifest's sha256 are jumpcad's and are replaced. All others belong to the user and stay; if one cannot,
`JumpcadError` is raised before anything is written.

The new folder is made beside the old one, from links to its files, and the two change places in one step: whenever a
build is killed, the name is that of a complete folder, and at most a hidden one is left beside it. Where the system
cannot exchange two folders there are two renames, between which no folder has the name (docs/decisions/swap.md).
"""

import ctypes
import errno
import importlib.metadata
import json
import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from jumpcad.bundle.manifest import (
    FORMAT,
    KEEP_LINE_ENDS,
    LINE_ENDS,
    MANIFEST,
    Bundle,
    Manifest,
    above,
    few,
    open_bundle,
    own_path,
    trouble,
)
from jumpcad.errors import JumpcadError
from jumpcad.face import __version__
from jumpcad.files.outputs import real_path, require_writable, sha256

LIBRARIES = ("manifold3d", "numpy", "trimesh")
"""Libraries on whose versions the shapes may depend."""
HERE, EXCHANGE = -100, 2
"""`AT_FDCWD` and `RENAME_EXCHANGE` of Linux's renameat2(2)."""
Stamp = tuple[int, int]
"""Size and date (ns) of a file."""


def write_folder(
    folder: str | Path, name: str, facts: Mapping[str, Any], contents: Iterable[tuple[str, str | bytes]],
    force: bool = False,
) -> Bundle:  # fmt: skip
    """Write files and the manifest that lists them, in place of those of an older bundle.

    The folder is made, with its parents; it may be empty or hold a bundle; files that a user added to it stay. `name`
    and `facts` are entries of the manifest, in addition to the versions and the sha256 of every file. `force` replaces
    another bundle too, and files that a user edited, or added under a path of the bundle.
    """
    target = _writable_folder(folder)
    versions = {"jumpcad": __version__} | {library: importlib.metadata.version(library) for library in LIBRARIES}
    old, new = _bundle_in(target), Bundle(target, {"format": FORMAT, "name": name, "versions": versions, **facts})
    if old and old.content != new.content and not force:
        raise JumpcadError(
            f"{target}: holds {old.content}, not {new.content}; choose another folder with -o, "
            "or replace it with --force"
        )
    return _put(new, old, dict(contents), set(old.files) if old else set(), force)


def change_files(
    bundle: Bundle, contents: Mapping[str, str | bytes], versions: Mapping[str, str], force: bool = False
) -> Bundle:
    """Write files of a bundle, old or new ones; the manifest then lists them, and `versions` of what made them."""
    manifest = {**bundle.manifest, "versions": {**bundle.manifest["versions"], **versions}}
    return _put(Bundle(_writable_folder(bundle.folder), manifest), bundle, contents, set(contents), force)


def require_place(folder: str | Path) -> None:
    """Require, before a bundle is made, that it can be written to a folder: `write_folder` looks again."""
    target = _writable_folder(folder)
    _bundle_in(target)
    require_writable(target.parent)


def require_unedited(bundle: Bundle, paths: Iterable[str], force: bool = False) -> None:
    """Require that a user has not edited files: `change_files` would reject them, but only after they were made."""
    with _plain_errors(bundle.folder):
        _replaceable(bundle, dict.fromkeys(paths, b""), set(), force)
    require_writable(real_path(bundle.folder).parent)


def _put(new: Bundle, old: Bundle | None, contents: Mapping[str, str | bytes], gone: set[str], force: bool) -> Bundle:
    """Write files in place of `gone` ones; the manifest lists the sha256 of these and of the old bundle's others."""
    files = {path: data.encode() if isinstance(data, str) else data for path, data in contents.items()}
    for path in files:
        try:
            own_path(path)
        except ValueError as wrong:
            raise JumpcadError(
                f"{path}: {wrong}: an exporter's new suffix belongs in SUFFIXES of jumpcad/bundle/manifest.py"
            ) from None
    stays = {path: digest for path, digest in old.manifest["files"].items() if path not in gone} if old else {}
    digests = stays | {path: sha256(data) for path, data in files.items()}
    manifest = {**new.manifest, "files": dict(sorted(digests.items()))}
    if old and old.manifest["files"] == manifest["files"]:  # the libraries that first gave these bytes stay named
        first = {library: version for library, version in old.manifest["versions"].items() if library in LIBRARIES}
        manifest["versions"] = manifest["versions"] | first
    manifest = Manifest.model_validate(manifest).model_dump(exclude_unset=True)
    files[MANIFEST] = (json.dumps(manifest, indent=2, allow_nan=False) + "\n").encode()
    with _plain_errors(new.folder):
        _replace(new.folder, files, _replaceable(old, files, gone, force) if old else {})
    return Bundle(new.folder, manifest)


def _writable_folder(folder: str | Path) -> Path:
    """Return the real path of a folder."""
    target = real_path(folder)
    with suppress(OSError):  # the working directory no longer exists
        here = Path.cwd().resolve()
        if target in (here, *here.parents):
            raise JumpcadError(
                f"{target}: is or holds the current folder; choose another folder with -o, or leave it first"
            )
    return target


def _bundle_in(target: Path) -> Bundle | None:
    """Return the bundle in a folder, or None if the folder is missing or empty."""
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


def _replaceable(old: Bundle, files: Mapping[str, bytes], gone: set[str], force: bool) -> dict[str, Stamp]:
    """Return the files in a bundle's folder that are removed when `files` replace those of `gone`."""
    for folder in sorted({folder for path in files for folder in above(path)}):
        if os.path.lexists(place := old.folder / folder) and (place.is_symlink() or not place.is_dir()):
            raise JumpcadError(f"{old.folder}: {folder}: must be a folder; move it away")
    found = {path: trouble(old.folder, path) for path in sorted({*gone, *files})}
    for path, wrong in found.items():
        if wrong not in ("", "missing", "behind a link"):
            raise JumpcadError(f"{old.folder}: {path}: must be a plain file; move it away")
    stamps = {path: _stamp(old.folder / path) for path, wrong in found.items() if not wrong}
    edited = {path: old.difference(path) for path in stamps if path != MANIFEST and not force}
    lost = [path for path, how in edited.items() if how and (old.folder / path).read_bytes() != files.get(path)]
    if lost and all(edited[path] == LINE_ENDS for path in lost):
        raise JumpcadError(f"{old.folder}: {few(lost)}: {LINE_ENDS}; {KEEP_LINE_ENDS}")
    if lost:
        raise JumpcadError(
            f"{old.folder}: {few(lost)}: edited or added since the bundle was written; "
            "keep a copy elsewhere, or replace with --force"
        )
    return stamps


def _replace(target: Path, files: Mapping[str, bytes], gone: Mapping[str, Stamp]) -> None:
    """Write files into a folder in place of `gone` ones; whatever else it holds stays."""
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name[:32]}."))
    fresh = temporary / "new"
    try:
        if target.exists():
            shutil.copytree(target, fresh, symlinks=True, copy_function=_link)
        for path in {*gone, *files}:  # what is written through a link would change the target
            (fresh / path).unlink(missing_ok=True)
        for path, data in files.items():
            (fresh / path).parent.mkdir(parents=True, exist_ok=True)
            (fresh / path).write_bytes(data)
        for folder in sorted({folder for path in gone for folder in above(path)}, reverse=True):
            with suppress(OSError):  # it is not empty
                (fresh / folder).rmdir()
        left = _exchange(fresh, target)
    except BaseException:
        shutil.rmtree(temporary, ignore_errors=True)  # the target still has everything
        raise
    if _changed(left, target, gone):
        raise JumpcadError(f"{target}: is written, but what was changed in it meanwhile is in {left}")
    shutil.rmtree(temporary, ignore_errors=True)


def _link(file: str, place: str) -> None:
    """Make a hard link to a file; copy it if the file system has no hard links."""
    try:
        os.link(file, place)
    except OSError as error:
        if error.errno == errno.EXDEV:
            raise JumpcadError(f"{file}: lies on another disk; choose another folder with -o") from None
        try:
            shutil.copy2(file, place)
        except OSError as error:  # also of what is no plain file
            raise JumpcadError(f"{file}: cannot be kept ({error.strerror or error}); move it away") from None


def _exchange(fresh: Path, target: Path) -> Path:
    """Put a new folder in the target's place; return the path of the old one then."""
    if not os.path.lexists(target):
        os.rename(fresh, target)
        return fresh
    if exchanged(fresh, target):
        return fresh
    aside = fresh.with_name("old")
    os.rename(target, aside)
    try:
        os.rename(fresh, target)
    except BaseException:
        os.rename(aside, target)
        raise
    return aside


def exchanged(one: Path, other: Path) -> bool:
    """Exchange two existing paths of one file system; return False, with nothing changed, if that is not possible."""
    try:
        rename = ctypes.CDLL(None).renameat2 if sys.platform == "linux" else None
    except AttributeError:  # a C library that does not have it
        rename = None
    return rename is not None and rename(HERE, os.fsencode(one), HERE, os.fsencode(other), EXCHANGE) == 0


def _changed(old: Path, new: Path, gone: Mapping[str, Stamp]) -> bool:
    """Tell whether a file of an old folder was changed since the new one was made; let the folder be removed."""
    for inside, _, names in os.walk(old):
        with suppress(OSError):
            os.chmod(inside, stat.S_IRWXU)
        for name in names:
            path = Path(inside, name).relative_to(old)
            known = gone.get(path.as_posix()) or (_stamp(new / path) if os.path.lexists(new / path) else None)
            if _stamp(old / path) != known:
                return True
    return False


def _stamp(file: Path) -> Stamp:
    now = os.lstat(file)
    return now.st_size, now.st_mtime_ns


@contextmanager
def _plain_errors(folder: str | Path) -> Iterator[None]:
    """Raise `JumpcadError` of one line for an `OSError`."""
    try:
        yield
    except OSError as error:
        why = error.args[0][0][2] if isinstance(error, shutil.Error) else error.strerror
        raise JumpcadError(f"{folder}: cannot be written: {why}") from None
