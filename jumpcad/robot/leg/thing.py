"""Strength of main leg, lever and front link: springs loaded, at release and at landing (N, N·mm, mm, MPa).

With loaded springs, the cam's push on the lever and the springs' arms bend main leg and lever about the hub. At
release the same torque goes into the foot (`jumpcad.strength.loads`). At landing the robot falls from as high as its
springs' energy could lift it and is stopped over `safety.landing_stop_mm`; the legs fold against the springs, which
bend them no more than the loaded springs do. All links print lying, so that motion bends them along their layers.
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import LEVER_EYE_RADIUS_MM
from jumpcad.findings import Basis, Finding, at_most, choose, higher, limit, lower
from jumpcad.robot.leg import bar_limits
from jumpcad.robot.leg.drawing import leg_hardware, legs
from jumpcad.robot.load_case import IN_PLANE, LANDING, PUSH_OFF, WEAKER, load_case, stress_finding
from jumpcad.robot.robot import Check, Robot, Thing
from jumpcad.robot.sizing import leg_flex_share
from jumpcad.strength.stress import (
    STATIONS,
    Beam,
    bored_stress_mpa,
    buckling_load_n,
    eye_stress_mpa,
    tapered_stress_mpa,
)

BASIS = {
    "leg_strength": Basis(
        f"largest M·h/(2·I) + F/A along the leg ≤ {IN_PLANE}; M falls evenly from the springs' torque K·(δ + p) at "
        "the hub to 0 at the ankle, F largest force along the leg in the push-off; I and A less what the infill lacks",
        f"Shigley 3-10; {PUSH_OFF}",
    ),
    "hub_strength": Basis(
        f"6·M·H/(b·(H³ - d³)) ≤ {IN_PLANE}; M springs' torque K·(δ + p), b leg's thickness, H larger of hub and leg's "
        "root, d the hub's bore",
        "section with a hole: Roark, table A.1",
    ),
    "lever_strength": Basis(
        f"largest M·h/(2·I) + F/A along the lever ≤ {IN_PLANE}; M falls evenly from the springs' torque K·(δ + p) at "
        "the hub to 0 at the roller, F = N·sin α with the cam's largest force N and pressure angle α",
        "Shigley 3-10",
    ),
    "leg_flex": Basis(
        "∫M²/(2·E·I)dx over the leg/U ≤ safety.leg_flex_share (%); M falls evenly from the springs' "
        "torque K·(δ + p) at the hub to 0 at the ankle, E modulus of the links' material",
        "strain energy in bending (Shigley, ch. 4); limit: judgement",
    ),
    "front_link_strength": Basis(
        f"F/A ≤ {IN_PLANE}; F largest force along the front link in the push-off", f"Shigley 3-10; {PUSH_OFF}"
    ),
    "front_link_buckling": Basis(
        f"F ≤ π²·E·I/(l3²·s) (N); {LANDING}",
        "Euler, a hinge at either end (Shigley 4-12); stopping distance: judgement",
    ),
    "eye_strength": Basis(
        f"max(F/(d·t), √3·F/((D - d)·t)) ≤ {IN_PLANE}; F largest of ankle and front link in the push-off and the "
        "landing force, t thickness, D outside, d bore",
        f"joints loaded in shear: Shigley 8-12; distortion energy; {PUSH_OFF}",
    ),
    **bar_limits.BASIS,
}


def leg_findings(robot: Robot) -> Iterator[Finding]:
    """Yield a finding for every way in which main leg, lever and front link could break."""
    case = load_case(robot)
    layout, sections, holes, most = case.layout, case.layout.sections, case.holes, case.allowable_mpa
    leg, cam, links = sections.leg(case.shell), layout.drive.cam, case.workshop.material("links")
    stress = tapered_stress_mpa(leg, case.torque_nmm, float(np.abs(case.forces.leg_axial_n).max()))
    yield stress_finding("leg_strength", "main leg in bending at release", stress, most, WEAKER, "leg")
    hub = max(2.0 * holes.hub_radius_mm, sections.leg_root_mm)
    stress = bored_stress_mpa(case.torque_nmm, sections.thickness_mm, hub, holes.hub_bore_mm)
    ways = choose("a smaller", "bought.leg_bearing") + WEAKER
    yield stress_finding("hub_strength", "main leg beside its hub's bore, springs loaded", stress, most, ways, "leg")
    heights = np.linspace(sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM, STATIONS)
    along = cam.peak_contact_n * math.sin(cam.max_pressure_angle_rad)
    stress = tapered_stress_mpa(Beam(sections.thickness_mm, heights, case.shell), case.torque_nmm, along)
    yield stress_finding("lever_strength", "lever in bending, springs loaded", stress, most, WEAKER, "lever")
    if layout.leg_bar is None:
        share = leg_flex_share(layout.design, leg, links.modulus_mpa, robot.spring)
        allowed = case.workshop.safety.leg_flex_share
        yield limit(
            "leg_flex", 100.0 * (allowed - share), "%",
            f"{100 * share:.1f} % of the springs' energy bends the main leg at release; {100 * allowed:g} % are "
            "allowed", WEAKER, value=100.0 * share, allowed=100.0 * allowed, grows="leg",
        )  # fmt: skip
    else:
        yield from bar_limits.leg_bar_findings(case)
    front = sections.front(case.shell)
    stress = float(front.stress_mpa(0.0, case.front_n))
    yield stress_finding("front_link_strength", "front link along its length at release", stress, most, WEAKER, "front")
    if layout.leg_bar is None:  # else `front_bar_buckling`
        load = buckling_load_n(front.second_moment_mm4, layout.design.l3_mm, links.modulus_mpa)
        allowed = load / case.workshop.safety.printed_factor
        yield at_most(
            "front_link_buckling", case.landing_n, allowed, "N",
            f"front link under the whole landing force: {case.landing_n:.1f} of {allowed:.1f} N (Euler)",
            lower("c_coef", "carrying_link_mm") + higher("safety.landing_stop_mm", note="softer ground"),
            grows="front",
        )  # fmt: skip
    force = max(case.ankle_n, case.front_n, case.landing_n)
    stress = eye_stress_mpa(force, sections.thickness_mm, 2.0 * sections.eye_radius_mm, holes.eye(layout.axle_mm))
    yield stress_finding("eye_strength", "eyes of main leg and front link", stress, most, WEAKER, "thickness")


LEG = Thing(legs, leg_hardware, (Check(leg_findings, BASIS),))
