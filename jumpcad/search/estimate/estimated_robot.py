"""A printed robot from a few figures: what is simulated in place of a built one.

Lengths, loaded angle and springs follow from the design, friction and pins from the workshop. What is left are mass,
centre of mass and inertia of the bodies, the radii that touch the ground, the stop and the release.

`quick_robot` is about what a design would be, in microseconds: the capsule robot with a printed one's mass and size,
with which the first designs of a search are chosen. Of ten winners of searches it tells the touchdown within a tenth;
what has no room, and most of what breaks, it does not know.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from jumpcad.design import Design
from jumpcad.dimensions import GAP_MM
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.findings import Finding, limit
from jumpcad.mechanism.linkage import Complex
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, ContactSphere, Mechanism, RollerOff, Stop
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.inside import legs_apart_mm
from jumpcad.scene.visuals import extent_m

EXTENTS = ("extent_x_m", "extent_y_m", "extent_z_m")
"""Figures of a standing robot, of which the largest is its size."""
LAID = {
    "laid_spring_g": 10.0, "laid_coil_mm": 10.0, "laid_cam_x_mm": 10.0, "laid_cam_z_mm": 10.0, "laid_motor_x_mm": 10.0,
    "laid_motor_z_mm": 10.0, "laid_tray_x_mm": 10.0,
}  # fmt: skip
"""Figures of a layout on which masses depend, and what counts as 1 of each in a fit; judgement."""
BODY_MM, ABOVE_MM, BESIDE_MM = 100.0, 60.0, 20.0
"""Length of a printed robot's body, and by how much body and feet stand out from the links' ends."""
MOST_J, MOST_NM = 0.8, 1.75
"""Energy and torque of springs above which a first design is hardly ever built: of 505 random robots of the default
workshop, all 146 that kept all limits had less. Release kick and the leg's axle reject the others."""


def layout_figures(layout: Layout) -> dict[str, float]:
    """Return figures of a layout on which masses depend, to six digits: they leap where it takes another wire."""
    spring = layout.drive.spring
    values = (spring.mass_g, spring.arms.mean_mm, *layout.cam_axis_mm, *layout.motor_mm, layout.tray_mm[0])
    return {name: float(f"{value:.6g}") for name, value in zip(LAID, values, strict=True)}


def robot_figures(robot: Robot) -> dict[str, float]:
    """Return what `estimated_robot` needs but for the masses, to six digits; x and z in the bodies' frames."""
    assert robot.stop is not None
    assert robot.roller_off is not None
    found: dict[str, float] = {}
    for name, body in robot.bodies.items():
        found |= {f"{name}_com_x_m": float(body.com_m[0]), f"{name}_com_z_m": float(body.com_m[2])}
        found[f"{name}_inertia_kg_m2"] = float(body.inertia_kg_m2[1, 1])
    found |= layout_figures(robot.layout) | dict(zip(EXTENTS, extent_m(robot).tolist(), strict=True))
    for name, corners in robot.outline_m.items():
        found |= dict(zip(_bounds(name), _box(corners), strict=True))
    found |= {
        "foot_depth_m": robot.foot_depth_m,
        "toe_radius_m": robot.bodies[FOOT].contacts[-1].radius_m,
        "stop_rad": robot.stop.angle_rad,
        "stop_nm_per_rad": robot.stop.stiffness_nm_per_rad,
        "release_turn_rad": robot.roller_off.leg_rad + robot.spring.wind_rad,
        "release_rad_s": robot.roller_off.leg_rad_s,
        "release_ratio": robot.roller_off.energy_ratio,
    }
    return {name: float(f"{value:.6g}") for name, value in found.items()}


def estimated_robot(design: Design, figures: Mapping[str, float], like: Robot) -> Mechanism:
    """Return the robot of a design with these figures, in all else like another one of its workshop."""
    plain = _plain(design)
    bodies = {name: _body(plain.bodies[name], figures, like.bodies[name]) for name in BODY_NAMES}
    spring = springs_on_leg(design, like.workshop.stock_spring, like.spring.preload_rad)
    ratio = min(figures["release_ratio"], 1.0)
    release = RollerOff(figures["release_turn_rad"] - spring.wind_rad, figures["release_rad_s"], ratio)
    return replace(
        plain,
        bodies=bodies,
        springs=(spring,),
        foot_depth_m=figures["foot_depth_m"],
        stop=Stop(spring.joint, figures["stop_rad"], figures["stop_nm_per_rad"]),
        roller_off=release,
        friction=like.friction,
        outline_m={name: _outline(name, figures, corners) for name, corners in like.outline_m.items()},
    )


_plain = lru_cache(maxsize=512)(capsule_robot)  # of designs that are estimated anew with other figures


def _outline(name: str, figures: Mapping[str, float], like: Complex) -> Complex:
    """Return another body's outline stretched to the bounds that the figures say."""
    (left, right, low, high), (x0, x1, z0, z1) = _box(like), (figures[key] for key in _bounds(name))
    x = x0 + (like.real - left) * (x1 - x0) / (right - left)
    return np.asarray(x + 1j * (z0 + (like.imag - low) * (z1 - z0) / (high - low)))


def _bounds(name: str) -> list[str]:
    return [f"{name}_{side}_m" for side in ("left", "right", "bottom", "top")]


def _box(corners: Complex) -> list[float]:
    """Return least and largest x, then z, of corners x + iz."""
    return [float(limit(axis)) for axis in (corners.real, corners.imag) for limit in (np.min, np.max)]


def _body(plain: Body, figures: Mapping[str, float], like: Body) -> Body:
    """Return a body with the figures' mass and inertia; only the plane of motion is right."""
    name = plain.name
    com = np.array([figures[f"{name}_com_x_m"], 0.0, figures[f"{name}_com_z_m"]])
    inertia = figures[f"{name}_inertia_kg_m2"] * np.diag([0.6, 1.0, 0.6])  # any about x and z: it turns about y
    contacts = tuple(_contact(contact, figures, like) for contact in plain.contacts)
    return Body(figures[f"{name}_mass_kg"], com, inertia, name, contacts)


def _contact(contact: ContactSphere, figures: Mapping[str, float], like: Body) -> ContactSphere:
    if like.name == BODY:
        return replace(contact, radius_m=like.contacts[0].radius_m)
    depth, toe = figures["foot_depth_m"], figures["toe_radius_m"]
    if "toe" not in contact.name:
        return replace(contact, radius_m=depth)
    return replace(contact, centre_m=contact.centre_m + np.array([0.0, 0.0, toe - depth]), radius_m=toe)


def quick_size_m(design: Design) -> float:
    """Return about the size of a printed robot: within 8 %, in the median of 223 that jump."""
    high = ABOVE_MM + design.l2_mm * math.sin(math.radians(design.rest_angle_deg))
    wide = BESIDE_MM + 2.0 * design.l5_mm * math.sin(math.radians(design.ground_link_angle_deg))
    return max(design.l_max_mm, BODY_MM, high, wide) / 1000.0


def quick_robot(design: Design) -> Mechanism | None:
    """Return the robot of a design about as it is printed; None where its springs are too strong.

    Its mass is that of 505 random robots of the default workshop within 6 g (least squares): by the lengths of the
    links, the stiffness and the energy of the springs.
    """
    plain = capsule_robot(design)
    energy_j, stiffness = plain.spring.energy_j, plain.spring.stiffness_nm_per_rad
    if energy_j > MOST_J or 2.0 * energy_j * stiffness > MOST_NM**2:
        return None
    links_g = 0.106 * design.l2_mm + 0.028 * design.l3_mm + 0.194 * design.l4_mm + 0.1 * design.l5_mm
    mass_kg = (77.0 + links_g + 0.216 * design.stiffness_nmm_per_deg + 48.5 * energy_j) / 1000.0
    heavier = mass_kg / sum(body.mass_kg for body in plain.bodies.values())
    bodies = {
        name: replace(body, mass_kg=heavier * body.mass_kg, inertia_kg_m2=heavier * body.inertia_kg_m2)
        for name, body in plain.bodies.items()
    }
    return replace(plain, bodies=bodies)


def room_findings(layout: Layout, reserve_mm: float) -> tuple[Finding, ...]:
    """Return what a robot has left, above a reserve, of the room for which most designs are refused."""
    gap, room, way = legs_apart_mm(layout.linkage, layout.sections), layout.stop.room_mm, layout.pin_hole.room_mm
    needed = GAP_MM + reserve_mm
    apart = f"main leg and front link are {gap:.2f} mm apart, of {needed:g} mm at least"
    return (
        limit("legs_apart", gap - GAP_MM - reserve_mm, "mm", apart, ""),
        limit("stop_room", room, "mm", f"the rest stop has {room:.2f} mm of room, of 0 mm at least", ""),
        limit("pin_way", way, "mm", f"the leg's pin has {way:.2f} mm of room on its way, of 0 mm at least", ""),
    )
