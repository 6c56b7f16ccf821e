"""What all engines have in common: a robot at its release, its energies, the ballistic flight, the pad of its stop."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from jumpcad.mechanism.linkage import Complex
from jumpcad.mechanism.model import BODY_NAMES, Mechanism, Multibody, Spring, body_poses
from jumpcad.mechanism.planar import leg_inertia_kg_m2, points
from jumpcad.transforms import Array

AIR_KG_M3 = 1.2
"""Density of air at 20 °C and 1013 hPa (ISO 2533 gives 1.225 at 15 °C)."""
TOLERANCE = 1e-9
"""Of the integration: relative, and in m and m/s."""


@dataclass(frozen=True)
class Ballistics:
    """The flight of a centre of mass from its place at release, through take-off, back to the height of release.

    `place_m` gives where it is, x + iz (n,), at times (n,) after take-off, until `deepest_s`, when it is far below the
    ground.
    """

    range_m: float
    rise_m: float
    speed_m_s: float
    angle_deg: float
    place_m: Callable[[Array], Complex] = field(compare=False)
    deepest_s: float


def drag_per_m(drag_area_m2: float, mass_kg: float) -> float:
    """Return the deceleration by air over the square of speed: ½·ρ·c_d·A/m."""
    return 0.5 * AIR_KG_M3 * drag_area_m2 / mass_kg


def drag_m_s2(velocity_m_s: Array, per_m: float) -> Array:
    """Return the acceleration (3,) or (2,) by quadratic drag."""
    return np.asarray(-per_m * float(np.linalg.norm(velocity_m_s)) * velocity_m_s)


def ballistics(
    start_m: Array, takeoff_m: Array, velocity_m_s: Array, gravity_m_s2: float, per_m: float = 0.0, below_m: float = 0.0
) -> Ballistics:
    """Return the ballistic flight of a centre of mass, with places (3,) at release and take-off, there rising.

    `per_m` is that of `drag_per_m`, `below_m` how far below the ground the height is wanted. The range runs along x
    from release to where the centre of mass falls through its height at release; the rise is that of the apex above
    that height. A centre of mass that leaves lower than it started and too slowly does not come back to that height: it
    lands at its apex.
    """
    forward, up = float(velocity_m_s[0]), float(velocity_m_s[2])
    before, lift = float(takeoff_m[0] - start_m[0]), float(takeoff_m[2] - start_m[2])
    height, place = float(takeoff_m[2]), complex(takeoff_m[0], takeoff_m[2])
    speed, angle = float(np.linalg.norm(velocity_m_s)), math.degrees(math.atan2(up, forward))

    def fall_s(drop_m: float) -> float:
        """Return the time without air from take-off until the centre has fallen below it by a drop."""
        return (up + math.sqrt(max(up**2 + 2.0 * gravity_m_s2 * drop_m, 0.0))) / gravity_m_s2

    if per_m == 0.0:
        rise = lift + up**2 / (2 * gravity_m_s2)
        time = (up + math.sqrt(max(2 * gravity_m_s2 * rise, 0.0))) / gravity_m_s2
        return Ballistics(
            before + forward * time, rise, speed, angle,
            lambda at: place + forward * at + 1j * (up * at - 0.5 * gravity_m_s2 * at**2), fall_s(height + below_m),
        )  # fmt: skip
    from scipy.integrate import solve_ivp

    def rates(_time: float, state: Array) -> Array:
        return np.concatenate([state[2:], drag_m_s2(state[2:], per_m) - np.array([0.0, gravity_m_s2])])

    def apex(_time: float, state: Array) -> float:
        return float(state[3])

    def back(_time: float, state: Array) -> float:
        return float(state[1] + lift) if state[3] < 0.0 else 1.0

    def deep(_time: float, state: Array) -> float:
        return float(state[1] + height + below_m)

    deep.terminal, deep.direction = True, -1.0  # type: ignore[attr-defined]
    longest = 4.0 * fall_s(height + below_m) + 4.0  # falling through air takes longer than without
    found = solve_ivp(
        rates, (0.0, longest), [0.0, 0.0, forward, up], rtol=TOLERANCE, atol=TOLERANCE, dense_output=True,
        events=(apex, back, deep),
    )  # fmt: skip
    top = found.sol(found.t_events[0][0]) if len(found.t_events[0]) else np.array([0.0, 0.0])
    down = found.sol(found.t_events[1][0]) if lift + top[1] > 0.0 and len(found.t_events[1]) else top
    return Ballistics(
        before + float(down[0]), lift + float(top[1]), speed, angle,
        lambda at: place + found.sol(at)[0] + 1j * found.sol(at)[1], float(found.t[-1]),
    )  # fmt: skip


@dataclass(frozen=True)
class State:
    """Where the bodies are and how they move, in the world, in the mechanism's `order`.

    `com_m` (b, 3), `rotation` (b, 3, 3) from body to world, `velocity_m_s` (b, 3) of the centres of mass,
    `angular_rad_s` (b, 3), and the coordinates of the joints with springs: of a five-bar the leg's.
    """

    com_m: Array
    rotation: Array
    velocity_m_s: Array
    angular_rad_s: Array
    spring_rad: tuple[float, ...]

    @property
    def leg_rad(self) -> float:
        """The coordinate of a five-bar's leg joint."""
        return self.spring_rad[0]


def loaded_state(mechanism: Mechanism) -> State:
    """Return the state of a robot that stands still with its springs loaded."""
    placed = body_poses(mechanism, 1.0)
    poses = [placed[name] for name in BODY_NAMES]
    com = [mechanism.bodies[name].com_m for name in BODY_NAMES]
    still = np.zeros((len(poses), 3))
    return State(
        np.stack([pose[:3, 3] + np.einsum("ij,j->i", pose[:3, :3], at) for pose, at in zip(poses, com, strict=True)]),
        np.stack([pose[:3, :3] for pose in poses]), still, still, (-mechanism.spring.wind_rad,),
    )  # fmt: skip


Points = Mapping[str, tuple[Complex, Array]]
"""Points of bodies, x + iz (k,) in their frames, with the radii (k,) of what is round about them."""


def surface(mechanism: Multibody) -> Points:
    """Return the corners of the parts' outlines; of a robot without parts its contact spheres.

    A robot that is no five-bar may have given them to its foot alone: its hinges count too.
    """
    if mechanism.outline_m:
        return {name: (corners, np.zeros(len(corners))) for name, corners in mechanism.outline_m.items()}
    touching = {
        name: [(one.centre_m, one.radius_m) for one in body.contacts] for name, body in mechanism.bodies.items()
    }
    if not isinstance(mechanism, Mechanism):
        hinges = [(joint.parent, joint.origin_m) for joint in mechanism.joints]
        for name, at_m in (*hinges, *((loop.body_a, loop.point_a_m) for loop in mechanism.loops)):
            touching[name].append((at_m, 0.0))
    return {
        name: (points(np.array([at[[0, 2]] for at, _ in found])), np.array([radius for _, radius in found]))
        for name, found in touching.items()
        if found
    }


@dataclass(frozen=True)
class Energies:
    """Mechanical energy (J): potential is that of height above z = 0, `spring_j` that above the springs' at rest."""

    kinetic_j: float
    potential_j: float
    spring_j: float

    @property
    def total_j(self) -> float:
        """Their sum (J)."""
        return self.kinetic_j + self.potential_j + self.spring_j


class Mechanics:
    """Energies, centre of mass, loops' gap and clearance of one robot under one gravity, from its state."""

    def __init__(self, mechanism: Multibody, gravity_m_s2: float) -> None:
        order = mechanism.order
        bodies = [mechanism.bodies[name] for name in order]
        self.mass_kg = np.array([body.mass_kg for body in bodies])
        self.total_mass_kg = float(self.mass_kg.sum())
        self.weight_n = self.total_mass_kg * gravity_m_s2
        self.inertia_kg_m2 = np.stack([body.inertia_kg_m2 for body in bodies])
        self.com_in_body_m = np.stack([body.com_m for body in bodies])
        self._springs = mechanism.springs
        self._surface = [(order.index(name), *around) for name, around in surface(mechanism).items()]
        self._loops = [
            [(order.index(loop.body_a), loop.point_a_m - mechanism.bodies[loop.body_a].com_m),
             (order.index(loop.body_b), loop.point_b_m - mechanism.bodies[loop.body_b].com_m)]
            for loop in mechanism.loops
        ]  # fmt: skip
        self._spheres = [
            (index, contact.centre_m - body.com_m, contact.radius_m)
            for index, body in enumerate(bodies)
            for contact in body.contacts
        ]

    def centre_of_mass_m(self, state: State) -> Array:
        """Return the robot's centre of mass (3,)."""
        return self.mass_kg @ state.com_m / self.total_mass_kg

    def velocity_m_s(self, state: State) -> Array:
        """Return the velocity of the robot's centre of mass (3,)."""
        return self.mass_kg @ state.velocity_m_s / self.total_mass_kg

    def energies(self, state: State) -> Energies:
        """Return the robot's mechanical energies."""
        spin = np.einsum("bji,bj->bi", state.rotation, state.angular_rad_s)
        linear = (self.mass_kg @ (state.velocity_m_s * state.velocity_m_s)).sum()
        angular = np.einsum("bi,bij,bj->", spin, self.inertia_kg_m2, spin)
        height = float(self.centre_of_mass_m(state)[2])
        return Energies(
            0.5 * float(linear + angular),
            self.weight_n * height,
            math.fsum(map(Spring.stored_j, self._springs, state.spring_rad)),
        )

    def loop_gap_m(self, state: State) -> float:
        """Return by how far the two sides of a loop have come apart, at most."""
        ends = ([state.com_m[at] + state.rotation[at] @ arm_m for at, arm_m in loop] for loop in self._loops)
        return max((math.dist(*both) for both in ends), default=0.0)

    def clearance_m(self, state: State) -> float:
        """Return the distance of the lowest contact sphere from the ground."""
        return min(
            float(state.com_m[index, 2] + state.rotation[index, 2] @ arm_m) - radius_m
            for index, arm_m, radius_m in self._spheres
        )

    def lowest_m(self, state: State) -> float:
        """Return the height of the lowest point of all parts, taken to lie in the leg's plane."""
        heights = []
        for index, at, radius_m in self._surface:
            x, y, z = self.com_in_body_m[index]
            up = state.rotation[index, 2]
            heights.append(
                state.com_m[index, 2] + np.min((at.real - x) * up[0] + (at.imag - z) * up[2] - radius_m) - y * up[1]
            )
        return float(min(heights))

    def frame_positions_m(self, state: State) -> Array:
        """Return the origins (b, 3) of the bodies' frames."""
        return np.asarray(state.com_m - np.einsum("bij,bj->bi", state.rotation, self.com_in_body_m))


class StopPad:
    """The torque of a mechanism's stop on its leg joint, step by step; of one without a stop, none.

    A limit with critical damping, which MuJoCo has, throws the leg back at an eighth of its speed: more momentum on the
    foot, which decides whether a robot that tips over its nose leaves the ground.
    """

    def __init__(self, mechanism: Mechanism, dt_s: float) -> None:
        stop = mechanism.stop
        self._from_rad = stop.angle_rad if stop else math.inf
        self._nm_per_rad = stop.stiffness_nm_per_rad if stop else 0.0
        self._halting_nms = leg_inertia_kg_m2(mechanism, stop.angle_rad) / dt_s if stop else 0.0
        self._spring = mechanism.spring

    def torque_nm(self, leg_rad: float, leg_rad_s: float) -> float:
        """Return the torque against the leg's opening: no more than brings it to a standstill within a step."""
        if leg_rad <= self._from_rad:
            return 0.0
        halting = self._halting_nms * leg_rad_s + self._spring.torque_nm(leg_rad)
        return max(min(self._nm_per_rad * (leg_rad - self._from_rad), halting), 0.0)
