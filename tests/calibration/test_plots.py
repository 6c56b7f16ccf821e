"""Plots of a calibration show its numbers, each where it belongs."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from jumpcad.calibration import plots
from jumpcad.calibration.likelihood import CalibrationParameter
from jumpcad.calibration.priors import Prior


def test_each_parameter_is_drawn_before_and_after_the_data() -> None:
    """Areas of 1: grey about the prior's mean, the blue line about the draws' 0.8, below label and verdict."""
    keys = {"efficiency": 1.0, "pins": 3.0}
    known = [
        CalibrationParameter(key, f"the {key}", Prior("normal", mean, 0.1, "made up")) for key, mean in keys.items()
    ]
    draws = np.random.default_rng(1).standard_normal(4000)
    posterior: Any = SimpleNamespace(
        model=SimpleNamespace(parameters=known), z=np.zeros((4000, 2)),
        values={key: 0.8 * mean + 0.02 * draws for key, mean in keys.items()},
        summaries=lambda: [{"verdict": "identified"}, {"verdict": "stays at its prior"}],
    )  # fmt: skip
    figure = plots.parameters(posterior)
    assert [axes.get_title() for axes in figure.axes] == [
        "the efficiency\nidentified", "the pins\nstays at its prior"
    ]  # fmt: skip
    for axes, mean in zip(figure.axes, keys.values(), strict=True):
        *bars, step = axes.patches
        area = [(bar.get_x() + bar.get_width() / 2.0, bar.get_width() * bar.get_height()) for bar in bars]
        assert sum(share for _, share in area) == pytest.approx(1.0)
        assert sum(middle * share for middle, share in area) == pytest.approx(mean, abs=0.01)
        corners = step.get_path().vertices
        tallest = corners[corners[:, 1].argmax(), 0]
        assert tallest == pytest.approx(0.8 * mean, abs=0.04)
        assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["prior", "posterior"]


def test_each_measurement_stands_beside_what_is_predicted_of_it() -> None:
    """From the 10th to the 90th percentile about the median; lengths and energies apart, in the order of the data."""
    rows = [
        {"what": "distance", "robot": "k1", "as": "first-touchdown", "measured": 0.25, "predicted": [0.1, 0.2, 0.4]},
        {"what": "battery", "robot": "k1", "as": "battery", "measured": 1.5, "predicted": [1.0, 1.25, 1.75]},
        {"what": "distance", "robot": "k2", "as": "centre-of-mass", "measured": 0.5, "predicted": [0.3, 0.6, 0.7]},
    ]
    posterior: Any = SimpleNamespace(residuals=lambda: rows)
    figure = plots.measurements(posterior)
    assert [axes.get_ylabel() for axes in figure.axes] == ["distance (m)", "battery (J)"]
    for axes, places in zip(figure.axes, ((0, 2), (1,)), strict=True):
        told = [rows[place] for place in places]
        assert [label.get_text() for label in axes.get_xticklabels()] == [
            f"{one['robot']}\n{one['as']}" for one in told
        ]
        spans = [bar.get_segments()[0] for bar in axes.collections]
        assert [[float(y) for _, y in span] for span in spans] == [
            pytest.approx([one["predicted"][0], one["predicted"][2]]) for one in told
        ]
        points = {marker: [] for marker in "ox"}
        for line in axes.lines:
            if line.get_marker() in points:
                points[line.get_marker()].append((line.get_xdata()[0], line.get_ydata()[0]))
        assert points["x"] == [(place, one["measured"]) for place, one in enumerate(told)]
        assert points["o"] == [(place, one["predicted"][1]) for place, one in enumerate(told)]
