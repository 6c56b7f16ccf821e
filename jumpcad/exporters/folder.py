"""A bundle's folder, written whole or not at all.

It is written beside its place and changes places with the old one in one step: whenever a build is killed, a whole
bundle stands under the name, the old one or the new one, and at most a hidden folder is left over beside it. Where the
system cannot exchange two folders (see `jumpcad.exporters.swap`) there are two renames, between which there is none.
"""

import hashlib
import importlib.metadata
import json
import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import jumpcad
from jumpcad.errors import JumpcadError
from jumpcad.exporters.manifest import FORMAT, MANIFEST, Bundle, is_bundle
from jumpcad.exporters.swap import exchanged
from jumpcad.files import real_path

LIBRARIES = ("manifold3d", "numpy", "trimesh")
"""Whose versions the shapes may depend on."""


def write_folder(
    folder: str | Path, name: str, facts: Mapping[str, Any], contents: Iterable[tuple[str, str | bytes]]
) -> Bundle:
    """Write files and the manifest that knows them, in place of an older bundle.

    Parameters
    ----------
    folder
        Is made, with its parents; may be empty or hold a bundle, which is replaced as a whole.
    name, facts
        What the manifest says beside the versions and the sha256 of every file.
    contents
        Path and content of every file but the manifest.

    Raises
    ------
    JumpcadError
        If the folder holds anything else, or cannot be written.
    """
    target = real_path(folder)
    _require_free(target)
    files = {path: data.encode() if isinstance(data, str) else data for path, data in contents}
    manifest = {
        "format": FORMAT,
        "name": name,
        "versions": {"jumpcad": jumpcad.__version__} | {lib: importlib.metadata.version(lib) for lib in LIBRARIES},
        **facts,
    }
    return _put(target, manifest, files)


def change_files(bundle: Bundle, contents: Mapping[str, str], versions: Mapping[str, str]) -> Bundle:
    """Put other contents into files that a bundle has; the manifest then knows them and what wrote them.

    Raises
    ------
    JumpcadError
        If the folder cannot be read or written.
    """
    target = bundle.folder.resolve()
    try:
        files = {path: (target / path).read_bytes() for path in bundle.files}
    except OSError as error:
        raise JumpcadError(f"{target}: cannot be read: {error.strerror}") from None
    manifest = {**bundle.manifest, "versions": {**bundle.manifest["versions"], **versions}}
    return _put(target, manifest, files | {path: text.encode() for path, text in contents.items()})


def _put(target: Path, manifest: Mapping[str, Any], files: Mapping[str, bytes]) -> Bundle:
    """Write files with a manifest that knows their sha256."""
    known = {**manifest, "files": {path: hashlib.sha256(data).hexdigest() for path, data in sorted(files.items())}}
    text = json.dumps(known, indent=2, allow_nan=False) + "\n"
    try:
        _write(target, {**files, MANIFEST: text.encode()})
    except OSError as error:
        raise JumpcadError(f"{target}: cannot be written: {error.strerror}") from None
    return Bundle(target, known)


def _require_free(target: Path) -> None:
    """Refuse to replace what is not a bundle."""
    if not target.exists():
        return
    if not target.is_dir():
        raise JumpcadError(f"{target}: is a file; choose another folder with -o")
    if any(target.iterdir()) and not is_bundle(target):
        raise JumpcadError(f"{target}: holds files but no {MANIFEST}, so it is not a bundle; choose another with -o")


def _write(target: Path, files: Mapping[str, bytes]) -> None:
    """Write files to a folder beside the target and put it in the target's place."""
    target.parent.mkdir(parents=True, exist_ok=True)
    workplace = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name}."))
    try:
        fresh = workplace / "new"
        for path, data in files.items():
            file = fresh / PurePosixPath(path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        if target.exists() and exchanged(fresh, target):
            return
        if target.exists():
            os.rename(target, workplace / "old")
        os.rename(fresh, target)
    finally:
        shutil.rmtree(workplace, ignore_errors=True)
