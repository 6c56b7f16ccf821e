"""The study's capsule robot of a design, and the same robot a little different: other springs, other lengths.

Every link of the capsule robot is a uniform solid capsule whose *total* mass is that of the published study (1200 kg/m³
times the cylinder alone); the foot link and both toes make one body. Spheres of the capsules' radius touch the ground.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from jumpcad.arguments import check_arguments
from jumpcad.design import PARAMETERS, Design, limits_of
from jumpcad.mechanism.linkage import Linkage, linkage_of, toe_tip_mm
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import (
    BODY,
    FOOT,
    FRONT_LINK,
    MAIN_LEG,
    Body,
    ContactSphere,
    Mechanism,
    Multibody,
    five_bar,
)
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
    l1, l2, l3, l4, l5 = (getattr(design, f"l{number}_mm") / 1000.0 for number in range(1, 6))
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
        Body.of(BODY, capsule(BODY_MASS_KG, radius, back_pivot, front_pivot), body_contacts),
        Body.of(MAIN_LEG, link(np.array([l2, 0.0, 0.0]))),
        Body.of(FRONT_LINK, link(np.array([l3, 0.0, 0.0]))),
        Body.of(FOOT, foot, foot_contacts),
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


Robot = TypeVar("Robot", bound=Mechanism)
AnyRobot = TypeVar("AnyRobot", bound=Multibody)
LIMITS = np.array([limits_of(name) for name in PARAMETERS]).T


def with_spring_factor(mechanism: AnyRobot, factor: float) -> AnyRobot:
    """Return a robot whose springs have another stiffness, and so another energy, at the same angles.

    The leg leaves the cam with the same share of the springs' energy: its speed there goes with the root of the factor.
    """
    if factor == 1.0:
        return mechanism
    off = mechanism.roller_off
    return replace(
        mechanism,
        springs=tuple(
            replace(one, stiffness_nm_per_rad=factor * one.stiffness_nm_per_rad) for one in mechanism.springs
        ),
        roller_off=off and replace(off, leg_rad_s=math.sqrt(factor) * off.leg_rad_s),
    )


def with_lengths(mechanism: Robot, design: Design) -> Robot:
    """Return a robot whose links have lengths and angles of another design, and whose bodies keep mass and inertia.

    Joints, loop and contacts move with the ends of the links. The leg leaves the cam as far before the loaded pose as
    it did. For small differences, such as errors of print and assembly.
    """
    old, spring, off = mechanism.design, mechanism.spring, mechanism.roller_off
    joint = mechanism.joint(spring.joint)
    joints, loop, _ = five_bar(Linkage(design), (-design.compression_rad, joint.upper_rad), joint.effort_nm)
    eye, toe = design.l4_mm - old.l4_mm, float(toe_tip_mm(design)[0] - toe_tip_mm(old)[0])
    half = (design.l1_mm - old.l1_mm) / 2.0
    middle_m = old.l4_mm / 2000.0
    bodies = dict(mechanism.bodies)
    bodies[FOOT] = _moved(bodies[FOOT], lambda sphere: eye if sphere.centre_m[0] > middle_m else toe)
    bodies[BODY] = _moved(bodies[BODY], lambda sphere: math.copysign(half, half * float(sphere.centre_m[0])))
    return replace(
        mechanism, design=design, bodies=bodies, joints=joints, loops=(loop,),
        springs=(replace(spring, wind_rad=design.compression_rad),),
        roller_off=off and replace(off, leg_rad=off.leg_rad + spring.wind_rad - design.compression_rad),
    )  # fmt: skip


def with_length_errors(design: Design, error_mm: Array) -> Design:
    """Return the design whose links l2…l5 are longer by errors (4,) (mm)."""
    l2, l3, l4, l5 = np.array([design.l2_mm, design.l3_mm, design.l4_mm, design.l5_mm]) + error_mm
    return design_within_limits(np.array([l2, l3 / l2, l4 / l2, l5 / l2, *design.to_vector()[4:]]))


def design_within_limits(vector: Array) -> Design:
    """Return the design nearest to a vector (8,)."""
    return Design.from_vector(np.clip(vector, *LIMITS).tolist())


def _moved(body: Body, by_mm: Callable[[ContactSphere], float]) -> Body:
    """Return a body whose contact spheres are moved along x."""
    contacts = tuple(
        replace(sphere, centre_m=sphere.centre_m + np.array([by_mm(sphere) / 1000.0, 0.0, 0.0]))
        for sphere in body.contacts
    )
    return replace(body, contacts=contacts)
