"""The shipped templates: the file of a name or path, and texts made from them by Jinja2."""

import importlib.resources
import os
import re
from collections.abc import Callable, Mapping
from functools import cache
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import did_you_mean, shown

if TYPE_CHECKING:  # a shell that completes names needs no texts
    from jinja2 import Environment

SIGNS = re.compile(r"[\\|<&`\[\]]")
"""Characters that begin a table's cell, HTML, code, a link or an escape in Markdown."""


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
    """Return the TOML file of a template's name, also if there is such a file, or a path, which need not exist."""
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


@cache
def environment() -> "Environment":
    """Return the environment of all templates of texts.

    Its filters: `n(digits)` rounds to so many decimals, `g` writes a number as short as possible, `plain` escapes text
    for Markdown, `html` for HTML, `capital` and `small` change a sentence's first letter alone, `places` writes points
    (n, 2) for SVG. What a template names and nobody gives is an error.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    found = Environment(
        loader=FileSystemLoader(templates_folder()),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # names of users are escaped by `plain` in Markdown, by `html` in HTML
    )
    filters: dict[str, Callable[..., str]] = {
        "n": lambda value, digits=0: f"{float(value):.{digits}f}",
        "g": lambda value: f"{float(value):g}",
        "places": lambda points, digits=1: " ".join(f"{x:.{digits}f},{y:.{digits}f}" for x, y in points),
        "plain": lambda text: SIGNS.sub(r"\\\g<0>", text),
        "html": escape,
        "capital": lambda text: text[:1].upper() + text[1:],
        "small": lambda text: text[:1].lower() + text[1:],
    }
    found.filters |= filters
    return found


def render(template: str, values: Mapping[str, Any]) -> str:
    """Return a template of `templates/` with values in it, lists numbered, without runs of empty lines."""
    text = environment().get_template(template).render(values)
    return _numbered(re.sub(r"\n{3,}", "\n\n", text).strip()) + "\n"


def fill(template: str, values: Mapping[str, Any]) -> str:
    """Return a template with values in it, line by line as it is; errors are those of `render`."""
    return environment().get_template(template).render(values)


def _numbered(text: str) -> str:
    """Return text whose lists have their numbers; in templates all items begin with `1. `."""
    lines, count = [], 0
    for line in text.splitlines():
        if line.startswith("1. "):
            count += 1
        elif line and not line.startswith(" "):
            count = 0
        lines.append(f"{count}. {line[3:]}" if line.startswith("1. ") else line)
    return "\n".join(lines)
