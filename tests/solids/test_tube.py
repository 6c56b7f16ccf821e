"""A tube along a line: closed, within the round wire, of the right volume."""

import math

import numpy as np
import pytest
from support.decimals import decimals

from jumpcad.solids.tube import SIDES, tube

OCTAGON = SIDES / 2.0 * math.sin(2.0 * math.pi / SIDES)
"""Area of a section over its radius squared."""


@pytest.mark.parametrize("diameter", [0.8, 2.0, 3.0])
def test_a_straight_tube_is_a_prism(diameter: float) -> None:
    mesh = tube(np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 9.0]]), diameter)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(9.0 * OCTAGON * (diameter / 2.0) ** 2, rel=1e-5)


def test_a_helix_is_closed_and_stays_within_its_wire() -> None:
    angle = np.linspace(0.0, 4.4 * 2.0 * math.pi, 107)
    helix = np.column_stack([6.0 * np.cos(angle), 6.0 * np.sin(angle), 1.4 * angle / math.pi])
    mesh = tube(helix, 2.0)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(OCTAGON * math.hypot(6.0, 1.4 / math.pi) * angle[-1], rel=0.02)
    assert decimals(mesh.vertices) == 6  # nanometres
    radius = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1])
    assert radius.min() >= 5.0 - 1e-6
    assert radius.max() <= 7.0 + 1e-6
