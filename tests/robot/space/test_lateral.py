"""The stack across the robot: what moves past something has a gap to it, and the sum agrees with one by hand."""

import itertools

import pytest

from jumpcad.catalogue import load_catalogue
from jumpcad.dimensions import GAP_MM
from jumpcad.robot.space.inside import Lateral, lateral_stack

MOTOR = load_catalogue().motors["n20-298"]
"""An N20: 24 mm over motor and gearbox."""


def stack(
    spring: float = 5.0, gears: tuple[float, ...] = (5.0,), tray: float = 20.0, motor: float = 24.0, screw: float = 16.0
) -> Lateral:
    """Return the stack of an 8 mm leg with a 623 bearing (4 mm wide) for a roller and plates of 2.4 mm."""
    lying = MOTOR.model_copy(update={"body_length_mm": motor})
    return lateral_stack(8.0, 4.0, 4.0, spring, gears, lying, 2.4, tray, screw)


def apart(one: tuple[float, float], other: tuple[float, float]) -> float:
    """Return the gap between two intervals, negative where they overlap."""
    return max(other[0] - one[1], one[0] - other[1])


CASES = [stack(), stack(spring=13.0), stack(gears=(5.0, 4.0)), stack(tray=60.0), stack(spring=13.0, motor=9.0)]


def test_the_sum_of_the_left_side() -> None:
    """Half the leg 4, washer 0.5, roller 4, its screw's head 1.65, 1 mm, gear 5, gap 0.5: the plate at 16.65 mm."""
    lateral = stack()
    assert lateral.cam == (4.5, 8.5)
    assert lateral.gears == (pytest.approx((11.15, 16.15)),)
    assert lateral.left_plate == pytest.approx((16.65, 19.05))
    right = lateral.right_plate
    assert lateral.plates_mm == pytest.approx((17.85, right[1] - 1.2))  # of 2.4 mm
    assert right[1] - right[0] == pytest.approx(2.4)
    thicker = stack(spring=13.0)  # the coil, 0.5 to 13.5 mm beside the leg, now is what the gear must clear
    assert thicker.gears == (pytest.approx((18.0, 23.0)),)
    two = stack(gears=(5.0, 4.0))
    assert two.gears[1] == pytest.approx((16.65, 20.65))
    assert two.left_plate[0] == pytest.approx(21.15)


@pytest.mark.parametrize("lateral", CASES)
def test_what_turns_has_a_gap_on_either_side(lateral: Lateral) -> None:
    turning = [lateral.leg, *lateral.gears]
    beside = [lateral.spring_left, lateral.spring_right, lateral.lug_left, lateral.lug_right]
    for one, other in itertools.combinations([*turning, lateral.left_plate, lateral.right_plate], 2):
        assert apart(one, other) >= GAP_MM - 1e-9
    for still in beside:
        assert apart(lateral.leg, still) >= GAP_MM - 1e-9
        assert apart(lateral.left_plate, still) >= GAP_MM - 1e-9 or still in (lateral.lug_left, lateral.lug_right)
        assert apart(lateral.right_plate, still) >= GAP_MM - 1e-9 or still in (lateral.lug_left, lateral.lug_right)
    for gear in lateral.gears:
        assert apart(gear, lateral.spring_left) >= GAP_MM - 1e-9
        assert apart(gear, lateral.cam) >= 1.65 - 1e-9  # head of an ISO 7380 M3 screw


@pytest.mark.parametrize("lateral", CASES)
def test_springs_and_lugs_are_the_same_on_both_sides(lateral: Lateral) -> None:
    for left, right in ((lateral.spring_left, lateral.spring_right), (lateral.lug_left, lateral.lug_right)):
        assert left == (-right[1], -right[0])
    assert lateral.leg[0] == -lateral.leg[1]


def test_the_widest_of_motor_spring_and_tray_places_the_right_plate() -> None:
    by_motor, by_tray, by_spring = stack(), stack(tray=60.0), stack(spring=13.0, motor=9.0)
    assert by_motor.motor[0] - by_motor.inside[0] == pytest.approx(0.5)  # the terminals' room
    assert by_tray.inside[1] - by_tray.inside[0] == pytest.approx(60.0)
    assert by_tray.left_plate == by_motor.left_plate
    assert apart(by_spring.right_plate, by_spring.spring_right) == pytest.approx(GAP_MM)
