"""Feasibility without solids or simulation: findings with signed margins.

A design is tested in two steps: first its geometry alone, then the statics of the mechanism's masses. The verdict is
the first test that fails, in this order; of a printed robot springs that are too weak come before tipping over.
"""

import math

import numpy as np

from jumpcad.design import Design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.findings import Basis, Finding, at_least, higher, lower, nearer_to_1
from jumpcad.mechanism.linkage import Linkage, Pose, linkage_of, toe_tip_mm
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Mechanism
from jumpcad.mechanism.planar import points
from jumpcad.transforms import Array

TAKEOFF_ENERGY_FACTOR = 1.3
"""Least spring energy over the work against gravity in the push-off; measured: no wrong rejection in 399 designs."""
BASIS = {
    "loop": Basis(
        "min(d1 - |l3 - l4|, l3 + l4 - d2) > 0 (mm), d1 and d2 least and largest distance of ankle and front pivot "
        "over the travel; before that l4 - max(|l3 - l2|·sin(rest_angle_deg), l3 - l2) > 0, a pose with parallel legs",
        "triangle inequality for the four-bar loop",
    ),
    "winding": Basis(
        "rest_angle_deg + β > 0 (°), β tilt of the body at rest, sin β = (l3 - l2)·sin(rest_angle_deg)/l4", "geometry"
    ),
    "below_ground": Basis(
        "least height of both body pivots above the line through ankle and front eye, springs loaded ≥ 0 (mm)",
        "geometry of the four-bar loop",
    ),
    "tips": Basis(
        "min(x - x_back, x_front - x) ≥ 0 (mm); x centre of mass, springs loaded, x_back and x_front least and "
        "largest of ankle, toes' tips and front eye, along the foot",
        "statics: the weight acts within the support",
    ),
    "too_weak": Basis(
        f"U ≥ {TAKEOFF_ENERGY_FACTOR:g}·m·g·h (J, shown in mJ); U = K·((δ + p)² - p²)/2 springs' energy, h rise of the "
        "centre of mass from loaded springs to rest",
        f"energy; {TAKEOFF_ENERGY_FACTOR:g}: measurement, simulated jumps of 399 designs",
    ),
}


def feasibility_findings(mechanism: Mechanism) -> list[Finding]:
    """Return the findings of both steps for a mechanism whose masses are known."""
    return [*geometry_findings(mechanism.design), *statics_findings(mechanism)]


def geometry_findings(design: Design) -> list[Finding]:
    """Return the findings `loop` and `below_ground` of a design; the second only where the first holds.

    A design whose springs cannot be loaded at all has the finding `winding` instead.
    """
    assembly = design.assembly_margin_mm
    if assembly <= 0:
        return [_loop_finding(assembly, "there is no pose with parallel legs and a flat foot")]
    if design.compression_rad <= 0:
        to_flat = design.rest_angle_deg + math.degrees(design.beta_rad)  # beta: the body's nose-down tilt at rest
        return [Finding(
            "winding", "error", to_flat, "°",
            f"the springs cannot be loaded: the body tilts by {math.degrees(design.beta_rad):.1f}° at rest, which "
            f"leaves {to_flat:.1f}° of rest_angle_deg = {design.rest_angle_deg:g} to a flat leg; more than 0° are "
            "needed", nearer_to_1("c_coef") + higher("d_coef"), to_flat, 0.0,
        )]  # fmt: skip
    linkage = linkage_of(design)
    margin = linkage.closing_margin_mm()
    loop = _loop_finding(margin, "foot and front link must reach each other over the whole travel")
    if margin <= 0:
        return [loop]
    height = float(linkage.height_of_body_mm(-design.compression_rad).min())
    below = at_least(
        "below_ground", height, 0.0, "mm",
        f"lowest body pivot with loaded springs is {height:.1f} mm above the line through ankle and front eye, of 0 "
        "mm at least",
        lower("compression_ratio") + higher("rest_angle_deg"),
    )  # fmt: skip
    return [loop, below]


def statics_findings(mechanism: Mechanism, gravity_m_s2: float = GRAVITY_M_S2) -> list[Finding]:
    """Return the findings `tips` and `too_weak` of a robot whose geometry passes."""
    linkage = mechanism.linkage
    pose = linkage.pose([-mechanism.spring.wind_rad, 0.0])
    com = centre_of_mass_on_foot_mm(mechanism, linkage, pose)
    back, front = support_span_mm(mechanism.design)
    x = float(com[0, 0])
    stability = min(x - back, front - x)
    tips = at_least(
        "tips", stability, 0.0, "mm",
        f"centre of mass with loaded springs is {x:.1f} mm from the ankle; the foot spans {back:.1f} to {front:.1f} "
        f"mm: {stability:.1f} mm are left, of 0 mm at least",
        higher("e_coef", note="longer toes") + lower("ground_link_angle_deg", "compression_ratio"),
    )  # fmt: skip
    work = mechanism.mass_kg * gravity_m_s2 * float(com[1, 1] - com[0, 1]) / 1000.0
    needed = TAKEOFF_ENERGY_FACTOR * work
    weak = at_least(
        "too_weak", mechanism.spring.energy_j, needed, "J",
        f"the springs hold {1000.0 * mechanism.spring.energy_j:.1f} mJ; standing up against gravity takes "
        f"{1000.0 * work:.1f} mJ, and a jump needs {TAKEOFF_ENERGY_FACTOR} times that, {1000.0 * needed:.1f} mJ",
        higher("stiffness_nmm_per_deg", "compression_ratio", "rest_angle_deg") + lower("carrying_link_mm"),
    )  # fmt: skip
    return [tips, weak]


def support_span_mm(design: Design) -> tuple[float, float]:
    """Return the rearmost and foremost support point on the foot's x axis: ankle, front eye, toe tips (mm)."""
    return min(0.0, float(toe_tip_mm(design)[0])), max(0.0, design.l4_mm)


def centre_of_mass_on_foot_mm(mechanism: Mechanism, linkage: Linkage, pose: Pose) -> Array:
    """Return the robot's centre of mass (n, 2) in the foot's x-z frame at n poses (mm)."""
    still = np.zeros_like(pose.leg_rad)
    places = {
        BODY: (still, still),
        MAIN_LEG: (still - linkage.l1 / 2, linkage.rest_rad + pose.leg_rad),
        FRONT_LINK: (still + linkage.l1 / 2, linkage.rest_rad + pose.front_rad),
        FOOT: (points(pose.ankle_mm), pose.foot_rad),
    }
    moment = still + 0j
    for name, (origin, angle) in places.items():
        body = mechanism.bodies[name]
        moment += body.mass_kg * (origin + 1000.0 * points(body.com_m[::2]) * np.exp(-1j * angle))
    centre = (moment / mechanism.mass_kg - points(pose.ankle_mm)) * np.exp(1j * pose.foot_rad)
    return np.stack([centre.real, centre.imag], axis=-1)


def _loop_finding(margin_mm: float, why: str) -> Finding:
    closes = f"closes with {margin_mm:.2f} mm margin, of 0 mm at least"
    found = closes if margin_mm > 0 else f"is {abs(margin_mm):.2f} mm short of closing"
    return Finding(
        "loop", "info" if margin_mm > 0 else "error", margin_mm, "mm", f"the loop {found}: {why}",
        lower("compression_ratio") + nearer_to_1("c_coef"), margin_mm, 0.0,
    )  # fmt: skip
