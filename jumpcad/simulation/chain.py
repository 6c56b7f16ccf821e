"""A planar chain: any tree of hinges with loops, a spring at any joint, on a flat foot; MuJoCo alone simulates it.

The loaded pose is found by least squares. The take-off is found as for other robots (`jumpcad.simulation.run`): the
ground no longer carries the robot, for some time, while its centre of mass rises.
"""

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from jumpcad.errors import JumpcadError
from jumpcad.exporters.mjcf import CONTACT_IMPEDANCE, SUBSTEPS, options, stiff
from jumpcad.exporters.xml import add, document, wxyz
from jumpcad.findings import Finding
from jumpcad.mechanism.model import Body, Joint, Loop, Spring
from jumpcad.settings import Settings
from jumpcad.simulation.ballistics import ballistics, drag_per_m
from jumpcad.simulation.engines import import_mujoco
from jumpcad.simulation.jump import EnergyBudget, Jump
from jumpcad.simulation.run import AIRBORNE_S, ENERGY_RATIO_LIMIT
from jumpcad.transforms import Array, pose_at, rotation_about_y

CLOSED_M = 1e-5
"""Gap that a closed loop, or a foot on the ground, may have in the loaded pose."""
NEAR_REST = 1e-5
"""Weight of a joint's angle (rad) beside a gap (m) in the loaded pose: what nothing determines stays near rest."""
LOADING_POSES = 13
"""Poses from rest to the loaded one, each found from the one before."""
SETTLED_SHARE, FINEST_S = 0.002, 2e-6
"""Change of the take-off speed below which a step is fine enough; the finest step."""
TAKEN = {"dt_s", "push_off_steps", "solver_iterations", "solver_residual", "gravity_m_s2", "drag_area_m2", "max_time_s",
         "spring_efficiency", "trajectory_rate_hz"}  # fmt: skip
"""Settings that a chain takes, or that make no difference to MuJoCo."""
PUSH_OFF_WITHIN_S = 0.5
"""A robot that stands this long does not jump."""
CARRIED_SHARE = 0.02
"""Of the weight: with less than this the robot has left the ground, as in `jumpcad.simulation.mujoco`."""


@dataclass(frozen=True, eq=False)
class Chain:
    """The bodies, hinges, loops and springs of a robot, of which the bodies with contacts `foot` stand on the ground.

    A joint comes after that of its parent; its limits are stops, if finite. A spring's preload is where it is relaxed.
    `loaded_rad` has the coordinates of joints that are known in the loaded pose, `friction_nm` their dry friction,
    `friction` the coefficients of foot and body on the ground.
    """

    name: str
    bodies: Mapping[str, Body]
    joints: tuple[Joint, ...]
    loops: tuple[Loop, ...]
    springs: tuple[Spring, ...]
    loaded_rad: Mapping[str, float]
    friction_nm: Mapping[str, float]
    friction: Mapping[str, float]

    @property
    def mass_kg(self) -> float:
        """Total mass (kg)."""
        return math.fsum(body.mass_kg for body in self.bodies.values())

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

    def poses(self, coordinates: Array) -> dict[str, Array]:
        """Return all frames (4, 4) at the root's height and pitch and the joints' angles (2 + joints,)."""
        placed = {self.joints[0].parent: pose_at(rotation_about_y(coordinates[1]), (0.0, 0.0, coordinates[0]))}
        for joint, angle in zip(self.joints, coordinates[2:].tolist(), strict=True):
            turn = rotation_about_y(joint.rest_angle_rad + angle)
            placed[joint.child] = np.asarray(placed[joint.parent] @ pose_at(turn, joint.origin_m))
        return placed

    @cached_property
    def loaded(self) -> Array:
        """Root's height (m) and pitch (rad), and the joints' angles (rad) in the loaded pose, (2 + joints,).

        Raises
        ------
        JumpcadError
            If the loops do not close, or the foot is not flat, at the stated angles.
        """
        stated = np.array([self.loaded_rad.get(joint.name, np.nan) for joint in self.joints])
        known = np.isfinite(stated)

        def gaps(coordinates: Array, share: float = 1.0) -> Array:
            placed = self.poses(coordinates)
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


def simulate_chain(chain: Chain, settings: Settings, engine: str) -> Jump:
    """Let a chain jump from its loaded pose.

    The step of the settings is quartered until the take-off speed no longer depends on it.

    Raises
    ------
    JumpcadError
        If the engine is not MuJoCo, or cannot do what the settings ask.
    """
    if engine != "mujoco":
        raise JumpcadError(f"--engine {engine}: {chain.name} is a chain of hinges, which only MuJoCo simulates")
    for key, value in settings.model_dump(exclude_defaults=True, exclude=TAKEN).items():
        raise JumpcadError(f"{key} = {value}: a chain of hinges is simulated without it: leave it out")
    springs = (replace(one, stiffness_nm_per_rad=settings.spring_efficiency * one.stiffness_nm_per_rad)
               for one in chain.springs)  # fmt: skip
    chain = replace(chain, springs=tuple(springs))
    jump = _jump(chain, settings)
    while settings.dt_s > FINEST_S:
        before, settings = jump, settings.model_copy(update={"dt_s": settings.dt_s / 4.0})
        jump = _jump(chain, settings)
        speed, other = jump.takeoff_speed_m_s, before.takeoff_speed_m_s
        if jump.verdict == before.verdict and abs((speed or 1.0) / (other or 1.0) - 1.0) < SETTLED_SHARE:
            break
    return jump


def chain_mjcf(chain: Chain, settings: Settings) -> str:
    """Return the MuJoCo model of a chain, in the plane, above the ground."""
    root = ET.Element("mujoco", model=chain.name)
    add(root, "compiler", angle="radian", inertiafromgeom="false")
    add(root, "option", **options(settings))
    world = add(root, "worldbody")
    add(world, "geom", name="ground", type="plane", size="2 2 0.1", contype="0", conaffinity="0")
    first = chain.joints[0].parent
    nodes = {first: add(world, "body", name=first)}
    for name, kind, axis in (("x", "slide", "1 0 0"), ("z", "slide", "0 0 1"), ("pitch", "hinge", "0 1 0")):
        add(nodes[first], "joint", name=f"root {name}", type=kind, axis=axis)
    springs = {spring.joint: spring for spring in chain.springs}
    limit = {f"{key}limit": value for key, value in stiff(settings).items()}
    for joint in chain.joints:
        turn = wxyz(rotation_about_y(joint.rest_angle_rad))
        node = nodes[joint.child] = add(nodes[joint.parent], "body", name=joint.child, pos=joint.origin_m, quat=turn)
        more: dict[str, Any] = {"frictionloss": chain.friction_nm.get(joint.name, 0.0)}
        if spring := springs.get(joint.name):
            more |= {"stiffness": spring.stiffness_nm_per_rad, "springref": spring.preload_rad}
        if math.isfinite(joint.lower_rad):
            more |= {"range": (joint.lower_rad, joint.upper_rad), "limited": "true"} | limit
        add(node, "joint", name=joint.name, type="hinge", axis="0 1 0", **more)
    pairs = add(root, "contact")
    for name, body in chain.bodies.items():
        tensor = body.inertia_kg_m2
        add(nodes[name], "inertial", pos=body.com_m, mass=body.mass_kg, diaginertia=np.full(3, tensor[1, 1]))
        for one in body.contacts:
            geom, rub = f"{name} {one.name}", chain.friction[one.surface]
            add(nodes[name], "geom", name=geom, pos=one.centre_m, size=one.radius_m, contype="0", conaffinity="0")
            add(pairs, "pair", geom1="ground", geom2=geom, condim="3", friction=(rub, rub, 0.0, 0.0, 0.0),
                **stiff(settings) | {"solimp": CONTACT_IMPEDANCE})  # fmt: skip
    equality = add(root, "equality")
    for number, loop in enumerate(chain.loops):
        for body_name, point in ((loop.body_a, loop.point_a_m), (loop.body_b, loop.point_b_m)):
            add(nodes[body_name], "site", name=f"{body_name} loop {number}", pos=point)
        sites = {f"site{end}": f"{name} loop {number}" for end, name in ((1, loop.body_a), (2, loop.body_b))}
        add(equality, "connect", **sites, **stiff(settings))
    return document(root)


class _ChainRun:
    """One push-off in MuJoCo, from the loaded pose to the last contact."""

    def __init__(self, chain: Chain, settings: Settings) -> None:
        self._mujoco = mujoco = import_mujoco()
        mujoco.set_mju_user_warning(str)
        self.chain, self.settings, self.dt_s = chain, settings, settings.dt_s / SUBSTEPS
        self.model = mujoco.MjModel.from_xml_string(chain_mjcf(chain, settings))
        self.model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
        self.data = mujoco.MjData(self.model)
        names = ["root z", "root pitch", *(joint.name for joint in chain.joints)]
        for name, value in zip(names, chain.loaded, strict=True):
            self.data.joint(name).qpos = value
        mujoco.mj_forward(self.model, self.data)
        self._springs = [(int(self.model.joint(spring.joint).qposadr[0]), spring) for spring in chain.springs]
        self._dry_nm = self.model.dof_frictionloss.copy()
        self.start_m, _ = self.motion(self.data)
        self.start_j, self.worst_ratio = float(self.data.energy.sum()), 1.0
        self.joint_j = self.slip_j = self.time_s = 0.0

    def stored_j(self, data: Any) -> float:
        """Return what the springs hold, less what they hold at rest."""
        return math.fsum(spring.stored_j(float(data.qpos[place])) for place, spring in self._springs)

    def motion(self, data: Any) -> tuple[Array, Array]:
        """Return place and velocity (3,) of the centre of mass."""
        self._mujoco.mj_subtreeVel(self.model, data)
        return data.subtree_com[0].copy(), data.subtree_linvel[0].copy()

    def go(self) -> Any:
        """Return the state at take-off, or None if the robot does not fly."""
        mujoco, model, data = self._mujoco, self.model, self.data
        carried_n = CARRIED_SHARE * self.chain.mass_kg * self.settings.gravity_m_s2
        energy_j, hold = self.chain.spring_energy_j, max(1, round(AIRBORNE_S / self.dt_s))
        stored_j, airborne, left = energy_j, 0, (None, 0.0, 0.0, 0.0)
        for step in range(1, round(PUSH_OFF_WITHIN_S / self.dt_s) + 1):
            mujoco.mj_step(model, data)
            ratio = 1.0 + (float(data.energy.sum()) - self.start_j) / energy_j
            self.worst_ratio = max(self.worst_ratio, ratio if math.isfinite(ratio) else math.inf)
            if self.worst_ratio > ENERGY_RATIO_LIMIT:
                return None
            self.joint_j += self.dt_s * float(self._dry_nm @ np.abs(data.qvel))
            first = data.ne + data.nf + data.nl
            forces, speeds = data.efc_force[first:].reshape(-1, 3), data.efc_vel[first:].reshape(-1, 3)
            self.slip_j -= self.dt_s * float((forces[:, 1:] * speeds[:, 1:]).sum())
            before_j, stored_j = stored_j, self.stored_j(data)
            carried = float(forces[:, 0].sum()) > carried_n
            airborne = 0 if carried else airborne + 1
            if airborne == 1:
                left = copy.copy(data), step * self.dt_s, self.joint_j, self.slip_j
            spent = stored_j <= 0.5 * energy_j and stored_j >= min(before_j, 0.0)
            if airborne >= hold and spent and self.motion(data)[1][2] > 0.0:
                state, self.time_s, self.joint_j, self.slip_j = left
                mujoco.mj_forward(model, state)
                return state
        return None


def _jump(chain: Chain, settings: Settings) -> Jump:
    run, wound_j, mass_kg = _ChainRun(chain, settings), chain.spring_energy_j, chain.mass_kg
    state = run.go()
    if state is None:
        audit = run.worst_ratio > ENERGY_RATIO_LIMIT
        name, message, remedy = (
            ("audit_energy", f"mechanical energy reached {run.worst_ratio:.4f} of the springs'", "use a smaller dt_s")
            if audit
            else ("no_takeoff", "the robot stays on the ground", "give it stiffer springs, or load them further")
        )
        finding = Finding(name, "error", -1.0, "", message, remedy)
        return Jump(name, "mujoco", mass_kg, wound_j, findings=(finding,))
    (here_m, velocity), energy = run.motion(state), state.energy
    forward_j, upward_j = (0.5 * mass_kg * float(velocity[axis]) ** 2 for axis in (0, 2))
    lift_j = mass_kg * settings.gravity_m_s2 * float(here_m[2] - run.start_m[2])
    internal_j, spring_j = float(energy[1]) - forward_j - upward_j, run.stored_j(state)
    left_j = forward_j + upward_j + lift_j + internal_j + spring_j
    budget = EnergyBudget(
        forward_j, upward_j, internal_j, lift_j, spring_j, 0.0, run.joint_j, run.slip_j,
        wound_j - left_j - run.joint_j - run.slip_j,
    )  # fmt: skip
    per_m = drag_per_m(settings.drag_area_m2, mass_kg)
    path = ballistics(run.start_m, here_m, velocity, settings.gravity_m_s2, per_m)
    return Jump(
        "jump", "mujoco", mass_kg, wound_j,
        fitness=path.range_m / chain.length_m,
        ballistic_range_m=path.range_m,
        com_rise_m=path.rise_m,
        release_energy_ratio=1.0,
        takeoff_energy_ratio=left_j / wound_j,
        takeoff_speed_m_s=path.speed_m_s,
        takeoff_angle_deg=path.angle_deg,
        takeoff_time_s=run.time_s,
        energy=budget,
    )  # fmt: skip
