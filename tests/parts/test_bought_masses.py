"""Bought parts: together they weigh and measure what the catalogue says."""

import math

import numpy as np
import pytest

from jumpcad.building.assembly import assembled
from jumpcad.design import load_design
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot import Robot
from jumpcad.strength.sizing import Growth
from jumpcad.workshop import load_workshop


@pytest.fixture(scope="module", params=["kenan-2.0", "best-bo"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return assembled(load_design(request.param), load_workshop(), request.param, Growth())


def named(robot: Robot, beginning: str) -> list[BoughtPart]:
    return [thing for thing in robot.hardware if thing.name.startswith(beginning)]


def grams(things: list[BoughtPart]) -> float:
    return 1000.0 * math.fsum(thing.mass_kg for thing in things)


def test_the_motor_weighs_what_the_catalogue_says_with_its_shaft(robot: Robot) -> None:
    """A motor is weighed whole: its shaft is drawn apart, since it lies elsewhere, and is ordered with it."""
    motor = robot.layout.drive.train.motor
    things = [thing for thing in robot.hardware if motor.name in thing.article]
    assert grams(things) == pytest.approx(motor.mass_g, rel=1e-9)
    assert sum(thing.units for thing in things) == 1
    shaft = next(thing for thing in things if thing.name == "motor_shaft")
    assert grams([shaft]) == pytest.approx(
        7.85e-3 * math.pi / 4.0 * motor.shaft_mm**2 * motor.shaft_length_mm, rel=0.01
    )


def test_two_springs_weigh_their_wire(robot: Robot) -> None:
    """Wire of steel, 7.85 g/cm³: the turns of each coil and its arms."""
    spring = robot.layout.drive.spring
    things = [thing for thing in robot.hardware if thing.article.startswith("torsion spring")]
    assert sum(thing.units for thing in things) == 2
    mean = spring.inside_diameter_mm + spring.wire_mm
    coil_mm = math.pi * mean * spring.turns
    per_mm = 7.85e-3 * math.pi / 4.0 * spring.wire_mm**2
    assert 2.0 * per_mm * coil_mm < grams(things) < 2.0 * per_mm * (coil_mm + 4.0 * spring.arm_length_mm + 2.0 * mean)


def test_electronics_weigh_what_the_catalogue_says(robot: Robot) -> None:
    electronics = robot.layout.electronics
    for name in ("battery", "controller", "driver"):
        (thing,) = named(robot, name)
        assert grams([thing]) == pytest.approx(getattr(electronics, name).mass_g, rel=1e-9)


def test_a_nut_is_a_hexagon_of_iso_4032(robot: Robot) -> None:
    """M3: 5.5 mm across the flats, 2.4 mm high; a regular hexagon has an area of s²·√3/2."""
    (nut,) = named(robot, "roller_nut")
    volume = (5.5**2 * math.sqrt(3.0) / 2.0 - math.pi / 4.0 * 3.0**2) * 2.4
    assert nut.shape.volume_mm3 == pytest.approx(volume, rel=0.01)
    size = np.ptp(np.asarray(nut.look.vertices), axis=0)
    assert sorted(size) == pytest.approx([2.4, 5.5, 5.5 * 2.0 / math.sqrt(3.0)], abs=0.01)


def test_standoff_screws_go_through_the_plate_into_the_standoff(robot: Robot) -> None:
    """A screw's head sits on the outside of its plate, and two diameters of thread (6 mm) at least hold inside."""
    inside, outside = robot.layout.lateral.inside, robot.layout.lateral.outside
    for side, sign in (("left", 1.0), ("right", -1.0)):
        screws = [thing for thing in named(robot, "standoff_") if thing.name.endswith(f"_screw_{side}")]
        assert len(screws) == len(robot.layout.standoffs_mm)
        for screw in screws:
            low, high = np.array(screw.solid.transform(screw.T_body_part[:3]).bounding_box())[[1, 4]]
            tip, head = (low, high) if sign > 0 else (high, low)
            inner, outer = (inside[1], outside[1]) if sign > 0 else (inside[0], outside[0])
            assert sign * (inner - tip) >= 6.0 - 1e-6
            assert 1.0 < sign * (head - outer) < 3.0
