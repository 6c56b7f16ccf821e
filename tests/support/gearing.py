"""Play of gears, as by hand: how far one turns while the other is held."""

from collections.abc import Callable

from manifold3d import CrossSection

TOUCH_MM2 = 1e-5
TRIES = 240


def turning_play_deg(held: CrossSection, turned: CrossSection, distance_mm: float, pitch_deg: float) -> float:
    """Return by what angle a gear turns about the origin between touching a held one's flanks on either side.

    The held gear's axis is at (distance, 0). A gear that touches in every position has no play: 0.
    """
    mate = held.translate((distance_mm, 0.0))

    def touches(angle_deg: float) -> bool:
        return (turned.rotate(angle_deg) ^ mate).area() > TOUCH_MM2

    free = next((turn for turn in (pitch_deg * n / TRIES for n in range(TRIES)) if not touches(turn)), None)
    if free is None:
        return 0.0
    return _last_free(touches, free, pitch_deg / TRIES) - _last_free(touches, free, -pitch_deg / TRIES)


def _last_free(touches: Callable[[float], bool], free_deg: float, step_deg: float) -> float:
    """Return the angle at which the flanks touch, starting from a free one."""
    while not touches(free_deg + step_deg):
        free_deg += step_deg
    for _ in range(12):
        step_deg /= 2.0
        if not touches(free_deg + step_deg):
            free_deg += step_deg
    return free_deg
