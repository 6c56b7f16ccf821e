"""A bundle's manifest: reads it, and compares the bundle's files with it."""

import hashlib
import json
import math
import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, NoReturn

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from jumpcad.bundle.tree import above, is_safe, shown, tree, trouble
from jumpcad.errors import JumpcadError
from jumpcad.files.names import Text
from jumpcad.plural import counted

MANIFEST = "manifest.json"
FORMAT = 1
LINE_ENDS = "other line ends, nothing else"
KEEP_LINE_ENDS = (
    "Git writes such line ends with core.autocrlf: put `* -text` into .gitattributes and check out again, "
    "or build again with --force"
)
LARGEST_BYTES = 16_000_000
"""A manifest has some 30 kB; a file that is far larger is not read."""


SUFFIXES = (
    ".3mf", ".config", ".csv", ".dxf", ".gif", ".glb", ".html", ".json", ".md", ".obj", ".png", ".rviz", ".sdf",
    ".step", ".stl", ".svg", ".toml", ".urdf", ".xacro", ".xml",
)  # fmt: skip
PROGRAMS = ("firmware/main.py", "firmware/robot.py", "firmware/winder.py")
IN_ROS2 = re.compile(
    r"ros2/[a-z0-9_]+_description/(CMakeLists\.txt|launch/(view_robot|gazebo)\.launch\.py|config/controllers\.yaml)"
)
"""With `SUFFIXES` and `PROGRAMS`: the files that a bundle may have. A forged manifest that lists others, such as
.git/HEAD or a Python module, would cause their removal when the bundle is built again."""


def _safe(path: str) -> str:
    """Return a path below the bundle's folder; others raise `ValueError`."""
    if not is_safe(path) or path == MANIFEST:
        raise ValueError("leads out of the bundle")
    return path


def _ours(path: str) -> str:
    """Return the path of a file that jumpcad can have written; others raise `ValueError`."""
    hidden = any(name.startswith(".") for name in path.split("/"))
    if hidden or not (path.endswith(SUFFIXES) or path in PROGRAMS or IN_ROS2.fullmatch(path)):
        raise ValueError("is no file of a bundle")
    return _safe(path)


def require_ours(paths: Iterable[str]) -> None:
    """Require that files are such as a bundle may have: one with others could never be read.

    Raises
    ------
    JumpcadError
        If one is not.
    """
    for path in paths:
        try:
            _ours(path)
        except ValueError as wrong:
            raise JumpcadError(
                f"{shown(path)}: {wrong}: an exporter's new suffix belongs in SUFFIXES of jumpcad/bundle/manifest.py"
            ) from None


def _no_file_is_folder(files: dict[str, str]) -> dict[str, str]:
    """Return files of which none is the folder of another; others raise `ValueError`."""
    if any(folder in files for path in files for folder in above(path)):
        raise ValueError("a file is the folder of another")
    return files


Name = Annotated[str, Field(min_length=1, pattern=r"^[^/]*$"), AfterValidator(_safe)]
Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class _MassLine(BaseModel):
    """Where the mass of a part comes from."""

    model_config = ConfigDict(strict=True)

    kind: Literal["printed", "pad", "bought"]
    name: Text
    quantity: Annotated[int, Field(ge=1)]
    material: Text
    mass_kg: Annotated[float, Field(ge=0.0)]
    source: Text


class _Manifest(BaseModel):
    """The keys of a manifest that jumpcad reads; it may have more."""

    model_config = ConfigDict(strict=True)

    format: int
    name: Name
    versions: dict[str, str]
    masses: list[_MassLine] = []
    mass_kg: float = 0.0
    bodies: dict[str, Any] = {}
    files: Annotated[dict[Annotated[str, AfterValidator(_ours)], Sha256], AfterValidator(_no_file_is_folder)]


@dataclass(frozen=True, repr=False)
class Bundle:
    """A folder that holds a robot or the coupon; `manifest` is the content of its manifest.json."""

    folder: Path
    manifest: Mapping[str, Any]

    def __repr__(self) -> str:
        return f"<Bundle {self.name[:40]!r}: {counted(len(self.files), 'file')} in {shown(str(self.folder))[-100:]}>"

    @property
    def name(self) -> str:
        """The robot's name, which is part of its files' names."""
        return str(self.manifest["name"])

    @property
    def content(self) -> str:
        """What the bundle holds, in words."""
        return f"the robot {self.name}" if "bodies" in self.manifest else f"the {self.name}"

    @property
    def files(self) -> tuple[str, ...]:
        """The paths of all files, except the manifest, relative to the folder."""
        return tuple(self.manifest["files"])

    @property
    def urdf(self) -> Path:
        """Path of the URDF file; the loop file is beside it.

        Raises
        ------
        JumpcadError
            If one of the two is missing.
        """
        self.file(f"urdf/{self.name}.loop.json")
        return self.file(f"urdf/{self.name}.urdf")

    def file(self, path: str) -> Path:
        """Return the path of one of the bundle's files.

        Raises
        ------
        JumpcadError
            If the manifest does not list it, or it is missing, a link, below a link, or not a plain file.
        """
        wrong = trouble(self.folder, path) if path in self.manifest["files"] else "not in the manifest"
        if wrong:
            raise JumpcadError(f"{self.folder}: {shown(path)}: {wrong}; build the bundle again with jumpcad build")
        return self.folder / path

    def is_unchanged(self, path: str) -> bool:
        """Tell whether a plain file has the manifest's sha256."""
        return bool(self.manifest["files"].get(path) == _sha256(self.folder / path))

    def has_other_line_ends(self, path: str) -> bool:
        """Tell whether a file is as it was written, but for CR LF in the place of LF."""
        unix = (self.folder / path).read_bytes().replace(b"\r\n", b"\n")
        return bool(self.manifest["files"].get(path) == hashlib.sha256(unix).hexdigest())


def open_bundle(folder: str | Path) -> Bundle:
    """Return the bundle in a folder.

    Raises
    ------
    JumpcadError
        If there is none, its manifest cannot be read, or it has another format.
    """
    path = Path(folder) / MANIFEST
    if wrong := trouble(Path(folder), MANIFEST):
        raise JumpcadError(f"{path}: {wrong}; a bundle has one: jumpcad build makes it")
    try:
        with path.open("rb") as stream:
            text = stream.read(LARGEST_BYTES + 1)
        small = len(text) <= LARGEST_BYTES
        manifest: Any = json.loads(text, parse_constant=_refuse, parse_float=_finite) if small else None
        if manifest["format"] != FORMAT and isinstance(manifest["format"], int):
            raise JumpcadError(f"{path}: format {manifest['format']}; this version reads {FORMAT}: build it again")
        _Manifest.model_validate(manifest)
        json.dumps(manifest, ensure_ascii=False).encode()  # half of a character cannot be
        return Bundle(Path(os.path.realpath(folder)), manifest)
    except OSError as error:
        raise JumpcadError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise JumpcadError(f"{path}: is not the manifest of a bundle: build it again with jumpcad build") from None


def verify(folder: str | Path) -> list[str]:
    """Return what is wrong with a bundle's files, one line each: `stl/foot.stl: missing`, `bom.csv: changed`.

    Raises
    ------
    JumpcadError
        If the folder is not a bundle, or a file cannot be read.
    """
    bundle = open_bundle(folder)
    wrong = []
    for path in bundle.files:
        try:
            reason = trouble(bundle.folder, path)
            if not reason and not bundle.is_unchanged(path):
                reason = LINE_ENDS if bundle.has_other_line_ends(path) else "changed"
        except OSError as error:
            reason = f"cannot be read ({error.strerror})"
        if reason:
            wrong.append(f"{path}: {reason}")
    return wrong


def unlisted(folder: str | Path) -> list[str]:
    """Return the paths in a bundle's folder that its manifest does not list: files that a user added.

    Raises
    ------
    JumpcadError
        If the folder is not a bundle, or cannot be read.
    """
    bundle = open_bundle(folder)
    try:
        there = tree(bundle.folder)
    except OSError as error:
        raise JumpcadError(f"{error.filename}: cannot be read: {error.strerror}") from None
    own = {MANIFEST, *bundle.files}.union(*map(above, bundle.files))
    inner = {parent for path in there for parent in above(path)}
    return [shown(path) for path in sorted(there.keys() - own - inner)]


def _sha256(file: Path) -> str:
    with file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _finite(number: str) -> float:
    """Return a number; one that is too large for a double, as 1e999, raises `ValueError`."""
    if not math.isfinite(value := float(number)):
        raise ValueError(number)
    return value


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number")
