"""Link loads during push-off and landing (numpy only; N, N·mm, mm).

Until take-off the foot stands on the ground and the mechanism has one degree of freedom, the leg's angle. Legs and
foot are taken as massless beside the body, so that the equation of motion follows from energy alone and every joint
force from equilibrium (inverse dynamics; e.g. Norton, Design of Machinery, ch. 11). Then the leg meets its stop's pad.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.design import Design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.mechanism.flight import Blow
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.mass import MassProperties
from jumpcad.mechanism.model import BODY, Mechanism, Spring, Stop
from jumpcad.transforms import Array, turned_about_y

POSITIONS = 17
"""Leg angles of a push-off; with twice as many, the largest forces of the template designs change by 0.8 % at most."""
TILTING = 1.1
"""Friction losses with a tilting foot and links with mass over those from `push_off`; judgement: with the pins' forces
in the planar engine, up to rest, 1.04 to 1.16 on the templates, 0.74 to 1.16 on 45 printed robots, 1 % of the springs'
energy at most."""


@dataclass(frozen=True)
class PushOffForces:
    """Forces at n leg angles from release to rest; zero from take-off on. Vectors (n, 2) are x-z on a flat foot.

    `ground_n` is the ground's on the foot, `ankle_n` and `front_eye_n` the foot's on main leg and front link;
    `leg_axial_n` and `front_n` are their compression, negative in tension; `residual_n` is the imbalance of forces and
    torques on the body: the error of the finite differences.
    """

    leg_rad: Array
    ground_n: Array
    ankle_n: Array
    front_eye_n: Array
    leg_axial_n: Array
    front_n: Array
    residual_n: Array


def push_off(linkage: Linkage, body: MassProperties, springs: Spring | None = None) -> PushOffForces:
    """Return the forces of a push-off from a flat foot that does not slip; the legs accelerate the body alone.

    With compression δ, mass m, centre of mass c(q), turn t(q), radius of gyration k and J = |c'|² + k² t'², energy
    gives m·J·q̇²/2 = K·((δ + p)² - (q - p)²)/2 - m·g·(rise), and its derivative by q gives q̈; K and the preload p are
    those of the springs, without any the design's.
    """
    design = linkage.design
    leg = np.linspace(*linkage.travel_rad, POSITIONS)
    pose = linkage.pose(leg)
    springs = springs or springs_on_leg(design)
    stiffness, weight = 1000.0 * springs.stiffness_nm_per_rad, body.mass_kg * GRAVITY_M_S2

    def on_foot(point_mm: Array) -> Array:
        return turned_about_y(point_mm - pose.ankle_mm, -pose.foot_rad)

    def by_leg(values: Array) -> Array:
        return np.gradient(values, leg, axis=0, edge_order=2)

    places = linkage.back_pivot_mm, linkage.front_pivot_mm, 1000.0 * body.com_m[[0, 2]]
    hub, front, com = map(on_foot, places)
    first = by_leg(np.column_stack([com, -pose.foot_rad]))
    second = by_leg(first)
    com_1, turn_1, com_2, turn_2 = first[:, :2], first[:, 2], second[:, :2], second[:, 2]
    arm_square = (1000.0 * math.sqrt(body.inertia_kg_m2[1, 1] / body.mass_kg)) ** 2
    reflected = (com_1**2).sum(axis=1) + arm_square * turn_1**2
    loaded = springs.preload_rad - leg
    energy = 0.5 * stiffness * (loaded[0] ** 2 - loaded**2) - weight * (com[:, 1] - com[0, 1])
    speed_square = np.maximum(2.0 * energy, 0.0) / reflected  # times the mass, as is the next
    torque = stiffness * loaded
    reflected_1 = 2.0 * ((com_1 * com_2).sum(axis=1) + arm_square * turn_1 * turn_2)
    acceleration = (torque - weight * com_1[:, 1] - 0.5 * reflected_1 * speed_square) / reflected
    ground = acceleration[:, None] * com_1 + speed_square[:, None] * com_2 + np.array([0.0, weight])
    spin = arm_square * (acceleration * turn_1 + speed_square * turn_2)

    along = hub / design.l2_mm  # from the ankle, which is the origin
    across = np.stack([along[:, 1], -along[:, 0]], axis=-1)
    shear = torque / design.l2_mm
    front_along = (front - np.array([design.l4_mm, 0.0])) / design.l3_mm
    # Two unknown forces, three equations: the third holds automatically, or separates the forces of parallel links.
    arm = design.l1_mm
    columns = [
        np.column_stack([unit, _moment(pivot - com, unit) / arm])
        for unit, pivot in ((along, hub), (front_along, front))
    ]
    unknown = np.stack(columns, axis=-1)
    known = np.column_stack(
        [ground - shear[:, None] * across, (torque + spin - shear * _moment(hub - com, across)) / arm]
    )
    transposed = unknown.transpose(0, 2, 1)
    forces = np.linalg.solve(transposed @ unknown, transposed @ known[..., None])
    axial, front_force = forces[..., 0].T
    residual = np.linalg.norm((unknown @ forces)[..., 0] - known, axis=1)
    ankle = axial[:, None] * along + shear[:, None] * across
    stands = np.cumprod(ground[:, 1] > 0.0).astype(float)
    return PushOffForces(
        leg_rad=leg, ground_n=ground * stands[:, None], ankle_n=ankle * stands[:, None],
        front_eye_n=(front_force * stands)[:, None] * front_along, leg_axial_n=axial * stands,
        front_n=front_force * stands, residual_n=residual * stands,
    )  # fmt: skip


def toe_load_n(forces: PushOffForces, design: Design, foot_depth_mm: float) -> Array:
    """Return the load of both toe tips together (n,), with the foot resting on nose and tips alone."""
    along, up = forces.ground_n.T
    back, _ = toe_reach_mm(design)
    centre_of_pressure = (design.l4_mm * forces.front_eye_n[:, 1] - foot_depth_mm * along) / np.where(up > 0.0, up, 1.0)
    share = np.clip((design.l4_mm - centre_of_pressure) / (design.l4_mm + back), 0.0, 1.0)
    return np.asarray(share * up)


def _moment(arm: Array, force: Array) -> Array:
    """Return the moment (n,) about +y of forces (n, 2) at arms (n, 2), both x-z."""
    return arm[:, 1] * force[:, 0] - arm[:, 0] * force[:, 1]


def reflected_share(arm_mm: tuple[float, float], gyration_mm: tuple[float, float]) -> float:
    """Return the effective share of a body's mass in a vertical impact at arms x, y from its centre of mass.

    The body turns away from the impact: 1/(1 + (x/k_y)² + (y/k_x)²) with the radii of gyration (k_x, k_y) about x and y
    (centre of percussion; e.g. Meriam and Kraige, Dynamics, 6/8).
    """
    return 1.0 / (1.0 + (arm_mm[0] / gyration_mm[1]) ** 2 + (arm_mm[1] / gyration_mm[0]) ** 2)


def toe_moment_nmm(design: Design, toes_n: float) -> float:
    """Return the moment at the root of one toe when both tips carry a force together."""
    return 0.5 * toes_n * design.l5_mm


def rail_moment_nmm(design: Design, toes_n: float) -> float:
    """Return the moment in one of the two rails at the ankle when both toe tips carry a force together."""
    return 0.5 * toes_n * toe_reach_mm(design)[0]


def rail_twist_nmm(design: Design, toes_n: float, rail_mm: float) -> float:
    """Return the torque in one of the two rails at the ankle when both toe tips carry a force together.

    It is that of the tip's force about the rail's middle, `rail_mm` from that of the robot: the web before the ankle
    leads it to the other rail, whose toe turns the other way.
    """
    return 0.5 * toes_n * max(0.0, toe_reach_mm(design)[1] - rail_mm)


def toe_reach_mm(design: Design) -> tuple[float, float]:
    """Return how far behind the ankle and how far from the middle a toe's tip is."""
    x, y = toe_tip_mm(design)
    return -float(x), float(y)


def pin_torque_nm(mechanism: Mechanism, coefficient: float) -> float:
    """Return the constant torque at the leg joint that dissipates as much as all pins in a push-off (N·m).

    Rounded to 1 µN·m: it is written into files, and the forces come from linear algebra.

    The work of coefficient · radius · force along the turn of each pin is divided by the springs' travel. The forces
    are those of `push_off`, for which legs and foot have no mass, times `TILTING`.
    """
    friction = mechanism.friction
    if friction is None or coefficient == 0.0:
        return 0.0
    linkage = mechanism.linkage
    loads = push_off(linkage, mechanism.bodies[BODY], mechanism.spring)
    leg, front, ankle, eye = friction.pin_radius_m
    foot_rate, front_rate = linkage.turning(loads.leg_rad)
    on_leg, on_front = np.hypot(*loads.ankle_n.T), np.abs(loads.front_n)
    torque = on_leg * (leg + ankle * np.abs(foot_rate - 1.0))
    torque += on_front * (front * np.abs(front_rate) + eye * np.abs(front_rate - foot_rate))
    return round(TILTING * coefficient * float(np.trapezoid(torque, loads.leg_rad)) / mechanism.spring.wind_rad, 6)


BLOW_FACTOR = 2.0
"""Safety factor on the peak force, against the material's strength; judgement: the force is computed without
friction."""
PEAK_SHARE = 0.82
"""Peak force of a pad without rebound over that of a lossless spring; judgement, from computed blows of three
templates."""


@dataclass(frozen=True)
class StopBlow:
    """The impact of the leg on its stop.

    `energy_j` is the energy that the pad absorbs, `torque_nm` the peak torque about the leg's joint, `force_n` the peak
    force on the pad, `give_rad` and `give_mm` the pad's deflection, that of a lossless spring of its stiffness.
    """

    stop: Stop
    energy_j: float
    torque_nm: float
    force_n: float
    give_rad: float
    give_mm: float


def stop_blow(blow: Blow, angle_rad: float, radius_mm: float, pad_n_per_mm: float) -> StopBlow:
    """Return the impact on a pad of some stiffness at a radius from the leg's joint: F = 0.82·v·sqrt(k·I)/r."""
    radius = radius_mm / 1000.0
    stiffness = 1000.0 * pad_n_per_mm * radius**2
    torque = PEAK_SHARE * blow.stop_rad_s * math.sqrt(stiffness * blow.inertia_kg_m2)
    give = blow.stop_rad_s * math.sqrt(blow.inertia_kg_m2 / stiffness)
    return StopBlow(
        Stop("leg", angle_rad, stiffness), blow.energy_j, torque, torque / radius, give, 1000.0 * give * radius
    )
