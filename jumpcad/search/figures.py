"""Figures as SVG and PNG files: one style, and the same bytes for the same data."""

import io
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jumpcad.arguments import typed
from jumpcad.files.outputs import sealed, sealed_png, write_files

PICTURES = (
    "history", "slices", "parallel", "pareto", "acquisition-first", "acquisition",
    "sweeps", "pca", "importance", "feasibility",
)  # fmt: skip
"""Names of the pictures of a study, then of those of the design space."""

BLUE, ORANGE, GREY, RED = "#1f5fa8", "#d9822b", "#8a8f98", "#b3322b"
PNG_DPI = 150
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


def panels(count: int, width: float = 3.2, height: float = 2.4, columns: int = 4) -> tuple[Figure, list[Axes]]:
    """Return a figure of `count` equal panels, each `width` by `height` inches."""
    with matplotlib.rc_context(STYLE):
        columns = min(columns, count)
        rows = -(-count // columns)
        figure = Figure(figsize=(width * columns, height * rows), layout="constrained")
        axes = [figure.add_subplot(rows, columns, index + 1) for index in range(count)]
    return figure, axes


@typed
def save_figure(figure: Figure, folder: str | Path, name: str) -> Path:
    """Write a figure as `folder/name.svg` and `folder/name.png`, marked as jumpcad's; return the first path."""
    drawn, pixels = io.StringIO(), io.BytesIO()
    with matplotlib.rc_context(STYLE):
        figure.savefig(drawn, format="svg", metadata={"Date": None})
        figure.savefig(pixels, format="png", dpi=PNG_DPI, metadata={"Software": None})
    files: dict[str, str | bytes] = {
        f"{name}.svg": sealed(drawn.getvalue(), "<!-- {} -->"),
        f"{name}.png": sealed_png(pixels.getvalue()),
    }
    path, _ = write_files(Path(folder), files)
    return path


def heat(figure: Figure, axes: Axes, x: Any, y: Any, values: Any, label: str) -> None:
    """Draw values (len(y), len(x)) as a colour map with its scale."""
    image = axes.pcolormesh(x, y, values, shading="nearest", cmap="viridis", rasterized=True)
    axes.grid(False)
    figure.colorbar(image, ax=axes, label=label)


def labels(axes: Axes, x: str, y: str, title: str = "") -> None:
    """Name the axes."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, fontsize=9.0)
