"""Springs that are made for templates, 13 mm long when loaded."""

import math
from dataclasses import replace

from jumpcad.catalogue import load_catalogue
from jumpcad.design import Design, load_design
from jumpcad.drive.spring import SpringLimits, TorsionSpring
from jumpcad.drive.spring_choice import springs_on_leg, synthesise_spring
from support.limits import default_limits

WIRE = load_catalogue().wire
LENGTH_MM = 13.0
LIMITS = replace(default_limits().spring, body_lengths_max_mm=(LENGTH_MM,), pin_radius_min_mm=0.0)
NAMES = ["kenan-1.0", "kenan-2.0", "best-ga", "best-bo"]


def spring_of(name: str, limits: SpringLimits = LIMITS) -> tuple[Design, TorsionSpring]:
    """Return a template's design and the spring that is made for it."""
    design = load_design(name)
    return design, synthesise_spring(springs_on_leg(design), -math.radians(design.rest_angle_deg), WIRE, limits)
