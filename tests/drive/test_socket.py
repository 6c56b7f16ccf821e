"""The room that is kept for a motor holds the socket and the cap that are drawn."""

import pytest
from support.built import built, part

from jumpcad.drive.socket import front_length_mm, socket_half_mm


@pytest.mark.parametrize("motor", ["", "n20-50"])
def test_the_cap_lies_within_the_socket_s_room_and_all_but_fills_it(motor: str) -> None:
    """The cap has the outline of the socket; in its own frame the ears stand along y."""
    robot = built("best-bo", motor=motor)
    half = socket_half_mm(robot.layout.drive.train.motor)
    low, high = part(robot, "motor_cap").mesh.bounds[:, :2]
    for room, drawn in zip(half, (high - low) / 2.0, strict=True):
        assert room - 0.4 < drawn <= room


def test_in_front_of_the_motor_is_the_cap_or_a_boss_that_is_longer() -> None:
    robot = built("kenan-2.0")
    motor, cap = robot.layout.drive.train.motor, part(robot, "motor_cap").mesh.extents[2]
    short, long = (motor.model_copy(update={"boss_length_mm": length}) for length in (0.5, 4.0))
    assert front_length_mm(short) == pytest.approx(cap)
    assert front_length_mm(long) == 4.0
