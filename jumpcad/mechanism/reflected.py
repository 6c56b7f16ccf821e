"""The robot as its leg joint feels it while the foot stands flat on the ground without slipping (SI units)."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.model import BODY, FRONT_LINK, MAIN_LEG, Body
from jumpcad.transforms import Array, turned_about_y

POSITIONS = 33
"""Leg angles of the table; with four times as many, inertia and slopes change by less than 0.3 %."""


@dataclass(frozen=True)
class ReflectedMass:
    """What moves with the leg, at wind angles (n,) that grow from rest to the loaded springs.

    Attributes
    ----------
    wind_rad
        Angles (n,), evenly spaced.
    inertia_kg_m2, inertia_slope
        Reflected inertia I (n,), of which half times the wind rate squared is the kinetic energy; its slope by the
        wind angle.
    weight_nm
        Slope (n,) of the potential energy of weight by the wind angle: negative where the body sinks.
    """

    wind_rad: Array
    inertia_kg_m2: Array
    inertia_slope: Array
    weight_nm: Array

    def at(self, wind_rad: Array) -> tuple[Array, Array, Array]:
        """Return I, its slope and the weight's torque (n,) at wind angles (n,); constant beyond the table."""
        columns = (self.inertia_kg_m2, self.inertia_slope, self.weight_nm)
        inertia, slope, weight = (np.interp(wind_rad, self.wind_rad, column) for column in columns)
        return inertia, slope, weight


def reflected_mass(bodies: Mapping[str, Body], linkage: Linkage) -> ReflectedMass:
    """Return what body, main leg and front link are to the leg joint; the foot stands still.

    I = sum of m·|dc/dw|² + I_y·(dt/dw)² over the bodies, c and t their centres of mass and turns seen from the foot
    (e.g. Norton, Design of Machinery, 10.12: equivalent inertia from equal kinetic energy).
    """
    leg = np.linspace(*linkage.travel_rad, POSITIONS)
    pose = linkage.pose(leg)
    still = np.zeros_like(pose.ankle_mm)
    places = (
        (bodies[BODY], still, 0.0 * leg),
        (bodies[MAIN_LEG], still + linkage.back_pivot_mm, linkage.rest_rad + pose.leg_rad),
        (bodies[FRONT_LINK], still + linkage.front_pivot_mm, linkage.rest_rad + pose.front_rad),
    )

    def by_wind(values: Array) -> Array:
        return -np.gradient(values, leg, axis=0, edge_order=2)

    inertia, height = np.zeros_like(leg), np.zeros_like(leg)
    for body, origin_mm, turn in places:
        com_mm = origin_mm + turned_about_y(1000.0 * body.com_m[[0, 2]] + still, turn)
        seen = turned_about_y(com_mm - pose.ankle_mm, -pose.foot_rad) / 1000.0
        speed = by_wind(seen)
        spin = by_wind(turn - pose.foot_rad)
        inertia = inertia + body.mass_kg * (speed**2).sum(axis=1) + body.inertia_kg_m2[1, 1] * spin**2
        height = height + body.mass_kg * seen[:, 1]
    columns = (-leg, inertia, by_wind(inertia), GRAVITY_M_S2 * by_wind(height))
    return ReflectedMass(*(column[::-1].copy() for column in columns))
