"""A robot whose links are sized but not laid out: masses, inertias, and what touches the ground.

Nearer than `quick_mass`, for designs within a search's default bounds in workshops near the shipped ones. Sections are
those of the built robot before any of them grows; the rest follows by coefficients that `benchmarks/refuse.py --fit`
finds. It takes a millisecond.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Self

import numpy as np

from jumpcad.catalogue import Bearing
from jumpcad.design import SEARCH_BOUNDS, Design
from jumpcad.dimensions import PAD_WALL_MM, STOP_PAD_MM, TOE_TIP_WIDTH_MM
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files import TomlTable, template_names
from jumpcad.layout.stop import WANTED_MM
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.model import (
    BODY,
    FOOT,
    FRONT_LINK,
    MAIN_LEG,
    Body,
    ContactSphere,
    Friction,
    Mechanism,
    Spring,
    Stop,
    Surface,
)
from jumpcad.parts.foot import in_one_piece
from jumpcad.search.estimate.quick_mass import axle_measure, known_masses, quick_robot, solid_share
from jumpcad.strength.bearings import allowed_n, hub_bearings, hub_width_mm
from jumpcad.strength.sizing import Sections, sections
from jumpcad.workshop import Workshop, load_workshop
from jumpcad.workshop.workshop import Role

NUMBERS = {("body", "plate_mm"): (1.6, 3.2), ("process", "infill"): (0.1, 0.6)}
"""Least and greatest values of the numbers in which a near workshop may differ from a shipped one."""
CHOICES = {
    "roles": ("links", "body", "gears"),
    "bought": ("kit", "motors", "battery", "regulator", "diode", "retention", "leg_bearing"),
}
"""What may be chosen otherwise there, but for parts of the user's own."""
ARM_MM = 3.93
"""Springs' torque over the load of a hub's bearing; of 3,100 robots, it tells the bearing of 99 %."""
PLATE_MM = 60.0
"""Usual width of the body's plates, which decides how much of them is walls; judgement."""

MASS = {
    BODY: (5.1, 0.0722, 0.04, -2.73, 0.776),
    MAIN_LEG: (2.99, 1.05, 0.852, 0.358),
    FRONT_LINK: (0.0618, 1.04),
    FOOT: (2.5, 2.17, 2.4, 0.0276, 6.54, 0.0523),
}
"""Coefficients of masses, in the order of `SizedLinks.mass_features`; likewise those below."""
PLACE = {
    BODY: (0.989, 16.4, 1.17, -0.0927, -0.221, -0.0039),
    MAIN_LEG: (-5.02, 0.0824, 0.4),
    FRONT_LINK: (0.5,),
    FOOT: (1.25, 1.035, 0.0352, 143.0, 1.73),
}
HEIGHT = {BODY: (12.0, 0.008, -0.0462, 48.7), MAIN_LEG: (-0.57,), FRONT_LINK: (0.0,), FOOT: (1.3, -0.654)}
INERTIA = {BODY: (278.0, 0.204), MAIN_LEG: (0.112,), FRONT_LINK: (0.0972,), FOOT: (1.33, 0.636, 484.0)}

Features = Mapping[str, tuple[float, ...]]


def near(design: Design, workshop: Workshop) -> bool:
    """Tell whether a design in a workshop is of the kind whose errors are known to be small."""
    if not all(bound.lower <= getattr(design, name) <= bound.upper for name, bound in SEARCH_BOUNDS.items()):
        return False
    materials = [one for template in _shipped() for one in template.materials.values()]
    if not all(one in materials for one in workshop.materials.values()):
        return False
    return any(_like(workshop, template) for template in _shipped())


def _like(workshop: Workshop, template: Workshop) -> bool:
    """Tell whether a workshop differs from a template in `NUMBERS` and `CHOICES` alone, apart from its materials."""
    for table in type(template).model_fields:
        mine, other = getattr(workshop, table), getattr(template, table)
        if mine == other or table == "materials":
            continue
        if not isinstance(mine, TomlTable) or not all(
            value == getattr(other, key) or _may_be(table, key, value) for key, value in mine
        ):
            return False
    return True


def _may_be(table: str, key: str, value: Any) -> bool:
    if (table, key) in NUMBERS:
        low, high = NUMBERS[table, key]
        return bool(low <= value <= high)
    return key in CHOICES.get(table, ())


@cache
def _shipped() -> tuple[Workshop, ...]:
    return tuple(load_workshop(name) for name in template_names("workshops"))


def sized_robot(design: Design, workshop: Workshop) -> Mechanism:
    """Return the robot of a design with sized links; its springs are released at once, with all of their energy."""
    links = SizedLinks.of(design, workshop)
    mass = {name: known + float(np.dot(MASS[name], links.mass_features[name])) for name, known in links.known_g.items()}
    x, z = (_sums(table, found) for table, found in ((PLACE, links.places(mass)), (HEIGHT, links.heights(mass))))
    inertia, touching = _sums(INERTIA, links.inertias(mass)), links.contacts()
    bodies = {
        name: Body(
            name,
            mass[name] / 1000.0,
            np.array([x[name], 0.0, z[name]]) / 1000.0,
            1e-9 * inertia[name] * np.eye(3),
            touching.get(name, ()),
        )
        for name in mass
    }
    radius_m, ground, sized = workshop.bought.axle_mm / 2000.0, workshop.ground, links.sections
    pins = (radius_m if links.bearing_g == 0.0 else 0.0, radius_m, radius_m, radius_m)
    pad_n_per_mm = workshop.stop_pad.rate_n_per_mm(sized.thickness_mm, STOP_PAD_MM)
    return replace(
        links.plain,
        bodies=bodies,
        foot_depth_m=sized.ground_mm / 1000.0,
        friction=Friction(ground.foot_friction, ground.bare_friction, workshop.pins.friction, pins),
        stop=Stop("leg", math.radians(workshop.body.stop_deg), pad_n_per_mm * WANTED_MM**2 / 1000.0),
    )


def _sums(coefficients: Features, found: Features) -> dict[str, float]:
    return {name: float(np.dot(coefficients[name], values)) for name, values in found.items()}


@dataclass(frozen=True)
class SizedLinks:
    """A design's links with their sections, and what of them and of the body weighs how much.

    Attributes
    ----------
    plain
        The robot of `quick_mass`, for lengths, joints and springs.
    bearing_g
        Of one of the hub's bearings; 0 without.
    known_g
        What is bought, by body.
    leg_g_mm, front_g_mm, toe_g_mm, rail_g_mm
        Printed mass over length of a mean section.
    apart
        1 where the toes are parts of their own, else 0.
    """

    workshop: Workshop
    plain: Mechanism
    sections: Sections
    bearing_g: float
    known_g: Mapping[str, float]
    leg_g_mm: float
    front_g_mm: float
    toe_g_mm: float
    rail_g_mm: float
    apart: float

    @classmethod
    def of(cls, design: Design, workshop: Workshop) -> Self:
        """Size the links of a design, with the hub's usual bearing."""
        plain = quick_robot(design, workshop)
        bearing = usual_bearing(workshop, plain.spring)
        sized = sections(plain.linkage, workshop, hub_width_mm(bearing))

        def lying(height_mm: float) -> float:
            return printed_g_mm(workshop, "links", height_mm, sized.thickness_mm)

        toe, rail = sized.toe_root_mm + sized.toe_tip_height_mm, sized.rail_root_mm + sized.rail_tip_mm
        whole = in_one_piece(design, sized, workshop.printer.bed_mm, workshop.body.toe_half_width_mm)
        return cls(
            workshop,
            plain,
            sized,
            bearing.mass_g if bearing else 0.0,
            known_masses(design, workshop),
            lying((sized.leg_root_mm + sized.leg_tip_mm) / 2.0),
            lying(sized.front_mm),
            printed_g_mm(workshop, "links", (sized.toe_width_mm + TOE_TIP_WIDTH_MM) / 2.0, toe / 2.0),
            printed_g_mm(workshop, "links", sized.lug_thickness_mm, rail / 2.0),
            0.0 if whole else 1.0,
        )

    @property
    def mass_features(self) -> Features:
        """What the masses besides the bought parts are proportional to (g)."""
        design, sized, energy, torque = self.plain.design, self.sections, *self._springs()
        density = self.workshop.material("links").density_g_cm3
        plate = printed_g_mm(self.workshop, "body", PLATE_MM, self.workshop.body.plate_mm) / PLATE_MM
        return {
            BODY: (1000.0 * plate, 1000.0 * plate * design.l1_mm, energy, torque, axle_measure(self.workshop)),
            MAIN_LEG: (
                1.0, self.leg_g_mm * design.l2_mm, 2.0 * self.bearing_g, density * sized.thickness_mm,
            ),
            FRONT_LINK: (density * sized.thickness_mm, self.front_g_mm * design.l3_mm),
            FOOT: (1.0, *self._foot_g(), self.apart, density * sized.foot_depth_mm**2),
        }  # fmt: skip

    def places(self, mass_g: Mapping[str, float]) -> Features:
        """Return what the centres of mass are proportional to, along the bodies' x axes (mm)."""
        design, energy, torque = self.plain.design, *self._springs()
        share, tip = self._battery(mass_g), float(toe_tip_mm(design)[0])
        toes, rails, bars = self._foot_g()
        moments = (rails * design.l4_mm, toes * tip, bars * tip, self.apart * tip / design.l5_mm, design.l4_mm)
        return {
            BODY: (1.0, share, share * design.l1_mm, design.l1_mm, torque, energy),
            MAIN_LEG: (1.0, design.l2_mm, self.leg_g_mm * design.l2_mm**2 / mass_g[MAIN_LEG]),
            FRONT_LINK: (design.l3_mm,),
            FOOT: tuple(moment / mass_g[FOOT] for moment in moments),
        }

    def heights(self, mass_g: Mapping[str, float]) -> Features:
        """Return what the centres of mass are proportional to, along the bodies' z axes (mm)."""
        _, torque = self._springs()
        body = (1.0, self.plain.design.l1_mm, torque, self._battery(mass_g))
        return {BODY: body, MAIN_LEG: (1.0,), FRONT_LINK: (1.0,), FOOT: (1.0, self.sections.foot_depth_mm)}

    def inertias(self, mass_g: Mapping[str, float]) -> Features:
        """Return what the inertias about the centres of mass are proportional to (g·mm²)."""
        design, tip = self.plain.design, float(toe_tip_mm(self.plain.design)[0])
        toes, rails, _ = self._foot_g()
        return {
            BODY: (mass_g[BODY], mass_g[BODY] * design.l1_mm**2),
            MAIN_LEG: (mass_g[MAIN_LEG] * design.l2_mm**2,),
            FRONT_LINK: (mass_g[FRONT_LINK] * design.l3_mm**2,),
            FOOT: (rails * design.l4_mm**2, toes * tip**2, mass_g[FOOT]),
        }

    def contacts(self) -> dict[str, tuple[ContactSphere, ...]]:
        """Return what of foot and body may touch the ground, both sides in one plane."""
        design, sized = self.plain.design, self.sections
        toe, pad = sized.toe_tip_height_mm / 2.0, self.workshop.bought.axle_mm / 2.0 + PAD_WALL_MM

        def sphere(name: str, x: float, z: float, radius: float, surface: Surface) -> ContactSphere:
            return ContactSphere(name, np.array([x, 0.0, z]) / 1000.0, radius / 1000.0, surface)

        tip = (float(toe_tip_mm(design)[0]), toe - sized.foot_depth_mm)
        return {
            FOOT: (
                sphere("front_eye", design.l4_mm, 0.0, sized.ground_mm, "foot"),
                sphere("toe", *tip, toe + sized.pad_mm, "foot"),
            ),
            BODY: (
                sphere("back", -design.l1_mm / 2.0, 0.0, pad, "body"),
                sphere("front", design.l1_mm / 2.0, 0.0, pad, "body"),
            ),
        }

    def _springs(self) -> tuple[float, float]:
        """Return the energy in the loaded springs (mJ), their preload's included, and their torque's root³ (N·mm)."""
        spring = self.plain.spring
        torque = spring.peak_torque_nm
        return 500.0 * torque**2 / spring.stiffness_nm_per_rad, (1000.0 * torque) ** (1.0 / 3.0)

    def _foot_g(self) -> tuple[float, float, float]:
        """Return about what toes, rails and the bars across the toes' tips weigh."""
        design, workshop = self.plain.design, self.workshop
        bars = max(0.0, workshop.body.toe_half_width_mm - float(toe_tip_mm(design)[1]))
        density = workshop.material("links").density_g_cm3
        return self.toe_g_mm * design.l5_mm, self.rail_g_mm * design.l4_mm, density * bars

    def _battery(self, mass_g: Mapping[str, float]) -> float:
        return chosen_parts(self.workshop).battery.mass_g / mass_g[BODY]


def usual_bearing(workshop: Workshop, spring: Spring) -> Bearing | None:
    """Return the hub's bearing: the lightest, or the next if that is too weak; a third is hardly ever needed."""
    lightest, *others = hub_bearings(workshop)
    if lightest is None or not others or 1000.0 * spring.peak_torque_nm <= ARM_MM * allowed_n(lightest, workshop):
        return lightest
    return others[0]


def printed_g_mm(workshop: Workshop, role: Role, between_walls_mm: float, between_layers_mm: float) -> float:
    """Return the mass over length of a printed bar (g/mm)."""
    share = solid_share(workshop.process, between_walls_mm, between_layers_mm)
    return 1e-3 * workshop.material(role).density_g_cm3 * share * between_walls_mm * between_layers_mm
