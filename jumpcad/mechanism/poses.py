"""Where the bodies of a standing robot are, at any load of its springs, and their rates once the cam has released."""

import cmath
import math
from dataclasses import dataclass, field

import numpy as np

from jumpcad.mechanism.model import Mechanism, Multibody
from jumpcad.transforms import Array, ByValue, pose_at, rotation_about_y


@dataclass(frozen=True, eq=False)
class ReleasePose(ByValue):
    """The robot at release: loops closed, foot flat and still on the ground, a five-bar's ankle above the origin.

    `joint_rad` holds the coordinate of every joint by name; the frame of the joints' root, `body`, lies at
    `body_position_m` (3,), turned about the world's y axis by `body_pitch_rad`. `joint_rad_s`, `body_m_s` (3,) and
    `body_rad_s`, about y, are the rates of these, zero where the springs are released instantly.
    """

    joint_rad: dict[str, float]
    body_position_m: Array
    body_pitch_rad: float
    joint_rad_s: dict[str, float] = field(default_factory=lambda: {"leg": 0.0, "front": 0.0, "ankle": 0.0})
    body_m_s: Array = field(default_factory=lambda: np.zeros(3))
    body_rad_s: float = 0.0


def release_pose(mechanism: Multibody) -> ReleasePose:
    """Return pose and rates where the jump begins: where the roller has left the cam, or at rest with loaded springs.

    That of a five-bar is in closed form, that of others found, see `Multibody.loaded`.
    """
    if not isinstance(mechanism, Mechanism):
        height_m, pitch_rad, *angles = mechanism.loaded.tolist()
        names = [joint.name for joint in mechanism.joints]
        place_m, still = np.array([0.0, 0.0, height_m]), dict.fromkeys(names, 0.0)
        return ReleasePose(dict(zip(names, angles, strict=True)), place_m, pitch_rad, still)
    off = mechanism.roller_off
    return standing(mechanism, 1.0) if off is None else _moving(mechanism, off.leg_rad, off.leg_rad_s)


def standing(mechanism: Mechanism, loaded: float) -> ReleasePose:
    """Return the pose, foot flat on the ground, with the springs loaded by a share (0 at rest … 1)."""
    return _at(mechanism, -loaded * mechanism.spring.wind_rad)


def _moving(mechanism: Mechanism, leg_rad: float, leg_rad_s: float) -> ReleasePose:
    """Return pose and rates of a robot whose leg joint turns while its foot stands still.

    In the world the ankle is fixed, so the body moves against the ankle's motion in the body's frame, and turns against
    the foot's.
    """
    pose, (foot, front, ankle_mm) = _at(mechanism, leg_rad), mechanism.linkage.rates(leg_rad)
    l1_m, l2_m = mechanism.linkage.l1 / 1000.0, mechanism.linkage.l2 / 1000.0
    ankle_m = -l1_m / 2.0 + l2_m * cmath.exp(-1j * (mechanism.linkage.rest_rad + leg_rad))
    across = -(ankle_mm / 1000.0 + 1j * foot * ankle_m) * cmath.exp(-1j * pose.body_pitch_rad) * leg_rad_s
    rates = {"leg": leg_rad_s, "front": front * leg_rad_s, "ankle": (foot - 1.0) * leg_rad_s}
    velocity = np.array([across.real, 0.0, across.imag])
    return ReleasePose(pose.joint_rad, pose.body_position_m, pose.body_pitch_rad, rates, velocity, -foot * leg_rad_s)


def _at(mechanism: Mechanism, leg_rad: float) -> ReleasePose:
    pose = mechanism.linkage.pose([leg_rad])
    pitch = -float(pose.foot_rad[0])
    cos, sin = math.cos(pitch), math.sin(pitch)
    x, z = pose.ankle_mm[0] / 1000.0
    position = np.array([-cos * x - sin * z, 0.0, mechanism.foot_depth_m + sin * x - cos * z])
    joints = {"leg": pose.leg_rad, "front": pose.front_rad, "ankle": pose.ankle_rad}
    return ReleasePose({name: float(angle[0]) for name, angle in joints.items()}, position, pitch)


def body_poses(mechanism: Mechanism, loaded: float = 0.0) -> dict[str, Array]:
    """Return the pose (4, 4) of every body's frame in the world (m) of a standing robot."""
    stance = standing(mechanism, loaded)
    root = pose_at(rotation_about_y(stance.body_pitch_rad), stance.body_position_m)
    return mechanism.poses(root, [stance.joint_rad.get(joint.name, 0.0) for joint in mechanism.joints])
