"""Writes files at a user's path: completely or not at all, and never over the user's own files.

For every command, a file is replaced only if jumpcad wrote it and nobody has changed it since, or with `--force`. A
bundle's manifest lists its files; other text files and pictures that jumpcad may replace end with a seal, a checksum
of their content; any other file counts as the user's own.
"""

import hashlib
import os
import re
import secrets
import shutil
import stat
import struct
import zlib
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from jumpcad.errors import JumpcadError

SEAL = "Written by jumpcad; SHA-256 of the lines above: "
FILES = ".toml", ".urdf"
"""Ends of inputs that are files: no templates' names, and no bundles, which their manifests protect."""
LARGEST_SEALED = 1 << 28
"""Bytes of a file beyond which jumpcad did not write it; the largest page has some megabytes."""
DEVICE = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³])(\.|$)", re.IGNORECASE)
"""Names that Windows keeps for devices, with any ending (Microsoft, Naming Files, Paths, and Namespaces)."""
DEEPEST = 200
"""Folders of a path."""
PNG_END = 12
"""Bytes of the chunk that ends a PNG file."""


def write_atomically(path: Path, data: str | bytes, force: bool = False) -> None:
    """Write a file so that `path` has either the new or the old content; see `write_files`."""
    write_files(path.parent, {path.name: data}, force)


def write_files(folder: Path, files: Mapping[str, str | bytes], force: bool = False) -> list[Path]:
    """Write files into a folder, which is made with its parents; return them. All are written or none.

    They get temporary names in the folder first. A new one is then put in its place by a hard link, which replaces
    nothing that a user made meanwhile. Text is written in UTF-8.
    """
    require_path(folder)
    made, at = [one for one in (folder, *folder.parents) if not os.path.lexists(one)], folder
    waiting, old = ({folder / name: folder / f".jumpcad-{secrets.token_hex(8)}" for name in files} for _ in range(2))
    done: list[Path] = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for (at, temporary), data in zip(waiting.items(), files.values(), strict=True):
            with temporary.open("xb") as stream:  # with the permissions that the user's umask allows
                stream.write(data.encode() if isinstance(data, str) else data)
            if at.exists():
                shutil.copymode(at, temporary)
        for at, temporary in waiting.items():
            there = os.path.lexists(at)  # what is made from here on is not replaced
            require_free(at, force)
            if there:
                _keep(at, old[at])
                done.append(at)
                os.replace(temporary, at)
            else:
                _put(temporary, at, done)
    except BaseException as error:
        for path in done:
            with suppress(OSError):
                os.replace(old[path], path) if old[path].exists() else os.unlink(path)
        _unlink(*waiting.values(), *old.values())
        for one in made:
            with suppress(OSError):
                one.rmdir()
        if isinstance(error, OSError):
            raise JumpcadError(f"{at}: cannot be written: {error.strerror}") from None
        raise
    _unlink(*waiting.values(), *old.values())
    return list(waiting)


def _keep(file: Path, aside: Path) -> None:
    try:
        os.link(file, aside)
    except OSError:  # a file system without hard links, such as FAT
        shutil.copy2(file, aside)


def _put(temporary: Path, at: Path, done: list[Path]) -> None:
    """Give a file its name, if that is free."""
    try:
        os.link(temporary, at)
    except OSError:
        at.open("xb").close()  # no links there, or the name is taken now
        done.append(at)
        os.replace(temporary, at)
    done.append(at)


def _unlink(*files: Path) -> None:
    for file in files:
        with suppress(OSError):
            os.unlink(file)


def require_path(path: Path) -> None:
    """Require that a path is possible."""
    if "\0" in str(path):
        raise JumpcadError(f"{path}: cannot be a path: it has a NUL")
    if len(path.parts) > DEEPEST:
        raise JumpcadError(f"{path}: cannot be a path: it has more than {DEEPEST} folders")
    for one in (path, *path.parents):
        if DEVICE.match(one.name) and not os.path.lexists(one):
            raise JumpcadError(f"{path}: cannot be a path: {one.name} is a device on Windows; choose another name")
    try:
        os.fsencode(path)
    except UnicodeEncodeError as error:
        wrong = f"U+{ord(error.object[error.start]):04X}"
        raise JumpcadError(f"{path}: cannot be a path: {wrong} cannot be part of a file's name") from None


def real_path(path: str | Path) -> Path:
    """Return the absolute path with all links followed; it need not exist."""
    require_path(Path(path))
    try:
        real = Path(path).resolve()
        with suppress(FileNotFoundError, NotADirectoryError):
            real.stat()  # in Python 3.14 neither `resolve` nor `exists` says what is wrong
    except (OSError, RuntimeError) as error:
        raise JumpcadError(f"{path}: cannot be a path: {getattr(error, 'strerror', None) or error}") from None
    return real


def require_apart(outputs: Mapping[str, Path | None], inputs: Mapping[str, str | Path | None]) -> None:
    """Require that no output is another output or an input, or below one, also through links.

    Both are paths by their options, None if not given. Inputs that are templates or bundles do not count.
    """
    there = {name: path for name, path in outputs.items() if path is not None}
    files = {name: path for name, path in inputs.items() if path is not None and not os.path.isdir(path)}
    read = {name: Path(path) for name, path in files.items() if isinstance(path, Path) or path.endswith(FILES)}
    for number, (name, path) in enumerate(there.items()):
        for other, second in [*list(there.items())[:number], *read.items()]:
            if _same_file(path, second):
                raise JumpcadError(f"{name} {path}: is {other} itself; choose another name")
            if _lies_below(path, second):
                raise JumpcadError(f"{name} {path}: lies below {other} {second}, which is a file; choose another name")
            if other in there and _lies_below(second, path):
                raise JumpcadError(f"{other} {second}: lies below {name} {path}, which is a file; choose another name")


def require_target(path: Path, suffixes: tuple[str, ...], force: bool = False) -> None:
    """Require that an output file can be written."""
    require_path(path)
    if path.suffix not in suffixes:
        raise JumpcadError(f"{path}: must end in {' or '.join(suffixes)}")
    require_folder(path)
    require_free(path, force)
    require_writable(path.parent)


def require_folder(path: Path) -> None:
    """Require that the folder of an output file exists."""
    if not os.path.isdir(path.parent):
        raise JumpcadError(f"{path}: cannot be written: there is no folder {path.parent}")


def require_writable(folder: Path) -> None:
    """Require that files can be made in a folder, or in the nearest one above it that is there, by making an empty one.

    What the system says of rights is not the whole truth on disks that are shared or mounted to be read only.
    """
    require_path(folder)
    there = folder
    while not os.path.lexists(there) and there.parent != there:
        there = there.parent
    probe = there / f".jumpcad-{secrets.token_hex(8)}"
    try:
        os.close(os.open(probe, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))
        os.unlink(probe)
    except OSError as error:
        raise JumpcadError(
            f"{folder}: cannot be written: no file can be made in {there} ({error.strerror}); choose another folder"
        ) from None


def require_free(path: Path, force: bool = False) -> None:
    """Require that a path is free, or a file that may be replaced."""
    require_path(path)
    try:
        mode = os.lstat(path).st_mode
    except (FileNotFoundError, NotADirectoryError):
        return
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be written: {error.strerror}") from None
    if not stat.S_ISREG(mode):
        raise JumpcadError(f"{path}: is there already and is no plain file; choose another name")
    if not force and not is_sealed(path):
        raise JumpcadError(f"{path}: exists already; choose another name, or replace it with --force")


def sealed(text: str, comment: str = "# {}") -> str:
    """Return text, which ends with a line break, with a seal as its last line: `require_free` knows unchanged files."""
    return f"{text}{comment.format(SEAL + sha256(text.encode()))}\n"


def sealed_png(png: bytes) -> bytes:
    """Return a PNG file with a seal in a comment before its end (PNG 11.3.4.3), for the same purpose as `sealed`."""
    words = b"tEXtComment\0" + (SEAL + sha256(png[:-PNG_END])).encode()
    chunk = struct.pack(">I", len(words) - 4) + words + struct.pack(">I", zlib.crc32(words))
    return png[:-PNG_END] + chunk + png[-PNG_END:]


def _same_file(one: Path, other: Path) -> bool:
    """Tell whether two paths are the same file, also through links, and also if it does not exist yet."""
    if os.path.realpath(one) == os.path.realpath(other):
        return True
    return os.path.exists(one) and os.path.exists(other) and os.path.samefile(one, other)


def _lies_below(path: Path, file: Path) -> bool:
    """Tell whether a path would be in a folder of a file's name."""
    folder = bool(file.suffix) and not os.path.isdir(file)
    return folder and os.path.realpath(path).startswith(os.path.realpath(file) + os.sep)


def is_sealed(path: Path) -> bool:
    """Whether a file is as jumpcad wrote it: see `sealed`."""
    try:
        data = path.read_bytes() if path.stat().st_size <= LARGEST_SEALED else b""
    except OSError:
        return False
    if path.suffix == ".png":
        without = data[: data.rfind(b"tEXtComment\0" + SEAL.encode()) - 4] + data[-PNG_END:]
        return sealed_png(without) == data
    last = data.rfind(b"\n", 0, -1) + 1
    return (SEAL + sha256(data[:last])).encode() in data[last:]


def sha256(data: bytes) -> str:
    """Return a digest in hexadecimal."""
    return hashlib.sha256(data).hexdigest()
