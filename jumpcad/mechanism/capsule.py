"""The capsule robot: the published masses as uniform capsules, to check the evaluator apart from printed parts.

Every link is a uniform solid capsule whose *total* mass is that of the published study (1200 kg/m³ times the cylinder
alone); the foot link and both toes make one body. Spheres of the capsules' radius touch the ground.
"""

import math

import numpy as np
import numpy.typing as npt

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.mechanism.linkage import linkage_of
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Body, ContactSphere, Mechanism, five_bar
from jumpcad.transforms import Array

DENSITY_KG_M3 = 1200.0
"""Density of the published links."""
BODY_MASS_KG = 0.07
"""Mass of the published body with motor, gears and battery."""
LENGTH_PER_RADIUS = 25.0
"""Longest link over the radius of every capsule in the published model."""


@check_arguments
def capsule_robot(design: Design) -> Mechanism:
    """Return the robot of a design that has the published masses and no parts.

    Raises
    ------
    CannotBuildError
        If the design has no assembled pose.
    JumpcadError
        If the design was changed to invalid values.
    """
    design = design.revalidated()
    l1, l2, l3, l4, l5 = (
        length / 1000.0 for length in (design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm)
    )
    radius = design.l_max_mm / 1000.0 / LENGTH_PER_RADIUS
    angle = math.pi - math.radians(design.ground_link_angle_deg)
    left, right = (l5 * np.array([math.cos(angle), side * math.sin(angle), 0.0]) for side in (1.0, -1.0))
    origin, front_eye = np.zeros(3), np.array([l4, 0.0, 0.0])
    back_pivot, front_pivot = np.array([-l1 / 2, 0.0, 0.0]), np.array([l1 / 2, 0.0, 0.0])

    def link(to: Array) -> MassProperties:
        mass = DENSITY_KG_M3 * math.pi * radius**2 * float(np.linalg.norm(to))
        return capsule(mass, radius, origin, to)

    foot = combined([link(front_eye), link(left), link(right)])
    foot_contacts = (
        ContactSphere("front_eye", front_eye, radius, "foot"),
        ContactSphere("left_toe", left, radius, "foot"),
        ContactSphere("right_toe", right, radius, "foot"),
    )
    body_contacts = (
        ContactSphere("back_pivot", back_pivot, radius, "body"),
        ContactSphere("front_pivot", front_pivot, radius, "body"),
    )
    bodies = (
        _body(BODY, capsule(BODY_MASS_KG, radius, back_pivot, front_pivot), body_contacts),
        _body(MAIN_LEG, link(np.array([l2, 0.0, 0.0]))),
        _body(FRONT_LINK, link(np.array([l3, 0.0, 0.0]))),
        _body(FOOT, foot, foot_contacts),
    )
    joints, loop, spring = five_bar(linkage_of(design), (-design.compression_rad, 0.0), design.peak_spring_torque_nm)
    named = {body.name: body for body in bodies}
    return Mechanism("capsule", named, joints, (loop,), (spring,), design, foot_depth_m=radius)


def capsule(mass_kg: float, radius_m: float, start_m: npt.ArrayLike, end_m: npt.ArrayLike) -> MassProperties:
    """Return a uniform solid capsule whose cap centres are at `start_m` and `end_m`, each (3,).

    Cylinder plus two half balls, each moved along the axis by 3/8 of the radius beyond the cylinder's end.
    """
    start, end = np.asarray(start_m, dtype=float), np.asarray(end_m, dtype=float)
    length = float(np.linalg.norm(end - start))
    axis = (end - start) / length
    caps = mass_kg * (4 / 3 * radius_m) / (length + 4 / 3 * radius_m)
    cylinder = mass_kg - caps
    ball = 2 / 5 * caps * radius_m**2
    along = cylinder * radius_m**2 / 2 + ball
    across = cylinder * (radius_m**2 / 4 + length**2 / 12) + ball + caps * length * (length / 4 + 3 / 8 * radius_m)
    inertia = across * np.eye(3) + (along - across) * np.outer(axis, axis)
    return MassProperties(mass_kg, (start + end) / 2, inertia)


def _body(name: str, mass: MassProperties, contacts: tuple[ContactSphere, ...] = ()) -> Body:
    return Body(name, mass.mass_kg, mass.com_m, mass.inertia_kg_m2, contacts)
