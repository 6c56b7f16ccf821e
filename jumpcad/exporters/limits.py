"""How far joints may turn, as the formats that know limits say it."""

import math

from jumpcad.mechanism.model import Joint, Mechanism

SWING_RAD = math.pi / 2
"""Limits leave this much on either side of the travel: simulators make stops of them, and legs swing past rest."""


def limits_rad(joint: Joint, mechanism: Mechanism) -> tuple[float, float]:
    """Return the limits of a joint: the travel and a swing on either side, or the stop where there is one."""
    stop = mechanism.stop
    upper = stop.angle_rad if stop and stop.joint == joint.name else joint.upper_rad + SWING_RAD
    return joint.lower_rad - SWING_RAD, upper
