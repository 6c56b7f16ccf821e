"""Plots of a calibration: prior and posterior, predicted and measured; energy accounts; jumps over floor friction."""

import numpy as np
from matplotlib.figure import Figure

from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.search.report.figures import BLUE, GREY, RED, labels, panels

PICTURES = ("parameters", "measurements")
"""Names of the pictures of a calibration."""
BINS = 40
TITLES = {"distance": "distance (m)", "height": "height (m)", "battery": "battery (J)", "speed": "speed (m/s)",
          "angle": "angle (°)"}  # fmt: skip


def parameters(posterior: CalibrationPosterior) -> Figure:
    """Draw prior (grey) and posterior (blue) of every parameter."""
    figure, all_axes = panels(len(posterior.model.parameters), 2.9, 2.1)
    normal = np.random.default_rng(0).standard_normal(len(posterior.z))
    for axes, one, summary in zip(all_axes, posterior.model.parameters, posterior.summaries(), strict=True):
        before, after = one.prior.at(normal), posterior.values[one.key]
        low, high = np.quantile(np.concatenate([before, after]), (0.002, 0.998)).tolist()
        bins = np.linspace(low, high, BINS).tolist()
        axes.hist(before, bins=bins, density=True, color=GREY, alpha=0.4, label="prior")
        axes.hist(after, bins=bins, density=True, histtype="step", color=BLUE, lw=1.4, label="posterior")
        axes.set_yticks([])
        labels(axes, "", "", f"{one.label}\n{summary['verdict']}")
    all_axes[0].legend(fontsize=7)
    return figure


def measurements(posterior: CalibrationPosterior) -> Figure:
    """Draw what the posterior predicts (10 to 90 %) beside what was measured, with the likeliest reading."""
    rows = posterior.residuals()
    kinds = list(dict.fromkeys(row["what"] for row in rows))
    figure, all_axes = panels(len(kinds), 3.4, 2.6)
    for axes, kind in zip(all_axes, kinds, strict=True):
        chosen = [row for row in rows if row["what"] == kind]
        for place, row in enumerate(chosen):
            low, middle, high = row["predicted"]
            axes.errorbar(place, middle, [[middle - low], [high - middle]], fmt="o", ms=4, color=BLUE, capsize=3)
            axes.plot(place, row["measured"], "x", ms=7, color=RED)
        axes.set_xticks(range(len(chosen)), [f"{row['robot']}\n{row['as']}" for row in chosen], fontsize=7)
        axes.set_xlim(-0.6, len(chosen) - 0.4)
        axes.set_ylim(0.0)
        labels(axes, "", TITLES[kind], "predicted (blue), measured (red)")
    return figure
