"""The release of a robot from its finished parts: inertias about the drive's axes, the lever's stiffness."""

from collections.abc import Mapping

import numpy as np

from jumpcad.dimensions import LEVER_EYE_RADIUS_MM
from jumpcad.drive.release import MovingParts, Release, release
from jumpcad.mechanism.model import Body, Spring
from jumpcad.mechanism.planar import reflected_mass
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.layout import Layout
from jumpcad.strength.stress import STATIONS, Beam, Shell, tip_stiffness_n_per_mm
from jumpcad.transforms import Array, in_metres
from jumpcad.workshop import Workshop

LEVER_SHARE = 33.0 / 140.0
"""Of a cantilever's mass that moves with its end (Rayleigh)."""


def release_of(
    layout: Layout,
    workshop: Workshop,
    parts: tuple[Part, ...],
    hardware: tuple[BoughtPart, ...],
    bodies: Mapping[str, Body],
    spring: Spring,
) -> Release:
    """Return the release of a robot with all its masses."""
    by_name = {part.name: part for part in parts}
    lever, length = _lever(layout, workshop), layout.drive.cam.lever_length_mm
    mass = 1e-6 * float(np.mean(lever.area_mm2)) * length * workshop.material("links").density_g_cm3
    moving = MovingParts(
        spring=spring,
        leg=reflected_mass(bodies, layout.linkage),
        cam_kg_m2=_about_axle(by_name["cam"], layout.cam_axis_mm),
        cam_gear_kg_m2=_about_axle(by_name["cam_gear"], layout.cam_axis_mm),
        pinion_kg_m2=_about_axle(by_name["motor_pinion"], layout.motor_mm),
        bore_mm=HoleSizes.of(workshop, layout.hub_bearing).running(layout.axle_mm),
        lever_n_per_m=1000.0 * tip_stiffness_n_per_mm(lever, length, workshop.material("links").modulus_mpa),
        roller_kg=sum(item.mass.mass_kg for item in hardware if item.name.startswith("roller")) + LEVER_SHARE * mass,
    )
    return release(layout.drive, moving, workshop)


def _about_axle(part: Part, axis_mm: Array) -> float:
    """Return a part's moment of inertia about an axle along y (kg·m²)."""
    mass = part.mass.placed(in_metres(part.placements[0].T_body_part))
    away = mass.com_m[[0, 2]] - axis_mm / 1000.0
    return float(mass.inertia_kg_m2[1, 1] + mass.mass_kg * np.sum(away**2))


def _lever(layout: Layout, workshop: Workshop) -> Beam:
    """Return the printed lever from the leg's hub to the roller."""
    sections = layout.sections
    heights = np.linspace(sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM, STATIONS)
    return Beam(sections.thickness_mm, heights, Shell.of(workshop.process))
