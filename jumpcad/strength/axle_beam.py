"""An axle as a beam on both plates: what each plate carries, and the largest bending moment (N, mm, N·mm)."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jumpcad.drive.gear_pair import GearPair
from jumpcad.transforms import Array


@dataclass(frozen=True)
class AxleBeam:
    """A straight beam on two supports under forces across it (statics; Roark, ch. 8).

    Attributes
    ----------
    supports_mm
        Places of the left and of the right plate's middle, y to the left.
    places_mm, forces_n
        Places (n,) of the forces between the plates, and forces (n, 2), x-z in the body's frame.
    """

    supports_mm: tuple[float, float]
    places_mm: Array
    forces_n: Array

    @classmethod
    def of(cls, supports_mm: tuple[float, float], *loads: tuple[float, Array]) -> "AxleBeam":
        """Return the beam under loads, each a place and a force (2,)."""
        return cls(supports_mm, np.array([place for place, _ in loads]), np.array([force for _, force in loads]))

    def on_plates_n(self) -> Array:
        """Return what the axle presses on the left and on the right plate (2, 2)."""
        left, right = self.supports_mm
        share = (self.places_mm - right) / (left - right)
        return np.stack([share, 1.0 - share]) @ self.forces_n

    @property
    def plate_load_n(self) -> float:
        """The larger of what both plates carry."""
        return float(np.linalg.norm(self.on_plates_n(), axis=1).max())

    def moments_nmm(self, at_mm: Array) -> Array:
        """Return the bending moments (k,) at places (k,) between the plates."""
        beyond = np.maximum(at_mm[:, None] - self.places_mm, 0.0)
        moments = (at_mm - self.supports_mm[1])[:, None] * self.on_plates_n()[1] - beyond @ self.forces_n
        return np.asarray(np.linalg.norm(moments, axis=1))

    def largest_nmm(self, up_to_mm: float = np.inf) -> float:
        """Return the largest bending moment from the right plate to a place: at a force, or there."""
        return float(self.moments_nmm(np.minimum(self.places_mm, up_to_mm)).max())


def on_hub(force_n: Array, half_mm: float, place_mm: float = 0.0) -> Iterator[tuple[float, Array]]:
    """Yield the loads of a hub that bears `half_mm` to either side of y = 0, pushed at a place (mm).

    Pushed beside them it tilts, so that the nearer one may carry more than the whole force.
    """
    for side in (1.0, -1.0):
        yield side * half_mm, force_n * (0.5 + side * place_mm / (2.0 * half_mm))


def mesh_force_n(torque_nmm: float, pair: GearPair, wheel_mm: Array, pinion_mm: Array, sense: float) -> Array:
    """Return the force (2,) of a pinion's teeth on the wheel that it drives.

    T over the wheel's base radius along the line of action: the wheel is pushed in its sense of rotation, and away from
    the pinion (Shigley 13-14).

    Parameters
    ----------
    torque_nmm, pair
        Torque on the wheel, and the gears.
    wheel_mm, pinion_mm
        Both axes (2,), x-z.
    sense
        1 for a wheel that turns positively about +y, -1 for the other way.
    """
    away = (wheel_mm - pinion_mm) / np.linalg.norm(wheel_mm - pinion_mm)
    along = sense * np.array([-away[1], away[0]])
    angle = pair.working_angle_rad
    force: Array = torque_nmm / pair.wheel.base_radius_mm * (math.cos(angle) * along + math.sin(angle) * away)
    return force
