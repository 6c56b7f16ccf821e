"""The MuJoCo back end: the same bodies, joints, loop and spring in an independent engine.

MuJoCo's constraints are springs; here contacts and the loop are as stiff as the time step allows, and the time step is
a fraction of that in the settings.
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from jumpcad.errors import JumpcadError
from jumpcad.robot import BODY, BODY_NAMES, Robot
from jumpcad.simulation.engines import import_mujoco
from jumpcad.simulation.mechanics import Release, State, release_pose
from jumpcad.simulation.settings import Settings, surface_friction

SUBSTEPS = 4
"""MuJoCo's own steps in one of the settings': what makes its stiffest constraints as exact as Bullet's rigid ones."""
SOFTNESS_STEPS = 2.0
"""Time constant of the constraints over MuJoCo's own step: the least that MuJoCo keeps stable."""
IMPEDANCE = [0.99, 0.9999, 0.0001, 0.5, 2.0]
"""Share of a constraint that is enforced, and how it grows with penetration (MuJoCo's `solimp`)."""


class MujocoEngine:
    """Makes a model of its own for every robot."""

    def __init__(self) -> None:
        self._mujoco = import_mujoco()
        # Left alone, it writes a file into the current folder; the audit tells of a run that blew up.
        self._mujoco.set_mju_user_warning(lambda text: None)

    @contextmanager
    def world(self, robot: Robot, settings: Settings) -> Iterator["MujocoWorld"]:
        """Put a robot on the ground, ready for release.

        Raises
        ------
        JumpcadError
            If the settings ask for what MuJoCo does not have.
        """
        for key in ("restitution", "drag_per_s"):
            if getattr(settings, key):
                raise JumpcadError(
                    f"{key} = {getattr(settings, key):g}: MuJoCo has none; set it to 0 or use --engine pybullet"
                )
        yield MujocoWorld(self._mujoco, robot, settings)


class MujocoWorld:
    """One robot on the ground; a `World` for `Run`."""

    def __init__(self, mujoco: Any, robot: Robot, settings: Settings) -> None:
        self._mujoco = mujoco
        self._damping_dt = settings.joint_damping_nms_per_rad * settings.dt_s / SUBSTEPS
        self.joint_damping_j = 0.0
        self._loaded = True
        self._force = np.zeros(6)
        self.model = model_spec(mujoco, robot, settings).compile()
        self.data = mujoco.MjData(self.model)
        self._bodies = [self.model.body(name).id for name in BODY_NAMES]
        self._joints = [int(self.model.joint(joint.name).dofadr[0]) for joint in robot.joints]
        self._leg = int(self.model.joint(robot.spring.joint).qposadr[0])
        self._place(release_pose(robot))

    def advance(self, steps: int) -> float:
        """Go on by a number of time steps; MuJoCo's own joint spring acts in each."""
        squares = 0.0
        for _ in range(steps):
            leg_rad = float(self.data.qpos[self._leg])
            self._loaded = False
            for _ in range(SUBSTEPS):
                speeds = self.data.qvel[self._joints]
                squares += float(speeds @ speeds)
                self._mujoco.mj_step(self.model, self.data)
                self._loaded = self._loaded or self._carried()
        self.joint_damping_j += self._damping_dt * squares
        return leg_rad

    def loaded(self) -> bool:
        """Say whether the ground carried any of the robot during the last time step."""
        return self._loaded

    def state(self) -> State:
        """Return where the bodies are and how they move, leaving the solver's warm start and contacts as they are."""
        mujoco, model, data = self._mujoco, self.model, self.data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        rotation = np.array([data.xmat[body].reshape(3, 3) for body in self._bodies])
        velocity = np.zeros((len(self._bodies), 6))
        for row, body in zip(velocity, self._bodies, strict=True):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, row, 0)
        return State(
            data.xipos[self._bodies].copy(), rotation, velocity[:, 3:], velocity[:, :3], float(data.qpos[self._leg])
        )

    def _carried(self) -> bool:
        """Say whether the ground pushed during MuJoCo's last own step."""
        for index in range(self.data.ncon):
            self._mujoco.mj_contactForce(self.model, self.data, index, self._force)
            if self._force[0] > 0.0:
                return True
        return False

    def _place(self, release: Release) -> None:
        """Put the body's frame and every joint where they are before release."""
        self.data.joint("free").qpos = [*release.body_position_m, *_about_y(release.body_pitch_rad)]
        for name, angle in release.joint_rad.items():
            self.data.joint(name).qpos = angle
        self._mujoco.mj_forward(self.model, self.data)


def model_spec(mujoco: Any, robot: Robot, settings: Settings) -> Any:
    """Return the `MjSpec` of a robot above a plane."""
    step = settings.dt_s / SUBSTEPS
    stiff = [SOFTNESS_STEPS * step, 1.0]
    spec = mujoco.MjSpec()
    option = spec.option
    option.timestep = step
    option.gravity = [0.0, 0.0, -settings.gravity_m_s2]
    option.iterations = max(settings.solver_iterations, 50)
    option.tolerance = 1e-12
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 10.0
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], contype=0, conaffinity=0)
    bodies = {BODY: spec.worldbody.add_body(name=BODY)}
    bodies[BODY].add_freejoint(name="free")
    for joint in robot.joints:
        bodies[joint.child] = child = bodies[joint.parent].add_body(
            name=joint.child, pos=joint.origin_m, quat=_about_y(joint.rest_angle_rad)
        )
        child.add_joint(
            name=joint.name,
            type=mujoco.mjtJoint.mjJNT_HINGE,
            axis=[0, 1, 0],
            damping=settings.joint_damping_nms_per_rad,
            frictionloss=settings.joint_friction_nm,
            stiffness=robot.spring.stiffness_nm_per_rad if joint.name == robot.spring.joint else 0.0,
        )
    for node in bodies.values():
        _fill(mujoco, spec, node, robot, settings, stiff)
    ends = {robot.loop.body_a: robot.loop.point_a_m, robot.loop.body_b: robot.loop.point_b_m}
    for name, point in ends.items():
        bodies[name].add_site(name=f"{name}_loop", pos=point)
    spec.add_equality(
        type=mujoco.mjtEq.mjEQ_CONNECT,
        objtype=mujoco.mjtObj.mjOBJ_SITE,
        name1=f"{robot.loop.body_a}_loop",
        name2=f"{robot.loop.body_b}_loop",
        solref=stiff,
        solimp=IMPEDANCE,
    )
    return spec


def _fill(mujoco: Any, spec: Any, node: Any, robot: Robot, settings: Settings, stiff: list[float]) -> None:
    """Give a body its mass properties and its contact spheres, each paired with the ground."""
    body = robot.bodies[node.name]
    inertia = body.inertia_kg_m2
    node.explicitinertial = True
    node.mass = body.mass_kg
    node.ipos = body.com_m
    node.fullinertia = [*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2]]
    slide = settings.ground_friction * surface_friction(body, settings)
    spin = settings.ground_friction * settings.spinning_friction_m
    roll = settings.ground_friction * settings.rolling_friction_m
    for contact in body.contacts:
        name = f"{body.name}_{contact.name}"
        node.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_SPHERE,
            pos=contact.centre_m,
            size=[contact.radius_m, 0.0, 0.0],
            contype=0,
            conaffinity=0,
        )
        spec.add_pair(
            geomname1="ground",
            geomname2=name,
            condim=6 if spin or roll else 3,
            friction=[slide, slide, spin, roll, roll],
            solref=stiff,
            solimp=IMPEDANCE,
        )


def _about_y(angle_rad: float) -> list[float]:
    """Return the quaternion (w, x, y, z) of a turn about y."""
    return [math.cos(angle_rad / 2), 0.0, math.sin(angle_rad / 2), 0.0]
