"""The two springs (mm, g)."""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.parts.purchased import BoughtPart, bought
from jumpcad.parts.simple import interval
from jumpcad.robot.layout import Layout
from jumpcad.robot.springs.place import arm_line
from jumpcad.robot.springs.wire import coil_with_arm, leg_arm_wire, spring_article
from jumpcad.solids.outline import ring, stadium
from jumpcad.workshop import Workshop


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
