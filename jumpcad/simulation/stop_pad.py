"""The stop's pad as both general engines apply it: elastic until the leg stands still, without rebound."""

import math

from jumpcad.mechanism.leg_inertia import leg_inertia_kg_m2
from jumpcad.mechanism.model import Mechanism


class StopPad:
    """The torque of a mechanism's stop on its leg joint, step by step; of one without a stop, none.

    A limit with critical damping, which MuJoCo has, throws the leg back at an eighth of its speed: more momentum on the
    foot, which decides whether a robot that tips over its nose leaves the ground.
    """

    def __init__(self, mechanism: Mechanism, dt_s: float) -> None:
        stop = mechanism.stop
        self._from_rad = stop.angle_rad if stop else math.inf
        self._nm_per_rad = stop.stiffness_nm_per_rad if stop else 0.0
        self._halting_nms = leg_inertia_kg_m2(mechanism, stop.angle_rad) / dt_s if stop else 0.0
        self._spring = mechanism.spring

    def torque_nm(self, leg_rad: float, leg_rad_s: float) -> float:
        """Return the torque against the leg's opening: no more than brings it to a standstill within a step."""
        if leg_rad <= self._from_rad:
            return 0.0
        halting = self._halting_nms * leg_rad_s + self._spring.torque_nm(leg_rad)
        return max(min(self._nm_per_rad * (leg_rad - self._from_rad), halting), 0.0)
