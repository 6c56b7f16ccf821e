"""The same robot or design a little different: other springs, or links of other lengths."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np

from jumpcad.design import PARAMETERS, Design, limits_of
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, Body, ContactSphere, Mechanism, Multibody, five_bar
from jumpcad.transforms import Array

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
        mechanism,
        design=design,
        bodies=bodies,
        joints=joints,
        loops=(loop,),
        springs=(replace(spring, wind_rad=design.compression_rad),),
        roller_off=off and replace(off, leg_rad=off.leg_rad + spring.wind_rad - design.compression_rad),
    )


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
