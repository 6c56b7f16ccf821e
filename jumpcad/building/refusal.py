"""What refuses a design before anything is drawn: springs that cannot raise its body."""

import math
from dataclasses import replace

from jumpcad.catalogue import Battery, Board, Component
from jumpcad.design import Design
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.variants import capsule_robot, with_spring_factor
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop

BARE_BODY_KG = 0.0555
"""A body without electrical parts; the lightest of 2,000 in `benchmarks/refuse.py` has more."""


def statics_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return `too_weak` of springs that could not raise the published body alone; nothing of others.

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
    robot = with_spring_factor(replace(plain, bodies=bodies, springs=(spring,)), settings.spring_efficiency)
    _, weak = statics_findings(robot, settings.gravity_m_s2)
    return tuple(replace(one, message=f"{one.message}; for its body alone") for one in errors([weak]))
