"""The steering wheel as a body of its own, on the joint `steer`, in the files of simulators (kg, m).

The project's own engines carry it with the body: it is in the air while they push off and fly.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import BODY, Body, ContactSphere, Joint, Mechanism, ReleasePose
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.drawing import WHEEL_PARTS
from jumpcad.robot.steering.limits import steers
from jumpcad.robot.steering.place import Steering
from jumpcad.scene.visuals import Visual
from jumpcad.transforms import chained, in_metres, rotation_about_y

WHEEL, STEER = "wheel", "steer"
"""Names of its body and of its joint."""
AXLE = "1 0 0"
N20_MM = 10.0
"""Width of the motors whose rotor's inertia a workshop gives; that of others grows with the fifth power of theirs."""
AnyMechanism = TypeVar("AnyMechanism", bound=Mechanism)


def wheel_of(mechanism: Mechanism) -> Steering | None:
    """Return where a robot's wheel is; None without one."""
    return mechanism.layout.of(Steering) if isinstance(mechanism, Robot) else None


def steered(mechanism: AnyMechanism, visible: Sequence[Visual] = ()) -> tuple[AnyMechanism, Sequence[Visual]]:
    """Return a robot and what is seen of it with the wheel as a fifth body; without a wheel they are the same."""
    if not isinstance(mechanism, Robot) or (place := mechanism.layout.of(Steering)) is None:
        return mechanism, visible
    T_body_wheel = in_metres(place.T_body_axle)
    T_wheel_body = np.asarray(np.linalg.inv(T_body_wheel))
    turning = [item.mass for item in mechanism.hardware if item.name in WHEEL_PARTS]
    for part in mechanism.parts:
        if part.name in WHEEL_PARTS:
            turning += [part.mass.placed(in_metres(one.T_body_part)) for one in part.placements]
    whole, wheel = mechanism.bodies[BODY], combined(turning)
    rest = combined([whole, MassProperties(-wheel.mass_kg, wheel.com_m, -wheel.inertia_kg_m2)])
    touches = ContactSphere("rim", np.zeros(3), place.radius_mm / 1000.0, "foot")
    bodies = dict(mechanism.bodies)
    bodies[BODY] = replace(whole, **vars(rest))
    bodies[WHEEL] = Body.of(WHEEL, wheel.placed(T_wheel_body), (touches,))
    drive = steers(mechanism)
    tilt = -np.radians(place.turn_deg)
    low, high = mechanism.workshop.release.rotor_kg_m2
    narrow = min(place.motor.width_mm, place.motor.height_mm) / N20_MM
    rotor = math.sqrt(low * high) * narrow**5 * place.motor.ratio**2
    joint = Joint(
        STEER, BODY, WHEEL, T_body_wheel[:3, 3], float(tilt), -np.inf, np.inf, drive.gears_nm, drive.free_rad_s,
        axis=AXLE, armature_kg_m2=rotor,
    )  # fmt: skip
    moved = [
        replace(one, body=WHEEL, T_body_mesh=chained(T_wheel_body, one.T_body_mesh)) if one.name in WHEEL_PARTS else one
        for one in visible
    ]
    return replace(mechanism, bodies=bodies, joints=(*mechanism.joints, joint)), moved


def on_its_wheel(mechanism: Mechanism, pose: ReleasePose) -> ReleasePose:
    """Return a loaded robot's pose turned about the sole of its front eye until the wheel stands on the ground."""
    if not isinstance(mechanism, Robot) or (place := mechanism.layout.of(Steering)) is None:
        return pose
    lean = math.asin(place.dip_mm / place.lever_mm)
    turn, eye = rotation_about_y(lean), np.array([mechanism.linkage.l4 / 1000.0, 0.0, 0.0])
    place_m = eye + np.einsum("ij,j->i", turn, pose.body_position_m - eye)
    velocity = np.einsum("ij,j->i", turn, pose.body_m_s)
    return replace(pose, body_position_m=place_m, body_pitch_rad=pose.body_pitch_rad + lean, body_m_s=velocity)
