"""A robot in a PyBullet client: bodies and joints, what rubs, its motion at release, and the loop that is closed."""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from jumpcad.mechanism.mass import principal_axes
from jumpcad.mechanism.model import BODY, FOOT, FRONT_LINK, MAIN_LEG, Body, Joint, Mechanism, ReleasePose, release_pose
from jumpcad.settings import Coefficients, Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import quaternion_about_y, rotation_about_y

UNCLAMPED_RAD_S = 1e6
"""Instead of Bullet's limit of 100 rad/s to joint velocities, which good designs reach."""
LINKS = (MAIN_LEG, FOOT, FRONT_LINK)
"""Bullet's numbers of the links: depth first, so the foot comes before the front link."""
LEG, FOOT_LINK, FRONT = range(3)
JOINTS = [LEG, FOOT_LINK, FRONT]


class BulletRobot:
    """A robot as it is released, by its `number` in the client of PyBullet's module.

    `axes` are rotations (4, 3, 3) from the bodies' principal axes, in which Bullet keeps them, to their frames; base
    first. Every joint has viscous damping, each link's dry friction is `dry_nm`.
    """

    def __init__(self, bullet: Any, client: int, mechanism: Mechanism, settings: Settings) -> None:
        self.bullet, self.client = bullet, client
        rubs = coefficients(mechanism, settings)
        self.joint_damping_nms_per_rad = rubs.joint_damping_nms_per_rad
        self.dry_nm = [settings.joint_friction_nm] * len(JOINTS)
        self.dry_nm[LEG] += pin_torque_nm(mechanism, rubs.pin)
        bodies = [mechanism.bodies[name] for name in (BODY, *LINKS)]
        principal = [principal_axes(body.inertia_kg_m2) for body in bodies]
        self._moments, self.axes = (np.stack(arrays) for arrays in zip(*principal, strict=True))
        release = release_pose(mechanism)
        self.number = self._create(mechanism, bodies, release)
        self._set_dynamics(settings, rubs, bodies)
        for link, joint in enumerate(_joints(mechanism)):
            bullet.resetJointState(
                self.number, link, release.joint_rad[joint.name], release.joint_rad_s[joint.name],
                physicsClientId=client,
            )  # fmt: skip
        if mechanism.roller_off:
            spin = np.array([0.0, release.body_rad_s, 0.0])
            to_com = rotation_about_y(release.body_pitch_rad) @ bodies[0].com_m  # of which Bullet wants the velocity
            moves = (release.body_m_s + np.cross(spin, to_com)).tolist()
            bullet.resetBaseVelocity(self.number, moves, spin.tolist(), physicsClientId=client)
        self._close_loop(mechanism)

    def _create(self, mechanism: Mechanism, bodies: list[Body], release: ReleasePose) -> int:
        bullet, client = self.bullet, self.client
        # A link without a visual gets one made from its collision shape, which costs more than the whole robot.
        box = bullet.createVisualShape(bullet.GEOM_BOX, halfExtents=[0.001] * 3, physicsClientId=client)
        orientations = Rotation.from_matrix(self.axes).as_quat().tolist()
        positions = [body.com_m.tolist() for body in bodies]
        shapes = [self._contact_shape(body) for body in bodies]
        joints = _joints(mechanism)
        return int(
            bullet.createMultiBody(
                bodies[0].mass_kg, shapes[0], box, basePosition=release.body_position_m.tolist(),
                baseOrientation=_xyzw_about_y(release.body_pitch_rad), baseInertialFramePosition=positions[0],
                baseInertialFrameOrientation=orientations[0], linkMasses=[body.mass_kg for body in bodies[1:]],
                linkCollisionShapeIndices=shapes[1:], linkVisualShapeIndices=[box] * len(LINKS),
                linkPositions=[joint.origin_m.tolist() for joint in joints],
                linkOrientations=[_xyzw_about_y(joint.rest_angle_rad) for joint in joints],
                linkInertialFramePositions=positions[1:], linkInertialFrameOrientations=orientations[1:],
                linkParentIndices=[0, 1, 0], linkJointTypes=[bullet.JOINT_REVOLUTE] * len(LINKS),
                linkJointAxis=[[0.0, 1.0, 0.0]] * len(LINKS), physicsClientId=client,
            )
        )  # fmt: skip

    def _contact_shape(self, body: Body) -> int:
        """Return a compound of the body's contact spheres, or none."""
        if not body.contacts:
            return -1
        bullet = self.bullet
        return int(
            bullet.createCollisionShapeArray(
                shapeTypes=[bullet.GEOM_SPHERE] * len(body.contacts),
                radii=[contact.radius_m for contact in body.contacts],
                collisionFramePositions=[contact.centre_m.tolist() for contact in body.contacts],
                physicsClientId=self.client,
            )
        )

    def _set_dynamics(self, settings: Settings, rubs: Coefficients, bodies: list[Body]) -> None:
        """Set inertia and friction of every link, then what Bullet would apply to the base if set with these."""
        bullet, mechanism, client = self.bullet, self.number, self.client
        for link, (body, moments) in enumerate(zip(bodies, self._moments, strict=True), start=-1):
            bullet.changeDynamics(
                mechanism, link, localInertiaDiagonal=moments.tolist(), lateralFriction=rubs.of(body.surface),
                rollingFriction=settings.rolling_friction_m, spinningFriction=settings.spinning_friction_m,
                restitution=settings.restitution, jointDamping=rubs.joint_damping_nms_per_rad, physicsClientId=client,
            )  # fmt: skip
        bullet.changeDynamics(mechanism, -1, linearDamping=0.0, angularDamping=0.0, physicsClientId=client)
        bullet.changeDynamics(mechanism, -1, maxJointVelocity=UNCLAMPED_RAD_S, physicsClientId=client)
        # Bullet gives every joint a motor that holds it.
        bullet.setJointMotorControlArray(
            mechanism, JOINTS, bullet.VELOCITY_CONTROL, forces=self.dry_nm, physicsClientId=client,
        )  # fmt: skip

    def _close_loop(self, mechanism: Mechanism) -> None:
        """Connect front link and foot; Bullet needs the points in their principal axes."""
        front, foot = mechanism.bodies[FRONT_LINK], mechanism.bodies[FOOT]
        points = {mechanism.loop.body_a: mechanism.loop.point_a_m, mechanism.loop.body_b: mechanism.loop.point_b_m}
        front_axes, foot_axes = self.axes[1 + FRONT], self.axes[1 + FOOT_LINK]
        self.bullet.createConstraint(
            self.number, FRONT, self.number, FOOT_LINK, self.bullet.JOINT_POINT2POINT, [0.0, 0.0, 0.0],
            (front_axes.T @ (points[FRONT_LINK] - front.com_m)).tolist(),
            (foot_axes.T @ (points[FOOT] - foot.com_m)).tolist(), physicsClientId=self.client,
        )  # fmt: skip


def _joints(mechanism: Mechanism) -> list[Joint]:
    """Return the joints in the order of Bullet's links."""
    return [next(joint for joint in mechanism.joints if joint.child == name) for name in LINKS]


def _xyzw_about_y(angle_rad: float) -> list[float]:
    """Return the quaternion of a turn about y in Bullet's order: scalar last."""
    w, *vector = quaternion_about_y(angle_rad)
    return [*vector, w]
