"""The PyBullet back end: a persistent world in which one robot after another is released.

A run is the same in any process and after any other robot: every parameter that persists between robots is set again
for each, and the whole world is made again every `RESET_EVERY` robots, which also frees the memory that removing a
robot does not free.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from jumpcad.mechanism.model import Mechanism
from jumpcad.settings import Settings, coefficients
from jumpcad.simulation.bullet_robot import FOOT_LINK, JOINTS, LEG, BulletRobot
from jumpcad.simulation.engines import import_pybullet
from jumpcad.simulation.mechanics import State, StopPad
from jumpcad.simulation.run import Run
from jumpcad.transforms import Array

RESET_EVERY = 500
BODY_ORDER = [0, 1, 3, 2]
"""From Bullet's order (base, leg, foot, front link) to that of `BODY_NAMES`."""


class BulletEngine:
    """A PyBullet client of its own, without window, that runs one robot at a time.

    A lock makes threads wait for each other; this costs nothing, because PyBullet holds the interpreter's lock.
    """

    run = Run

    def __init__(self) -> None:
        self._bullet = import_pybullet()
        self._lock = threading.Lock()
        self._client = -1
        self._robots = 0
        self._ground = -1

    @contextmanager
    def world(self, mechanism: Mechanism, settings: Settings) -> Iterator["BulletWorld"]:
        """Put a robot on the ground, ready for release, and remove it afterwards."""
        with self._lock:
            self._prepare(settings, coefficients(mechanism, settings).ground)
            robot = BulletRobot(self._bullet, self._client, mechanism, settings)
            world = BulletWorld(robot, self._ground, mechanism, settings)
            try:
                yield world
            finally:
                left = world.state()
                if np.isfinite(left.com_m).all() and np.isfinite(left.velocity_m_s).all():
                    self._bullet.removeBody(world.robot_id, physicsClientId=self._client)
                else:  # its NaN would stay in the client, and no later robot would jump
                    self._bullet.disconnect(physicsClientId=self._client)

    def _prepare(self, settings: Settings, ground_friction: float) -> None:
        bullet = self._bullet
        if not bullet.isConnected(self._client):
            self._client = bullet.connect(bullet.DIRECT)
            self._robots = 0
        client = self._client
        if self._robots % RESET_EVERY == 0:
            bullet.resetSimulation(physicsClientId=client)
            plane = bullet.createCollisionShape(bullet.GEOM_PLANE, physicsClientId=client)
            self._ground = bullet.createMultiBody(0.0, plane, physicsClientId=client)
        self._robots += 1
        bullet.setGravity(0.0, 0.0, -settings.gravity_m_s2, physicsClientId=client)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=settings.dt_s, numSolverIterations=settings.solver_iterations,
            solverResidualThreshold=settings.solver_residual, numSubSteps=0, physicsClientId=client,
        )  # fmt: skip
        # Bullet multiplies the restitutions of both sides: with 1 for the ground, the robot's is that of the contact.
        bullet.changeDynamics(
            self._ground, -1, lateralFriction=ground_friction, restitution=1.0, physicsClientId=client
        )


class BulletWorld:
    """One robot on the ground; a `World` for `Run`."""

    def __init__(self, robot: BulletRobot, ground: int, mechanism: Mechanism, settings: Settings) -> None:
        self._bullet, self._client, self._ground = robot.bullet, robot.client, ground
        self.robot_id, self._dry_nm = robot.number, robot.dry_nm
        self._body_in_principal = robot.axes[BODY_ORDER].transpose(0, 2, 1)
        self._dt_s, self._spring, self._pad = settings.dt_s, mechanism.spring, StopPad(mechanism, settings.dt_s)
        self._damping_dt = robot.joint_damping_nms_per_rad * settings.dt_s
        # On the friction of the study (1.5) no foot slides.
        self._slides = mechanism.friction is not None or settings.ground_friction is not None
        self.joint_damping_j = self.slip_j = 0.0
        self._foot = self._foot_motion()

    def advance(self, steps: int) -> float:
        """Go on by a number of time steps with the springs' torque of each step's beginning."""
        bullet, mechanism, client = self._bullet, self.robot_id, self._client
        spring_nm, pad_nm = self._spring.torque_nm, self._pad.torque_nm
        joint_states, set_motor, torque = bullet.getJointStates, bullet.setJointMotorControl2, bullet.TORQUE_CONTROL
        step = bullet.stepSimulation
        dry_leg, dry_foot, dry_front = self._dry_nm
        squares = rubbed = 0.0
        for _ in range(steps):
            leg, foot, front = joint_states(mechanism, JOINTS, client)
            squares += leg[1] * leg[1] + foot[1] * foot[1] + front[1] * front[1]
            rubbed += dry_leg * abs(leg[1]) + dry_foot * abs(foot[1]) + dry_front * abs(front[1])
            push = spring_nm(leg[0]) - pad_nm(leg[0], leg[1])
            set_motor(mechanism, LEG, torque, force=push, physicsClientId=client)
            step(client)
            if self._slides:
                self.slip_j += self._slip_work_j()
        self.joint_damping_j += self._damping_dt * squares + self._dt_s * rubbed
        return float(leg[0])

    def _slip_work_j(self) -> float:
        """Return what friction on the ground took from the foot in the last time step.

        The force at each contact times the mean of the foot's velocities there before and after.
        """
        before, self._foot = self._foot, self._foot_motion()
        power = 0.0
        contacts = self._bullet.getContactPoints(
            self.robot_id, self._ground, linkIndexA=FOOT_LINK, physicsClientId=self._client
        )
        for contact in contacts:
            x, y, z = contact[5]
            for com, velocity, spin in (before, self._foot):
                arm_x, arm_y, arm_z = x - com[0], y - com[1], z - com[2]
                slip_x = velocity[0] + spin[1] * arm_z - spin[2] * arm_y
                slip_y = velocity[1] + spin[2] * arm_x - spin[0] * arm_z
                for force, along in ((contact[10], contact[11]), (contact[12], contact[13])):
                    power -= 0.5 * force * (along[0] * slip_x + along[1] * slip_y)
        return power * self._dt_s

    def _foot_motion(self) -> tuple[Any, Any, Any]:
        """Return centre of mass, velocity and spin of the foot."""
        state = self._bullet.getLinkState(self.robot_id, FOOT_LINK, computeLinkVelocity=1, physicsClientId=self._client)
        return state[0], state[6], state[7]

    def pull(self, acceleration_m_s2: Array) -> None:
        """Take another gravity (3,); the engine sets that of the next robot."""
        self._bullet.setGravity(*acceleration_m_s2.tolist(), physicsClientId=self._client)

    def loaded(self) -> bool:
        """Tell whether the ground carries any of the robot (Bullet also lists contacts that are only near)."""
        for contact in self._bullet.getContactPoints(self.robot_id, self._ground, physicsClientId=self._client):
            if contact[9] > 0.0:
                return True
        return False

    def state(self) -> State:
        """Return where the bodies are and how they move.

        Bullet's poses are of the principal axes; those of the links' frames, which it also gives, are single precision.
        """
        bullet, mechanism, client = self._bullet, self.robot_id, self._client
        position, quaternion = bullet.getBasePositionAndOrientation(mechanism, client)
        velocity, spin = bullet.getBaseVelocity(mechanism, client)
        links = bullet.getLinkStates(
            mechanism, JOINTS, computeLinkVelocity=1, computeForwardKinematics=1, physicsClientId=client
        )
        matrix = bullet.getMatrixFromQuaternion
        rows = [
            (*position, *velocity, *spin, *matrix(quaternion)),
            *((*link[0], *link[6], *link[7], *matrix(link[1])) for link in links),
        ]
        values = np.array([rows[index] for index in BODY_ORDER])
        rotation = values[:, 9:].reshape(-1, 3, 3) @ self._body_in_principal
        leg_rad = bullet.getJointState(mechanism, LEG, client)[0]
        return State(values[:, 0:3], rotation, values[:, 3:6], values[:, 6:9], (leg_rad,))
