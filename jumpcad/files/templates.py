"""The shipped templates, and the file for a name or path from the command line."""

import importlib.resources
import os
from functools import cache
from pathlib import Path

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import did_you_mean, shown


@cache
def templates_folder() -> Path:
    """Return the folder of the shipped templates, in an installed wheel or in a source tree."""
    package = Path(str(importlib.resources.files("jumpcad")))
    installed = package / "templates"
    return installed if installed.is_dir() else package.parent / "templates"


def template_names(kind: str) -> list[str]:
    """Return the names of the shipped templates of a kind (`robots`, `workshops`, …), sorted."""
    return sorted(path.stem for path in (templates_folder() / kind).glob("*.toml"))


def find_template(kind: str, name_or_path: str | Path) -> Path:
    """Return the TOML file of a template's name, or a path; a path to a TOML file need not exist.

    A template's name without suffix or folder is always the template, also if the working directory has such a file.
    """
    text = str(name_or_path)
    if text.endswith(".toml") or os.path.dirname(text):
        return Path(text)
    names = template_names(kind)
    if text in names:
        return templates_folder() / kind / f"{text}.toml"
    if os.path.isfile(text):
        return Path(text)
    raise JumpcadError(
        f"{shown(text)} is neither a TOML file nor one of the {kind} {', '.join(names)}{did_you_mean(text, names)}"
    )
