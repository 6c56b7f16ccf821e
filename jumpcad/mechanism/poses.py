"""Where the bodies of a standing robot are, at any load of its springs, and before release."""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.model import BODY, Mechanism
from jumpcad.transforms import Array, chained, pose_at, rotation_about_y


@dataclass(frozen=True)
class Release:
    """The robot before release: loop exactly closed, foot flat on the ground, ankle above the world's origin.

    `joint_rad` holds the coordinate of every joint by name; the frame of `body` lies at `body_position_m` (3,), turned
    about the world's y axis by `body_pitch_rad`.
    """

    joint_rad: dict[str, float]
    body_position_m: Array
    body_pitch_rad: float


def release_pose(mechanism: Mechanism) -> Release:
    """Return the pose of a robot with loaded springs.

    Raises
    ------
    CannotBuildError
        If the loop does not close there.
    """
    return standing(mechanism, 1.0)


def standing(mechanism: Mechanism, loaded: float) -> Release:
    """Return the pose, foot flat on the ground, with the springs loaded by a share (0 at rest … 1)."""
    pose = mechanism.linkage.pose([-loaded * mechanism.spring.wind_rad])
    pitch = -float(pose.foot_rad[0])
    cos, sin = math.cos(pitch), math.sin(pitch)
    x, z = pose.ankle_mm[0] / 1000.0
    position = np.array([-cos * x - sin * z, 0.0, mechanism.foot_depth_m + sin * x - cos * z])
    joints = {"leg": pose.leg_rad, "front": pose.front_rad, "ankle": pose.ankle_rad}
    return Release({name: float(angle[0]) for name, angle in joints.items()}, position, pitch)


def body_poses(mechanism: Mechanism, loaded: float = 0.0) -> dict[str, Array]:
    """Return the pose (4, 4) of every body's frame in the world (m) of a standing robot."""
    stance = standing(mechanism, loaded)
    poses = {BODY: pose_at(rotation_about_y(stance.body_pitch_rad), stance.body_position_m)}
    for joint in mechanism.joints:
        turn = rotation_about_y(joint.rest_angle_rad + stance.joint_rad[joint.name])
        poses[joint.child] = chained(poses[joint.parent], pose_at(turn, joint.origin_m))
    return poses
