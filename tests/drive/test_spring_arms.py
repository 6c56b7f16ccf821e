"""A torsion spring's arms as tangents of its coil: plane geometry."""

import math

import numpy as np
import pytest

from jumpcad.drive.spring_arms import Arms, beside_mm, between_pins_rad, free_arm_angle_rad


@pytest.mark.parametrize(("turns", "degrees"), [(5.0, 180.0), (5.25, 90.0), (5.5, 0.0), (5.75, 270.0), (0.25, 90.0)])
def test_arms_of_whole_turns_point_in_opposite_directions(turns: float, degrees: float) -> None:
    """A quarter of a turn more closes them to a right angle; makers count them from 0° to 360°."""
    assert math.degrees(free_arm_angle_rad(turns)) == pytest.approx(degrees, abs=1e-9)


@pytest.mark.parametrize(("plate", "leg", "between"), [(10.0, 100.0, 90.0), (100.0, 10.0, 270.0), (-30.0, 30.0, 60.0)])
def test_pins_are_counted_counter_clockwise_from_the_plates(plate: float, leg: float, between: float) -> None:
    assert math.degrees(between_pins_rad(math.radians(plate), math.radians(leg))) == pytest.approx(between)


def test_an_arm_touches_coil_and_pin() -> None:
    """Coil of 8 mm mean and 1 mm wire on a pin of 3 mm: axes 6 mm apart square to the arm; with 10 mm along it 11.7.

    The arm's axis is a tangent of the coil's mean circle; the pin's surface is half a wire beside it.
    """
    arms = Arms(8.0, 1.0, 3.0, 10.0)
    assert beside_mm(8.0, 1.0, 3.0) == 6.0
    assert arms.pin_radius_mm == pytest.approx(math.sqrt(136.0))
    tangent = np.array([4.0, 0.0])
    touched = tangent + np.array([0.0, 10.0])
    pin = touched + np.array([0.5 + 1.5, 0.0])
    assert np.hypot(*pin) == pytest.approx(arms.pin_radius_mm)
    assert arms.turn_rad == pytest.approx(math.atan2(pin[1], pin[0]))
    assert Arms.to_pins(8.0, 1.0, 3.0, math.sqrt(136.0)).lever_mm == pytest.approx(10.0)


def test_both_arms_bend_as_a_third_of_their_length_of_coil() -> None:
    """A cantilever with a force at its end gives way there by F·l³/(3·E·I): as much as l/3 of wire in pure bending.

    Wire of a turn: pi·D. Two arms of 12 mm on a coil of 8 mm: 8 mm over 25.1 mm.
    """
    assert Arms(8.0, 1.0, 3.0, 12.0).arm_turns == pytest.approx(2.0 * 12.0 / 3.0 / (8.0 * math.pi))
