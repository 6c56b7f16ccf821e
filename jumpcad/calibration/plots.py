"""Plots of a calibration: prior and posterior, predicted and measured; energy accounts; jumps over floor friction."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from jumpcad.calibration.posterior import CalibrationPosterior
from jumpcad.search.report.figures import BLUE, GREY, ORANGE, RED, labels, panels
from jumpcad.transforms import Array

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


def energy_accounts(accounts: Mapping[str, Mapping[str, float]]) -> Figure:
    """Draw where the springs' energy is at take-off, one bar for each robot, as shares of the energy account."""
    figure, (axes,) = panels(1, 6.4, 0.9 + 0.5 * len(accounts))
    left = np.zeros(len(accounts))
    totals = np.array([sum(account.values()) for account in accounts.values()])
    colours = (BLUE, ORANGE, GREY, RED, "#4f9d69", "#8d5fa8", "#6b4a2f")
    for index, name in enumerate(next(iter(accounts.values()))):
        share = np.array([account[name] for account in accounts.values()]) / totals
        axes.barh(list(accounts), share, left=left, color=colours[index % len(colours)], label=name)
        left += share
    axes.invert_yaxis()
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), fontsize=8)
    labels(axes, "share of the energy that was loaded into the springs", "")
    return figure


def floors(friction: Sequence[float], jumps: Mapping[str, tuple[Array, Array]]) -> Figure:
    """Draw range and rise (m) of robots over the friction of the floor; NaN where they do not jump."""
    figure, (ranges, rises) = panels(2, 4.2, 3.2)
    for index, (name, (range_m, rise_m)) in enumerate(jumps.items()):
        colour = (BLUE, ORANGE, RED)[index % 3]
        ranges.plot(friction, range_m, ".-", color=colour, label=name)
        rises.plot(friction, rise_m, ".-", color=colour, label=name)
    ranges.legend()
    labels(ranges, "friction of feet on the floor", "range (m)")
    labels(rises, "friction of feet on the floor", "rise of the centre of mass (m)")
    return figure
