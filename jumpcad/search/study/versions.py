"""Of what versions a study is: those of packages, and a hash of the code that decides its trials."""

import hashlib
import importlib.metadata
from functools import cache
from pathlib import Path

from jumpcad.files import templates_folder

PRESENTATION = ("bundle", "calibration", "cli", "coupon", "studio")
"""The packages of jumpcad that do not affect the trials of a study."""
FORKS = {"pybullet": "pybullet-arm64"}
"""What is installed in place of a package where that has no wheel."""


@cache
def code_digest() -> str:
    """Return a hash (hexadecimal) of the code and the catalogue that decide the trials of a study.

    Between two releases the version number stays, but the code changes.
    """
    package = Path(__file__).parents[2]
    files = {path.relative_to(package).as_posix(): path for path in package.rglob("*.py")}
    files |= {f"hardware/{path.name}": path for path in (templates_folder() / "hardware").glob("*.toml")}
    found = hashlib.sha256()
    for name in sorted(files):
        if name.split("/")[0] not in PRESENTATION:
            content = files[name].read_bytes()
            found.update(f"{name} {len(content)}\n".encode() + content)
    return found.hexdigest()[:16]


def versions(*packages: str) -> dict[str, str]:
    """Return the installed versions of packages; of those that are not installed, `none`."""
    return {package: _version(package) or _version(FORKS.get(package, package)) or "none" for package in packages}


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None
