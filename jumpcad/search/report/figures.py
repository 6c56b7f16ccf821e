"""Figures as SVG and PNG files, of one style and the same bytes for the same data; words and units of figures."""

import io
from functools import cache
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.dimensions import KEY_UNITS, unit_of_key
from jumpcad.evaluation import FIGURES
from jumpcad.files import read_toml, templates_folder
from jumpcad.files.outputs import sealed, sealed_png, write_files
from jumpcad.workshop.varied import Value

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
SHOWN_AS = {"kg": ("g", 1000.0), "m": ("mm", 1000.0), "J": ("mJ", 1000.0)}
"""Units in which figures are shown in place of others, and the factor."""
STYLE: dict[Any, Any] = {
    "svg.hashsalt": "jumpcad", "svg.fonttype": "path", "font.size": 9.0, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25, "legend.frameon": False,
}  # fmt: skip


@cache
def report_words(name: str) -> dict[str, str]:
    """Return words of `templates/report`: `pictures`, by the names in `PICTURES`, or `reasons` of refusals.

    Names that begin with that of a reason mean the same.
    """
    return read_toml(templates_folder() / f"report/{name}.toml")[0]


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
        words = fill(report_words("pictures")[name], int(LETTERS_PER_INCH * figure.get_figwidth()))
        figure.supxlabel(words, fontsize=7.5, color=INK)
    with matplotlib.rc_context(STYLE):
        drawn = svg_text(figure)
        figure.savefig(pixels, format="png", dpi=PNG_DPI, metadata={"Software": None})
    svg, png = sealed(drawn, "<!-- {} -->"), sealed_png(pixels.getvalue())
    return write_files(Path(folder), {f"{name}.svg": svg, f"{name}.png": png}, force)[0]


def svg_text(figure: Figure) -> str:
    drawn = io.StringIO()
    with matplotlib.rc_context(STYLE):
        figure.savefig(drawn, format="svg", dpi=PNG_DPI, metadata={"Date": None})
    return drawn.getvalue()


def labels(axes: Axes, x: str, y: str, title: str = "") -> None:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, fontsize=9.0)


def unit_of(parameter: str) -> str:
    """Return the unit of a parameter by the end of its name; of one of the design without any, `ratio`."""
    return unit_of_key(parameter) or ("ratio" if parameter in Design.model_fields else "")


def with_unit(text: str, parameter: str) -> str:
    """Return values of a parameter with its unit; ratios have none."""
    unit = unit_of(parameter)
    return text if unit in ("", "ratio") else f"{text}{unit}" if unit == "°" else f"{text} {unit}"


def named(parameter: str) -> str:
    """Return a parameter's name with its unit, for a heading or an axis."""
    unit = unit_of(parameter)
    return f"{parameter} ({unit})" if unit else parameter


def meaning_of(parameter: str) -> str:
    """Return what a parameter of the design is; empty for a value of the workshop."""
    field = Design.model_fields.get(parameter)
    return field.description or "" if field else ""


def reason_words(reason: str) -> str:
    """Return what a reason of a refusal means; empty if it is not known."""
    known = report_words("reasons")
    names = [one for one in known if f"{reason}_".startswith(f"{one}_")]
    return known[max(names, key=len)] if names else ""


def figure_words(name: str, value: float) -> tuple[str, str]:
    """Return label and value, with its unit, of a figure of an evaluation."""
    end = next((end for end in KEY_UNITS if name.endswith(f"_{end}")), "")
    unit, factor = SHOWN_AS.get(KEY_UNITS.get(end, ""), (KEY_UNITS.get(end, ""), 1.0))
    label = FIGURES.get(name, name.removesuffix(f"_{end}").replace("_", " "))
    return label, f"{factor * value:.4g}{'' if unit == '°' else ' '}{unit}".strip()


def value_words(value: Value, digits: int = 6) -> str:
    """Return a parameter's value: a name, or a number with so many digits."""
    return value if isinstance(value, str) else f"{value:.{digits}g}"
