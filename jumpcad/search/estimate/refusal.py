"""What refuses a design before it is built, and by how much: springs that cannot raise its body, and its layout.

A layout ends with its first refusal. Studies keep the missing millimetres, which are learned.
"""

import math
from dataclasses import replace

from jumpcad.design import Design
from jumpcad.dimensions import GAP_MM
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, errors, limit
from jumpcad.layout.layout import Layout
from jumpcad.layout.sweep import legs_apart_mm
from jumpcad.mechanism.capsule import capsule_robot
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop


def statics_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return `too_weak` of springs that could not raise the published body alone; nothing of others.

    It has 70 g; printed bodies have 76 g and more, and legs besides (`benchmarks/refuse.py`). The design has passed the
    checks of its geometry.
    """
    plain = capsule_robot(design)
    bodies = {name: body if name == BODY else replace(body, mass_kg=0.0) for name, body in plain.bodies.items()}
    spring = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    robot = with_spring_factor(replace(plain, bodies=bodies, spring=spring), settings.spring_efficiency)
    _, weak = statics_findings(robot, settings.gravity_m_s2)
    return tuple(replace(one, message=f"{one.message}; for its body alone") for one in errors([weak]))


def layout_findings(error: CannotBuildError) -> tuple[Finding, ...]:
    """Return the limit that a refused layout missed, with its negative margin, if it was a number."""
    if error.margin is None:
        return ()
    return (Finding(error.limit, "error", error.margin, error.unit, str(error), ""),)


def room_findings(layout: Layout, reserve_mm: float) -> tuple[Finding, ...]:
    """Return what a robot has left, above a reserve, of the room for which most designs are refused."""
    gap, room = legs_apart_mm(layout.linkage, layout.sections), layout.stop.room_mm
    needed = GAP_MM + reserve_mm
    apart = f"main leg and front link are {gap:.2f} mm apart, of {needed:g} mm at least"
    return (
        limit("legs_apart", gap - GAP_MM - reserve_mm, "mm", apart, ""),
        limit("stop_room", room, "mm", f"the rest stop has {room:.2f} mm of room, of 0 mm at least", ""),
    )
