"""What all engines have in common: a robot at its release, its energies, the ballistic flight, the pad of its stop."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.linkage import Complex
from jumpcad.mechanism.model import BODY_NAMES, Mechanism, Multibody, Spring
from jumpcad.mechanism.planar import points
from jumpcad.mechanism.poses import body_poses
from jumpcad.mechanism.reflected import leg_inertia_kg_m2
from jumpcad.transforms import Array


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
        np.stack([pose[:3, :3] for pose in poses]),
        still,
        still,
        (-mechanism.spring.wind_rad,),
    )


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
        origins: Array = state.com_m - np.einsum("bij,bj->bi", state.rotation, self.com_in_body_m)
        return origins


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
