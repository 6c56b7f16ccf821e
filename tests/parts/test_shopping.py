"""What is bought: rods as long and as heavy as their articles say, screws of stock lengths, springs of either hand."""

import math
import re

import numpy as np
import pytest
from support.built import LONG_TOES, built

from jumpcad.catalogue import load_catalogue
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot import Robot


@pytest.fixture(scope="module", params=["kenan-2.0", LONG_TOES])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


def reach_mm(item: BoughtPart) -> np.ndarray:
    """Return the least and the greatest y of a bought part in the frame of its body."""
    return item.look.copy().apply_transform(item.T_body_part).bounds[:, 1]


def test_a_rod_is_steel_of_the_length_in_its_name(robot: Robot) -> None:
    rods = [item for item in robot.hardware if item.article.startswith("spring steel rod 3 x ")]
    assert {"leg_axle", "cam_axle", "front_axle", "ankle_pin", "front_eye_pin", "spring_pin"} < {r.name for r in rods}
    for rod in rods:
        length = float(rod.article.split()[-2])
        assert np.ptp(reach_mm(rod)) == pytest.approx(length, abs=0.051), rod.name
        assert rod.mass.mass_kg == pytest.approx(7.85e-6 * math.pi / 4.0 * 3.0**2 * length, rel=0.01), rod.name


def test_axles_stand_out_of_both_plates_for_a_collar(robot: Robot) -> None:
    right, left = robot.layout.lateral.outside
    for item in robot.hardware:
        if item.name.endswith("_axle"):
            low, high = reach_mm(item)
            assert right - low == pytest.approx(3.5)  # a collar of 3 mm and a gap
            assert high - left == pytest.approx(3.5)


def test_screws_have_lengths_that_are_sold(robot: Robot) -> None:
    screws = [item for item in robot.hardware if item.article.startswith("screw ")]
    assert len(screws) >= 2 * len(robot.layout.standoffs_mm) + 3
    assert any("toe" in screw.name for screw in screws) == robot.layout.toes_apart
    for screw in screws:
        size, length = re.fullmatch(r"screw (M\d) x ([\d.]+) ISO 7380-1", screw.article).groups()  # type: ignore[union-attr]
        if size == "M3":
            assert float(length) in load_catalogue().screws[size].lengths_mm


def test_the_two_springs_mirror_each_other(robot: Robot) -> None:
    left, right = (next(item for item in robot.hardware if item.name == f"spring_{side}") for side in ("left", "right"))
    assert left.article.removesuffix("left hand") == right.article.removesuffix("right hand")
    assert left.mass.mass_kg == pytest.approx(right.mass.mass_kg)
    assert left.mass.com_m * [1.0, -1.0, 1.0] == pytest.approx(right.mass.com_m, abs=1e-6)
