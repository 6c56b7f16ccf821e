"""The rigid bodies of a robot: what they carry, where they touch the ground, and the friction there and at the pins."""

import itertools
from collections import defaultdict
from collections.abc import Iterable

import numpy as np

from jumpcad.collision.hulls import CAGE
from jumpcad.dimensions import PAD_WALL_MM
from jumpcad.mechanism.linkage import Complex, toe_tip_mm
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, ContactSphere, Friction, Surface
from jumpcad.mechanism.planar import points
from jumpcad.parts.part import Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.layout import Layout
from jumpcad.transforms import in_metres
from jumpcad.workshop import Workshop

CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))
"""Which bound a corner of a box has along each axis."""


def bodies_of(layout: Layout, parts: Iterable[Part], hardware: Iterable[BoughtPart]) -> dict[str, Body]:
    """Return the four rigid bodies by name (kg, m, in their frames) with everything that they carry."""
    carried: dict[str, list[MassProperties]] = defaultdict(list)
    for part in parts:
        for placement in part.placements:
            carried[placement.body].append(part.mass.placed(in_metres(placement.T_body_part)))
    for item in hardware:
        carried[item.body].append(item.mass)
    contacts = _contacts(layout)
    bodies = {}
    for name in BODY_NAMES:
        mass = combined(carried[name])
        bodies[name] = Body(name, mass.mass_kg, mass.com_m, mass.inertia_kg_m2, contacts.get(name, ()))
    return bodies


def outlines_m(parts: Iterable[Part], hardware: Iterable[BoughtPart]) -> dict[str, Complex]:
    """Return the corners x + iz (k,) of the convex outline of what each body carries.

    By the parts' bounding boxes; rods of the cage, which are wide and round, by their line.
    """
    from scipy.spatial import ConvexHull

    hardware = list(hardware)
    rods = {item.name: item.wire for item in hardware if item.wire is not None and item.name.startswith(CAGE)}
    placed = [(one.drawing.shape.bounds_mm, place.body, place.T_body_part) for one in parts for place in one.placements]
    boxed = [(item.shape.bounds_mm, item.body, item.T_body_part) for item in hardware if item.name not in rods]
    bounds, of_body, poses = (np.array(column) for column in zip(*placed, *boxed, strict=True))
    boxes = bounds[:, CORNERS, [0, 1, 2]] @ poses[:, :3, :3].transpose(0, 2, 1) + poses[:, None, :3, 3]
    joined = {
        body: boxes[of_body == body][..., [0, 2]].reshape(-1, 2) / 1000.0 for body in dict.fromkeys(of_body.tolist())
    }
    lines = [rod.points_mm[:, [0, 2]] / 1000.0 for rod in rods.values()]
    joined[BODY] = np.concatenate([joined[BODY], *lines])
    return {body: points(found[ConvexHull(found).vertices]) for body, found in joined.items()}


def _contacts(layout: Layout) -> dict[str, tuple[ContactSphere, ...]]:
    """Return the spheres that may touch the ground: the pads of the foot's nose and toe tips, the plates' corners."""
    sections = layout.sections
    tip_radius = sections.toe_tip_height_mm / 2.0
    tip_x, tip_y = float(toe_tip_mm(layout.design)[0]), layout.toe_half_width_mm
    tip_z = tip_radius - sections.foot_depth_mm

    def sphere(name: str, x: float, y: float, z: float, radius: float, surface: Surface) -> ContactSphere:
        return ContactSphere(name, np.array([x, y, z]) / 1000.0, radius / 1000.0, surface)

    pad = layout.axle_mm / 2.0 + PAD_WALL_MM
    return {
        FOOT: (
            sphere("front_eye", layout.design.l4_mm, 0.0, 0.0, sections.ground_mm, "foot"),
            sphere("left_toe", tip_x, tip_y, tip_z, tip_radius + sections.pad_mm, "foot"),
            sphere("right_toe", tip_x, -tip_y, tip_z, tip_radius + sections.pad_mm, "foot"),
        ),
        BODY: (
            sphere("back", layout.hub_mm[0], 0.0, layout.hub_mm[1], pad, "body"),
            sphere("front", layout.front_mm[0], 0.0, layout.front_mm[1], pad, "body"),
        ),
    }


def friction_of(layout: Layout, workshop: Workshop) -> Friction:
    """Return the friction of feet and body on the workshop's ground, and of pins with its axles' diameter."""
    ground, radius_m = workshop.ground, layout.axle_mm / 2000.0
    hub_m = 0.0 if layout.hub_bearing else radius_m
    pins = (hub_m, radius_m, radius_m, radius_m)
    return Friction(ground.foot_friction, ground.bare_friction, workshop.pins.friction, pins)
