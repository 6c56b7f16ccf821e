"""A bundle read: its manifest, with which its files are compared, and design and workshop, which build it again.

No link is followed.
"""

import os
import re
import stat
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, NoReturn

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StrictFloat, StrictInt

from jumpcad.building import build
from jumpcad.design import Design, load_design
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError, without_controls
from jumpcad.files import read_json, read_toml, template_names
from jumpcad.files.outputs import sha256
from jumpcad.files.records import Text
from jumpcad.parts.part import MassLine
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, load_workshop

MANIFEST = "manifest.json"
FORMAT = 1
LINE_ENDS = "other line ends, nothing else"
KEEP_LINE_ENDS = (
    "Git writes such line ends with core.autocrlf: put `* -text` into .gitattributes and check out again, "
    "or build again with --force"
)
NAMED = 3
"""Files that an error names; the others are counted."""
SUFFIXES = (
    ".3mf", ".config", ".csv", ".dxf", ".gif", ".glb", ".html", ".json", ".md", ".obj", ".png", ".rviz", ".sdf",
    ".step", ".stl", ".svg", ".toml", ".urdf", ".xacro", ".xml",
)  # fmt: skip
OTHERS = re.compile(
    r"firmware/(main|robot|winder|gyroscope)\.py|"
    r"ros2/[a-z0-9_]+_description/(CMakeLists\.txt|launch/(view_robot|gazebo)\.launch\.py|config/controllers\.yaml)"
)
"""With `SUFFIXES`: the files that a bundle may have. A forged manifest that lists others, such as .git/HEAD or a
Python module, would cause their removal when the bundle is built again."""


def _part(name: str) -> str:
    """Return a name that stays below its folder on every system and can be printed; others raise `ValueError`."""
    if name in ("", ".", "..") or not name.isprintable() or any(sign in name for sign in "/\\:"):
        raise ValueError("leads out of the bundle")
    return name


def own_path(path: str) -> str:
    """Return the path of a file that jumpcad can have written; others raise `ValueError`."""
    hidden = any(_part(name).startswith(".") for name in path.split("/"))
    if hidden or path == MANIFEST or not (path.endswith(SUFFIXES) or OTHERS.fullmatch(path)):
        raise ValueError("is no file of a bundle")
    return path


class Manifest(BaseModel):
    """What manifest.json says, in its order: of the coupon no more than masses. One that is read may say more."""

    model_config = ConfigDict(extra="allow")

    format: StrictInt
    name: Annotated[str, AfterValidator(_part)]
    versions: dict[str, str]
    mass_kg: StrictFloat = 0.0
    masses: list[MassLine] = []
    used_up: list[Text] = []
    bodies: dict[str, Any] = {}
    drive: Any = None
    electronics: Any = None
    stop: Any = None
    joints: Any = None
    cage: Any = None
    flight: Any = None
    rights_itself: Any = None
    ground: Any = None
    files: dict[Annotated[str, AfterValidator(own_path)], Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]]


@dataclass(frozen=True, repr=False)
class Bundle:
    """A folder that holds a robot or the coupon; `manifest` is the content of its manifest.json."""

    folder: Path
    manifest: Mapping[str, Any]

    def __repr__(self) -> str:
        return f"<Bundle {self.name[:40]!r}: {counted(len(self.files), 'file')} in {str(self.folder)[-100:]!a}>"

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
            raise JumpcadError(f"{self.folder}: {path}: {wrong}; build the bundle again with jumpcad build")
        return self.folder / path

    def difference(self, path: str) -> str:
        """Return how the content of a plain file differs from the manifest's; empty if it does not."""
        data, digest = (self.folder / path).read_bytes(), self.manifest["files"].get(path)
        if sha256(data) == digest:
            return ""
        return LINE_ENDS if sha256(data.replace(b"\r\n", b"\n")) == digest else "changed"


def open_bundle(folder: str | Path) -> Bundle:
    """Return the bundle in a folder."""
    path = Path(folder) / MANIFEST
    if wrong := trouble(Path(folder), MANIFEST):
        raise JumpcadError(f"{path}: {wrong}; a bundle has one: jumpcad build makes it")
    manifest = read_json(path)
    form = manifest.get("format") if isinstance(manifest, dict) else None
    if isinstance(form, int) and form != FORMAT:
        raise JumpcadError(f"{path}: format {form}; this version reads {FORMAT}: build it again")
    try:
        Manifest.model_validate(manifest)
    except ValueError:
        raise JumpcadError(f"{path}: is not the manifest of a bundle: build it again with jumpcad build") from None
    return Bundle(Path(os.path.realpath(folder)), manifest)


def verify(folder: str | Path) -> list[str]:
    """Return what is wrong with a bundle's files, one line each: `stl/foot.stl: missing`, `bom.csv: changed`."""
    bundle = open_bundle(folder)
    wrong = []
    for path in bundle.files:
        try:
            reason = trouble(bundle.folder, path) or bundle.difference(path)
        except OSError as error:
            reason = f"cannot be read ({error.strerror})"
        if reason:
            wrong.append(f"{path}: {reason}")
    return wrong


def unlisted(folder: str | Path) -> list[str]:
    """Return the paths in a bundle's folder that its manifest does not list: files that a user added."""
    bundle = open_bundle(folder)

    def refuse(error: OSError) -> NoReturn:
        raise JumpcadError(f"{error.filename}: cannot be read: {error.strerror}")

    there = {
        Path(inside, name).relative_to(bundle.folder).as_posix()
        for inside, folders, names in os.walk(bundle.folder, onerror=refuse)
        for name in (*folders, *names)
    }
    own = {MANIFEST, *bundle.files}.union(*map(above, bundle.files))
    return [
        without_controls(path) for path in sorted(there - own - {folder for path in there for folder in above(path)})
    ]


def trouble(folder: Path, path: str) -> str:
    """Return why a path is not a plain file below a folder; empty if it is one."""
    for part in [*above(path), path]:
        try:
            mode = os.lstat(folder / part).st_mode
        except (FileNotFoundError, NotADirectoryError):
            return "missing"
        except OSError as error:
            return str(error.strerror)
        if stat.S_ISLNK(mode):
            return "a link" if part == path else "behind a link"
    return "" if stat.S_ISREG(mode) else "not a plain file"


def above(path: str) -> list[str]:
    """Return the folders of a path, the outermost first: `a/b/c` has `a` and `a/b`."""
    names = path.split("/")
    return ["/".join(names[:count]) for count in range(1, len(names))]


def few(paths: Sequence[str]) -> str:
    """Return the first of several paths as text, and how many more there are."""
    return ", ".join(paths[:NAMED]) + (f" and {len(paths) - NAMED} more" if len(paths) > NAMED else "")


DESIGN = "design.toml"
WORKSHOP = "workshop.toml"


def robot_of(subject: Design | str | Path, workshop: Workshop | None = None, name: str | None = None) -> Robot:
    """Return the printed robot of what `inputs_of` takes, under its own name unless another is given."""
    design, shop, own_name = inputs_of(subject, workshop)
    return build(design, shop, own_name if name is None else name)


def inputs_of(subject: Design | str | Path, workshop: Workshop | None = None) -> tuple[Design, Workshop, str]:
    """Return design, workshop and name of a design, a template, a design file or a bundle, as the command line does."""
    if isinstance(subject, Design):
        return subject, workshop or load_workshop(subject.workshop_name), "robot"
    if os.path.isdir(subject) and str(subject) not in template_names("robots"):
        bundle = open_bundle(subject)
        if workshop is not None:
            raise JumpcadError(f"{subject}: is a bundle, which has a workshop of its own; leave the workshop out")
        return kept_design(bundle), kept_workshop(bundle), bundle.name
    design = load_design(subject)
    return design, workshop or load_workshop(design.workshop_name), Path(subject).name.removesuffix(".toml")


def kept_robot(bundle: Bundle) -> Robot:
    """Return the robot of a bundle, built again; raise what `kept_design`, `kept_workshop` and `build` raise."""
    return build(kept_design(bundle), kept_workshop(bundle), bundle.name)


def kept_design(bundle: Bundle) -> Design:
    """Return the design of a bundle."""
    return load_design(bundle.file(DESIGN))


def kept_workshop(bundle: Bundle) -> Workshop:
    """Return the workshop of a bundle."""
    path = bundle.file(WORKSHOP)
    data, _ = read_toml(path)
    for key in ("base", "printer"):
        if isinstance(data.get(key), str):
            raise JumpcadError(
                f"{path}: {key} = {data[key]!r}: a bundle's workshop is complete and names no other file"
            )
    return load_workshop(path)
