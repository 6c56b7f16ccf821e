"""From drawings and bought parts to weighed parts, rigid bodies that touch the ground, and the release of the cam."""

import itertools
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from jumpcad.collision.hulls import CAGE
from jumpcad.dimensions import LEVER_EYE_RADIUS_MM, PAD_WALL_MM
from jumpcad.drive.release import MovingParts, Release, release
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.mechanism.linkage import Complex, toe_tip_mm
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, ContactSphere, Friction, Spring, Surface
from jumpcad.mechanism.planar import points, reflected_mass
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.robot.layout import Layout
from jumpcad.strength.stress import STATIONS, Beam, Shell, tip_stiffness_n_per_mm
from jumpcad.transforms import Array, in_metres
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
    return {name: Body.of(name, combined(carried[name]), contacts.get(name, ())) for name in BODY_NAMES}


def outlines_m(parts: Iterable[Part], hardware: Iterable[BoughtPart]) -> dict[str, Complex]:
    """Return the corners x + iz (k,) of the convex outline of what each body carries.

    By the parts' bounding boxes; rods of the cage, which are wide and round, by their line.
    """
    from scipy.spatial import ConvexHull

    hardware = list(hardware)
    rods = {item.name: item.wire for item in hardware if item.wire is not None and item.name.startswith(CAGE)}
    placed = [(one.shape.bounds_mm, place.body, place.T_body_part) for one in parts for place in one.placements]
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
            sphere("front_eye", layout.eye_x_mm, 0.0, 0.0, sections.ground_mm, "foot"),
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


WEIGHED_OFF = 20.0
"""By how much a printed part may be heavier or lighter than as drawn; judgement: kilograms are 1000 times off."""
NOT_IN_EVERY_ROBOT = (
    "idler", "cam_spacer_left", "idler_spacer_right", "toe_left", "toe_right", "main_leg_end", "sensor_mount",
)  # fmt: skip
"""Parts that only some designs have: a workshop with their weights serves the other designs too."""


def weighed_part(drawing: Drawing, workshop: Workshop) -> Part:
    """Return a drawing with its material and the mass of one copy."""
    material, material_name = workshop.material(drawing.role), workshop.material_name(drawing.role)
    model, nozzle = workshop.mass.model, workshop.printer.nozzle_mm
    mass = mass_properties(drawing.shape, material.density_g_cm3, workshop.process, nozzle, model)
    drawn = drawing.name, drawing.role, drawing.shape, drawing.placements, material_name
    weighed, grams = workshop.mass.weighed_g.get(drawing.name), 1000.0 * mass.mass_kg
    if weighed is None:
        return Part(*drawn, mass, model)
    if not grams / WEIGHED_OFF <= weighed <= grams * WEIGHED_OFF:
        raise JumpcadError(
            f"mass.weighed_g.{drawing.name} = {weighed:g}: as drawn it weighs about {grams:.2g} g: is it in grams?"
        )
    return Part(*drawn, mass.scaled_to(weighed / 1000.0), "weighed")


def require_parts(weighed: Iterable[str], names: Sequence[str]) -> None:
    """Reject weights of parts that neither this robot, whose parts have these names, nor any other has."""
    known = (*names, *NOT_IN_EVERY_ROBOT)
    for name in weighed:
        if name not in known:
            raise JumpcadError(
                f"mass.weighed_g.{name}: no such part{did_you_mean(name, known)}; the robot has {', '.join(names)}"
            )


LEVER_SHARE = 33.0 / 140.0
"""Of a cantilever's mass that moves with its end (Rayleigh)."""


def release_of(
    layout: Layout, workshop: Workshop, parts: tuple[Part, ...], hardware: tuple[BoughtPart, ...],
    bodies: Mapping[str, Body], spring: Spring,
) -> Release:  # fmt: skip
    """Return the release of a robot with all its masses."""
    by_name, length, sections = {part.name: part for part in parts}, layout.drive.cam.geometry.lever_mm, layout.sections
    heights = np.linspace(sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM, STATIONS)
    lever = Beam(sections.thickness_mm, heights, Shell.of(workshop.process))
    mass = 1e-6 * float(np.mean(lever.area_mm2)) * length * workshop.material("links").density_g_cm3
    moving = MovingParts(
        spring=spring, leg=reflected_mass(bodies, layout.linkage),
        cam_kg_m2=_about_axle(by_name["cam"], layout.cam_axis_mm),
        cam_gear_kg_m2=_about_axle(by_name["cam_gear"], layout.cam_axis_mm),
        pinion_kg_m2=_about_axle(by_name["motor_pinion"], layout.motor_mm),
        bore_mm=HoleSizes.of(workshop, layout.hub_bearing).running(layout.axle_mm),
        lever_n_per_m=1000.0 * tip_stiffness_n_per_mm(lever, length, workshop.material("links").modulus_mpa),
        roller_kg=sum(item.mass.mass_kg for item in hardware if item.name.startswith("roller")) + LEVER_SHARE * mass,
    )  # fmt: skip
    return release(layout.drive, moving, workshop)


def _about_axle(part: Part, axis_mm: Array) -> float:
    """Return a part's moment of inertia about an axle along y (kg·m²)."""
    mass = part.mass.placed(in_metres(part.placements[0].T_body_part))
    away = mass.com_m[[0, 2]] - axis_mm / 1000.0
    return float(mass.inertia_kg_m2[1, 1] + mass.mass_kg * np.sum(away**2))
