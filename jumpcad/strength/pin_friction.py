"""Dry friction of all pins as one torque on the leg joint, for engines and file formats that have no pin forces."""

import numpy as np

from jumpcad.mechanism.model import BODY, Mechanism
from jumpcad.strength.loads import MovingMass, push_off

TILTING = 1.1
"""Friction losses with a tilting foot and links with mass over those from `push_off`; judgement: in the planar engine,
up to rest, 1.04 to 1.16 on the templates, 0.74 to 1.16 on 45 printed robots, 1 % of the springs' energy at most."""


def pin_torque_nm(mechanism: Mechanism, coefficient: float) -> float:
    """Return the constant torque at the leg joint that dissipates as much as all pins in a push-off (N·m).

    Rounded to 1 µN·m: it is written into files, and the forces come from linear algebra.

    The work of coefficient · radius · force along the turn of each pin is divided by the springs' travel. The forces
    are those of `push_off`, for which legs and foot have no mass, times `TILTING`.
    """
    friction = mechanism.friction
    if friction is None or coefficient == 0.0:
        return 0.0
    linkage, body = mechanism.linkage, mechanism.bodies[BODY]
    gyration_mm = 1000.0 * (body.inertia_kg_m2[1, 1] / body.mass_kg) ** 0.5
    mass = MovingMass(body.mass_kg, 1000.0 * body.com_m[[0, 2]], float(gyration_mm))
    loads = push_off(linkage, mass, mechanism.spring)
    leg, front, ankle, eye = friction.pin_radius_m
    foot_rate, front_rate = linkage.turning(loads.leg_rad)
    on_leg, on_front = np.hypot(*loads.ankle_n.T), np.abs(loads.front_n)
    torque = on_leg * (leg + ankle * np.abs(foot_rate - 1.0))
    torque += on_front * (front * np.abs(front_rate) + eye * np.abs(front_rate - foot_rate))
    return round(TILTING * coefficient * float(np.trapezoid(torque, loads.leg_rad)) / mechanism.spring.wind_rad, 6)
