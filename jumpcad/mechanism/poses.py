"""Where the bodies of a standing robot are, at any winding of its springs."""

from dataclasses import replace

from jumpcad.robot import BODY, Robot
from jumpcad.simulation.mechanics import Release, release_pose
from jumpcad.transforms import Array, chained, pose_at, rotation_about_y


def standing(robot: Robot, wound: float) -> Release:
    """Return the pose, foot flat on the ground, with the springs wound by a share (0 at rest … 1)."""
    spring = replace(robot.spring, wind_rad=wound * robot.spring.wind_rad)
    return release_pose(replace(robot, spring=spring))


def body_poses(robot: Robot, wound: float = 0.0) -> dict[str, Array]:
    """Return the pose (4, 4) of every body's frame in the world (m) of a standing robot."""
    stance = standing(robot, wound)
    poses = {BODY: pose_at(rotation_about_y(stance.body_pitch_rad), stance.body_position_m)}
    for joint in robot.joints:
        turn = rotation_about_y(joint.rest_angle_rad + stance.joint_rad[joint.name])
        poses[joint.child] = chained(poses[joint.parent], pose_at(turn, joint.origin_m))
    return poses
