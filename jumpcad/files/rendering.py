"""Texts from templates (Jinja2): what a template names and nobody gives is an error."""

import re
from collections.abc import Callable, Mapping
from functools import cache
from html import escape
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from jumpcad.files.templates import templates_folder

SIGNS = re.compile(r"[\\|<&`\[\]]")
"""Characters that begin a table's cell, HTML, code, a link or an escape in Markdown."""


@cache
def environment() -> Environment:
    """Return the environment of all templates of texts.

    Its filters: `n(digits)` rounds to so many decimals, `g` writes a number as short as possible, `plain` escapes text
    for Markdown, `html` for HTML, `capital` and `small` change a sentence's first letter alone, `places` writes points
    (n, 2) for SVG.
    """
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
