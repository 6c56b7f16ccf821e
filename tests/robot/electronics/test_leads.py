"""Lengths to which wires are cut, from the places of what they join."""

import math

import numpy as np
import pytest

from jumpcad.robot.electronics.leads import _lead_mm


@pytest.mark.parametrize(
    ("one", "other", "more_mm"),
    [("controller", "driver", 0.0), ("controller", "sensor", 40.0), ("switch", "plug", 40.0)],
)
def test_a_wire_is_as_long_as_its_way_with_slack_in_whole_centimetres(one: str, other: str, more_mm: float) -> None:
    """Outside straight from point to point, inside along x, y and z; 30 mm for bends and solder."""
    outside = [np.array([0.0, 0.0, 0.0]), np.array([3.0, 4.0, 0.0])]
    for apart in ([10.0, 0.0, 0.0], [10.0, 7.0, -6.0], [14.9, 0.0, 0.0], [15.1, 0.0, 0.0]):
        inside = [np.array([3.0, 4.0, 0.0]) + apart]
        length = 5.0 + np.abs(apart).sum() + 30.0 + more_mm
        assert _lead_mm({one: outside, other: inside}, one, other) == pytest.approx(10.0 * math.ceil(length / 10.0))
        assert _lead_mm({one: inside, other: outside}, one, other) == pytest.approx(
            10.0 * math.ceil((5.0 + np.abs(outside[-1] - inside[-1]).sum() + 30.0 + more_mm) / 10.0)
        )
