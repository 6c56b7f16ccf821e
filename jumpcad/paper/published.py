"""The simulation of the published jumping-robot study, bit for bit: a regression path, not the evaluator.

Nothing here may be tidied: every line in which the result depends on an order, a rounding or a default says so. The
study's frames and units stay inside: links along z, joints about x, the jump along +y, a stiffness per *degree*.
"""

import math
from dataclasses import dataclass
from types import ModuleType

import numpy as np

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.mechanism.variants import BODY_MASS_KG, DENSITY_KG_M3, LENGTH_PER_RADIUS
from jumpcad.simulation.engines import import_pybullet

GROUND_FRICTION = 1.5
LATERAL_FRICTION = 1.0
SPINNING_FRICTION = 0.15
ROLLING_FRICTION = 0.01
JOINT_DAMPING = 0.001
RESTITUTION = 0.9
"""The values that give the published results; the study's hyperparameter table lists others (see `reproduction`)."""

STEP_S = 1.0 / 240.0
SETTLE_S = HOLD_S = IGNORED_S = 0.5
"""Settling before loading, holding before release, and contacts ignored after it."""
LIMIT_S = 10.0
HOLD_TOLERANCE_RAD = math.radians(2.0)
MOTOR_FORCE_NM = 0.001

# Bullet numbers links depth first, whatever order they are made in: the foot hangs from the leg, so it comes second.
LEG, FOOT, LEFT_TOE, RIGHT_TOE, FRONT = LINKS = range(5)


@dataclass(frozen=True)
class PublishedJump:
    """The three numbers that the study reports.

    `distance_m` is where the body is at the first contact later than 0.5 s after release, which need not be the
    landing; `base_height_m` is the body's greatest absolute height, standing height included; `energy_j` is ½·k·δ².
    """

    distance_m: float
    base_height_m: float
    energy_j: float


@check_arguments
def simulate(design: Design) -> PublishedJump:
    """Return the jump that the study's simulation gives for a design.

    Raises
    ------
    CannotBuildError
        If the design has no assembled pose.
    JumpcadError
        If PyBullet is not installed.
    """
    energy = design.spring_energy_j  # raises for a design without an assembled pose
    bullet = import_pybullet("the published model has no other engine")
    client = bullet.connect(bullet.DIRECT)
    try:
        distance, height = _jump(bullet, client, design, _geometry(design))
    finally:
        bullet.disconnect(physicsClientId=client)
    return PublishedJump(distance, height, energy)


@dataclass(frozen=True)
class _Geometry:
    """Lengths in m and angles in rad; `compression_rad` is δ, by which the springs are loaded."""

    l1: float
    l2: float
    l3: float
    l4: float
    l5: float
    radius: float
    rest_rad: float
    beta_rad: float
    compression_rad: float
    toe_rad: float


def _geometry(design: Design) -> _Geometry:
    """Compute in mm and divide last, angles as x·π/180: other roundings move some distances by up to 1e-4 m."""
    l2, l3, l4, l5 = design.links_mm
    rest = design.rest_angle_deg * math.pi / 180.0
    if l3 == l2:
        beta, l1 = 0.0, l4
    else:
        # The study's arcsine: the C library's differs in the last bit of one argument in twelve.
        beta = float(np.arcsin((l3 - l2) * math.sin(rest) / l4))
        l1 = l4 * math.sin(rest - beta) / math.sin(rest)
    return _Geometry(
        l1=l1 / 1000.0, l2=l2 / 1000.0, l3=l3 / 1000.0, l4=l4 / 1000.0, l5=l5 / 1000.0,
        radius=max(l2, l3, l5) / LENGTH_PER_RADIUS / 1000.0, rest_rad=rest, beta_rad=beta,
        compression_rad=design.compression_ratio * (rest + beta),
        toe_rad=design.ground_link_angle_deg * math.pi / 180.0,
    )  # fmt: skip


def _jump(bullet: ModuleType, client: int, design: Design, geometry: _Geometry) -> tuple[float, float]:
    """Run the jump; return the distance and the greatest height of the body (m)."""
    here = {"physicsClientId": client}
    # Bullet keeps this threshold per process: another simulation may have changed it from its default.
    bullet.setPhysicsEngineParameter(contactBreakingThreshold=0.02, **here)
    ground = bullet.createMultiBody(0.0, bullet.createCollisionShape(bullet.GEOM_PLANE, **here), **here)
    bullet.changeDynamics(ground, -1, lateralFriction=GROUND_FRICTION, **here)
    robot = _robot(bullet, client, geometry)
    compression = geometry.compression_rad
    stiffness_nm_per_deg = design.stiffness_nmm_per_deg / 1000.0
    released, start_y, height = False, 0.0, 0.0
    # Three float clocks: adding 1/240 does not give k/240, and the step in which each runs out decides the result.
    clock = held = flown = 0.0
    while clock < LIMIT_S:
        if clock >= SETTLE_S:  # before, the default motors of the joints hold the pose
            angle = bullet.getJointState(robot, LEG, **here)[0]
            if released:
                _, y, z = bullet.getBasePositionAndOrientation(robot, **here)[0]  # before the step
                height = max(height, z)
                # The spring's zero is the assembled pose, and its torque is held over the whole step.
                # In this order: math.degrees rounds otherwise, which moves one design in eight by more than 1e-9 m.
                torque = -angle * 180 / math.pi * stiffness_nm_per_deg
                bullet.setJointMotorControl2(robot, LEG, bullet.TORQUE_CONTROL, force=torque, **here)
                if flown > IGNORED_S and bullet.getContactPoints(robot, ground, **here):
                    return y - start_y, height
                flown += STEP_S
            else:
                bullet.setJointMotorControl2(robot, LEG, bullet.POSITION_CONTROL, targetPosition=compression, **here)
                if held > 0.0 or abs(angle - compression) < HOLD_TOLERANCE_RAD:
                    held += STEP_S  # before the comparison: one step later moves distances by 1e-4 m
                    if held > HOLD_S:
                        for link in LINKS:  # the motors stay on, as a little friction in every joint
                            bullet.setJointMotorControl2(
                                robot, link, bullet.VELOCITY_CONTROL, force=MOTOR_FORCE_NM, **here
                            )
                        start_y = bullet.getBasePositionAndOrientation(robot, **here)[0][1]
                        released = True  # without torque in this step
        bullet.stepSimulation(**here)
        clock += STEP_S
    return 0.0, height


def _robot(bullet: ModuleType, client: int, geometry: _Geometry) -> int:
    """Put the loaded robot into the world and return its number."""
    here = {"physicsClientId": client}
    g = geometry
    # In the order of creation, which is not the order of Bullet's numbers: leg, front link, foot, two toes.
    lengths = (g.l2, g.l3, g.l4, g.l5, g.l5)
    middles = [[0.0, 0.0, -length / 2] for length in lengths]
    shapes = [
        bullet.createCollisionShape(
            bullet.GEOM_CAPSULE, radius=g.radius, height=length, collisionFramePosition=middle, **here
        )
        for length, middle in zip(lengths, middles, strict=True)
    ]
    robot = bullet.createMultiBody(
        BODY_MASS_KG,
        bullet.createCollisionShape(bullet.GEOM_CAPSULE, radius=g.radius, height=g.l1, **here),
        basePosition=[0.0, 0.0, max(g.l2, g.l3)],  # higher than it stands: it drops and settles
        baseOrientation=_about_x(math.pi / 2 + g.beta_rad),
        # The cylinder alone, caps not counted; the tensor is Bullet's, of the shape's bounding box.
        linkMasses=[DENSITY_KG_M3 * length * math.pi * g.radius**2 for length in lengths],
        linkCollisionShapeIndices=shapes,
        linkVisualShapeIndices=[-1] * 5,
        linkPositions=[[0.0, 0.0, g.l1 / 2], [0.0, 0.0, -g.l1 / 2], [0.0, 0.0, -g.l2], [0.0] * 3, [0.0] * 3],
        linkOrientations=[
            _about_x(-g.rest_rad),
            _about_x(-g.rest_rad),
            _about_x(g.rest_rad - g.beta_rad),
            _about_y(math.pi - g.toe_rad),
            _about_y(math.pi + g.toe_rad),
        ],
        linkInertialFramePositions=middles,
        linkInertialFrameOrientations=[[0.0, 0.0, 0.0, 1.0]] * 5,
        linkParentIndices=[0, 0, 1, 3, 3],  # here 0 is the body
        linkJointTypes=[bullet.JOINT_REVOLUTE] * 3 + [bullet.JOINT_FIXED] * 2,
        linkJointAxis=[[1.0, 0.0, 0.0]] * 5,
        **here,
    )
    # The pose closes the loop only where l2 = l3 and l1 = l4; the constraint closes it while the robot settles.
    for link, angle in ((LEG, g.compression_rad), (FOOT, -g.compression_rad), (FRONT, g.compression_rad)):
        bullet.resetJointState(robot, link, angle, **here)
    bullet.createConstraint(
        robot, FRONT, robot, FOOT, bullet.JOINT_POINT2POINT, [1.0, 0.0, 0.0],
        [0.0, 0.0, -g.l3 / 2], [0.0, 0.0, -g.l4 / 2], **here,  # pivots seen from the centres of mass
    )  # fmt: skip
    for link in LINKS:  # not the base, which keeps Bullet's defaults
        bullet.changeDynamics(
            robot, link, lateralFriction=LATERAL_FRICTION, spinningFriction=SPINNING_FRICTION,
            rollingFriction=ROLLING_FRICTION, restitution=RESTITUTION, jointDamping=JOINT_DAMPING, **here,
        )  # fmt: skip
    bullet.setGravity(0.0, 0.0, -9.81, **here)
    return int(robot)


def _about_x(angle_rad: float) -> list[float]:
    """Return the quaternion (x, y, z, w) of a turn about x; Bullet's own helpers round it differently."""
    return [math.sin(angle_rad / 2), 0.0, 0.0, math.cos(angle_rad / 2)]


def _about_y(angle_rad: float) -> list[float]:
    return [0.0, math.sin(angle_rad / 2), 0.0, math.cos(angle_rad / 2)]
