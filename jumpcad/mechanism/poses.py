"""Where the bodies of a standing robot are, at any winding of its springs."""

from dataclasses import replace

import numpy as np

from jumpcad.exporters.xml import about_y
from jumpcad.parts.part import Array
from jumpcad.robot import BODY, Robot
from jumpcad.simulation.mechanics import Release, release_pose


def standing(robot: Robot, wound: float) -> Release:
    """Return the pose, foot flat on the ground, with the springs wound by a share (0 at rest … 1)."""
    spring = replace(robot.spring, wind_rad=wound * robot.spring.wind_rad)
    return release_pose(replace(robot, spring=spring))


def body_poses(robot: Robot, wound: float = 0.0) -> dict[str, Array]:
    """Return the pose (4, 4) of every body's frame in the world (m) of a standing robot."""
    pose = standing(robot, wound)
    poses = {BODY: transform(about_y(pose.body_pitch_rad), pose.body_position_m)}
    for joint in robot.joints:
        turn = about_y(joint.rest_angle_rad + pose.joint_rad[joint.name])
        poses[joint.child] = np.einsum("ij,jk->ik", poses[joint.parent], transform(turn, joint.origin_m))
    return poses


def transform(rotation: Array, translation: Array) -> Array:
    """Return the pose (4, 4) of a rotation (3, 3) and a translation (3,)."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, translation
    return pose
