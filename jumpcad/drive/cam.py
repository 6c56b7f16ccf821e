"""The snail cam: its curves in closed form, and the finished cam.

Frame. Everything lies in the body's x-z plane (x forward, z up), in mm, with the main leg's pivot (the hub) at the
origin. Angles of the lever are counter-clockwise from x. Winding turns leg and lever counter-clockwise; the cam turns
clockwise, which is a positive turn about +y. Turned the other way, the lobe would leave the roller on the hub's side,
where the lever is.

Curves are in the cam's own frame: origin on the cam's axis, directions those of the body at cam angle 0 (leg at
rest). At cam angle phi the cam is turned clockwise by phi.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from jumpcad.drive.cam_law import CamLaw
from jumpcad.findings import Finding
from jumpcad.transforms import Array, turned_about_y


@dataclass(frozen=True)
class CamGeometry:
    """Where the cam is and how large the lever is; with a law, this fixes every curve of the cam.

    - `lever_mm`: Hub to roller centre.
    - `axis_distance_mm`, `axis_rad`: The cam's axis from the hub: distance, and direction counter-clockwise from x.
    - `lead_rad`: Direction of the lever at rest, counter-clockwise from that of the cam's axis.
    - `roller_radius_mm`, `clearance_mm`: Radius of the roller, and the gap that the drop face leaves around it.
    - `overshoot_rad`: How far past rest the drop leaves room for the leg.
    """

    law: CamLaw
    lever_mm: float
    axis_distance_mm: float
    axis_rad: float
    lead_rad: float
    roller_radius_mm: float
    clearance_mm: float
    overshoot_rad: float

    @property
    def lever_start_rad(self) -> float:
        """Direction of the lever at rest, counter-clockwise from x (rad)."""
        return self.axis_rad + self.lead_rad

    @property
    def axis_mm(self) -> Array:
        """The cam's axis (2,) from the hub (mm)."""
        return self.axis_distance_mm * _unit(self.axis_rad)

    def roller_mm(self, wind_rad: npt.ArrayLike) -> Array:
        """Return the roller's centre (n, 2) at leg angles (n,), from the hub, in the body's directions."""
        return self.lever_mm * _unit(self.lever_start_rad + np.asarray(wind_rad, dtype=float))

    def in_cam(self, point_mm: npt.ArrayLike, cam_rad: npt.ArrayLike) -> Array:
        """Return points (n, 2), given from the hub, in the cam's frame at cam angles (n,)."""
        return turned_about_y(np.asarray(point_mm, dtype=float) - self.axis_mm, -np.asarray(cam_rad, dtype=float))

    def in_body(self, point_mm: npt.ArrayLike, cam_rad: npt.ArrayLike) -> Array:
        """Return points (n, 2) of the cam's frame, seen from the hub at cam angles (n,)."""
        return self.axis_mm + turned_about_y(point_mm, cam_rad)

    def pitch_mm(self, cam_rad: npt.ArrayLike) -> Array:
        """Return the pitch curve (n, 2), the roller's centre in the cam's frame, at cam angles (n,) of the lift."""
        return self.in_cam(self.roller_mm(self.law.wind_rad(cam_rad)), cam_rad)

    def normal(self, cam_rad: npt.ArrayLike) -> Array:
        """Return unit normals (n, 2) of the pitch curve in the body's directions, from the cam towards the roller.

        The common normal passes through the instant centre of cam and leg; with the lever's direction u and the axis
        c it is along L(1 + theta')u - c.
        """
        wind, first, _ = self.law.derivatives(cam_rad)
        arm = self.lever_mm * (1 + first)[..., None] * _unit(self.lever_start_rad + wind)
        vector = arm - self.axis_mm
        return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))

    def contact_mm(self, cam_rad: npt.ArrayLike) -> Array:
        """Return the profile (n, 2) of the lift in the cam's frame: where the roller touches at cam angles (n,)."""
        return self.pitch_mm(cam_rad) - self.roller_radius_mm * turned_about_y(
            self.normal(cam_rad), -np.asarray(cam_rad, dtype=float)
        )

    @cached_property
    def tip_mm(self) -> Array:
        """The corner (2,) at the end of the lift, in the cam's frame."""
        return self.contact_mm(self.law.lift_rad)

    @cached_property
    def free_rad(self) -> float:
        """Cam angle from which the roller can fall past the corner without touching it.

        The roller must clear the corner on its arc about the hub, so the corner must be farther from the hub than
        lever, roller radius and clearance together. NaN if the corner never is that far away.
        """
        radius = float(np.hypot(*self.tip_mm))
        reach = self.lever_mm + self.roller_radius_mm + self.clearance_mm
        cosine = (reach**2 - self.axis_distance_mm**2 - radius**2) / (2 * self.axis_distance_mm * radius)
        if abs(cosine) > 1:
            return math.nan
        direction = self.axis_rad + math.acos(cosine)
        now = math.atan2(self.tip_mm[1], self.tip_mm[0])
        turn = (now - direction - self.law.lift_rad) % (2 * math.pi)
        return self.law.lift_rad + turn

    def wind_around_rad(self, corner_mm: Array, reach_mm: float) -> tuple[Array, Array]:
        """Return the leg angle (n,) with the roller's centre at a distance from corners (n, 2), seen from the hub.

        And a cosine (n,), below 1 where the lever reaches so far.
        """
        x, z = corner_mm[..., 0], corner_mm[..., 1]
        distance = np.hypot(x, z)
        cosine = (distance**2 + self.lever_mm**2 - reach_mm**2) / (2 * distance * self.lever_mm)
        behind = np.arctan2(z, x) - self.lever_start_rad
        wind = np.mod(behind + math.pi, 2 * math.pi) - math.pi + np.arccos(np.clip(cosine, -1.0, 1.0))
        return wind, cosine

    def outline_mm(self, lift_points: int = 181) -> Array:
        """Return the cam's outline (n, 2) in its frame, counter-clockwise, not closed by repeating its first point.

        Lift; drop face, an arc about the hub's position at release; the hollow for the roller's overshoot; the
        relief, an arc about the cam's axis that touches the hollow; and the step up to the lift.
        """
        lift = self.contact_mm(np.linspace(0.0, self.law.lift_rad, lift_points))
        gap = self.roller_radius_mm + self.clearance_mm
        free = self.free_rad
        start = self.lever_start_rad
        corner = self.in_body(self.tip_mm, free)
        first = math.atan2(corner[1], corner[0]) % (2 * math.pi)
        face = (self.lever_mm + gap) * _unit(np.linspace(first, start - self.overshoot_rad, 24)[1:])
        bottom = self.roller_mm(-self.overshoot_rad)
        inwards = self.axis_mm - bottom
        outwards = start - self.overshoot_rad
        to_axis = math.atan2(inwards[1], inwards[0])
        to_axis = outwards - (outwards - to_axis) % (2 * math.pi)
        hollow = bottom + gap * _unit(np.linspace(outwards, to_axis, 16)[1:])
        relief_radius = float(np.hypot(*inwards)) - gap
        begin = float(np.arctan2(*self.in_cam(hollow[-1], free)[::-1]))
        end = begin + (math.atan2(lift[0, 1], lift[0, 0]) - begin) % (2 * math.pi)
        relief = relief_radius * _unit(np.linspace(begin, end, 16)[1:])
        return np.concatenate([lift, self.in_cam(np.concatenate([face, hollow]), free), relief])


@dataclass(frozen=True)
class Cam:
    """A finished cam with its lever; lengths in mm, points from the hub unless the cam's frame is named.

    - `profile_mm`: Outline (n, 2), in the cam's frame at cam angle 0.
    - `outer_radius_mm`, `core_radius_mm`: Distances of the outline's farthest and nearest point from the cam's axis.
    - `max_pressure_angle_rad`, `min_convex_radius_mm`: Largest pressure angle of the lift, and smallest convex radius
      of its pitch curve.
    - `peak_contact_n`, `contact_pressure_mpa`: Largest force between roller and cam, and largest pressure of their line
      contact (Hertz).
    - `worn_mm`: Radius to which the corner at the end of the lift wears.
    """

    geometry: CamGeometry
    profile_mm: Array
    outer_radius_mm: float
    core_radius_mm: float
    max_pressure_angle_rad: float
    min_convex_radius_mm: float
    peak_contact_n: float
    contact_pressure_mpa: float
    worn_mm: float
    findings: tuple[Finding, ...]

    @property
    def law(self) -> CamLaw:
        return self.geometry.law

    @property
    def roll_over_rad(self) -> float:
        """Cam angle from the end of the lift until the roller falls past the corner with the usual clearance."""
        return self.geometry.free_rad - self.law.lift_rad

    def wind_rad(self, cam_rad: npt.ArrayLike) -> Array:
        """Return the leg angle (n,) at cam angles (n,) of any turn: lift, over the corner, then at rest."""
        phi = np.mod(np.asarray(cam_rad, dtype=float), 2 * math.pi)
        lift = self.law.wind_rad(np.minimum(phi, self.law.lift_rad))
        tip = self.geometry.in_body(self.geometry.tip_mm, phi)
        wind, cosine = self.geometry.wind_around_rad(tip, self.geometry.roller_radius_mm)
        over = np.where(cosine < 1, np.clip(wind, 0.0, self.law.compression_rad), 0.0)
        return np.where(phi <= self.law.lift_rad, lift, over)


def _unit(angle_rad: npt.ArrayLike) -> Array:
    """Return unit vectors (..., 2) counter-clockwise from x by angles (...)."""
    angle = np.asarray(angle_rad, dtype=float)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
