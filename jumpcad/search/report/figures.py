"""Figures as SVG and PNG files: one style, and the same bytes for the same data."""

import io
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jumpcad.arguments import check_arguments
from jumpcad.files.outputs import sealed, sealed_png, write_files

PICTURES = (
    "history", "slices", "parallel", "pareto", "acquisition-first", "acquisition",
    "sweeps", "pca", "importance", "feasibility",
)  # fmt: skip
"""Names of the pictures of a study, then of those of the design space."""

MEANINGS = {
    "history": "Every design in the order of the search: a line that rises late says that more evaluations may pay.",
    "slices": "The score over one parameter at a time, the others being what they were: good designs at an edge of a "
    "range say that the bound matters. The star is the best design.",
    "parallel": "One line per design that jumps: where the best ones run together, a parameter is decided; where they "
    "spread, it matters little.",
    "pareto": "No design of the front is beaten by one that is better in both figures: choose what you can spend of "
    "one, and read the other.",
    "acquisition-first": "What the method knew at its first proposal, and where it expected to gain.",
    "acquisition": "What the method knew at its last proposal: it looks where score and doubt are high.",
    "sweeps": "One parameter varied at a time around the centre design, whose value is the dashed line; crosses are "
    "rejected designs.",
    "pca": "Directions in which the designs spread: a few large shares among the best say that they lie on a line or "
    "a surface.",
    "importance": "How much worse the score is predicted if a parameter is shuffled: a long bar matters, a bar no "
    "longer than its error does not.",
    "feasibility": "What rejects a design over two parameters, the others as in the centre design, which is ringed.",
}
"""Explanation below each picture, by its name in `PICTURES`."""

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


def panels(count: int, width: float = 3.2, height: float = 2.4, columns: int = 4) -> tuple[Figure, list[Axes]]:
    """Return a figure of `count` equal panels, each `width` by `height` inches."""
    with matplotlib.rc_context(STYLE):
        columns = min(columns, count)
        rows = -(-count // columns)
        figure = Figure(figsize=(width * columns, height * rows), layout="constrained")
        axes = [figure.add_subplot(rows, columns, index + 1) for index in range(count)]
    return figure, axes


@check_arguments
def save_figure(figure: Figure, folder: str | Path, name: str) -> Path:
    """Write a figure as `folder/name.svg` and `folder/name.png`, with a seal; return the first path.

    A picture of `PICTURES` has its explanation below it.

    Raises
    ------
    JumpcadError
        If the folder cannot be written.
    """
    pixels = io.BytesIO()
    if name in MEANINGS:
        figure.supxlabel(fill(MEANINGS[name], int(LETTERS_PER_INCH * figure.get_figwidth())), fontsize=7.5, color=INK)
    with matplotlib.rc_context(STYLE):
        drawn = svg_text(figure)
        figure.savefig(pixels, format="png", dpi=PNG_DPI, metadata={"Software": None})
    files: dict[str, str | bytes] = {
        f"{name}.svg": sealed(drawn, "<!-- {} -->"),
        f"{name}.png": sealed_png(pixels.getvalue()),
    }
    path, _ = write_files(Path(folder), files)
    return path


def svg_text(figure: Figure) -> str:
    """Return a figure as the text of an SVG file."""
    drawn = io.StringIO()
    with matplotlib.rc_context(STYLE):
        figure.savefig(drawn, format="svg", dpi=PNG_DPI, metadata={"Date": None})
    return drawn.getvalue()


def heat(figure: Figure, axes: Axes, x: Any, y: Any, values: Any, label: str) -> None:
    """Draw values (len(y), len(x)) as a colour map with a colour bar."""
    image = axes.pcolormesh(x, y, values, shading="nearest", cmap="viridis", rasterized=True)
    axes.grid(False)
    figure.colorbar(image, ax=axes, label=label)


def labels(axes: Axes, x: str, y: str, title: str = "") -> None:
    """Name the axes."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, fontsize=9.0)
