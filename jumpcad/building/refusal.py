"""What refuses a design before anything is drawn: springs that cannot raise its body, a body far beyond its feet."""

import math
from dataclasses import replace

import numpy as np

from jumpcad.catalogue import Battery, Board, Component
from jumpcad.design import Design
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop

BARE_BODY_KG = 0.0555
"""A body without electrical parts; the lightest of 2,000 in `benchmarks/refuse.py` has more."""
BODY_UP_M = 0.0167
"""Centre of mass of a body above the middle of its pivots; of 500 bodies it was 15 to 19 mm."""
LEG_KG_M, LEG_SHARE, FRONT_KG_M = 0.1, 0.26, 0.039
FOOT_KG_M, TOE_KG_M = 0.074, 0.026
"""Mass of prints per length, and where the main leg's centre is; those of the foot a fifth more than usual."""
SURE_MM = 12.0
"""By how much such a robot must tip over; 800 robots as built tipped over less by 11 mm at most."""
SURE_SHARE = 0.4
"""Of its springs' energy, what must be left then: else it may be too weak, which is its verdict. Of 110 robots, those
with less than nothing left were too weak as built, those with 0.29 and more were not."""


def statics_refusal(design: Design, workshop: Workshop, settings: Settings, tips: bool = False) -> tuple[Finding, ...]:
    """Return `too_weak` of springs that could not raise the published body alone; nothing of others.

    Where it is asked for, also of others that would tip over by `SURE_MM` with that body on usual legs: then `tips`,
    or `too_weak` where they are that too.

    It has 70 g; printed bodies have 71 g and more, and legs besides (`benchmarks/refuse.py`); less with lighter
    electrical parts than any that are shipped. Nothing is said where the user weighed parts. The design has passed the
    checks of its geometry.
    """
    if workshop.mass.weighed_g:
        return ()
    chosen, plain = chosen_parts(workshop), capsule_robot(design)
    parts: list[Battery | Board | Component] = [chosen.battery, *chosen.boards.values(), *chosen.components.values()]
    body_kg = min(plain.bodies[BODY].mass_kg, BARE_BODY_KG + sum(part.mass_g for part in parts) / 1000.0)
    masses = {BODY: body_kg}
    bodies = {name: replace(body, mass_kg=masses.get(name, 0.0)) for name, body in plain.bodies.items()}
    spring = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    robot = with_spring_factor(replace(plain, bodies=bodies, spring=spring), settings.spring_efficiency)
    _, weak = statics_findings(robot, settings.gravity_m_s2)
    if errors([weak]):
        return (replace(weak, message=f"{weak.message}; for its body alone"),)
    if not tips or workshop.cage.rod:
        return ()
    l2, l3, l4, l5 = (length / 1000.0 for length in (design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm))
    foot_kg, toes_kg = FOOT_KG_M * l4, 2.0 * TOE_KG_M * l5
    foot_m = (foot_kg * l4 + toes_kg * toe_tip_mm(design)[0] / 1000.0) / (foot_kg + toes_kg) / 2.0
    usual = {
        BODY: (body_kg, (0.0, 0.0, BODY_UP_M)),
        MAIN_LEG: (LEG_KG_M * l2, (LEG_SHARE * l2, 0.0, 0.0)),
        FRONT_LINK: (FRONT_KG_M * l3, (l3 / 2.0, 0.0, 0.0)),
        FOOT: (foot_kg + toes_kg, (foot_m, 0.0, 0.0)),
    }
    bodies = {name: replace(plain.bodies[name], mass_kg=kg, com_m=np.array(at)) for name, (kg, at) in usual.items()}
    over, weak = statics_findings(replace(robot, bodies=bodies), settings.gravity_m_s2)
    left = weak.margin / robot.spring.energy_j
    if over.margin >= -SURE_MM or 0.0 <= left < SURE_SHARE:
        return ()
    first = weak if left < 0.0 else over
    return (replace(first, message=f"{first.message}; with usual legs"),)
