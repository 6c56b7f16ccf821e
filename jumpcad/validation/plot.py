"""The picture of a validation: what is computed over what was measured, figure by figure."""

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from jumpcad.search.report.figures import BLUE, GREY, INK, ORANGE, RED, labels, panels

PICTURES = ("validation",)
"""Names of the pictures."""
COLOURS = {"agrees": BLUE, "below the bound": BLUE, "differs": RED, "above the bound": RED, "chosen by": GREY,
           "not judged": ORANGE}  # fmt: skip


def validation(robots: Sequence[dict[str, Any]]) -> Figure:
    """Draw 5, 50 and 95 % of every computed figure over the measured one, tier by tier.

    What is not judged, because it rests on a remembered figure, is orange, hollow, and has a question mark.
    """
    rows = [(one, row) for one in robots for row in one["figures"] if row["low"] is not None]
    figure, (axes,) = panels(1, 7.0, 0.24 * len(rows) + 0.9)
    for place, (_, row) in enumerate(rows):
        low, middle, high = (row[key] / row["measured"] for key in ("low", "median", "high"))
        hollow = "white" if row["verdict"] == "not judged" else COLOURS[row["verdict"]]
        axes.errorbar(middle, -place, xerr=[[middle - low], [high - middle]], fmt="o", ms=5, capsize=3,
                      color=COLOURS[row["verdict"]], mfc=hollow)  # fmt: skip
    axes.axvline(1.0, color=INK, lw=0.8)
    marks = {"not judged": " ?"}
    names = [f"{one['tier']}: {one['name']}, {row['name']}{marks.get(row['verdict'], '')}" for one, row in rows]
    axes.set_yticks([-place for place in range(len(rows))], names, fontsize=6.5)
    title = "blue agrees, red differs, grey: chosen by it, orange: not judged"
    labels(axes, "computed over measured, 5…50…95 %", "", title)
    return figure
