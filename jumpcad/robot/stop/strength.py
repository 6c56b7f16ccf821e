"""Impact (blow) of the leg on the rest stop's pad: energy, peak force, deflection (SI, except the pad in N and mm)."""

import math
from dataclasses import dataclass

from jumpcad.mechanism.flight import Blow
from jumpcad.mechanism.model import Stop

BLOW_FACTOR = 2.0
"""Safety factor on the peak force, against the material's strength; judgement: the force is computed without
friction."""
PEAK_SHARE = 0.82
"""Peak force of a pad without rebound over that of a lossless spring; judgement, from computed blows of three
templates."""


@dataclass(frozen=True)
class StopBlow:
    """The impact of the leg on its stop.

    `energy_j` is the energy that the pad absorbs, `torque_nm` the peak torque about the leg's joint, `force_n` the peak
    force on the pad, `give_rad` and `give_mm` the pad's deflection, that of a lossless spring of its stiffness.
    """

    stop: Stop
    energy_j: float
    torque_nm: float
    force_n: float
    give_rad: float
    give_mm: float


def stop_blow(blow: Blow, angle_rad: float, radius_mm: float, pad_n_per_mm: float) -> StopBlow:
    """Return the impact on a pad of some stiffness at a radius from the leg's joint: F = 0.82·v·sqrt(k·I)/r."""
    radius = radius_mm / 1000.0
    stiffness = 1000.0 * pad_n_per_mm * radius**2
    torque = PEAK_SHARE * blow.stop_rad_s * math.sqrt(stiffness * blow.inertia_kg_m2)
    give = blow.stop_rad_s * math.sqrt(blow.inertia_kg_m2 / stiffness)
    return StopBlow(
        Stop("leg", angle_rad, stiffness), blow.energy_j, torque, torque / radius, give, 1000.0 * give * radius
    )
