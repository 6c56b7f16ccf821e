"""The wire of a torsion spring as it is seen, and what to order (mm)."""

import math
from collections.abc import Mapping

import numpy as np

from jumpcad.catalogue import StockSpring
from jumpcad.drive import TorsionSpring
from jumpcad.drive.spring_arms import FULL_TURN_RAD
from jumpcad.robot.springs.place import arm_line
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array

STEPS_A_TURN = 24
"""Chords per turn of a drawn coil; judgement: at most 0.9 % of the radius inside the circle."""
STEPS_MAX = 400
"""Chords of a whole coil at most, so that its mesh stays small."""
ORDERED = 2
"""Springs of each hand to order, of which one is chosen by its torque; judgement."""
CHOOSE = f"; {ORDERED} in all, to choose from"
"""End of the name of an article of which more are ordered than the robot needs."""


def spring_article(spring: TorsionSpring, hand: str, springs: Mapping[str, StockSpring]) -> str:
    """Return what to order: a spring from stock by its name, or the figures that a spring maker needs."""
    if spring.stock:
        return f"{springs[spring.stock].article(hand)}, arms cut to {spring.arm_length_mm:.1f} mm{CHOOSE}"
    return (
        f"torsion spring, {spring.rate_nmm_per_deg:.2f} N·mm/°, wire {spring.wire_mm:g} mm, inside diameter "
        f"{spring.inside_diameter_mm:.2f} mm, {spring.turns:.2f} turns, {hand} hand{CHOOSE}"
    )


def coil_with_arm(hub_mm: Array, spring: TorsionSpring, y_mm: tuple[float, float]) -> DrawnWire:
    """Return body arm and coil in the body's frame at rest, the wire's middle from the outer y to the inner one.

    Seen from the robot's right the wire turns counter-clockwise from the body's arm to the leg's; a preload closes
    the coil further.
    """
    turn = FULL_TURN_RAD * spring.turns + spring.preload_rad
    steps = min(STEPS_MAX, math.ceil(STEPS_A_TURN * turn / FULL_TURN_RAD))
    share = np.linspace(0.0, 1.0, steps + 1)
    angle = spring.plate_pin_rad + spring.arms.turn_rad + share * turn
    radius, (outer, inner) = spring.arms.mean_mm / 2.0, y_mm
    coil = np.column_stack(
        [hub_mm[0] + radius * np.cos(angle), outer + share * (inner - outer), hub_mm[1] + radius * np.sin(angle)]
    )
    _, end = arm_line(hub_mm, spring, "plate")
    return DrawnWire(np.vstack([[end[0], outer, end[1]], coil]), spring.wire_mm)


def leg_arm_wire(spring: TorsionSpring, y_mm: tuple[float, float]) -> DrawnWire:
    """Return the leg's arm in the leg's frame, with the end of the coil that loading adds to it.

    At rest that end lies in the coil; `y_mm` are those of `coil_with_arm`.
    """
    turn = spring.wound_rad - spring.preload_rad
    share = np.linspace(0.0, 1.0, 1 + math.ceil(STEPS_A_TURN * turn / FULL_TURN_RAD))
    angle = -spring.arms.turn_rad - turn * (1.0 - share)
    radius, (outer, inner) = spring.arms.mean_mm / 2.0, y_mm
    rise = (inner - outer) * turn / (FULL_TURN_RAD * spring.turns + spring.preload_rad)
    coil = np.column_stack([radius * np.cos(angle), inner - rise * (1.0 - share), radius * np.sin(angle)])
    _, end = arm_line(np.zeros(2), spring, "leg")
    return DrawnWire(np.vstack([coil, [[end[0], inner, end[1]]]]), spring.wire_mm)
