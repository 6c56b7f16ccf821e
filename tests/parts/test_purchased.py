"""Bought parts: the catalogue's mass spread over a shape that all copies share."""

import math
import re

import numpy as np
import pytest
from support.built import built

from jumpcad.parts.purchased import bought
from jumpcad.solids.outline import disc


def rod(length=40.0, at=(0.0, 0.0, 0.0), turn=0.0, diameter=3.0):
    return bought("pin", "rod", "body", 2.2, [(0.0, length, disc(diameter))], at, turn)


def test_a_rod_across_the_robot_turns_like_a_cylinder():
    mass = rod(at=(5.0, -20.0, 7.0)).mass
    assert mass.mass_kg == pytest.approx(2.2e-3)
    assert mass.com_m == pytest.approx([0.005, 0.0, 0.007], abs=1e-12)
    across = 2.2e-3 * (3.0 * 0.0015**2 + 0.040**2) / 12.0
    assert np.diag(mass.inertia_kg_m2) == pytest.approx([across, 2.2e-3 * 0.0015**2 / 2.0, across], rel=3e-3)


def test_pins_weigh_what_their_steel_does() -> None:
    """7.85 g/cm³: a split pin's wire over its length, a clevis pin's shank and head."""
    robot = built("kenan-2.0")
    found = {item.name: item for item in robot.hardware if "pin" in item.name and "ISO" in item.article}
    assert {"ankle_pin", "ankle_pin_split_pin", "front_eye_pin", "leg_spring_pin"} <= set(found)
    for name, item in found.items():
        diameter, length = map(float, re.findall(r"([\d.]+) x ([\d.]+) ISO", item.article)[0])
        shank = 7.85e-6 * math.pi / 4.0 * diameter**2 * length
        if name.endswith("split_pin"):
            assert item.mass_kg == pytest.approx(shank, rel=0.02), name
        else:
            assert shank < item.mass_kg < 1.6 * shank, name
