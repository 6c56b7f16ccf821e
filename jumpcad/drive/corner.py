"""The roller on the corner at the end of the cam's lift, sharp or rounded (mm, rad; frames as in `cam`)."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from jumpcad.drive.cam import CamGeometry
from jumpcad.transforms import Array, turned_about_y

POSITIONS = 401
"""Cam angles on the corner; with 32 times as many, the energy ratio changes by less than 0.0002, the motor's torque
peak by 2 %."""
WINDOW_POSITIONS = 51
"""Cam angles between the end of the lift and a whole turn at which the roller's path is checked."""
SEARCHED_RAD = 0.5
"""How far before the end of the lift a rounding may begin; judgement: far more than a printed corner needs."""


@dataclass(frozen=True)
class Corner:
    """The roller's path over the corner, at n evenly spaced cam angles while the two touch.

    `slope` and `bend` are the derivatives of the leg's angle `wind_rad` by the cam's, `arm_mm` the contact force's
    lever arms about the leg's pivot.
    """

    cam_rad: Array
    wind_rad: Array
    slope: Array
    bend: Array
    arm_mm: Array


def roll_over(geometry: CamGeometry, rounding_mm: float = 0.0) -> Corner:
    """Return the roller's path over a corner, from the end of the lift until the leg is at rest or the roller is free.

    A corner rounded by a radius is an arc about `_rounding`; the roller's centre then stays at the sum of both
    radii from that centre.
    """
    begin, centre = _rounding(geometry, rounding_mm)
    reach = geometry.roller_radius_mm + rounding_mm
    cam = np.linspace(begin, geometry.free_rad, POSITIONS)
    corner = geometry.in_body(centre, cam)
    wind, cosine = geometry.wind_around_rad(corner, reach)
    touching = (cosine < 1.0) & (wind > 0.0)
    last = POSITIONS if touching.all() else int(np.argmin(touching))
    cam, corner, wind = cam[:last], corner[:last], wind[:last]
    centre_mm = geometry.roller_mm(wind)
    normal = (centre_mm - corner) / reach
    arm = normal[:, 1] * centre_mm[:, 0] - normal[:, 0] * centre_mm[:, 1]
    from_axis = corner - geometry.axis_mm
    moved = normal[:, 0] * from_axis[:, 1] - normal[:, 1] * from_axis[:, 0]
    slope = moved / np.maximum(arm, 1e-3)
    return Corner(cam, wind, slope, np.gradient(slope, cam[1] - cam[0]), np.maximum(arm, 1e-3))


@lru_cache(maxsize=8)
def clear_window_rad(geometry: CamGeometry) -> tuple[float, float]:
    """Return the range of cam angles, from the end of the lift, in which the roller can fall freely to past rest (rad).

    There every corner of the cam's outline is at least a roller's radius from the arc of the roller's centre. NaN if
    there is no such angle.
    """
    return _window(geometry, geometry.outline_mm())


def _window(geometry: CamGeometry, outline_mm: Array) -> tuple[float, float]:
    lift = geometry.law.lift_rad
    low, high = geometry.roller_mm([-geometry.overshoot_rad, geometry.law.compression_rad])
    turns = np.linspace(0.0, 2.0 * math.pi - lift, WINDOW_POSITIONS)
    outline = geometry.in_body(outline_mm[None], lift + turns[:, None])
    x, z = outline[..., 0], outline[..., 1]
    beside = (low[0] * z >= low[1] * x) & (x * high[1] >= z * high[0])  # the arc is less than half a turn
    off_arc = np.abs(np.sqrt(x * x + z * z) - geometry.lever_mm)  # products and roots are quicker than `hypot`
    off_ends = np.sqrt(np.minimum(*((x - end[0]) ** 2 + (z - end[1]) ** 2 for end in (low, high))))
    gap = np.where(beside, off_arc, off_ends).min(axis=1) - geometry.roller_radius_mm
    free = np.flatnonzero(gap >= 0.0)
    if not free.size:
        return math.nan, math.nan
    first, last = int(free[0]), int(free[-1])
    return _crossing(turns, gap, first - 1, first), _crossing(turns, gap, last + 1, last)


def _crossing(turns: Array, gap: Array, outside: int, inside: int) -> float:
    """Return the angle at which a gap becomes positive between two samples; at either end, the inner sample."""
    if not 0 <= outside < len(turns):
        return float(turns[inside])
    share = gap[inside] / (gap[inside] - gap[outside])
    return float(turns[inside] + share * (turns[outside] - turns[inside]))


def _rounding(geometry: CamGeometry, radius_mm: float) -> tuple[float, Array]:
    """Return where a rounding begins on the lift (cam angle), and its centre (2,) in the cam's frame.

    The centre lies a radius inside both the lift and the drop face, which is an arc about the hub at `free_rad`.
    """
    lift = geometry.law.lift_rad
    if radius_mm == 0.0:
        return lift, geometry.tip_mm
    cam = np.linspace(lift - SEARCHED_RAD, lift, POSITIONS)
    inside = geometry.contact_mm(cam) - radius_mm * turned_about_y(geometry.normal(cam), -cam)
    seen = geometry.in_body(inside, geometry.free_rad)
    face = geometry.lever_mm + geometry.roller_radius_mm + geometry.clearance_mm
    room = np.hypot(seen[:, 0], seen[:, 1]) - face - radius_mm
    index = int(np.flatnonzero(room >= 0.0)[-1]) if (room >= 0.0).any() else 0
    if index == POSITIONS - 1:
        return float(cam[index]), inside[index]
    share = float(np.clip(room[index] / (room[index] - room[index + 1]), 0.0, 1.0))
    between = cam[index] + share * (cam[1] - cam[0])
    return float(between), inside[index] + share * (inside[index + 1] - inside[index])
