"""Does it break? Links, eyes, pins and seats wound, at release and at landing (N, N·mm, mm, MPa).

Wound, the cam's push on the lever and the springs' arms bend main leg and lever about the hub. At release the same
torque goes into the foot (`jumpcad.loads`). At landing the robot falls from as high as its springs' energy could lift
it and is stopped over `safety.landing_stop_mm`; the legs fold against the springs, which bend them no more than
winding did. All links print lying, so that motion bends them along their layers; the foot prints on its sole, so that
its lugs are pulled across theirs.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from jumpcad.findings import Finding, limit
from jumpcad.hub import allowed_n, bearing_load_n, wound_forces_n
from jumpcad.layout.lateral import ROLLER_WASHER_MM
from jumpcad.layout.plan import Plan
from jumpcad.loads import (
    MovingMass,
    PushOff,
    landing_force_n,
    push_off,
    rail_moment_nmm,
    reflected_share,
    toe_moment_nmm,
    toe_tip_mm,
)
from jumpcad.parts.bores import Bores
from jumpcad.parts.links import LEVER_EYE_RADIUS_MM
from jumpcad.parts.toes import SCREWS_MM, joint_height_mm
from jumpcad.robot import BODY, Array, Robot
from jumpcad.sizing import leg_flex_share
from jumpcad.stress import (
    STATIONS,
    VON_MISES,
    Bar,
    Skin,
    bored_stress_mpa,
    buckling_load_n,
    eye_stress_mpa,
    pin_stress_mpa,
    tapered_stress_mpa,
    tube_shear_mpa,
)
from jumpcad.workshop import Workshop

ROLLER_SCREW_CORE_MM = 2.39
"""M3, ISO 724."""
ROLLER_SCREW_YIELD_MPA = 640.0
"""Property class 8.8, ISO 898-1."""
WEAKER = "lower stiffness_nmm_per_deg or compression_ratio, or choose a stronger material for the links"


@dataclass(frozen=True)
class _Case:
    """A robot under load."""

    robot: Robot
    plan: Plan
    workshop: Workshop

    @cached_property
    def torque_nmm(self) -> float:
        return 1000.0 * self.robot.design.peak_spring_torque_nm

    @cached_property
    def skin(self) -> Skin:
        return Skin.of(self.workshop.process)

    @cached_property
    def bores(self) -> Bores:
        return Bores.of(self.workshop, self.plan.hub_bearing)

    @cached_property
    def allowable_mpa(self) -> float:
        return self.workshop.material("links").strength_in_plane_mpa / self.workshop.safety.strength_factor

    @cached_property
    def steel_mpa(self) -> float:
        return self.workshop.safety.steel_yield_mpa / self.workshop.safety.steel_factor

    @cached_property
    def forces(self) -> PushOff:
        body = self.robot.bodies[BODY]
        gyration = 1000.0 * math.sqrt(body.inertia_kg_m2[1, 1] / body.mass_kg)
        mass = MovingMass(body.mass_kg, 1000.0 * body.com_m[[0, 2]], gyration)
        return push_off(self.robot.design, mass, self.plan.sections.foot_depth_mm)

    @cached_property
    def ankle_n(self) -> float:
        return float(np.linalg.norm(self.forces.ankle_n, axis=1).max())

    @cached_property
    def front_n(self) -> float:
        return float(np.abs(self.forces.front_n).max())

    @cached_property
    def landing_n(self) -> float:
        return landing_force_n(self.robot.design, self.robot.mass_kg, self.workshop.safety.landing_stop_mm)

    @cached_property
    def wound_forces_n(self) -> tuple[tuple[Array, Array], Array]:
        """Forces (2,) of the springs' arms on leg and plates, and that of the cam on the lever.

        In the body's frame, springs wound, roller at the end of the lift; both springs together.
        """
        plan = self.plan
        on_leg, on_lever = wound_forces_n(self.robot.design, plan.drive)
        pin = (plan.spring_pin_mm - plan.hub_mm) / plan.leg_pin_mm
        on_pin = self.torque_nmm / plan.leg_pin_mm * np.array([-pin[1], pin[0]])
        return (on_leg, on_pin), on_lever


def strength_findings(robot: Robot) -> list[Finding]:
    """Return a finding for every way in which a generated robot could break."""
    if robot.plan is None or robot.workshop is None:
        return []
    case = _Case(robot, robot.plan, robot.workshop)
    return [*_leg(case), *_front_link(case), *_eyes(case), *_foot(case), *_steel(case), *_bearings(case), *_seats(case)]


def _stress(name: str, what: str, stress: float, allowable: float, remedy: str) -> Finding:
    message = f"{what}: {stress:.1f} of {allowable:.1f} MPa"
    return limit(name, allowable - stress, "MPa", message, remedy)


def _leg(case: _Case) -> Iterator[Finding]:
    """Yield those of main leg and lever."""
    plan, torque = case.plan, case.torque_nmm
    sections, cam = plan.sections, plan.drive.cam
    leg = sections.leg(case.skin)
    stress = tapered_stress_mpa(leg, torque, float(np.abs(case.forces.leg_axial_n).max()))
    yield _stress("leg_strength", "main leg in bending at release", stress, case.allowable_mpa, WEAKER)
    bores = case.bores
    hub = max(2.0 * bores.hub_radius_mm, sections.leg_root_mm)
    stress = bored_stress_mpa(torque, sections.thickness_mm, hub, bores.hub_bore_mm)
    yield _stress(
        "hub_strength", "main leg beside its hub's bore, wound", stress, case.allowable_mpa,
        f"a smaller bought.leg_bearing, or {WEAKER}",
    )  # fmt: skip
    lever = Bar(
        sections.thickness_mm, np.linspace(sections.lever_root_mm, 2.0 * LEVER_EYE_RADIUS_MM, STATIONS), case.skin
    )
    along = cam.peak_contact_n * math.sin(cam.max_pressure_angle_rad)
    stress = tapered_stress_mpa(lever, torque, along)
    yield _stress("lever_strength", "lever in bending, wound", stress, case.allowable_mpa, WEAKER)
    share = leg_flex_share(plan.design, leg, case.workshop.material("links").modulus_mpa)
    allowed = case.workshop.safety.leg_flex_share
    yield limit(
        "leg_flex", 100.0 * (allowed - share), "%",
        f"{100 * share:.1f} % of the springs' energy bends the main leg at release; {100 * allowed:g} % are allowed",
        WEAKER,
    )  # fmt: skip


def _front_link(case: _Case) -> Iterator[Finding]:
    """Yield those of the front link: pulled at release, pushed at landing."""
    bar = case.plan.sections.front(case.skin)
    stress = float(bar.stress_mpa(0.0, case.front_n))
    yield _stress("front_link_strength", "front link along its length at release", stress, case.allowable_mpa, WEAKER)
    load = buckling_load_n(bar, case.plan.design.l3_mm, case.workshop.material("links").modulus_mpa)
    allowed = load / case.workshop.safety.strength_factor
    yield limit(
        "front_link_buckling", allowed - case.landing_n, "N",
        f"front link under the whole landing: {case.landing_n:.1f} of {allowed:.1f} N (Euler)",
        "shorten the front link (c_coef, carrying_link_mm), or raise landing_stop_mm with softer ground",
    )  # fmt: skip


def _eyes(case: _Case) -> Iterator[Finding]:
    """Yield those of the printed eyes: links along their layers, the foot's lugs across them."""
    sections, bores = case.plan.sections, case.bores
    force = max(case.ankle_n, case.front_n, case.landing_n)
    stress = eye_stress_mpa(
        force, sections.thickness_mm, 2.0 * sections.eye_radius_mm, bores.running(case.plan.axle_mm)
    )
    yield _stress("eye_strength", "eyes of main leg and front link", stress, case.allowable_mpa, WEAKER)
    pull = max(case.ankle_n, case.front_n) / 2.0
    bore = bores.press(case.plan.axle_mm)
    stress = eye_stress_mpa(pull, sections.lug_thickness_mm, 2.0 * sections.foot_depth_mm, bore)
    interlayer = case.workshop.material("links").strength_interlayer_mpa / case.workshop.safety.strength_factor
    yield _stress("foot_lug_strength", "the foot's lugs, pulled across their layers", stress, interlayer, WEAKER)


def _foot(case: _Case) -> Iterator[Finding]:
    """Yield those of toes and rails."""
    design, sections = case.robot.design, case.plan.sections
    toes = float(case.forces.toes_n.max())
    toe, rail = sections.toe(case.skin), sections.rail(case.skin)
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, toes))
    remedy = f"shorten the toes (e_coef), or {WEAKER}"
    yield _stress("toe_strength", "toes in bending at release", stress, case.allowable_mpa, remedy)
    stress = tapered_stress_mpa(rail, rail_moment_nmm(design, toes))
    yield _stress("rail_strength", "the foot's rails in bending at release", stress, case.allowable_mpa, remedy)
    body = case.robot.bodies[BODY]
    about_x, about_y = 1000.0 * np.sqrt(np.diag(body.inertia_kg_m2)[:2] / body.mass_kg)
    blow = case.landing_n * reflected_share(toe_tip_mm(design), (float(about_x), float(about_y)))
    stress = tapered_stress_mpa(toe, toe_moment_nmm(design, 2.0 * blow))
    yield _stress("toe_landing", "one toe's tip that lands first", stress, case.allowable_mpa, remedy)
    if case.plan.toes_apart:
        stress = _toe_joint_mpa(case, max(0.5 * toes, blow))
        yield _stress("toe_joint_strength", "the toes' screw holes", stress, case.allowable_mpa, remedy)


def _toe_joint_mpa(case: _Case, tip_n: float) -> float:
    """Return the stress beside the screws that hold a toe of its own, with a force on its tip.

    The outer screw bears the most: the force's moment about the inner one over their distance.
    """
    inner, outer = SCREWS_MM
    force = tip_n * (case.plan.design.l5_mm - inner) / (outer - inner)
    bores = case.bores
    height, width = joint_height_mm(case.plan, bores), case.plan.sections.toe_width_mm
    holes = (bores.fits.m3_tap_mm, bores.m3_clearance_mm)
    return max(eye_stress_mpa(force, width, height, bore) for bore in holes)


def _steel(case: _Case) -> Iterator[Finding]:
    """Yield those of axles, pins and the roller's screw."""
    plan, lateral = case.plan, case.plan.lateral
    remedy = "raise bought.axle_mm with its bearings, or lower stiffness_nmm_per_deg or compression_ratio"
    span = (sum(lateral.left_plate) - sum(lateral.right_plate)) / 2.0
    coil = sum(lateral.spring_left) / 2.0
    arms, cam = case.wound_forces_n
    moment = leg_axle_moment_nmm(arms, cam, span, coil)
    stress = pin_stress_mpa(moment, plan.axle_mm)
    yield _stress("leg_axle_strength", "the leg's axle, wound", stress, case.steel_mpa, remedy)
    at = sum(lateral.cam) / 2.0 - sum(lateral.right_plate) / 2.0
    moment = plan.drive.cam.peak_contact_n * at * (span - at) / span
    stress = pin_stress_mpa(moment, plan.axle_mm)
    yield _stress("cam_axle_strength", "the cam's axle, wound", stress, case.steel_mpa, remedy)
    half = case.torque_nmm / plan.leg_pin_mm / 2.0
    stress = pin_stress_mpa(half * (span / 2.0 - lateral.spring_left[1]), plan.axle_mm)
    yield _stress("spring_pin_strength", "the pin that holds the springs' arms", stress, case.steel_mpa, remedy)
    thickness, lug = plan.sections.thickness_mm, plan.sections.lug_thickness_mm
    lever = lateral.lug_left[0] - thickness / 2.0 + lug / 2.0 + thickness / 4.0
    stress = pin_stress_mpa(max(case.ankle_n, case.front_n, case.landing_n) / 2.0 * lever, plan.axle_mm)
    yield _stress("foot_pin_strength", "the foot's pins", stress, case.steel_mpa, remedy)
    lever = ROLLER_WASHER_MM + (lateral.cam[1] - lateral.cam[0]) / 2.0
    stress = pin_stress_mpa(plan.drive.cam.peak_contact_n * lever, ROLLER_SCREW_CORE_MM)
    allowed = ROLLER_SCREW_YIELD_MPA / case.workshop.safety.steel_factor
    yield _stress("roller_screw_strength", "the roller's screw, wound", stress, allowed, "a narrower bought.roller")


def _bearings(case: _Case) -> Iterator[Finding]:
    """Yield that of the hub's bearings: an overload dents their races but does not stop the robot."""
    hub, cam = case.plan.hub_bearing, case.plan.lateral.cam
    if hub is None:
        return
    (arms, _), push = case.wound_forces_n
    force = bearing_load_n((arms, push), case.plan.sections.thickness_mm, cam[1] - cam[0], hub)
    allowed = allowed_n(hub, case.workshop)
    yield limit(
        "hub_bearing_load", allowed - force, "N",
        f"the {hub.name} at the cam's side of the leg's hub bears {force:.0f} of {allowed:.0f} N, its static rating "
        f"over {case.workshop.safety.bearing_factor:g}",
        'bought.leg_bearing = "any" for a stronger one, or "" for none', "warning",
    )  # fmt: skip


def _seats(case: _Case) -> Iterator[Finding]:
    """Yield those of the plates around axles and pins, and of the cam's key."""
    safety, body = case.workshop.safety, case.workshop.material("body")
    arms, cam = case.wound_forces_n
    worst = max(float(np.linalg.norm(force)) for force in (cam - arms[1], cam, arms[1])) / 2.0
    stress = worst / (case.plan.axle_mm * (case.plan.lateral.left_plate[1] - case.plan.lateral.left_plate[0]))
    allowable = body.strength_in_plane_mpa / safety.strength_factor
    yield _stress("plate_seat", "plates under axles and pins", stress, allowable, "raise body.plate_mm")
    gears = case.workshop.material("gears")
    torque = 1000.0 * case.plan.drive.cam.peak_torque_nm
    bore = case.bores.running(case.plan.axle_mm)
    stress = VON_MISES * tube_shear_mpa(torque, case.plan.sections.key_mm, bore)
    allowable = gears.strength_interlayer_mpa / safety.strength_factor
    remedy = "lower stiffness_nmm_per_deg or compression_ratio, or choose a stronger material for the gears"
    yield _stress("cam_key_strength", "the cam's key, twisted across its layers", stress, allowable, remedy)


def leg_axle_moment_nmm(arms_n: tuple[Array, Array], cam_n: Array, span_mm: float, coil_mm: float) -> float:
    """Return the largest bending moment in the leg's axle, a simple beam between the plates.

    The leg pushes on its middle with arm and cam forces; each coil, `coil_mm` beside it, pushes back with half of
    what its arms bear.
    """
    on_leg, on_pin = arms_n
    support = (cam_n - on_pin) / 2.0
    coil = -(on_leg + on_pin) / 2.0
    middle = support * span_mm / 2.0 - coil * coil_mm
    beside = support * (span_mm / 2.0 - coil_mm)
    return float(max(np.linalg.norm(middle), np.linalg.norm(beside)))
