"""The gear motor, its socket and cap, and the drive's limits: of synthesis, release, dog, blocked motor (mm, MPa)."""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from jumpcad.dimensions import CAP_HEAD_MM, SOCKET_WALL_MM
from jumpcad.drive import cam_findings, release, spring, spring_choice
from jumpcad.drive import train as gear_train
from jumpcad.findings import Basis, Finding, Severity, at_most, lower
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement, lying_on_right
from jumpcad.parts.purchased import BoughtPart, bought, box_outline, placed_screw
from jumpcad.robot.layout import Layout
from jumpcad.robot.load_case import INTERLAYER, load_case, stress_finding
from jumpcad.robot.robot import Check, Robot, Thing
from jumpcad.robot.train.drawing import cam, gear_turns, gears
from jumpcad.solids.outline import Region, disc, filleted, hole, hull, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.transforms import pose_about_z
from jumpcad.workshop import Workshop

ROUND_OFF = 1e-6
BASIS = {
    "cam_dog_strength": Basis(
        f"max(√(σ² + 3·τ²) of a jaw, √3·16·T·D/(π·(D⁴ - d⁴)) of its boss) ≤ the gears' {INTERLAYER}; T larger of "
        "the cam's torque and the blow at the end of the dog's play; σ = 3·F·L/(b·h²), τ = 1.5·F/(b·h), F = "
        "T/(2·mean radius)",
        "bending, transverse shear, torsion: Shigley 3-10 to 3-12; blow: jumpcad/drive/dog.py",
    ),
    **spring.BASIS,
    **cam_findings.BASIS,
    **gear_train.BASIS,
    **release.BASIS,
    **spring_choice.BASIS,
}


def drive_findings(robot: Robot) -> Iterator[Finding]:
    """Yield the drive's findings; `spring_stress`, `cam_*`, `gear_*`, `motor_*`, `release_*` by what they limit."""
    for found in (*robot.layout.drive.findings, *robot.release.findings):
        failed: Severity = "warning" if found.severity == "warning" else "error"  # of what wears
        margin = 0.0 if abs(found.margin) < ROUND_OFF else found.margin  # the cam's search ends on its limits
        yield replace(found, margin=margin, severity="info" if margin >= 0.0 else failed)
    case, gears = load_case(robot), robot.workshop.material("gears")
    stress = case.dog_stress_mpa(max(robot.layout.drive.cam.law.peak_torque_nm, robot.release.blow_nm))
    allowable = gears.strength_interlayer_mpa / robot.workshop.safety.printed_factor
    ways = (*lower("stiffness_nmm_per_deg", "compression_ratio"), "choose a stronger material for the gears")
    what = "the cam's dog, across its layers at release"
    yield stress_finding("cam_dog_strength", what, stress, allowable, ways, "dog")


BLOCKED_FACTOR = 1.5
"""Factor of safety of printed parts; judgement: less than for every jump, since a motor is blocked by a fault alone."""
TORQUE = "T stall torque on a full battery under the firmware's PWM times the ratio, without losses"
WEAKER = "a weaker motor, a battery of fewer cells, or a stronger material for the gears"
BLOCKED_BASIS = {
    "gear_blocked": Basis(
        f"largest F/(b·m·Y) of the pairs ≤ the gears' strength_in_plane_mpa/{BLOCKED_FACTOR:g} (MPa); {TORQUE} up to "
        "the pair, others as of `gear_strength_*`",
        "Lewis (Shigley 14-1); factor: judgement",
    ),
    "cam_dog_blocked": Basis(
        f"stress as of `cam_dog_strength` ≤ the gears' strength_interlayer_mpa/{BLOCKED_FACTOR:g} (MPa); {TORQUE}",
        "Shigley 3-10 to 3-12; factor: judgement",
    ),
}


def blocked_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `gear_blocked` and `cam_dog_blocked`."""
    case, gears_used = load_case(robot), robot.layout.drive.train
    supply, allowed = robot.supply, robot.workshop.safety.motor_torque_max_nm
    torque = supply.driven(gears_used.motor, supply.full_v, allowed).stall_torque_nm
    gears, worst = robot.workshop.material("gears"), 0.0
    for pair in gears_used.stages:
        worst = max(worst, pair.pinion.lewis_stress_mpa(torque))
        torque *= pair.ratio
    dog = case.dog_stress_mpa(torque)
    for name, what, stress, strength in (
        ("gear_blocked", "teeth of the gears", worst, gears.strength_in_plane_mpa),
        ("cam_dog_blocked", "the cam's dog", dog, gears.strength_interlayer_mpa),
    ):
        allowed = strength / BLOCKED_FACTOR
        message = f"{what}, motor blocked: {stress:.1f} of {allowed:.1f} MPa"
        yield at_most(name, stress, allowed, "MPa", message, WEAKER, "warning")


CAP_SCREW_MM = 8.0
"""Length of the M2 screws that hold the motor's cap on the ears of its socket, a stock length; judgement: more thread
in plastic than twice their diameter, through a cap of 2.4 mm."""


def motor(layout: Layout, workshop: Workshop) -> Iterator[BoughtPart]:
    """Yield the gear motor and the screws of its cap; the shaft is turned to fit the pinion."""
    motor, (x, z), catalogue = layout.drive.train.motor, layout.motor_mm, workshop.catalogue
    low, front = layout.lateral.motor
    shaft_mass = catalogue.rod_mass_g(motor.shaft_mm, motor.shaft_length_mm)
    body = [(0.0, front - low, box_outline(motor.width_mm, motor.height_mm))]
    shaft = [(0.0, motor.shaft_length_mm, _d_shaft(motor.shaft_mm, motor.shaft_flat_mm))]
    article, turn = f"gear motor {motor.name}", gear_turns(layout)["motor_pinion"]
    article += f" ({motor.article})" if motor.article else ""
    yield bought("motor", article, BODY, motor.mass_g - shaft_mass, body, (x, low, z), layout.motor_angle_rad)
    yield bought("motor_shaft", article, BODY, shaft_mass, shaft, (x, front, z), turn, units=0)
    screw = catalogue.screws["M2"]
    for number, ear in enumerate(ear_places(layout), start=1):
        top = layout.lateral.motor_cap[1] - screw.button_head_height_mm
        yield placed_screw(f"cap_screw_{number}", BODY, ear, (top - CAP_SCREW_MM, top), 1.0, screw, catalogue)


@lru_cache(maxsize=64)
def _d_shaft(diameter_mm: float, across_flat_mm: float) -> Region:
    flat = rectangle((diameter_mm, 2.0 * diameter_mm)).translate((across_flat_mm, 0.0))
    return disc(diameter_mm) - flat


def ear_places(layout: Layout) -> list[np.ndarray]:
    """Return the two screws (2,) that hold the motor's cap on its socket."""
    across = np.array([-np.sin(layout.motor_angle_rad), np.cos(layout.motor_angle_rad)])
    reach = ear_reach_mm(layout.drive.train.motor.height_mm, layout.cap_ear_mm)
    return [layout.motor_mm + sign * reach * across for sign in (-1.0, 1.0)]


def ear_reach_mm(height_mm: float, ear_mm: float) -> float:
    """Return how far the cap's screws, in the middle of the ears, are from the axis of a motor of some height."""
    return height_mm / 2.0 + SOCKET_WALL_MM + ear_mm / 2.0


def socket_outline(layout: Layout) -> Region:
    """Return the outside of the motor's socket, which its cap shares."""
    motor = layout.drive.train.motor
    turn = float(np.degrees(layout.motor_angle_rad))
    outline = socket_about_axis(motor.width_mm, motor.height_mm, layout.cap_ear_mm)
    return outline.rotate(turn).translate(tuple(layout.motor_mm))


@lru_cache(maxsize=32)
def socket_about_axis(width_mm: float, height_mm: float, ear_mm: float) -> Region:
    """Return the outside of the socket for a motor of some width and height about its axis, ears along y."""
    wall = 2.0 * (SOCKET_WALL_MM + 0.2)
    ears = hull(disc(ear_mm, (0.0, sign * ear_reach_mm(height_mm, ear_mm))) for sign in (-1.0, 1.0))
    return filleted(rectangle((width_mm + wall, height_mm + wall)) + ears, 1.0)


def motor_box(layout: Layout, width_mm: float, height_mm: float) -> Region:
    """Return a rectangle about the motor's axis, turned as the motor is."""
    turn = float(np.degrees(layout.motor_angle_rad))
    return rectangle((width_mm, height_mm)).rotate(turn).translate(tuple(layout.motor_mm))


CAP_HEAD_DEPTH_MM = 1.6


def motor_cap(layout: Layout, workshop: Workshop) -> Drawing:
    """Return the cap that closes the motor's socket in front of the gearbox."""
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    y0, y1 = layout.lateral.motor_cap
    motor = layout.drive.train.motor
    pose = lying_on_right(y0, *layout.motor_mm) @ pose_about_z(-layout.motor_angle_rad)
    boss_mm, screw_mm = holes.running(motor.boss_mm), holes.fits.m2_clearance_mm
    stack = _cap(motor.width_mm, motor.height_mm, layout.cap_ear_mm, boss_mm, y1 - y0, screw_mm)
    return Drawing("motor_cap", "body", stack, (Placement(BODY, pose),))


@lru_cache(maxsize=32)
def _cap(
    width_mm: float, height_mm: float, ear_mm: float, boss_mm: float, thickness_mm: float, screw_mm: float
) -> Stack:
    """Return the cap of a motor about its axis, ears along y, with a hole for its boss and seats for screws' heads."""
    ears = [(0.0, sign * ear_reach_mm(height_mm, ear_mm)) for sign in (-1.0, 1.0)]
    outline = socket_about_axis(width_mm, height_mm, ear_mm) - hole(boss_mm)
    seat = thickness_mm - CAP_HEAD_DEPTH_MM
    screws, heads = (union(hole(diameter, ear) for ear in ears) for diameter in (screw_mm, CAP_HEAD_MM))
    return Stack.of([(0.0, seat, outline - screws), (seat, thickness_mm, outline - heads)])


def drawings(layout: Layout, workshop: Workshop) -> list[Drawing]:
    """Return cam, gears and the motor's cap."""
    return [cam(layout, workshop), *gears(layout, workshop), motor_cap(layout, workshop)]


TRAIN = Thing(drawings, motor, (Check(drive_findings, BASIS), Check(blocked_findings, BLOCKED_BASIS)))
