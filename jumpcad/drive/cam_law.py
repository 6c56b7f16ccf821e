"""The law of the cam's lift: leg angle over cam angle, such that the motor's torque is constant in between."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jumpcad.transforms import Array


@dataclass(frozen=True)
class CamLaw:
    """Leg angle over cam angle: constant torque at the cam, ramped up linearly at first, and down to 0 at the end.

    Without the ramp the leg's speed per cam angle would start at infinity, and the pressure angle at 90°. With
    `ease_rad`, over which the torque falls, the leg hardly moves any more where the motor stops.

    Stiffness is that of both springs together, `lift_rad` the cam angle of the whole lift, at the end of which the leg
    is at `compression_rad`; `preload_rad` is how far the springs are loaded at its beginning.
    """

    compression_rad: float
    stiffness_nm_per_rad: float
    lift_rad: float
    ramp_rad: float
    preload_rad: float = 0.0
    ease_rad: float = 0.0

    @property
    def energy_j(self) -> float:
        """Energy that the lift brings into the springs, k·((δ + p)² - p²)/2 (J)."""
        return 0.5 * self.stiffness_nm_per_rad * self.compression_rad * (self.compression_rad + 2 * self.preload_rad)

    @property
    def spring_torque_nm(self) -> float:
        """Torque of both springs together at the end of the lift (N·m)."""
        return self.stiffness_nm_per_rad * (self.compression_rad + self.preload_rad)

    @property
    def peak_torque_nm(self) -> float:
        """Torque at the cam after the ramp, without friction (N·m)."""
        return self.energy_j / (self.lift_rad - self.ramp_rad / 2 - self.ease_rad / 2)

    def torque_nm(self, cam_rad: npt.ArrayLike) -> Array:
        """Return the torque (n,) that the springs need at the cam at cam angles (n,) of the lift, dE/dphi."""
        phi = np.asarray(cam_rad, dtype=float)
        rising = np.clip(phi / self.ramp_rad, 0.0, 1.0)
        falling = np.clip((self.lift_rad - phi) / self.ease_rad, 0.0, 1.0) if self.ease_rad else 1.0
        return self.peak_torque_nm * np.minimum(rising, falling)

    def derivatives(self, cam_rad: npt.ArrayLike) -> tuple[Array, Array, Array]:
        """Return leg angle (n,) and its first and second derivative by the cam angle, at cam angles (n,) of the lift.

        E(phi) = k·theta²/2 is a parabola in the ramp, so that theta is linear there, and linear after it. With a
        preload p it is k·((theta + p)² - p²)/2, and theta + p follows from it.
        """
        phi = np.asarray(cam_rad, dtype=float)
        if self.preload_rad > 0.0 or self.ease_rad > 0.0:
            return self._general(phi if self.preload_rad > 0.0 else np.maximum(phi, 1e-9))
        span = self.lift_rad - self.ramp_rad / 2
        slope = self.compression_rad / math.sqrt(2 * self.ramp_rad * span)
        beyond = np.maximum(phi - self.ramp_rad / 2, self.ramp_rad / 2)
        late = self.compression_rad * np.sqrt(beyond / span)
        in_ramp = phi < self.ramp_rad
        first = np.where(in_ramp, slope, late / (2 * beyond))
        return np.where(in_ramp, slope * phi, late), first, np.where(in_ramp, 0.0, -first / (2 * beyond))

    def _general(self, phi: Array) -> tuple[Array, Array, Array]:
        """Return leg angle (n,) and its derivatives, with a preload or an end at which the torque falls."""
        in_ramp, stiffness = phi < self.ramp_rad, self.stiffness_nm_per_rad
        energy = self.peak_torque_nm * np.where(in_ramp, phi**2 / (2 * self.ramp_rad), phi - self.ramp_rad / 2)
        rise = np.where(in_ramp, self.peak_torque_nm / (self.ramp_rad * stiffness), 0.0)
        if self.ease_rad > 0.0:
            left = np.clip(self.lift_rad - phi, 0.0, self.ease_rad)
            energy -= self.peak_torque_nm * (self.ease_rad - left) ** 2 / (2 * self.ease_rad)
            rise -= np.where(left < self.ease_rad, self.peak_torque_nm / (self.ease_rad * stiffness), 0.0)
        loaded = np.sqrt(self.preload_rad**2 + 2 * energy / stiffness)
        first = self.torque_nm(phi) / (stiffness * loaded)
        return loaded - self.preload_rad, first, (rise - first**2) / loaded

    def wind_rad(self, cam_rad: npt.ArrayLike) -> Array:
        """Return the leg angle (n,) at cam angles (n,) of the lift."""
        return self.derivatives(cam_rad)[0]
