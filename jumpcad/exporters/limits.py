"""Joint limits for URDF, SDF and MJCF."""

import math

from jumpcad.mechanism.model import Joint, Mechanism

SWING_RAD = math.pi / 2
"""Added to the travel on either side: simulators treat limits as stops, and legs swing past rest."""


def limits_rad(joint: Joint, mechanism: Mechanism) -> tuple[float, float]:
    """Return lower and upper limit of a joint (rad from rest): its travel and `SWING_RAD`; above, its stop if any."""
    stop = mechanism.stop
    upper = stop.angle_rad if stop and stop.joint == joint.name else joint.upper_rad + SWING_RAD
    return joint.lower_rad - SWING_RAD, upper
