"""Room that a motor needs in the body: its socket, and the distance from its front to its pinion (mm)."""

from jumpcad.catalogue import Motor
from jumpcad.dimensions import CAP_EAR_MM, CAP_HEAD_MM, MOTOR_CAP_MM, MOTOR_RIM_MM, SOCKET_PLAY_MM, SOCKET_WALL_MM

FACETS_MM = 0.04
"""What the facets of a head's seat take off both walls beside it."""


def cap_ear_mm(wall_min_mm: float) -> float:
    """Return how far the ears for the cap's screws reach beyond the socket, with walls that a printer can print."""
    return max(CAP_EAR_MM, CAP_HEAD_MM + 2.0 * wall_min_mm + FACETS_MM)


def socket_half_mm(motor: Motor, ear_mm: float = CAP_EAR_MM) -> tuple[float, float]:
    """Return the half sizes of a motor's socket: along its width, and along its height with the cap's ears."""
    wall = SOCKET_PLAY_MM + SOCKET_WALL_MM
    return motor.width_mm / 2.0 + wall, motor.height_mm / 2.0 + wall + ear_mm


def front_length_mm(motor: Motor) -> float:
    """Return how far the cap, or a boss that is longer, reaches from the motor's front."""
    return max(MOTOR_CAP_MM, motor.boss_length_mm)


def window_mm(motor: Motor) -> tuple[float, float]:
    """Return width and height of the window in the socket's floor, through which terminals and wires pass."""
    return motor.width_mm - 2.0 * MOTOR_RIM_MM, motor.height_mm - 2.0 * MOTOR_RIM_MM
