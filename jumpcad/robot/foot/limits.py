"""Clearance above the ground; strength of lugs, toes, rails, and of the leg bent sideways by a toe (N, N·mm, mm, MPa).

At release the ground pushes on both toes' tips; at landing one of them may touch the ground first.
"""

import itertools
import math
from collections.abc import Iterator

import numpy as np

from jumpcad import dimensions
from jumpcad.drive.motor import socket_half_mm
from jumpcad.findings import Basis, Finding, at_least, higher, lower
from jumpcad.robot.foot.toes import SCREWS_MM, joint_height_mm
from jumpcad.robot.load_case import IN_PLANE, INTERLAYER, ONE_TOE, PUSH_OFF, WEAKER, LoadCase, load_case, stress_finding
from jumpcad.robot.robot import Robot
from jumpcad.robot.sizing import TWIST_FACTOR, rail_middle_mm
from jumpcad.robot.stop.place import TAB_MM
from jumpcad.robot.train.thing import ear_places, motor_box
from jumpcad.strength.loads import rail_moment_nmm, rail_twist_nmm, toe_moment_nmm
from jumpcad.strength.stress import STATIONS, VON_MISES, Beam, bar_shear_mpa, eye_stress_mpa, tapered_stress_mpa
from jumpcad.transforms import Array, direction

SOFTER = (*higher("e_coef", note="longer toes"), *WEAKER)
"""A tip that is farther from the body's mass is met by less of it."""
TIPS = "F largest load of both toes' tips in the push-off"
BASIS = {
    "foot_lug_strength": Basis(
        f"max(F/(d·t), √3·F/((D - d)·t)) ≤ {INTERLAYER}; F half of the larger force of ankle and front link in the "
        "push-off, t a lug's thickness, D twice the foot's depth, d bore",
        f"joints loaded in shear: Shigley 8-12; distortion energy; {PUSH_OFF}",
    ),
    "toe_strength": Basis(
        f"largest M·h/(2·I) along a toe ≤ {IN_PLANE}; M falls evenly from F·l5/2 at its root to 0, {TIPS}",
        f"Shigley 3-10; {PUSH_OFF}",
    ),
    "rail_strength": Basis(
        f"largest M·h/(2·I) along a rail ≤ {IN_PLANE}; M falls evenly from F·x/2 at the ankle to 0, {TIPS}, x its "
        "distance behind the ankle",
        f"Shigley 3-10; {PUSH_OFF}",
    ),
    "rail_twist": Basis(
        f"√3·T/(b·c²)·(3 + 1.8·c/b) ≤ strength_in_plane_mpa/{TWIST_FACTOR:g} (MPa); T = F·(y - y0)/2, {TIPS}, y and y0 "
        "distances of tip and rail from the robot's middle, b and c long and short side of the rail at the ankle",
        "torsion: Shigley 3-12; distortion energy; the factor: judgement, the neck beside the ankle is short and the "
        "pin takes a part",
    ),
    "toe_landing": Basis(
        f"largest M·h/(2·I) along a toe ≤ {IN_PLANE}; M falls evenly from F·l5 at its root to 0, {ONE_TOE}",
        "Shigley 3-10; impact beside the centre of mass: Meriam and Kraige, Dynamics, 6/8",
    ),
    "toe_bar_strength": Basis(
        f"max(M·h/(2·I), √3·M/(b·c²)·(3 + 1.8·c/b)) ≤ {IN_PLANE}; M = F·length of the bar, {ONE_TOE}, b and c long and "
        "short side of its section",
        "bending and torsion: Shigley 3-10, 3-12; distortion energy",
    ),
    "toe_joint_strength": Basis(
        f"max(F/(d·t), √3·F/((h - d)·t)) ≤ {IN_PLANE}; F = F_tip·(l5 - x1)/(x2 - x1) on the outer screw, screws at x1 "
        "and x2, F_tip larger of F_toes/2 at release and the landing on one toe; d hole, h and t height and width",
        "joints loaded in shear: Shigley 8-12; distortion energy",
    ),
    "leg_sideways": Basis(
        f"largest √(σ² + 3·τ²) along the main leg ≤ {IN_PLANE}; M = F·toe_half_width_mm, {ONE_TOE}; σ of the bending "
        "M·sin(rest_angle_deg) across its thickness, τ of the torsion M·cos(rest_angle_deg)",
        "bending and torsion: Shigley 3-10, 3-12; distortion energy; that the front link carries nothing: judgement",
    ),
}


def toe_findings(robot: Robot) -> Iterator[Finding]:
    """Yield the findings of `BASIS`; those of bars and screws of toes only where there are any."""
    case = load_case(robot)
    design, sections, toes, blow = robot.design, case.layout.sections, case.toes_n, case.toe_blow_n
    links, most = case.workshop.material("links"), case.allowable_mpa
    bore, pull = case.holes.lying(case.layout.axle_mm), max(case.ankle_n, case.front_n) / 2.0
    stress = eye_stress_mpa(pull, sections.lug_thickness_mm, 2.0 * sections.foot_depth_mm, bore)
    least = links.strength_interlayer_mpa / case.workshop.safety.printed_factor  # the foot prints on its sole
    yield stress_finding(
        "foot_lug_strength", "the foot's lugs, pulled across their layers", stress, least, WEAKER, "lug"
    )
    toe = sections.toe(case.shell)
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, toes))
    ways = (*lower("e_coef", note="shorter toes"), *WEAKER)
    yield stress_finding("toe_strength", "toes in bending at release", stress, most, ways, "toe")
    stress = tapered_stress_mpa(sections.rail(case.shell), rail_moment_nmm(design, toes))
    yield stress_finding("rail_strength", "the foot's rails in bending at release", stress, most, ways, "rail")
    middle = rail_middle_mm(sections.thickness_mm, sections.lug_thickness_mm)
    shear = bar_shear_mpa(rail_twist_nmm(design, toes, middle), sections.lug_thickness_mm, sections.rail_root_mm)
    yield stress_finding(
        "rail_twist", "the foot's rails twisted beside the ankle at release", VON_MISES * float(shear),
        links.strength_in_plane_mpa / TWIST_FACTOR, (*lower("ground_link_angle_deg"), *ways), "rail",
    )  # fmt: skip
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, 2.0 * blow))
    yield stress_finding("toe_landing", "one toe's tip that lands first", stress, most, SOFTER, "toe")
    if bar := case.layout.toe_bar_mm:  # its end lands, which bends it and twists the toe
        width, height = dimensions.TOE_TIP_WIDTH_MM, sections.toe_tip_height_mm
        bending = float(Beam(width, height, case.shell, upright=True).stress_mpa(blow * bar))
        stress = max(bending, VON_MISES * float(bar_shear_mpa(blow * bar, width, height)))
        narrower = lower("body.toe_half_width_mm")
        yield stress_finding("toe_bar_strength", "the bar across a toe's tip", stress, most, narrower, "toe")
    if case.layout.toes_apart:
        stress = _toe_joint_mpa(case, max(0.5 * toes, blow))
        yield stress_finding("toe_joint_strength", "the toes' screw holes", stress, most, ways, "toe")
    stress = _sideways_mpa(case)
    yield stress_finding("leg_sideways", "main leg bent sideways by one toe's tip", stress, most, SOFTER, "thickness")


def _toe_joint_mpa(case: LoadCase, tip_n: float) -> float:
    """Return the stress beside the screws that hold a separate toe, with a force on its tip.

    The outer screw carries the most: the force's moment about the inner one over their distance.
    """
    inner, outer = SCREWS_MM
    force = tip_n * (case.layout.design.l5_mm - inner) / (outer - inner)
    holes = case.holes
    height, width = joint_height_mm(case.layout, holes), case.layout.sections.toe_width_mm
    bores = (holes.fits.m3_tap_mm, holes.fits.m3_clearance_mm)
    return max(eye_stress_mpa(force, width, height, bore) for bore in bores)


def _sideways_mpa(case: LoadCase) -> float:
    """Return the stress of the main leg bent and twisted out of its plane by one toe's tip that lands first.

    The impact's moment about the robot's long axis goes through the leg alone, the front link neglected: its part
    across the leg bends the leg sideways, its part along the leg twists it.
    """
    sections, angle = case.layout.sections, math.radians(case.robot.design.rest_angle_deg)
    moment = case.toe_blow_n * case.layout.toe_half_width_mm
    heights = np.linspace(sections.leg_root_mm, sections.leg_tip_mm, STATIONS)
    bending = Beam(heights, sections.thickness_mm, case.shell, upright=True).stress_mpa(moment * math.sin(angle))
    shear = VON_MISES * bar_shear_mpa(moment * math.cos(angle), heights, sections.thickness_mm)
    return float(np.max(np.hypot(bending, shear)))


GROUND_GAP_MM = 0.5
"""Least gap to the ground; judgement: play of the joints and the flexing of legs and foot."""
POSITIONS = 9
GROUND_BASIS = {
    "ground_clearance": Basis(
        f"least height above the ground of body, roller and legs' ends, from loaded to rest ≥ {GROUND_GAP_MM:g} mm + "
        "safety.gap_reserve_mm (mm), the foot flat",
        f"geometry; {GROUND_GAP_MM:g} mm: judgement, play of the joints and flexing of legs and foot",
    )
}


def ground_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `ground_clearance`: the lowest point of body, legs and lever above the ground, from loaded to rest."""
    layout = robot.layout
    linkage, sections, cam = robot.linkage, layout.sections, layout.drive.cam
    leg = np.linspace(-robot.design.compression_rad, 0.0, POSITIONS)
    pose = linkage.pose(leg)
    down = np.stack([np.sin(pose.foot_rad), np.cos(pose.foot_rad)], axis=-1)  # up, in the body's frame
    fixed, radii = _body_discs(robot)
    tips = layout.hub_mm + cam.geometry.lever_mm * direction(-cam.geometry.lever_start_rad + leg)
    heights = {
        "the body": (down @ fixed.T - _along(pose.ankle_mm, down)[:, None] - radii).min(axis=1),
        "the roller": _along(tips - pose.ankle_mm, down) - cam.geometry.roller_radius_mm,
        "the legs' ends": np.full(POSITIONS, -sections.eye_radius_mm),
    }
    name, lowest = min(((what, float(height.min())) for what, height in heights.items()), key=lambda item: item[1])
    clearance = lowest + sections.ground_mm
    needed = GROUND_GAP_MM + robot.workshop.safety.gap_reserve_mm
    yield at_least(
        "ground_clearance", clearance, needed, "mm",
        f"least height of {name} above the ground: {clearance:.1f} mm; {needed:g} mm are needed",
        lower("compression_ratio") + higher("rest_angle_deg"),
    )  # fmt: skip


def _along(vector: Array, unit: Array) -> Array:
    """Return the components (n,) of vectors (n, 2) along units (n, 2)."""
    return np.asarray(np.einsum("ij,ij->i", vector, unit))


def _body_discs(robot: Robot) -> tuple[Array, Array]:
    """Return the lowest parts of the body as discs: middles (n, 2) in its frame and radii (n,)."""
    layout = robot.layout
    pad = max(layout.axle_mm / 2.0 + dimensions.PAD_WALL_MM, dimensions.AXLE_END_RADIUS_MM)
    discs = [(place, pad) for place in layout.axles.values()]
    discs += [(place, dimensions.STANDOFF_PAD_MM / 2.0) for place in layout.standoffs_mm]
    stop = layout.stop
    boxes = [
        (stop.tab_mm, TAB_MM, dimensions.STOP_EDGE_MM),
        (stop.middle_mm, (dimensions.STOP_PAD_MM, stop.depth_mm), 0.0),
    ]
    discs += [
        (middle + a * (size[0] / 2.0 + edge) * stop.along + b * (size[1] / 2.0 + edge) * stop.behind, 0.0)
        for (middle, size, edge), a, b in itertools.product(boxes, (-1.0, 1.0), (-1.0, 1.0))
    ]
    discs.append((layout.hub_mm, layout.drive.spring.outer_diameter_mm / 2.0))
    discs.append((layout.cam_axis_mm, layout.drive.cam.outer_radius_mm))
    discs.append((layout.cam_axis_mm, layout.drive.train.stages[-1].wheel.tip_radius_mm))
    discs += [(place, layout.cap_ear_mm / 2.0) for place in ear_places(layout)]
    motor = layout.drive.train.motor
    socket = motor_box(layout, *(2.0 * half for half in socket_half_mm(motor, 0.0)))
    discs += [(corner, 0.0) for corner in socket.to_polygons()[0]]
    if layout.idler_mm is not None:
        discs.append((layout.idler_mm, layout.drive.train.stages[0].wheel.tip_radius_mm))
    half = layout.electronics.length_mm / 2.0
    discs += [(layout.tray_mm + np.array([x, 0.0]), 0.0) for x in (-half, half)]
    return np.array([place for place, _ in discs]), np.array([radius for _, radius in discs])
