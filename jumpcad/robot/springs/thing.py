"""The springs: bushings as printed parts, what is bought, and the wire from the body's arm to the leg's (mm, g)."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from jumpcad.catalogue import StockSpring
from jumpcad.dimensions import BUSHING_PLAY_MM
from jumpcad.drive import TorsionSpring
from jumpcad.drive.spring import FULL_TURN_RAD
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_left, lying_on_right
from jumpcad.parts.purchased import BoughtPart, bought, interval
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Thing
from jumpcad.robot.springs.place import arm_line
from jumpcad.solids.outline import disc, hole, ring, stadium
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

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


def springs(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield both springs, each as coil with body arm and as leg arm.

    Each shape is the room that wire takes, a ring and a bar; what is seen is the wire.
    """
    catalogue = workshop.catalogue
    spring, lateral, d = layout.drive.spring, layout.lateral, layout.drive.spring.wire_mm
    coil = ring(spring.outer_diameter_mm, spring.inside_diameter_mm, layout.hub_mm)
    body_arm = stadium(*arm_line(layout.hub_mm, spring, "plate"), d)
    leg_arm = stadium(*arm_line(np.zeros(2), spring, "leg"), d)
    arm_mass = math.pi / 4.0 * d**2 * spring.arm_length_mm * catalogue.wire.density_g_cm3 / 1000.0
    for side, sign, hand in zip(("left", "right"), (1.0, -1.0), spring.hands, strict=True):
        inner, outer = lateral.spring_left if side == "left" else lateral.spring_right[::-1]
        order = spring_article(spring, hand, catalogue.springs)
        slabs = [(*interval(inner, outer), coil), (*interval(outer - sign * d, outer), body_arm)]
        middles = (outer - sign * d / 2.0, inner + sign * d / 2.0)
        wire = coil_with_arm(layout.hub_mm, spring, middles)
        yield bought(f"spring_{side}", order, BODY, spring.mass_g - arm_mass, slabs).seen_as(wire)
        leg_slabs = [(*interval(inner, inner + sign * d), leg_arm)]
        leg = bought(f"spring_{side}_leg_arm", order, MAIN_LEG, arm_mass, leg_slabs, units=0)
        yield leg.seen_as(leg_arm_wire(spring, middles))


def spring_bushings(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    """Yield the bushing inside each spring: a mandrel from the leg under the coil, then a spacer out to the plate."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    lateral, spring, (x, z) = layout.lateral, layout.drive.spring, layout.hub_mm
    inner, outer = lateral.leg[1] + BUSHING_PLAY_MM, lateral.spring_left[1]
    bore = hole(holes.running(layout.axle_mm))
    mandrel, spacer = disc(spring.mandrel_mm), disc(layout.spring_bore_room_mm)
    # printed mandrel down; on the left the mandrel lies to the right, on the right to the left
    sides = (
        ("left", lateral.inside[1], lying_on_right(inner, x, z)),
        ("right", -lateral.inside[0], lying_on_left(-inner, x, z)),
    )
    for side, wall, pose in sides:
        end = wall - layout.boss_mm - BUSHING_PLAY_MM
        slabs = [(0.0, min(outer, end) - inner, mandrel - bore)]
        slabs += [(outer - inner, end - inner, spacer - bore)] if end > outer else []
        yield Drawing(f"spring_bushing_{side}", "body", Stack.of(slabs), (Placement(BODY, pose),))


SPRINGS = Thing(spring_bushings, springs)
