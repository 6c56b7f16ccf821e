"""Elements and documents of the XML formats; numbers are written so that they read back as the same doubles."""

import math
import re
import warnings
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import Joint, Mechanism, Multibody
from jumpcad.settings import Settings, coefficients
from jumpcad.strength.loads import pin_torque_nm
from jumpcad.transforms import Array

Value: TypeAlias = str | float | npt.ArrayLike

FORBIDDEN = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML does not allow (XML 1.0, production 2)."""
DIGITS = 12
"""Significant digits of shortened numbers: fewer than those in which processors differ."""
SWING_RAD = math.pi / 2
"""Added to the travel on either side: simulators treat limits as stops, and legs swing past rest."""


def written(value: Value) -> str:
    """Return a value as text: the shortest decimals that read back as the same doubles, separated by blanks."""
    if isinstance(value, str):
        return value
    return " ".join(repr(float(number) + 0.0) for number in np.ravel(value))


def shortened(value: Value) -> str:
    """Return a value as text, numbers with `DIGITS` digits, and 0 below 10^-DIGITS of the largest."""
    if isinstance(value, str):
        return value
    numbers = [float(number) for number in np.ravel(value)]
    least = 10.0**-DIGITS * max(map(abs, numbers))
    return " ".join(f"{number if abs(number) > least else 0.0:.{DIGITS}g}" for number in numbers)


def allowed(text: str) -> str:
    """Return a text that XML may hold; XML has no way to write most control characters, not even escaped."""
    if found := FORBIDDEN.search(text):
        around = text[max(found.start() - 20, 0) : found.end() + 20]
        raise JumpcadError(f"{around!r}: XML cannot hold the character U+{ord(found[0]):04X}: leave it out")
    return text


def rpy(rotation: Array) -> Array:
    """Return roll, pitch and yaw (3,) about fixed axes (rad) of a rotation (3, 3), as in URDF and SDF."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Gimbal lock")  # at a pitch of 90° yaw is chosen as zero
        angles: Array = Rotation.from_matrix(rotation).as_euler("xyz")
    return angles


def wxyz(rotation: Array) -> Array:
    """Return the quaternion (4,), scalar first, of a rotation (3, 3), as in MJCF."""
    return np.asarray(Rotation.from_matrix(rotation).as_quat(scalar_first=True))


def limits(joint: Joint, mechanism: Mechanism) -> dict[str, float]:
    """Return what URDF and SDF say of a joint's limits: lower and upper angle (rad from rest), effort and velocity.

    The angles are its travel and `SWING_RAD`; above, its stop if any. A joint that turns without end has none.
    """
    if math.isinf(joint.upper_rad):
        return {"effort": joint.effort_nm, "velocity": joint.velocity_rad_s}
    stop = mechanism.stop
    upper = stop.angle_rad if stop and stop.joint == joint.name else joint.upper_rad + SWING_RAD
    return {"lower": joint.lower_rad - SWING_RAD, "upper": upper, "effort": joint.effort_nm,
            "velocity": joint.velocity_rad_s}  # fmt: skip


def friction_nm(joint: Joint, mechanism: Multibody, settings: Settings) -> float:
    """Return a joint's dry friction: its own, that of the settings, and at a five-bar's leg that of all pins."""
    dry_nm = joint.friction_nm + settings.joint_friction_nm
    if not isinstance(mechanism, Mechanism) or joint.name != mechanism.spring.joint:
        return dry_nm
    return dry_nm + pin_torque_nm(mechanism, coefficients(mechanism, settings).pin)
