"""The published simulation a second time, written from its description and independent of `jumpcad.published`.

One flat program on plain numbers: no class, no default and no formula of the package is used. Angles in rad, lengths in
m unless a name says otherwise; the jump goes along +y.
"""

from collections.abc import Sequence

import numpy as np
import pybullet
from pybullet_utils.bullet_client import BulletClient

TICK = 1 / 240


def recipe_jump(parameters: Sequence[float]) -> tuple[float, float]:
    """Return distance and height (m) of the eight parameters, in the order of the study's vector."""
    l2_mm, c, d, e, ratio, rest_deg, k_nmm_per_deg, toe_deg = parameters
    l3_mm, l4_mm, l5_mm = c * l2_mm, d * l2_mm, e * l2_mm
    rest, toe = rest_deg * np.pi / 180, toe_deg * np.pi / 180
    beta, l1_mm = 0.0, l4_mm
    if l3_mm != l2_mm:
        beta = np.arcsin((l3_mm - l2_mm) * np.sin(rest) / l4_mm)
        l1_mm = np.sin(rest - beta) * l4_mm / np.sin(rest)
    delta = ratio * (rest + beta)
    l1, l2, l3, l4, l5 = (length / 1000 for length in (l1_mm, l2_mm, l3_mm, l4_mm, l5_mm))
    radius = max(l2_mm, l3_mm, l5_mm) / 25 / 1000
    world = BulletClient(pybullet.DIRECT)
    try:
        world.setPhysicsEngineParameter(contactBreakingThreshold=0.02)  # Bullet's default, but kept for a whole process
        ground = world.createMultiBody(0, world.createCollisionShape(pybullet.GEOM_PLANE))
        world.changeDynamics(ground, -1, lateralFriction=1.5)
        links = [  # length, where on the parent, half-turn's sine on x and y with its cosine, parent (0 is the base)
            (l2, [0, 0, l1 / 2], [np.sin(-rest / 2), 0, 0, np.cos(rest / 2)], 0),
            (l3, [0, 0, -l1 / 2], [np.sin(-rest / 2), 0, 0, np.cos(rest / 2)], 0),
            (l4, [0, 0, -l2], [np.sin((rest - beta) / 2), 0, 0, np.cos((rest - beta) / 2)], 1),
            (l5, [0, 0, 0], [0, np.sin((np.pi - toe) / 2), 0, np.cos((np.pi - toe) / 2)], 3),
            (l5, [0, 0, 0], [0, np.sin((np.pi + toe) / 2), 0, np.cos((np.pi + toe) / 2)], 3),
        ]
        middles = [[0, 0, -length / 2] for length, *_ in links]
        robot = world.createMultiBody(
            baseMass=0.07,
            baseCollisionShapeIndex=world.createCollisionShape(pybullet.GEOM_CAPSULE, radius=radius, height=l1),
            basePosition=[0, 0, max(l2, l3)],
            baseOrientation=[np.sin((np.pi / 2 + beta) / 2), 0, 0, np.cos((np.pi / 2 + beta) / 2)],
            linkMasses=[1200 * length * np.pi * radius**2 for length, *_ in links],
            linkCollisionShapeIndices=[
                world.createCollisionShape(
                    pybullet.GEOM_CAPSULE, radius=radius, height=length, collisionFramePosition=middle
                )
                for (length, *_), middle in zip(links, middles, strict=True)
            ],
            linkVisualShapeIndices=[-1] * 5,
            linkPositions=[place for _, place, _, _ in links],
            linkOrientations=[turn for _, _, turn, _ in links],
            linkInertialFramePositions=middles,
            linkInertialFrameOrientations=[[0, 0, 0, 1]] * 5,
            linkParentIndices=[parent for *_, parent in links],
            linkJointTypes=[pybullet.JOINT_REVOLUTE] * 3 + [pybullet.JOINT_FIXED] * 2,
            linkJointAxis=[[1, 0, 0]] * 5,
        )
        for joint, angle in ((0, delta), (1, -delta), (4, delta)):
            world.resetJointState(robot, joint, angle)
        pivots = ([0, 0, -l3 / 2], [0, 0, -l4 / 2])
        world.createConstraint(robot, 4, robot, 1, pybullet.JOINT_POINT2POINT, [1, 0, 0], *pivots)
        for link in range(5):
            world.changeDynamics(
                robot, link, lateralFriction=1.0, spinningFriction=0.15, rollingFriction=0.01, restitution=0.9,
                jointDamping=0.001,
            )  # fmt: skip
        world.setGravity(0, 0, -9.81)
        return _run(world, robot, ground, delta, k_nmm_per_deg / 1000)
    finally:
        world.disconnect()


def _run(world: BulletClient, robot: int, ground: int, delta: float, k_nm_per_deg: float) -> tuple[float, float]:
    """Settle 0.5 s, hold the loaded pose 0.5 s, release, look for contacts again after 0.5 s; at most 10 s in all."""
    clock = near_clock = free_clock = start_y = top = 0.0
    near = free = False
    while clock < 10:
        _, y, z = world.getBasePositionAndOrientation(robot)[0]
        angle = world.getJointState(robot, 0)[0]
        if free:
            top = max(top, z)
            torque = -(angle * 180 / np.pi) * k_nm_per_deg
            world.setJointMotorControl2(robot, 0, pybullet.TORQUE_CONTROL, force=torque)
            if free_clock <= 0.5:
                free_clock += TICK
            elif world.getContactPoints(robot, ground):
                return y - start_y, top
        elif clock >= 0.5:
            world.setJointMotorControl2(robot, 0, pybullet.POSITION_CONTROL, targetPosition=delta)
            near = near or abs(angle - delta) < 2 * np.pi / 180
            if near:
                near_clock += TICK
            if near_clock > 0.5:
                for joint in range(5):
                    world.setJointMotorControl2(robot, joint, pybullet.VELOCITY_CONTROL, force=0.001)
                start_y, free = y, True
        world.stepSimulation()
        clock += TICK
    return 0.0, top
