"""The room that a motor takes in the body."""

import pytest
from support.built import built

from jumpcad.drive.socket import cap_ear_mm, front_length_mm, socket_half_mm, window_mm


def test_the_socket_has_walls_around_the_motor_and_ears_across() -> None:
    """A motor of 10 x 12 mm, 0.3 mm of play and a wall of 1.6 mm on every side, ears of 5.6 mm."""
    motor = built("kenan-2.0").layout.drive.train.motor
    assert (motor.width_mm, motor.height_mm) == (10.0, 12.0)
    assert socket_half_mm(motor) == pytest.approx((5.0 + 1.9, 6.0 + 1.9 + 5.6))


@pytest.mark.parametrize(("wall", "ear"), [(0.5, 5.6), (0.8, 5.64), (1.2, 6.44)])
def test_ears_have_printable_walls_on_both_sides_of_a_counterbore_of_4_mm(wall: float, ear: float) -> None:
    assert cap_ear_mm(wall) == pytest.approx(ear)


def test_a_boss_that_is_longer_than_the_cap_reaches_further() -> None:
    motor = built("kenan-2.0").layout.drive.train.motor
    capped = front_length_mm(motor.model_copy(update={"boss_length_mm": 0.0}))
    assert capped == front_length_mm(motor)
    assert front_length_mm(motor.model_copy(update={"boss_length_mm": capped + 3.0})) == capped + 3.0


def test_the_sockets_floor_holds_a_millimetre_of_the_motors_rear_on_every_side() -> None:
    """A motor of 10 x 12 mm; the rest is open for terminals and wires."""
    assert window_mm(built("kenan-2.0").layout.drive.train.motor) == (8.0, 10.0)
