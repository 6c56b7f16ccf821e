"""The planar five-bar, solved exactly at any leg angle.

While the foot is on the ground the mechanism is a four-bar: body l1, main leg l2, foot l4, front link l3. Everything
here is in the body frame's x-z plane (see `model`), in mm and rad. Directions are given by their angle *below* the x
axis: angle a points along (cos a, -sin a), so that a grows with a positive turn about +y.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import higher, lower
from jumpcad.transforms import Array

Complex = npt.NDArray[np.complex128]
LONGER_BODY = higher("d_coef", "carrying_link_mm", note="a longer body")
SHORTER_BODY = lower("carrying_link_mm", "d_coef")
LEGS_APART = lower("compression_ratio") + higher("d_coef", "rest_angle_deg")
FARTHER_PAST_REST = lower("rest_angle_deg") + higher("d_coef", "c_coef")
SMALLER_LINKS = {
    "main_leg": lower("carrying_link_mm"), "front_link": lower("carrying_link_mm", "c_coef"),
    "foot": lower("carrying_link_mm", "d_coef", "e_coef"), "toe": lower("carrying_link_mm", "e_coef"),
}  # fmt: skip
"""What to change of a design: for more and for less room between the pivots, for legs that keep apart, for legs that
turn farther past rest, for smaller links by the beginnings of their names."""


@dataclass(frozen=True)
class Pose:
    """The mechanism at n leg angles; points (n, 2) in mm in the body frame's x-z plane, angles (n,) in rad.

    `leg_rad`, `front_rad`, `ankle_rad` are joint coordinates (zero in the assembled pose);
    `foot_rad` is the foot's direction below the body's x axis, so a flat foot means that the body is nose-up by it.
    """

    leg_rad: Array
    front_rad: Array
    ankle_rad: Array
    foot_rad: Array
    ankle_mm: Array
    front_eye_mm: Array


class Linkage:
    """The four-bar of one design."""

    def __init__(self, design: Design) -> None:
        self.design = design
        self.l1, self.l2, self.l3, self.l4 = design.l1_mm, design.l2_mm, design.l3_mm, design.l4_mm
        self.rest_rad = math.radians(design.rest_angle_deg)
        self.beta_rad = design.beta_rad
        self.back_pivot_mm = np.array([-self.l1 / 2, 0.0])
        self.front_pivot_mm = np.array([self.l1 / 2, 0.0])

    def __repr__(self) -> str:
        lengths = ", ".join(f"{length:.5g}" for length in (self.l1, self.l2, self.l3, self.l4))
        return f"<Linkage l1…l4 = {lengths} mm>"

    @property
    def travel_rad(self) -> tuple[float, float]:
        """Leg angles with the springs loaded and at rest (rad)."""
        return -self.design.compression_rad, 0.0

    @property
    def open_rad(self) -> float:
        """Leg angle just before foot and front link come into line, or main leg and body do."""
        cosine = (self.l1**2 + self.l2**2 - (self.l3 + self.l4) ** 2) / (2.0 * self.l1 * self.l2)
        return 0.999 * math.acos(max(cosine, -1.0)) - self.rest_rad

    def diagonal_mm(self, leg_rad: npt.ArrayLike) -> Array:
        """Return the distance (n,) from ankle to front pivot at leg angles (n,)."""
        return np.asarray(np.abs(self.l1 - self._ankle(leg_rad)))

    def closing_margin_mm(self) -> float:
        """Return the margin (mm) by which the loop closes over the whole travel; negative where it cannot.

        The diagonal from ankle to front pivot must stay between difference and sum of the lengths of foot and front
        link. It grows with the leg's angle from the body line up to 180°, so its extremes are at the ends of the
        travel, or where the leg crosses the body line.
        """
        shortest = self.diagonal_mm(-min(self.design.compression_rad, self.rest_rad))
        longest = self.diagonal_mm(0.0)
        return float(min(shortest - abs(self.l3 - self.l4), self.l3 + self.l4 - longest))

    def pose(self, leg_rad: npt.ArrayLike, other_branch: bool = False) -> Pose:
        """Solve the loop at leg angles (n,), on the branch continuous with the assembled pose, or on the other one."""
        leg = np.atleast_1d(np.asarray(leg_rad, dtype=float))
        return _solved(self.design, leg.tobytes(), leg.shape, other_branch)

    def _pose(self, leg: Array, other_branch: bool) -> Pose:
        ankle, foot = self._ankle(leg), self._foot(leg, other_branch)
        # Measured from the assembled pose, no link comes near the ±180° at which angles jump.
        front = _below((ankle + foot - self.l1) * np.exp(1j * self.rest_rad))
        angle = _below(foot)
        ankle_mm = self.back_pivot_mm + _points(ankle)
        return Pose(leg, front, angle - leg - self.beta_rad, angle, ankle_mm, ankle_mm + _points(foot))

    def height_of_body_mm(self, leg_rad: npt.ArrayLike) -> Array:
        """Return the heights (n, 2) of back and front pivot above the line through ankle and front eye."""
        ankle, foot = self._ankle(leg_rad), self._foot(leg_rad)
        return np.stack([(pivot - ankle) * foot.conjugate() for pivot in (0.0, self.l1)], axis=-1).imag / self.l4

    def rates(self, leg_rad: float) -> tuple[float, float, complex]:
        """Return d(foot angle, front joint, ankle)/d(leg angle), the ankle as x + iz (mm/rad); no linear algebra.

        The closure of the loop, differentiated, times the vectors of front link and foot (Norton, ch. 6).
        """
        leg, foot = complex(self._ankle(leg_rad)), complex(self._foot(leg_rad))
        return (*_turning(leg, foot, self.l1), -1j * leg)

    def turning(self, leg_rad: Array) -> tuple[Array, Array]:
        """Return d(foot angle, front joint)/d(leg angle) at leg angles (n,), as `rates`."""
        return _turning(self._ankle(leg_rad), self._foot(leg_rad), self.l1)

    def _ankle(self, leg_rad: npt.ArrayLike) -> Complex:
        """Return the ankle (n,) as x + iz, seen from the back pivot."""
        return np.asarray(self.l2 * np.exp(-1j * (self.rest_rad + np.asarray(leg_rad, dtype=float))))

    def _foot(self, leg_rad: npt.ArrayLike, other_branch: bool = False) -> Complex:
        """Return the vector (n,) from ankle to front eye as x + iz: the triangle of diagonal, foot and front link.

        In the assembled pose the front pivot stands above the flat foot, so the eye lies below the diagonal.
        """
        diagonal: Complex = self.l1 - self._ankle(leg_rad)
        distance: Array = np.abs(diagonal)
        along = (self.l4**2 - self.l3**2 + distance**2) / (2 * distance)
        square = self.l4**2 - along**2
        if (square < 0).any():
            where = math.degrees(np.ravel(leg_rad)[np.argmin(square)])
            raise CannotBuildError(
                f"the loop of foot and front link does not close with the leg turned by {where:.1f}° from rest"
            )
        side = 1j if other_branch else -1j
        return np.asarray(diagonal / distance * (along + side * np.sqrt(square)))


@lru_cache(maxsize=8)
def linkage_of(design: Design) -> Linkage:
    """Return the linkage of a design: one simulation asks for it a dozen times."""
    return Linkage(design)


@lru_cache(maxsize=64)
def _solved(design: Design, leg: bytes, shape: tuple[int, ...], other_branch: bool) -> Pose:
    """Return the pose of a design: loads, masses and room ask for it at the same angles."""
    return linkage_of(design)._pose(np.frombuffer(leg).reshape(shape), other_branch)


def toe_tip_mm(design: Design) -> Array:
    """Return the tip (2,) of the left toe, x and y in the foot's frame, whose origin is the ankle."""
    angle = math.radians(design.ground_link_angle_deg)
    return design.l5_mm * np.array([-math.cos(angle), math.sin(angle)])


def _turning(leg: Any, foot: Any, l1_mm: float) -> tuple[Any, Any]:
    """Return the rates of foot and front link by the leg's, from the vectors x + iz of leg and foot, one or (n,)."""
    front = leg + foot - l1_mm
    cross = (front.conjugate() * foot).imag
    return -(front.conjugate() * leg).imag / cross, -(foot.conjugate() * leg).imag / cross


def _points(vector: Complex) -> Array:
    """Return the points (n, 2) of numbers x + iz (n,)."""
    return np.stack([vector.real, vector.imag], axis=-1)


def _below(vector: Complex) -> Array:
    """Return the angle (n,) of vectors x + iz (n,) below the x axis."""
    return -np.angle(vector)
