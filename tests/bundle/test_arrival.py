"""What to check when things arrive; most of it is read in the guide, see `test_guide.py`."""

from dataclasses import replace

import pytest
from support.built import built

from jumpcad.bundle.arrival import loaded_grams, scale_range_kg


@pytest.mark.parametrize(("grams", "kilograms"), [(400.0, 1), (905.0, 1), (920.0, 2), (1800.0, 2), (1850.0, 3)])
def test_a_scale_bears_a_spring_that_is_stiff_by_its_tolerance(grams: float, kilograms: int) -> None:
    """10 % more than computed, in whole kilograms; grams are of force, 9.80665 N a kilogram."""
    robot = built("kenan-2.0")
    drive = robot.layout.drive
    lever = drive.spring.torque_nmm / (9.80665e-3 * grams)
    spring = replace(drive.spring, arms=replace(drive.spring.arms, lever_mm=lever))
    assert loaded_grams(spring) == pytest.approx(grams, rel=1e-3)
    own = replace(robot, layout=replace(robot.layout, drive=replace(drive, spring=spring)))
    assert robot.workshop.safety.spring_rate_scatter == 0.1
    assert scale_range_kg(own) == kilograms
