"""What a bundle's manifest says, and whether its files are still so."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jumpcad.errors import JumpcadError

MANIFEST = "manifest.json"
FORMAT = 1


@dataclass(frozen=True)
class Bundle:
    """A folder that holds a robot; `manifest` is what its manifest.json says."""

    folder: Path
    manifest: Mapping[str, Any]

    @property
    def name(self) -> str:
        """The robot's name, after which its files are called."""
        return str(self.manifest["name"])

    @property
    def files(self) -> tuple[str, ...]:
        """The paths of all files but the manifest, relative to the folder."""
        return tuple(self.manifest["files"])

    @property
    def urdf(self) -> Path:
        """The URDF file, beside which the loop lies."""
        return self.folder / "urdf" / f"{self.name}.urdf"


def open_bundle(folder: str | Path) -> Bundle:
    """Return the bundle in a folder.

    Raises
    ------
    JumpcadError
        If there is none.
    """
    path = Path(folder) / MANIFEST
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
        if manifest["format"] != FORMAT or not isinstance(manifest["files"], dict):
            raise JumpcadError(f"{path}: format {manifest['format']}; this version reads {FORMAT}: build it again")
        return Bundle(Path(folder), manifest)
    except OSError as error:
        raise JumpcadError(f"{path}: {error.strerror}; a bundle has one: jumpcad build makes it") from None
    except (ValueError, KeyError, TypeError):
        raise JumpcadError(f"{path}: is not the manifest of a bundle: jumpcad build makes it anew") from None


def is_bundle(folder: str | Path) -> bool:
    """Tell whether a folder is that of a bundle."""
    return (Path(folder) / MANIFEST).is_file()


def verify(folder: str | Path) -> list[str]:
    """Return what is wrong with a bundle's files, one line each: `stl/foot.stl: missing`, `bom.csv: changed`.

    Raises
    ------
    JumpcadError
        If the folder is not a bundle.
    """
    bundle = open_bundle(folder)
    wrong = []
    for path, digest in bundle.manifest["files"].items():
        file = bundle.folder / path
        if not file.is_file():
            wrong.append(f"{path}: missing")
        elif hashlib.sha256(file.read_bytes()).hexdigest() != digest:
            wrong.append(f"{path}: changed")
    return wrong
