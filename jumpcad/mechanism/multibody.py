"""`Multibody`: bodies, joints, loops, springs and contacts of any planar jumping robot, engine-free, in SI units.

A maker is `jumpcad.mechanism.model` for the five-bar, whose frames it tells, another `jumpcad.simulation.robot_file`.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.mass import MassProperties
from jumpcad.transforms import Array, ByValue, chained, pose_at, rotation_about_y

Surface = Literal["foot", "body"]

CLOSED_M = 1e-5
"""Gap that a closed loop, or a foot on the ground, may have in the loaded pose."""
NEAR_REST = 1e-5
"""Weight of a joint's angle (rad) beside a gap (m) in the loaded pose: what nothing determines stays near rest."""
LOADING_POSES = 13
"""Poses from rest to the loaded one, each found from the one before."""


@dataclass(frozen=True, eq=False)
class ContactSphere(ByValue):
    """A sphere that may touch the ground, in its body's frame; `surface` chooses the friction in the settings."""

    name: str
    centre_m: Array
    radius_m: float
    surface: Surface


@dataclass(frozen=True, eq=False)
class Body(MassProperties):
    """A rigid body, in its own frame."""

    name: str
    contacts: tuple[ContactSphere, ...] = ()

    @classmethod
    def of(cls, name: str, mass: MassProperties, contacts: tuple[ContactSphere, ...] = ()) -> "Body":
        """Return a body of some mass, with its centre and inertia."""
        return cls(mass.mass_kg, mass.com_m, mass.inertia_kg_m2, name, contacts)

    @property
    def surface(self) -> Surface:
        """What of it touches the ground: `foot` if any sphere is of the foot."""
        return "foot" if any(contact.surface == "foot" for contact in self.contacts) else "body"


@dataclass(frozen=True, eq=False)
class Joint(ByValue):
    """A hinge about +y: the child frame lies at `origin_m` in the parent frame, turned by `rest_angle_rad` + q.

    `lower_rad` and `upper_rad` bound q as far as the mechanism goes: with `stops` they stop it, otherwise they are
    information for exporters. `effort_nm` and `velocity_rad_s` are the joint's largest torque and speed, for the URDF's
    limits; `friction_nm` is its dry friction; `loaded_rad` its coordinate with loaded springs, where that is stated. A
    wheel that is no hinge of the mechanism has another `axis`, infinite bounds, and its motor's inertia.
    """

    name: str
    parent: str
    child: str
    origin_m: Array
    rest_angle_rad: float
    lower_rad: float
    upper_rad: float
    effort_nm: float
    velocity_rad_s: float
    friction_nm: float = 0.0
    stops: bool = False
    loaded_rad: float | None = None
    axis: str = "0 1 0"
    armature_kg_m2: float = 0.0


@dataclass(frozen=True, eq=False)
class Loop(ByValue):
    """A closure: `point_a_m` of `body_a` is at `point_b_m` of `body_b`, each in its frame."""

    body_a: str
    point_a_m: Array
    body_b: str
    point_b_m: Array


@dataclass(frozen=True)
class Spring:
    """All torsion springs on one joint together, loaded by q = -wind_rad before release.

    `wind_rad` is from the rest pose (q = 0) to the loaded one; that of other robots than five-bars is found, and 0
    here. `preload_rad` is how far the springs are still loaded in the rest pose: their arms are free at q =
    preload_rad. Arms of `one_sided` springs only push: beyond the angle at which they are free there is no torque.
    """

    joint: str
    stiffness_nm_per_rad: float
    wind_rad: float
    preload_rad: float = 0.0
    one_sided: bool = False

    @property
    def energy_j(self) -> float:
        """Energy that the springs give from the loaded to the rest pose, ½·k·((δ + p)² - p²) (J)."""
        return 0.5 * self.stiffness_nm_per_rad * self.wind_rad * (self.wind_rad + 2.0 * self.preload_rad)

    @property
    def peak_torque_nm(self) -> float:
        """Torque in the loaded pose, k·(δ + p) (N·m)."""
        return self.stiffness_nm_per_rad * (self.wind_rad + self.preload_rad)

    def torque_nm(self, joint_rad: float) -> float:
        """Return the torque on the joint at a coordinate of it (N·m)."""
        torque = self.stiffness_nm_per_rad * (self.preload_rad - joint_rad)
        return max(torque, 0.0) if self.one_sided else torque

    def stored_j(self, joint_rad: float) -> float:
        """Return the energy in the springs at a coordinate of the joint, less that at rest (J)."""
        deflection = self.preload_rad - joint_rad
        if self.one_sided:
            deflection = max(deflection, 0.0)
        return 0.5 * self.stiffness_nm_per_rad * (deflection * deflection - self.preload_rad * self.preload_rad)


@dataclass(frozen=True)
class Stop:
    """What stops a joint at q = angle_rad beyond rest: a pad, elastic until the joint stands still, without rebound."""

    joint: str
    angle_rad: float
    stiffness_nm_per_rad: float


@dataclass(frozen=True)
class RollerOff:
    """The state in which the roller has left the cam, where the jump begins: coordinate and rate of the leg joint.

    `energy_ratio` is the energy left in the springs there, plus the leg's kinetic energy, over the loaded energy.
    """

    leg_rad: float
    leg_rad_s: float
    energy_ratio: float


@dataclass(frozen=True)
class Friction:
    """Dry friction of a printed robot: coefficients of foot and body on the ground, and in the pins.

    `pin_radius_m` are the radii of the pins of leg, front, ankle and eye, 0 for one that runs in ball bearings: their
    friction, some 0.0015 of the bearing's load, is neglected.
    """

    foot: float
    body: float
    pin: float = 0.0
    pin_radius_m: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, repr=False, eq=False)
class Multibody(ByValue):
    """A tree of hinges with loops and springs; bodies with contacts `foot` stand on the ground.

    A joint comes after that of its parent. A printed robot has a `stop`, starts with `roller_off`, and has its own
    `friction`; the capsules of the study have none of them, and take friction from the study's settings. `outline_m`
    are the corners x + iz (k,) of the convex outline of each body's parts in its frame's x-z plane; without parts there
    is none.
    """

    name: str
    bodies: Mapping[str, Body]
    joints: tuple[Joint, ...]
    loops: tuple[Loop, ...]
    springs: tuple[Spring, ...]
    stop: Stop | None = field(default=None, kw_only=True)
    roller_off: RollerOff | None = field(default=None, kw_only=True)
    friction: Friction | None = field(default=None, kw_only=True)
    outline_m: Mapping[str, npt.NDArray[np.complex128]] = field(default_factory=dict, kw_only=True, compare=False)

    @property
    def mass_kg(self) -> float:
        """Total mass (kg)."""
        return math.fsum(body.mass_kg for body in self.bodies.values())

    @property
    def lateral_offset_mm(self) -> float:
        """How far the centre of mass lies beside the leg, to the left (mm), the same in every pose."""
        return 1000.0 * sum(body.mass_kg * float(body.com_m[1]) for body in self.bodies.values()) / self.mass_kg

    @property
    def root(self) -> str:
        """The body from which the tree of joints hangs."""
        return self.joints[0].parent

    @property
    def order(self) -> tuple[str, ...]:
        """Names of the bodies in the order of a simulation's states."""
        return tuple(self.bodies)

    @property
    def main(self) -> str:
        """The body whose turn and pitch are the robot's: the heaviest."""
        return max(self.bodies, key=lambda name: self.bodies[name].mass_kg)

    @property
    def length_m(self) -> float:
        """The largest distance of a joint, a loop's end or a contact from its frame's origin."""
        points = [joint.origin_m for joint in self.joints]
        points += [point for loop in self.loops for point in (loop.point_a_m, loop.point_b_m)]
        points += [one.centre_m for body in self.bodies.values() for one in body.contacts]
        return max(float(np.linalg.norm(point)) for point in points)

    @property
    def spring_energy_j(self) -> float:
        """What the springs hold in the loaded pose, less what they hold at rest (J)."""
        angles = {joint.name: angle for joint, angle in zip(self.joints, self.loaded[2:], strict=True)}
        return math.fsum(spring.stored_j(angles[spring.joint]) for spring in self.springs)

    def joint(self, name: str) -> Joint:
        """Return a joint by its name."""
        return next(joint for joint in self.joints if joint.name == name)

    def poses(self, root: Array, angles_rad: Iterable[float]) -> dict[str, Array]:
        """Return all frames (4, 4) from that of the root and the coordinates of the joints."""
        placed = {self.root: root}
        for joint, angle in zip(self.joints, angles_rad, strict=True):
            turn = rotation_about_y(joint.rest_angle_rad + angle)
            placed[joint.child] = chained(placed[joint.parent], pose_at(turn, joint.origin_m))
        return placed

    @cached_property
    def loaded(self) -> Array:
        """Root's height (m) and pitch (rad), and the joints' angles (rad) in the loaded pose, (2 + joints,).

        Found by least squares, from the angles that joints state. A `JumpcadError` says that they do not fit.
        """
        from scipy.optimize import least_squares

        stated = np.array([np.nan if one.loaded_rad is None else one.loaded_rad for one in self.joints])
        known = np.isfinite(stated)

        def gaps(coordinates: Array, share: float = 1.0) -> Array:
            root = pose_at(rotation_about_y(coordinates[1]), (0.0, 0.0, coordinates[0]))
            placed = self.poses(root, coordinates[2:].tolist())
            apart = [
                (placed[loop.body_a] @ [*loop.point_a_m, 1.0] - placed[loop.body_b] @ [*loop.point_b_m, 1.0])[[0, 2]]
                for loop in self.loops
            ]
            heights = [
                float((placed[name] @ [*one.centre_m, 1.0])[2]) - one.radius_m
                for name, body in self.bodies.items()
                for one in body.contacts
                if one.surface == "foot"
            ]
            return np.concatenate([*apart, heights, coordinates[2:][known] - share * stated[known]])

        def residuals(coordinates: Array, share: float) -> Array:
            return np.concatenate([gaps(coordinates, share), NEAR_REST * self.length_m * coordinates[1:]])

        found = np.zeros(2 + len(self.joints))
        for share in np.linspace(0.0, 1.0, LOADING_POSES):  # from rest on: a loop closes in more ways than one
            found = least_squares(residuals, found, args=(share,), xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        if (worst := float(np.abs(gaps(found)).max())) > CLOSED_M:
            raise JumpcadError(
                f"the loaded pose does not close: loops, foot and loaded_deg miss by {1000.0 * worst:.3g} mm or mrad: "
                "check lengths and loaded_deg"
            )
        return np.asarray(found)

    def __repr__(self) -> str:
        name = repr(self.name[:40]) if self.name else "without a name"
        figures = f"{1000.0 * self.mass_kg:.1f} g, spring energy {self.spring_energy_j:.3f} J"
        return f"<{type(self).__name__} {name}: {figures}>"
