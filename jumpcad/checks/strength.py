"""Strength of links, eyes, pins and seats: springs loaded, at release and at landing (N, N·mm, mm, MPa).

With loaded springs, the cam's push on the lever and the springs' arms bend main leg and lever about the hub. At
release the same torque goes into the foot (`jumpcad.strength.loads`). At landing the robot falls from as high as its
springs' energy could lift it and is stopped over `safety.landing_stop_mm`; the legs fold against the springs, which
bend them no more than the loaded springs do. All links print lying, so that motion bends them along their layers; the
foot prints on its sole, so that its lugs are pulled across theirs.
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import LEVER_EYE_RADIUS_MM
from jumpcad.findings import Basis, Finding, at_most, limit
from jumpcad.robot.axles import steel
from jumpcad.robot.foot import strength as foot
from jumpcad.robot.leg import limits as leg_bar
from jumpcad.robot.load_case import IN_PLANE, INTERLAYER, LANDING, LoadCase, stress_finding
from jumpcad.robot.robot import Robot
from jumpcad.robot.sizing import leg_flex_share
from jumpcad.strength.stress import (
    STATIONS,
    Beam,
    bored_stress_mpa,
    buckling_load_n,
    eye_stress_mpa,
    tapered_stress_mpa,
)

WEAKER = foot.WEAKER
PUSH_OFF = "loads: inverse dynamics of the push-off (Norton, Design of Machinery, ch. 11)"
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
    "foot_lug_strength": Basis(
        f"max(F/(d·t), √3·F/((D - d)·t)) ≤ {INTERLAYER}; F half of the larger force of ankle and front link in the "
        "push-off, t a lug's thickness, D twice the foot's depth, d bore",
        f"joints loaded in shear: Shigley 8-12; distortion energy; {PUSH_OFF}",
    ),
    **leg_bar.BASIS,
    **foot.BASIS,
    **steel.BASIS,
    "plate_seat": Basis(
        f"F/(d·t) ≤ the body's {IN_PLANE}; F what the more loaded plate carries of an axle or the springs' pin, a "
        "simple beam loaded as for `leg_axle_strength` and its like, d axle, t depth of its seat in one plate",
        "statics of two supports; bearing pressure (Shigley 8-12)",
    ),
    "cam_dog_strength": Basis(
        f"max(√(σ² + 3·τ²) of a jaw, √3·16·T·D/(π·(D⁴ - d⁴)) of its boss) ≤ the gears' {INTERLAYER}; T larger of "
        "the cam's torque and the blow at the end of the dog's play; σ = 3·F·L/(b·h²), τ = 1.5·F/(b·h), F = "
        "T/(2·mean radius)",
        "bending, transverse shear, torsion: Shigley 3-10 to 3-12; blow: jumpcad/drive/blows.py",
    ),
}


def strength_findings(robot: Robot) -> list[Finding]:
    """Return a finding for every way in which a generated robot could break."""
    case = LoadCase(robot)
    return [
        *_leg(case),
        *leg_bar.leg_bar_findings(case),
        *_front_link(case),
        *_eyes(case),
        *foot.foot_findings(case),
        *steel.steel_findings(case),
        *_seats(case),
    ]


def _leg(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of main leg and lever."""
    layout, torque = case.layout, case.torque_nmm
    sections, cam = layout.sections, layout.drive.cam
    leg = sections.leg(case.shell)
    stress = tapered_stress_mpa(leg, torque, float(np.abs(case.forces.leg_axial_n).max()))
    yield stress_finding("leg_strength", "main leg in bending at release", stress, case.allowable_mpa, WEAKER, "leg")
    holes = case.holes
    hub = max(2.0 * holes.hub_radius_mm, sections.leg_root_mm)
    stress = bored_stress_mpa(torque, sections.thickness_mm, hub, holes.hub_bore_mm)
    yield stress_finding(
        "hub_strength", "main leg beside its hub's bore, springs loaded", stress, case.allowable_mpa,
        f"a smaller bought.leg_bearing, or {WEAKER}", "leg",
    )  # fmt: skip
    lever = Beam(
        sections.thickness_mm, np.linspace(sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM, STATIONS), case.shell
    )
    along = cam.peak_contact_n * math.sin(cam.max_pressure_angle_rad)
    stress = tapered_stress_mpa(lever, torque, along)
    yield stress_finding(
        "lever_strength", "lever in bending, springs loaded", stress, case.allowable_mpa, WEAKER, "lever"
    )
    if layout.leg_bar is not None:
        return  # see `leg_bar_flex`
    share = leg_flex_share(layout.design, leg, case.workshop.material("links").modulus_mpa, case.robot.spring)
    allowed = case.workshop.safety.leg_flex_share
    yield limit(
        "leg_flex", 100.0 * (allowed - share), "%",
        f"{100 * share:.1f} % of the springs' energy bends the main leg at release; {100 * allowed:g} % are allowed",
        WEAKER, value=100.0 * share, allowed=100.0 * allowed, grows="leg",
    )  # fmt: skip


def _front_link(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of the front link: pulled at release, pushed at landing."""
    bar = case.layout.sections.front(case.shell)
    stress = float(bar.stress_mpa(0.0, case.front_n))
    yield stress_finding(
        "front_link_strength", "front link along its length at release", stress, case.allowable_mpa, WEAKER, "front"
    )
    load = buckling_load_n(bar, case.layout.design.l3_mm, case.workshop.material("links").modulus_mpa)
    allowed = load / case.workshop.safety.printed_factor
    if case.layout.leg_bar is not None:
        return  # see `front_bar_buckling`
    yield at_most(
        "front_link_buckling", case.landing_n, allowed, "N",
        f"front link under the whole landing force: {case.landing_n:.1f} of {allowed:.1f} N (Euler)",
        "shorten the front link (c_coef, carrying_link_mm), or raise landing_stop_mm with softer ground",
        grows="front",
    )  # fmt: skip


def _eyes(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of printed eyes: links along their layers, the foot's lugs across them."""
    sections, holes = case.layout.sections, case.holes
    force = max(case.ankle_n, case.front_n, case.landing_n)
    stress = eye_stress_mpa(force, sections.thickness_mm, 2.0 * sections.eye_radius_mm, holes.eye(case.layout.axle_mm))
    yield stress_finding(
        "eye_strength", "eyes of main leg and front link", stress, case.allowable_mpa, WEAKER, "thickness"
    )
    pull = max(case.ankle_n, case.front_n) / 2.0
    bore = holes.lying(case.layout.axle_mm)
    stress = eye_stress_mpa(pull, sections.lug_thickness_mm, 2.0 * sections.foot_depth_mm, bore)
    interlayer = case.workshop.material("links").strength_interlayer_mpa / case.workshop.safety.printed_factor
    yield stress_finding(
        "foot_lug_strength", "the foot's lugs, pulled across their layers", stress, interlayer, WEAKER, "lug"
    )


def _seats(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of the plates around axles and pins, and of the cam's dog, loaded and at the impact."""
    safety, body = case.workshop.safety, case.workshop.material("body")
    seat = case.layout.lateral.left_plate[1] - case.layout.lateral.left_plate[0] - case.layout.floor_mm
    longer = {"leg_axle": case.layout.boss_mm}
    worst = max(beam.plate_load_n / (seat + longer.get(name, 0.0)) for name, beam in case.beams.items())
    stress = worst / case.layout.axle_mm
    allowable = body.strength_in_plane_mpa / safety.printed_factor
    yield stress_finding("plate_seat", "plates under axles and pins", stress, allowable, "raise body.plate_mm", "plate")
    gears = case.workshop.material("gears")
    torque = max(case.layout.drive.cam.peak_torque_nm, case.robot.release.blow_nm)
    allowable = gears.strength_interlayer_mpa / safety.printed_factor
    remedy = "lower stiffness_nmm_per_deg or compression_ratio, or choose a stronger material for the gears"
    stress = case.dog_stress_mpa(torque)
    yield stress_finding(
        "cam_dog_strength", "the cam's dog, across its layers at release", stress, allowable, remedy, "dog"
    )
