"""Masses and centres of mass of a printed robot before it is laid out: an estimate in closed form.

Bought parts weigh what the catalogue says; printed ones follow from lengths, plates, material and infill, by
coefficients fitted to built robots. `benchmarks/refuse.py` fits them, and measures the error over all that `DESIGNS`,
`RANGES`, `MATERIALS` and `CARRIED_G` allow; what is outside is not `known`.
"""

import math
from collections.abc import Mapping
from functools import cache

import numpy as np

from jumpcad.catalogue.articles import STEEL_G_CM3
from jumpcad.design import Design
from jumpcad.drive.stock_spring import springs_on_leg
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Body, Mechanism, five_bar
from jumpcad.printing.layer_mass import line_spacing_mm
from jumpcad.workshop import DEFAULT, Process, Workshop, load_workshop

DESIGNS = {
    "carrying_link_mm": (80.0, 260.0),
    "c_coef": (0.7, 1.35),
    "d_coef": (0.4, 1.1),
    "e_coef": (0.5, 1.6),
    "compression_ratio": (0.05, 0.9),
    "rest_angle_deg": (15.0, 75.0),
    "stiffness_nmm_per_deg": (3.0, 45.0),
    "ground_link_angle_deg": (5.0, 85.0),
}
"""Designs of which masses are known; the default bounds of a search are about half as wide."""
RANGES = {
    ("process", "infill"): (0.0, 1.0),
    ("process", "perimeters"): (1.0, 6.0),
    ("process", "top_layers"): (0.0, 10.0),
    ("process", "bottom_layers"): (0.0, 10.0),
    ("process", "solid_below_area_mm2"): (0.0, 100.0),
    ("fits", "press_mm"): (-0.1, 0.3),
    ("fits", "lying_mm"): (-0.1, 0.3),
    ("fits", "hole_allowance_diameter_mm"): (-0.2, 0.5),
    ("body", "plate_mm"): (1.0, 5.0),
    ("body", "stop_deg"): (3.0, 8.0),
    ("body", "toe_half_width_mm"): (0.0, 50.0),
    ("spring", "preload_deg"): (0.0, 15.0),
    ("bought", "axle_mm"): (2.0, 4.0),
}
"""Least and greatest values in a workshop, by table and key; other numbers of `TABLES`: half, twice the default's."""
TABLES = ("process", "fits", "body", "seats", "safety", "spring")
MATERIALS = {"density_g_cm3": (0.9, 1.5), "strength_in_plane_mpa": (25.0, 100.0), "modulus_mpa": (1000.0, 8000.0)}
CARRIED_G = {"battery": (3.0, 30.0), "boards": (3.0, 7.0), "motors": (8.0, 12.0)}
"""Masses of batteries, of all boards together, and of each motor, which may be the user's own."""
WALL_MM = {BODY: (6.0, 2.4), MAIN_LEG: (8.0, 6.0), FRONT_LINK: (8.0, 6.0), FOOT: (6.0, 4.0)}
"""Width and height of a usual section of a body's parts, which decide how much of it is infill; judgement."""

MASS = {
    BODY: (46.7, 0.774, 0.0684, 0.0505),
    MAIN_LEG: (5.18, 3.47, 0.0437, 0.0553),
    FRONT_LINK: (0.504, 0.72, 0.0399),
    FOOT: (-0.226, 0.0483, 0.0654, 0.0474, 0.074),
}
"""Coefficients of `mass_features`, in their order."""
BODY_X, BODY_Z_MM, LEG_SHARE, FOOT_X = (-4.3, 70.4, -0.0872), 16.8, 0.249, (8.12, 0.221, 0.275)
"""Centres of mass: of the body, as `body_x_features`; of the main leg, over its length; of the foot, of ankle, nose and
toes."""


def known(design: Design, workshop: Workshop) -> bool:
    """Tell whether a design in a workshop is among those whose masses the estimate was compared with."""
    if workshop.mass.weighed_g or workshop.bearings or workshop.springs or workshop.pads:
        return False
    carried, materials = chosen_parts(workshop), [workshop.material(role) for role in ("links", "body", "gears")]
    numbers = [
        *((getattr(design, name), limits) for name, limits in DESIGNS.items()),
        *((getattr(getattr(workshop, table), key), limits) for (table, key), limits in ranges().items()),
        *((getattr(material, name), limits) for material in materials for name, limits in MATERIALS.items()),
        (carried.battery.mass_g, CARRIED_G["battery"]),
        (sum(board.mass_g for board in carried.boards.values()), CARRIED_G["boards"]),
        *((mass, CARRIED_G["motors"]) for mass in _motors_g(workshop)),
    ]
    return all(low <= value <= high for value, (low, high) in numbers)


@cache
def ranges() -> Mapping[tuple[str, str], tuple[float, float]]:
    """Return least and greatest value of every number of a workshop that bears on masses, by table and key."""
    default = load_workshop(DEFAULT)
    found = {
        (table, key): (0.5 * value, 2.0 * value)
        for table in TABLES
        for key, value in getattr(default, table)
        if isinstance(value, float | int)
    }
    return found | RANGES


def robot_of_masses(design: Design, workshop: Workshop) -> Mechanism:
    """Return the robot of a design with estimated masses: springs, lengths and angles are exact.

    Its bodies have no inertia and touch no ground; it serves statics alone.
    """
    known_g, features = known_masses(design, workshop), mass_features(design, workshop)
    masses = {name: known_g[name] + float(np.dot(MASS[name], features[name])) for name in MASS}
    places = {
        BODY: (float(np.dot(BODY_X, body_x_features(design, workshop, masses[BODY]))), BODY_Z_MM),
        MAIN_LEG: (LEG_SHARE * design.l2_mm, 0.0),
        FRONT_LINK: (0.5 * design.l3_mm, 0.0),
        FOOT: (float(np.dot(FOOT_X, foot_x_features(design))), 0.0),
    }
    bodies = {
        name: Body(name, mass / 1000.0, np.array([places[name][0], 0.0, places[name][1]]) / 1000.0, np.zeros((3, 3)))
        for name, mass in masses.items()
    }
    joints, loop, _ = five_bar(Linkage(design), (-design.compression_rad, 0.0))
    spring = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    return Mechanism("estimate", design, bodies, joints, loop, spring, foot_depth_m=0.0)


def known_masses(design: Design, workshop: Workshop) -> dict[str, float]:
    """Return what of each body is bought and weighs the same in every layout (g); of several motors, the lightest."""
    carried, spring, bar = chosen_parts(workshop), workshop.stock_spring, workshop.leg_bar
    body = carried.battery.mass_g + sum(board.mass_g for board in carried.boards.values()) + min(_motors_g(workshop))
    body += sum(part.mass_g for role, part in carried.components.items() if role != "wire")
    if spring is not None:
        coil = math.pi * (spring.inside_diameter_mm + spring.wire_mm) * spring.turns
        body += 2.0 * STEEL_G_CM3 / 1000.0 * math.pi / 4.0 * spring.wire_mm**2 * coil
    per_mm = 0.0 if bar is None else 1e-3 * bar.density_g_cm3 * bar.area_mm2
    return {BODY: body, MAIN_LEG: per_mm * design.l2_mm, FRONT_LINK: per_mm * design.l3_mm, FOOT: 0.0}


def mass_features(design: Design, workshop: Workshop) -> dict[str, tuple[float, ...]]:
    """Return what the other masses of each body are proportional to."""
    plates = workshop.body.plate_mm * _density(BODY, workshop)
    spring = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    strong = math.sqrt(spring.peak_torque_nm)  # heights of sections in bending go with the root of the moment
    links, whole = _density(MAIN_LEG, workshop), float(workshop.leg_bar is None)
    foot, half = _density(FOOT, workshop), design.l5_mm * math.sin(math.radians(design.ground_link_angle_deg))
    bars = max(0.0, workshop.body.toe_half_width_mm - half)
    return {
        BODY: (1.0, plates, plates * design.l1_mm, axle_measure(workshop)),
        MAIN_LEG: (1.0, links * (1.0 - whole), links * whole * design.l2_mm, links * whole * design.l2_mm * strong),
        FRONT_LINK: (links, links * (1.0 - whole), links * whole * design.l3_mm),
        FOOT: (1.0, foot * design.l4_mm, foot * design.l5_mm, foot * design.l5_mm * strong, foot * bars),
    }


def body_x_features(design: Design, workshop: Workshop, body_g: float) -> tuple[float, float, float]:
    """Return what the body's centre of mass depends on, along the line of its pivots: where the battery is."""
    share = chosen_parts(workshop).battery.mass_g / body_g
    return 1.0 - share, share, share * design.l1_mm


def foot_x_features(design: Design) -> tuple[float, float, float]:
    """Return what the foot's centre of mass depends on: ankle, nose and the toes' tips."""
    return 1.0, design.l4_mm, float(toe_tip_mm(design)[0])


def axle_measure(workshop: Workshop) -> float:
    """Return what the mass of the axles is proportional to: density times the square of the diameter."""
    rod = workshop.catalogue.rods[workshop.bought.axle]
    return rod.density_g_cm3 * (1.0 - rod.bore_share**2) * workshop.bought.axle_mm**2


def _motors_g(workshop: Workshop) -> list[float]:
    motors = workshop.catalogue.motors
    return [motors[name].mass_g for name in workshop.bought.motors or motors]


def _density(body: str, workshop: Workshop) -> float:
    """Return the mean density of a usual section: walls and outer layers solid, the rest infill (g/cm³)."""
    process, density = workshop.process, workshop.material("body" if body == BODY else "links").density_g_cm3
    if workshop.mass.model == "solid":
        return density
    return density * solid_share(process, *WALL_MM[body])


def solid_share(process: Process, width_mm: float, height_mm: float) -> float:
    """Return the mean density of a bar over that of its material: walls at its width's ends, layers at its height's."""
    walls = 2.0 * process.perimeters * line_spacing_mm(process.line_width_mm, process.layer_height_mm) / width_mm
    layers = (process.top_layers + process.bottom_layers) * process.layer_height_mm / height_mm
    return 1.0 - (1.0 - process.infill) * max(0.0, 1.0 - walls) * max(0.0, 1.0 - layers)
