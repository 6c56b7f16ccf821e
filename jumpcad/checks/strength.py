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

from jumpcad.checks.leg_bar import leg_bar_findings
from jumpcad.checks.load_case import LoadCase, stress_finding
from jumpcad.checks.steel import steel_findings
from jumpcad.dimensions import LEVER_EYE_RADIUS_MM, TOE_TIP_WIDTH_MM
from jumpcad.drive.dog import JAWS
from jumpcad.findings import Finding, at_most, limit
from jumpcad.parts.toes import SCREWS_MM, joint_height_mm
from jumpcad.robot import Robot
from jumpcad.strength.loads import rail_moment_nmm, toe_moment_nmm
from jumpcad.strength.sizing import dog_inside_mm, leg_flex_share
from jumpcad.strength.stress import (
    STATIONS,
    VON_MISES,
    Beam,
    bar_shear_mpa,
    bored_stress_mpa,
    buckling_load_n,
    eye_stress_mpa,
    jaw_stress_mpa,
    tapered_stress_mpa,
    tube_shear_mpa,
)

WEAKER = "lower stiffness_nmm_per_deg or compression_ratio, or choose a stronger material for the links"


def strength_findings(robot: Robot) -> list[Finding]:
    """Return a finding for every way in which a generated robot could break."""
    case = LoadCase(robot)
    return [
        *_leg(case),
        *leg_bar_findings(case),
        *_front_link(case),
        *_eyes(case),
        *_foot(case),
        *_sideways(case),
        *steel_findings(case),
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


def _foot(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of toes and rails."""
    design, sections = case.robot.design, case.layout.sections
    toes = float(case.forces.toes_n.max())
    toe, rail = sections.toe(case.shell), sections.rail(case.shell)
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, toes))
    remedy = f"shorten the toes (e_coef), or {WEAKER}"
    yield stress_finding("toe_strength", "toes in bending at release", stress, case.allowable_mpa, remedy, "toe")
    stress = tapered_stress_mpa(rail, rail_moment_nmm(design, toes))
    yield stress_finding(
        "rail_strength", "the foot's rails in bending at release", stress, case.allowable_mpa, remedy, "rail"
    )
    blow = case.toe_blow_n
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, 2.0 * blow))
    yield stress_finding("toe_landing", "one toe's tip that lands first", stress, case.allowable_mpa, remedy, "toe")
    if bar := case.layout.toe_bar_mm:
        stress = _toe_bar_mpa(case, blow * bar)
        yield stress_finding(
            "toe_bar_strength", "the bar across a toe's tip", stress, case.allowable_mpa,
            "lower body.toe_half_width_mm", "toe",
        )  # fmt: skip
    if case.layout.toes_apart:
        stress = _toe_joint_mpa(case, max(0.5 * toes, blow))
        yield stress_finding("toe_joint_strength", "the toes' screw holes", stress, case.allowable_mpa, remedy, "toe")


def _toe_bar_mpa(case: LoadCase, moment_nmm: float) -> float:
    """Return the stress of the bar across a toe's tip, bent by a landing on its end, which twists the toe as well."""
    width, height = TOE_TIP_WIDTH_MM, case.layout.sections.toe_tip_height_mm
    bending = float(Beam(width, height, case.shell, upright=True).stress_mpa(moment_nmm))
    return max(bending, VON_MISES * float(bar_shear_mpa(moment_nmm, width, height)))


def _toe_joint_mpa(case: LoadCase, tip_n: float) -> float:
    """Return the stress beside the screws that hold a separate toe, with a force on its tip.

    The outer screw carries the most: the force's moment about the inner one over their distance.
    """
    inner, outer = SCREWS_MM
    force = tip_n * (case.layout.design.l5_mm - inner) / (outer - inner)
    holes = case.holes
    height, width = joint_height_mm(case.layout, holes), case.layout.sections.toe_width_mm
    bores = (holes.fits.m3_tap_mm, holes.m3_clearance_mm)
    return max(eye_stress_mpa(force, width, height, bore) for bore in bores)


def _sideways(case: LoadCase) -> Iterator[Finding]:
    """Yield the finding of the main leg bent and twisted out of its plane by one toe's tip that lands first.

    The impact's moment about the robot's long axis goes through the leg alone, the front link neglected: its part
    across the leg bends the leg sideways, its part along the leg twists it.
    """
    sections, angle = case.layout.sections, math.radians(case.robot.design.rest_angle_deg)
    moment = case.toe_blow_n * case.layout.toe_half_width_mm
    heights = np.linspace(sections.leg_root_mm, sections.leg_tip_mm, STATIONS)
    bending = Beam(heights, sections.thickness_mm, case.shell, upright=True).stress_mpa(moment * math.sin(angle))
    shear = VON_MISES * bar_shear_mpa(moment * math.cos(angle), heights, sections.thickness_mm)
    stress = float(np.max(np.hypot(bending, shear)))
    remedy = f"shorten the toes (e_coef), lower ground_link_angle_deg, or {WEAKER}"
    yield stress_finding(
        "leg_sideways", "main leg bent sideways by one toe's tip", stress, case.allowable_mpa, remedy, "thickness"
    )


def _seats(case: LoadCase) -> Iterator[Finding]:
    """Yield the findings of the plates around axles and pins, and of the cam's dog, loaded and at the impact."""
    safety, body = case.workshop.safety, case.workshop.material("body")
    arms, cam = case.wound_forces_n
    seat = case.layout.lateral.left_plate[1] - case.layout.lateral.left_plate[0] - case.layout.floor_mm
    loads = ((cam - arms[1], seat + case.layout.boss_mm), (cam, seat), (arms[1], seat))
    worst = max(float(np.linalg.norm(force)) / depth for force, depth in loads) / 2.0
    stress = worst / case.layout.axle_mm
    allowable = body.strength_in_plane_mpa / safety.printed_factor
    yield stress_finding("plate_seat", "plates under axles and pins", stress, allowable, "raise body.plate_mm", "plate")
    gears = case.workshop.material("gears")
    dog, layout = case.layout.drive.dog, case.layout
    torque = 1000.0 * max(layout.drive.cam.peak_torque_nm, case.robot.release.blow_nm)
    inside = dog_inside_mm(case.holes.fits, layout.axle_mm)
    length = layout.lateral.gears[0][1] - layout.lateral.gears[0][0]
    jaw = jaw_stress_mpa(torque, dog.jaw_rad, JAWS, inside, dog.outer_mm, length)
    boss = VON_MISES * tube_shear_mpa(torque, dog.outer_mm, case.holes.running(layout.axle_mm))
    allowable = gears.strength_interlayer_mpa / safety.printed_factor
    remedy = "lower stiffness_nmm_per_deg or compression_ratio, or choose a stronger material for the gears"
    yield stress_finding(
        "cam_dog_strength", "the cam's dog, across its layers at release", max(jaw, boss), allowable, remedy, "dog"
    )
