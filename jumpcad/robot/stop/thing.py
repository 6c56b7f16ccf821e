"""The rest stop's bar between the plates, and the strength of what the leg's impact loads (mm, N, MPa).

The bar is taken as a beam on both plates with the pad's force in its middle, each plate's ear as a cantilever from the
pivots' line, the left one weakened by the hole for the leg's pin, and the leg as a beam on hub and pad whose inertia
acts at the ankle, the farthest that it can. All three print lying, so that the impact bends them along their layers.
The seats of axles and pins that transmit the impact are not checked.
"""

import math
from collections.abc import Iterator

import numpy as np

from jumpcad.dimensions import STOP_PAD_MM, STOP_SEAT_MM
from jumpcad.findings import Basis, Finding, at_most, choose, lower
from jumpcad.mechanism.flight import Blow
from jumpcad.mechanism.model import BODY
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Drawing, Placement
from jumpcad.robot.foot.pads import stop_pad
from jumpcad.robot.layout import Layout
from jumpcad.robot.load_case import LoadCase, load_case, stress_finding
from jumpcad.robot.robot import Check, Robot, Thing
from jumpcad.robot.stop.place import EAR_MM, GIVE_ROOM_RAD, TAB_MM
from jumpcad.solids.outline import Region, hull, rectangle, union
from jumpcad.solids.stack import Stack
from jumpcad.strength.axles import AxleBeam
from jumpcad.strength.loads import BLOW_FACTOR, stop_blow
from jumpcad.strength.stress import CREEP_MPA, Beam
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

END_SHARE = 0.6
"""Depth of the bar at the plates over that in its middle, where the impact bends it most; judgement."""
SEAT_PLAY_MM = 0.2
"""Play of the pad in its seat, either side; judgement."""
GLUE_MM = 0.02
"""Gap between pad and seat."""


def stop_bar(layout: Layout, workshop: Workshop) -> Iterator[Drawing]:
    """Yield the bar: its face towards the leg with the pad's seat, deepest in the middle, a tab through each plate.

    In its printing frame x is the robot's left, y points towards the leg, z along the leg.
    """
    holes = HoleSizes.of(workshop, layout.hub_bearing)
    stop, lateral = layout.stop, layout.lateral
    low, high = lateral.inside
    outer_low, outer_high = lateral.outside
    pad = layout.sections.thickness_mm + 2.0 * SEAT_PLAY_MM
    ends, middle = _box(low, high, -END_SHARE * stop.depth_mm, 0.0), pad / 2.0 + STOP_SEAT_MM
    body = hull([ends, _box(-middle, middle, -stop.depth_mm, 0.0)])
    tabs = _box(outer_low, outer_high, -TAB_MM[1], 0.0)
    seat = _box(-pad / 2.0, pad / 2.0, -STOP_SEAT_MM - GLUE_MM, 1.0)
    shape = Stack.of([(0.0, TAB_MM[0], union([body, tabs]) - seat), (TAB_MM[0], STOP_PAD_MM, body - seat)])
    yield Drawing("stop_bar", "links", holes.chamfered(shape), (Placement(BODY, _pose(layout)),))


def stop_slot(layout: Layout, play_mm: float, edge_mm: float = 0.0) -> Region:
    """Return the slot in a plate for a tab of the bar, or the plate's material around it, grown by an edge."""
    stop = layout.stop
    size = tuple(side + play_mm + 2.0 * edge_mm for side in TAB_MM)
    return rectangle(size).rotate(float(np.degrees(stop.turn_rad))).translate(tuple(stop.tab_mm))


def _pose(layout: Layout) -> Array:
    """Return the pose (4, 4) of the bar's printing frame in the body's frame."""
    stop = layout.stop
    behind, along = stop.behind, stop.along
    x, z = stop.seat_mm - STOP_PAD_MM / 2.0 * along
    return np.array(
        [[0.0, -behind[0], along[0], x], [1.0, 0.0, 0.0, 0.0], [0.0, -behind[1], along[1], z], [0.0, 0.0, 0.0, 1.0]]
    )


def _box(x0: float, x1: float, y0: float, y1: float) -> Region:
    return rectangle((x1 - x0, y1 - y0), ((x0 + x1) / 2.0, (y0 + y1) / 2.0))


PAD_STRAIN = 0.5
"""Largest deflection of a pad over its thickness; judgement: rubber bumpers are compressed to half."""
WEAKER = lower("stiffness_nmm_per_deg", "compression_ratio")
SOFTER = choose("another", "body.stop_pad") + WEAKER

BLOW = "F = 0.82·ω·√(k·I) the pad's peak force, ω and I rate and inertia of the leg at the stop, k the pad's stiffness"
TWICE = "0.82 and twice the peak: judgement; impact: jumpcad/mechanism/flight.py"
BASIS = {
    "stop_strength": Basis(
        "M·h/(2·I) ≤ strength_in_plane_mpa (MPa); M = 2·F·(l - w/2)/4 of a beam between the plates, w the leg's "
        f"thickness; {BLOW}",
        f"beams: Roark, ch. 8; {TWICE}",
    ),
    "stop_plates": Basis(
        f"max(12·s·F·x/(t·w²), 12·s_l·F·y·a/(t·(a³ - d³))) ≤ the body's strength_in_plane_mpa (MPa); t plate, w = "
        f"{EAR_MM:g} mm its ear, s and s_l shares of the force on the more loaded and on the left plate, x from the "
        f"pad to the hub, y from the pad to the end of the hole d nearest to the hub, a hole and edges; {BLOW}",
        f"cantilever: Roark, ch. 8; {TWICE}",
    ),
    "stop_leg": Basis(
        "M·h/(2·I) ≤ strength_in_plane_mpa (MPa); M = 2·F·x·(1 - x/l2), x from the pad to the hub, the leg's inertia "
        f"at the ankle; {BLOW}",
        f"beams: Roark, ch. 8; {TWICE}",
    ),
    "stop_pad": Basis(
        f"ω·√(I/k) ≤ {PAD_STRAIN:g}·thickness (mm), ω and I rate and inertia of the leg at the stop, k the pad's "
        "stiffness",
        "energy of a spring; k: Gent, Engineering with Rubber; limit: judgement",
    ),
    "stop_creep": Basis(
        f"largest of these three stresses, with K·p/x for 2·F ≤ {CREEP_MPA:g} MPa; K stiffness of both springs, p "
        "their preload on the stop, x from the pad to the hub; without a preload nothing is loaded there",
        "printed PLA creeps for months at room temperature: arXiv:2302.11240; limit: judgement",
    ),
    "stop_clearance": Basis(
        f"ω·√(I/k)/x ≤ {math.degrees(GIVE_ROOM_RAD):g}° + clearance/lever (°), x from the pad to the hub; ω, I and k "
        "as in `stop_pad`",
        "energy of a spring; limit: judgement",
    ),
    "free_release": Basis(
        "U_s ≤ E (J); U_s springs' energy from loaded to the stop, all of which meets it where the feet push on "
        "nothing; E energy at which F alone brings a stress of `stop_strength`, `stop_plates` or `stop_leg`, or the "
        "pad, to its limit",
        "conservation of energy and momentum; stresses: as there",
    ),
}
FEET_FIRST = "release it only standing on its feet; the guide says how to slacken it without a jump"


def stop_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `stop_strength`, `stop_plates`, `stop_leg`, `stop_pad`, `stop_clearance`, `free_release`; `stop_creep`."""
    case, blow, stop = load_case(robot), robot.stop_blow, robot.layout.stop
    bar, plates, leg = _stresses_mpa(robot, case, BLOW_FACTOR * blow.force_n, BLOW_FACTOR * blow.torque_nm)
    links, body = (robot.workshop.material(role).strength_in_plane_mpa for role in ("links", "body"))
    ways = choose("a softer", "body.stop_pad") + WEAKER
    yield stress_finding("stop_strength", "the rest stop's bar at twice the impact force", bar, links, ways, "stop")
    yield stress_finding("stop_plates", "plates' ears at twice the impact force", plates, body, ways, "plate")
    yield stress_finding("stop_leg", "main leg at its heel, at twice the impact force", leg, links, ways, "leg")
    if (loaded_rad := robot.spring.preload_rad - stop.angle_rad) > 0.0:
        held_nm = robot.spring.stiffness_nm_per_rad * loaded_rad
        lasting = max(_stresses_mpa(robot, case, 1000.0 * held_nm / stop.radius_mm, held_nm))
        yield at_most(
            "stop_creep", lasting, CREEP_MPA, "MPa",
            f"plates, leg and rest stop under the springs' preload, which lasts: {lasting:.1f} of {CREEP_MPA:g} MPa",
            lower("spring.preload_deg"),
        )  # fmt: skip
    give, room = blow.give_mm, PAD_STRAIN * stop.pad.thickness_mm
    yield at_most(
        "stop_pad", give, room, "mm",
        f"the rest stop's pad is compressed by {give:.2f} mm at {1000.0 * blow.energy_j:.0f} mJ; {room:.2f} mm, "
        f"half of its thickness, are allowed",
        SOFTER,
    )  # fmt: skip
    cam = robot.layout.drive.cam
    free = GIVE_ROOM_RAD + cam.geometry.clearance_mm / cam.geometry.lever_mm
    degrees, room = math.degrees(blow.give_rad), math.degrees(free)
    yield at_most(
        "stop_clearance", degrees, room, "°",
        f"the leg turns {degrees:.1f}° beyond its stop at {math.degrees(stop.angle_rad):.1f}° past rest; the cam "
        f"leaves room for {room:.1f}°",
        choose("a stiffer", "body.stop_pad") + WEAKER,
    )  # fmt: skip
    energy, borne = free_release_j(robot)
    told = f"released with its feet free its stop takes {energy:.2f} J, and bears {borne:.2f} J"
    if energy <= borne:
        yield at_most("free_release", energy, borne, "J", told, FEET_FIRST)
    else:  # a note, since a robot is not released so
        told += ": it stands on its feet at every release, is in no hand, not on its side, not in the air"
        yield Finding("free_release", "info", borne - energy, "J", told, FEET_FIRST, energy)


def free_release_j(robot: Robot) -> tuple[float, float]:
    """Return the energy (J) that the stop takes where the feet push on nothing, all of the springs', and what it bears.

    Force and deflection of a linear pad grow with the root of the energy.
    """
    spring, stop = robot.spring, robot.layout.stop
    rate = stop.pad_n_per_mm(robot.layout.sections.thickness_mm)
    joule = stop_blow(Blow(0.0, math.sqrt(2.0), 1.0), stop.angle_rad, stop.radius_mm, rate)
    strengths = [robot.workshop.material(role).strength_in_plane_mpa for role in ("links", "body", "links")]
    stresses = _stresses_mpa(robot, load_case(robot), joule.force_n, joule.torque_nm)
    use = max(joule.give_mm / (PAD_STRAIN * stop.pad.thickness_mm), *np.divide(stresses, strengths))
    return spring.stored_j(-spring.wind_rad) - spring.stored_j(stop.angle_rad), float(use) ** -2.0


def _stresses_mpa(robot: Robot, case: LoadCase, force_n: float, torque_nm: float) -> tuple[float, float, float]:
    """Return the stress in bar, plates' ears and leg under a force on the pad, and its torque about the leg's joint."""
    stop, sections = robot.layout.stop, robot.layout.sections
    low, high = robot.layout.lateral.inside
    moment = force_n * (high - low - sections.thickness_mm / 2.0) / 4.0
    bar = float(Beam(STOP_PAD_MM, stop.depth_mm - STOP_SEAT_MM, case.shell).stress_mpa(moment))
    plate = robot.layout.lateral.left_plate
    thickness = plate[1] - plate[0]
    left, right = AxleBeam.of(robot.layout.lateral.plates_mm, (0.0, np.array([0.0, force_n]))).on_plates_n()[:, 1]
    ear = float(Beam(thickness, EAR_MM).stress_mpa(max(left, right) * stop.radius_mm))
    share = stop.radius_mm / robot.design.l2_mm
    height = sections.leg_root_mm + share * (sections.leg_tip_mm - sections.leg_root_mm)
    leg = Beam(sections.thickness_mm, height, case.shell).stress_mpa(1000.0 * torque_nm * (1.0 - share))
    return bar, max(ear, float(left) * _at_hole(robot, thickness)), float(leg)


def _at_hole(robot: Robot, thickness_mm: float) -> float:
    """Return the stress (MPa) in the left plate's ear beside the hole for the leg's pin, per newton on the stop's tab.

    The section is the least that the ear has there, the hole and its edges alone; the moment that at the hole's end
    nearest to the hub. The section modulus of a rectangle with a hole in its middle is t·(w³ - d³)/(6·w).
    """
    hole = robot.layout.pin_hole
    reach = max(0.0, robot.layout.stop.radius_mm - robot.layout.leg_pin_mm + hole.diameter_mm / 2.0)
    modulus = thickness_mm * (hole.pad_mm**3 - hole.diameter_mm**3) / (6.0 * hole.pad_mm)
    return reach / modulus


STOP = Thing(stop_bar, stop_pad, (Check(stop_findings, BASIS),))
