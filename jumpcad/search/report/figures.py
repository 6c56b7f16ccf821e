"""Figures as SVG and PNG files: one style, and the same bytes for the same data."""

import io
import tomllib
from functools import cache
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jumpcad.arguments import check_arguments
from jumpcad.files.outputs import sealed, sealed_png, write_files
from jumpcad.files.templates import templates_folder

PICTURES = (
    "history", "slices", "parallel", "pareto", "acquisition-first", "acquisition", "seeds",
    "sweeps", "pca", "importance", "feasibility",
)  # fmt: skip
"""Names of the pictures of a study, then of those of the design space."""

BLUE, ORANGE, GREY, RED = "#1f5fa8", "#d9822b", "#8a8f98", "#b3322b"
INK = "#4a4f57"
PNG_DPI = 150
LETTERS_PER_INCH = 17.0
"""Of the sentence below a picture."""
STYLE: dict[Any, Any] = {
    "svg.hashsalt": "jumpcad",
    "svg.fonttype": "path",
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "legend.frameon": False,
}


@cache
def meanings() -> dict[str, str]:
    """Return the explanation below each picture, by its name in `PICTURES`."""
    return tomllib.loads((templates_folder() / "report/pictures.toml").read_text(encoding="utf-8"))


def panels(count: int, width: float = 3.2, height: float = 2.4, columns: int = 4) -> tuple[Figure, list[Axes]]:
    """Return a figure of `count` equal panels, each `width` by `height` inches."""
    with matplotlib.rc_context(STYLE):
        columns = min(columns, count)
        rows = -(-count // columns)
        figure = Figure(figsize=(width * columns, height * rows), layout="constrained")
        axes = [figure.add_subplot(rows, columns, index + 1) for index in range(count)]
    return figure, axes


@check_arguments
def save_figure(figure: Figure, folder: str | Path, name: str, force: bool = False) -> Path:
    """Write a figure as `folder/name.svg` and `folder/name.png`, with a seal; return the first path.

    A picture of `PICTURES` has its explanation below it.
    """
    pixels = io.BytesIO()
    if name in PICTURES:
        figure.supxlabel(fill(meanings()[name], int(LETTERS_PER_INCH * figure.get_figwidth())), fontsize=7.5, color=INK)
    with matplotlib.rc_context(STYLE):
        drawn = svg_text(figure)
        figure.savefig(pixels, format="png", dpi=PNG_DPI, metadata={"Software": None})
    files: dict[str, str | bytes] = {
        f"{name}.svg": sealed(drawn, "<!-- {} -->"),
        f"{name}.png": sealed_png(pixels.getvalue()),
    }
    path, _ = write_files(Path(folder), files, force)
    return path


def svg_text(figure: Figure) -> str:
    """Return a figure as the text of an SVG file."""
    drawn = io.StringIO()
    with matplotlib.rc_context(STYLE):
        figure.savefig(drawn, format="svg", dpi=PNG_DPI, metadata={"Date": None})
    return drawn.getvalue()


def labels(axes: Axes, x: str, y: str, title: str = "") -> None:
    """Name the axes."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, fontsize=9.0)
