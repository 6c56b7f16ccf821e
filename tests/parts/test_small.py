"""Small printed parts, measured on their meshes."""

import math

import numpy as np
import pytest
from support.built import built, cut, inscribed_diameter, part, placed
from support.fits import RUNNING, TOLERANCE_MM

from jumpcad.robot import Robot


@pytest.fixture(scope="module")
def kenan() -> Robot:
    return built("kenan-2.0")


@pytest.mark.parametrize("side", ["left", "right"])
def test_bushings_turn_on_the_axle_and_fill_the_wound_spring(kenan: Robot, side: str) -> None:
    lateral, spring = kenan.layout.lateral, kenan.layout.drive.spring
    coil = lateral.spring_left if side == "left" else lateral.spring_right
    segments = cut(placed(kenan, f"spring_bushing_{side}"), sum(coil) / 2.0)
    centred = segments.reshape(-1, 2) - kenan.layout.hub_mm
    assert inscribed_diameter(segments, kenan.layout.hub_mm) == pytest.approx(RUNNING, abs=TOLERANCE_MM)
    outside = 2.0 * np.hypot(*centred.T).max()
    mean = spring.outer_diameter_mm - spring.wire_mm
    turns_wound = kenan.design.compression_rad / (2 * math.pi)
    inside_wound = mean * spring.turns / (spring.turns + turns_wound) - spring.wire_mm  # Shigley 10-12
    assert outside < inside_wound
    assert outside == pytest.approx(inside_wound - 0.3, abs=0.01)


def test_spacers_turn_on_their_axles(kenan: Robot) -> None:
    for name in ("front_spacer_left", "front_spacer_right", "cam_spacer_right"):
        mesh = part(kenan, name).mesh
        segments = cut(mesh.copy().apply_transform([[1, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]), 1.03)
        assert inscribed_diameter(segments, np.zeros(2)) == pytest.approx(RUNNING, abs=TOLERANCE_MM)
