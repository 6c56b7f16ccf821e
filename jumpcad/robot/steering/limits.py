"""The steering wheel: what it does to a crouching robot, where it touches, and landings on it (mm, N, N·m, °)."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.dimensions import GRAVITY_M_S2, PAD_WALL_MM
from jumpcad.drive.motor import EMPTY_SHARE, free_speed_rad_s
from jumpcad.findings import Basis, Finding, at_least, at_most, choose, higher, lower
from jumpcad.mechanism.linkage import toe_tip_mm
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.cage.limits import FALLS
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.robot.steering.place import LEAST_MM, SLOT_EDGE_MM, TAB_MM, Steering
from jumpcad.transforms import Array, chained, direction, in_metres

TURN_DEG = 90.0
"""Turn whose energy is a figure."""
ROUGHEST = 1.2
"""Largest friction of rubber on a floor; judgement: on dry concrete up to 1.0."""
GRIP = 1.5
"""Least grip of the wheel over what it needs; judgement."""
LEAN_DEG = 2.0
"""Largest lean onto one toe: simulated, at 1.7° the worst of 32 own landings of `best-steered` is as without the wheel,
at 2.4° one toe's push rolls it onto its cage's side."""
GIVEN, POSITIONS = 20.0, 200
"""Largest share of the springs' energy (%) that is given before the wheel is in the air; judgement: the foot stands
still until then. Leg angles at which that is looked at."""
WIDE_MM = TAB_MM + 2.0 * SLOT_EDGE_MM
"""Width of the mount's base and of the plates' tails."""
SHARE = 0.3
"""Of the falling energy, that a blow on the wheel brings; judgement: none of 460 simulated landings of robots with a
cage that reaches behind the wheel touched it."""
BASIS = {
    "steering_touch": Basis(
        f"dip - miss ≥ {LEAST_MM:g} mm; dip of the wheel's rim below the feet's plane, springs loaded; miss = rise of "
        "the wheel where the motor stops at the sensor's earliest, + rise for the lever's bending F·L²/(3·E·I), + "
        "safety.room_reserve_mm",
        f"geometry; Shigley, table A-9; limit: simulated, at {LEAST_MM:g} mm a soft floor begins to let it slip",
    ),
    "steering_stands": Basis(
        "share of the weight on the toe to which the robot leans ≥ 0 %, by dip·(eye to toe)/(eye to wheel)/"
        "(half width of the toes); its other supports are that edge of the nose and the wheel, which rolls below its "
        "axle",
        "statics of three supports",
    ),
    "steering_lean": Basis(
        f"lean onto that toe ≤ {LEAN_DEG:g}°: released, one toe pushes, and the robot rolls in its flight",
        "statics of three supports; limit: simulated landings",
    ),
    "steering_air": Basis(
        f"share of the springs' energy given until the wheel is above the feet's plane ≤ {GIVEN:g} %, the foot flat; "
        "100 % where it comes below it again up to the rest stop",
        "geometry; limit: judgement",
    ),
    "steering_torque": Basis(
        f"{ROUGHEST:g}·W·R ≤ min(torque_max_nm of the motor, {EMPTY_SHARE:g}·T_stall) on an empty battery (N·m), W the "
        "wheel's load: no floor asks for more, since it slips there",
        f"friction; {ROUGHEST:g}: judgement",
    ),
    "steering_grip": Basis(
        f"W·lever/(T·d + E·r) ≥ {GRIP:g}; loads W, T, E of wheel, toe and front eye, d from the eye to the toe, r half "
        "width of the nose: on any floor the wheel grips, and toe and nose slide",
        "dry friction, the same at all three; limit: judgement",
    ),
    "steering_mount": Basis(
        "√(σ² + 3·τ²) ≤ strength_in_plane_mpa/s of the body (MPa); σ = 3·F·x/(w·h²), x from the mount's walls to a "
        f"plate, τ = 1.5·F·y/(w·h²), y from the wheel to the tabs' middle, w = {WIDE_MM:g} mm, h = steering.base_mm; "
        f"F = m·g + {SHARE:g}·2·U/3/safety.landing_stop_mm",
        "bending and torsion: Shigley 3-10, 3-12; share: judgement, simulated landings",
    ),
    "steering_tail": Basis(
        "3·F·x/(w·t²) ≤ strength_in_plane_mpa/s of the body (MPa), two tails of the plates that bend sideways: F "
        "friction of a landing as in `steering_mount`, x from around the leg's axle to the tabs, w as there",
        "cantilever: Roark, ch. 8",
    ),
    "steering_supply": Basis(
        "an empty battery's voltage ≥ lowest voltage of the motor (V); 0 without two free pins of the controller and a "
        "second bridge of the driver",
        "data sheet; net list",
    ),
}


@dataclass(frozen=True)
class Steers:
    """What the wheel does on the workshop's floor with a battery of nominal voltage.

    `loads_n` (3,) are those of front eye, wheel and toe, `toes` the sides of that toe and the other, `lean_deg` how far
    the robot leans to it, `grip` the wheel's over what it needs, `need_nm` its torque. Of the motor, `gears_nm` is what
    its gears bear, `empty_nm` what it may give on an empty battery of `empty_v`, `stall_nm` and `free_rad_s` are its
    line of torque and speed.
    """

    loads_n: Array
    toes: tuple[str, str]
    lean_deg: float
    grip: float
    need_nm: float
    gears_nm: float
    empty_nm: float
    empty_v: float
    stall_nm: float
    free_rad_s: float
    power_w: float
    margin_mm: float
    turn_per_rev_deg: float

    @property
    def figures(self) -> dict[str, float]:
        """Its figures by name; the energy of a turn is infinite where the floor stalls the motor."""
        speed_rad_s = self.free_rad_s * max(0.0, 1.0 - self.need_nm / self.stall_nm)
        rate = self.turn_per_rev_deg * speed_rad_s / (2.0 * math.pi)
        return {
            "turn_per_rev_deg": self.turn_per_rev_deg,
            "steering_rate_deg_s": rate,
            "steering_margin_mm": self.margin_mm,
            "turn_energy_j": self.power_w * TURN_DEG / rate if rate > 0.0 else math.inf,
        }


@decided_once
def steers(robot: Robot) -> Steers:
    """Return what a robot's wheel does; it has one."""
    place, layout, supply = robot.layout.of(Steering), robot.layout, robot.supply
    assert place is not None
    ahead, aside, height = _centre_mm(robot, place)
    lever, half_width, middle = place.lever_mm, layout.toe_half_width_mm, float(place.T_body_axle[1, 3])
    toe_x = layout.design.l4_mm - float(toe_tip_mm(layout.design)[0])  # behind the front eye
    side = math.copysign(1.0, aside - middle * (lever - ahead) / lever)  # of the line from eye to wheel
    lean = place.dip_mm * toe_x / lever / half_width
    nose = layout.lateral.lug_left[1]  # on whose edge it leans; the wheel rolls sideways below its axle
    places = [[1.0, 1.0, 1.0], [0.0, lever, toe_x], [side * nose, middle, side * half_width]]
    aside += side * (height - place.radius_mm) * lean
    weight = robot.mass_kg * GRAVITY_M_S2
    loads: Array = np.asarray(weight * np.linalg.solve(places, [1.0, lever - ahead, aside]), dtype=float)
    slides = max(float(loads[2]), 0.0) * math.hypot(toe_x, half_width) + float(loads[0]) * nose
    need = robot.workshop.ground.foot_friction * slides / lever * place.radius_mm / 1000.0
    gears = place.motor.torque_max_nm or robot.workshop.safety.motor_torque_max_nm
    # a wheel that is blocked slips, so that its gears do not limit the voltage
    driven, empty = (supply.driven(place.motor, volts, math.inf) for volts in (supply.nominal_v, supply.empty_v))
    rise = (driven.stall_current_a - driven.no_load_current_a) / driven.stall_torque_nm
    return Steers(
        loads, ("left", "right") if side > 0.0 else ("right", "left"), math.degrees(lean),
        float(loads[1]) * lever / slides, need, gears, min(gears, EMPTY_SHARE * empty.stall_torque_nm),
        empty.voltage_v, driven.stall_torque_nm, free_speed_rad_s(driven),
        supply.nominal_v * (driven.no_load_current_a + rise * need) + supply.boards_w,
        place.dip_mm - place.miss_mm, place.turn_per_rev_deg,
    )  # fmt: skip


def _centre_mm(robot: Robot, place: Steering) -> tuple[float, float, float]:
    """Return the loaded robot's centre of mass: ahead of the wheel, to the left, above the ground."""
    poses = body_poses(robot, 1.0)
    whole = combined(
        MassProperties(body.mass_kg, body.com_m, body.inertia_kg_m2).placed(poses[name])
        for name, body in robot.bodies.items()
    )
    wheel = chained(poses["body"], in_metres(place.T_body_axle))[:3, 3]
    ahead, aside, height = 1000.0 * (whole.com_m - wheel * (1.0, 0.0, 0.0))
    return float(ahead), float(aside), float(height)


def steering_findings(robot: Robot) -> Iterator[Finding]:
    """Yield the limits of a wheel; nothing without one."""
    if (place := robot.layout.of(Steering)) is None:
        return
    found, motor = steers(robot), place.motor
    yield at_least(
        "steering_touch", found.margin_mm, LEAST_MM, "mm",
        f"the wheel reaches {place.dip_mm:.1f} mm below the feet's plane with loaded springs, and cam, lever and print "
        f"may miss {place.miss_mm:.1f} mm; {LEAST_MM:g} mm must be left",
        higher("steering.dip_mm"),
    )  # fmt: skip
    shares = 100.0 * found.loads_n / found.loads_n.sum()
    yield at_least(
        "steering_stands", float(shares[2]), 0.0, "%",
        f"on its wheel it leans by {found.lean_deg:.1f}°; nose, wheel and toe bear {shares[0]:.0f}, {shares[1]:.0f} "
        f"and {shares[2]:.1f} % of the weight; below 0 both toes lift, and it stands on nose and wheel",
        higher("steering.aside_mm", "steering.dip_mm"), "warning",
    )  # fmt: skip
    yield at_most(
        "steering_lean", found.lean_deg, LEAN_DEG, "°",
        f"on its wheel it leans by {found.lean_deg:.1f}°; released, one toe pushes more than the other",
        (*higher("body.toe_half_width_mm"), "let it land on grass, a mat or a carpet"), "warning",
    )  # fmt: skip
    yield _air(robot, place)
    most = ROUGHEST * float(found.loads_n[1]) * place.radius_mm / 1000.0
    yield at_most(
        "steering_torque", most, found.empty_nm, "N·m",
        f"a wheel that slips on the roughest floor needs {1000.0 * most:.1f} mN·m, on this one "
        f"{1000.0 * found.need_nm:.1f}; {motor.name} may give {1000.0 * found.empty_nm:.1f} on an empty battery",
        choose("a stronger", "steering.motor") + lower("steering.radius_mm"),
    )  # fmt: skip
    yield at_least(
        "steering_grip", found.grip, GRIP, "",
        f"the wheel grips with {found.grip:.1f} times the force at which toe and nose slide; {GRIP:g} are needed",
        lower("steering.dip_mm") + higher("steering.behind_mm"),
    )  # fmt: skip
    yield from _blow(robot, place)
    wired = {"steering+", "steering-"} <= {net.name for net in robot.wiring.nets}
    yield at_least(
        "steering_supply", found.empty_v if wired else 0.0, motor.range_v[0], "V",
        f"{motor.name} gets {found.empty_v:.2f} V from an empty battery and needs {motor.range_v[0]:g}"
        if wired
        else "the wheel's motor needs a second bridge of the driver and two free pins of the controller",
        choose("another", "steering.motor", "bought.driver", "bought.controller"),
    )  # fmt: skip


def _air(robot: Robot, place: Steering) -> Finding:
    """Return whether the wheel leaves the feet's plane early in the push-off, and for good."""
    linkage, spring = robot.linkage, robot.spring
    leg = np.linspace(linkage.travel_rad[0], robot.layout.stop.reach_rad, POSITIONS)
    pose = linkage.pose(leg)
    up = direction(pose.foot_rad - math.pi / 2.0)
    height = np.einsum("ni,ni->n", place.T_body_axle[[0, 2], 3] - pose.ankle_mm, up) + robot.layout.sections.ground_mm
    leans = up @ place.T_body_axle[[0, 2], 0]
    lowest = height - place.radius_mm * np.sqrt(1.0 - leans**2) - place.half_width_mm * np.abs(leans)
    given = np.array([100.0 * (1.0 - max(spring.stored_j(one), 0.0) / spring.energy_j) for one in leg.tolist()])
    share, later = float(given[np.argmax(lowest > 0.0)]), float(lowest[given > GIVEN].min())
    return at_most(
        "steering_air", share if later > 0.0 else 100.0, GIVEN, "%",
        f"the springs give {share:.1f} % of their energy before the wheel is above the feet's plane; {GIVEN:g} % are "
        f"allowed, from when on it stays {later:.1f} mm above it",
        lower("steering.dip_mm") + higher("steering.behind_mm"),
    )  # fmt: skip


def _blow(robot: Robot, place: Steering) -> Iterator[Finding]:
    """Yield what mount and plates bear of a landing on the wheel."""
    layout, shop = robot.layout, robot.workshop
    energy_nmm = 1000.0 * SHARE * FALLS * robot.spring.energy_j
    force = robot.mass_kg * GRAVITY_M_S2 + energy_nmm / shop.safety.landing_stop_mm
    allowed = shop.material("body").strength_in_plane_mpa / shop.safety.printed_factor
    aside = abs(float(place.T_body_axle[1, 3]) - sum(layout.lateral.inside) / 2.0)
    beside = float(np.ptp(layout.lateral.inside)) / 2.0 + aside - place.half_mount_mm
    bends, twists = 3.0 * force * beside, 1.5 * force * sum(place.cradle_x_mm) / 2.0
    stress = math.hypot(bends, math.sqrt(3.0) * twists) / (WIDE_MM * place.base_mm**2)
    yield at_most(
        "steering_mount", stress, allowed, "MPa",
        f"the mount under {force:.0f} N of a landing on the wheel: {stress:.1f} of {allowed:.1f} MPa",
        higher("steering.base_mm") + choose("a stronger", "roles.body"),
    )  # fmt: skip
    plate = float(np.ptp(layout.lateral.left_plate))
    long = float(np.linalg.norm(place.tab_mm - layout.hub_mm)) - layout.axle_mm / 2.0 - PAD_WALL_MM
    stress = 3.0 * shop.ground.foot_friction * force * long / (WIDE_MM * plate**2)
    yield at_most(
        "steering_tail", stress, allowed, "MPa",
        f"the plates' tails, {long:.0f} mm long, where the wheel lands sideways: {stress:.1f} of {allowed:.1f} MPa",
        ("let it land on grass, a mat or a carpet", *higher("body.plate_mm")), "warning",
    )  # fmt: skip
