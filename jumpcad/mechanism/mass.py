"""Mass, centre of mass and inertia of rigid bodies, moved and added up.

Products of matrices are sums here and not calls to BLAS, whose last digits depend on the processor and on the number of
threads: the same robot has the same bytes everywhere.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from jumpcad.transforms import Array, ByValue


@dataclass(frozen=True, eq=False)
class MassProperties(ByValue):
    """Mass (kg), centre of mass (3,) in m, and inertia tensor (3, 3) in kg·m² about that centre, in one frame."""

    mass_kg: float
    com_m: Array
    inertia_kg_m2: Array

    def placed(self, transform: Array) -> "MassProperties":
        """Return the same body seen from a frame in which this frame is `transform` (4, 4), lengths in m."""
        rotation = transform[:3, :3]
        return MassProperties(
            self.mass_kg,
            np.einsum("ij,j->i", rotation, self.com_m) + transform[:3, 3],
            np.einsum("ij,jk,lk->il", rotation, self.inertia_kg_m2, rotation),
        )

    def scaled_to(self, mass_kg: float) -> "MassProperties":
        """Return the same distribution with another total mass."""
        return MassProperties(mass_kg, self.com_m, self.inertia_kg_m2 * (mass_kg / self.mass_kg))


def combined(items: Iterable[MassProperties]) -> MassProperties:
    """Return the mass properties of several bodies that share a frame (parallel-axis theorem)."""
    items = list(items)
    mass = math.fsum(item.mass_kg for item in items)
    masses = np.array([item.mass_kg for item in items])
    places = np.array([item.com_m for item in items])
    com = (masses[:, None] * places).sum(axis=0) / mass
    offset = places - com
    square = (offset * offset).sum(axis=1)[:, None, None] * np.eye(3)
    away = masses[:, None, None] * (square - offset[:, :, None] * offset[:, None, :])
    return MassProperties(mass, com, (np.array([item.inertia_kg_m2 for item in items]) + away).sum(axis=0))


def principal_axes(inertia_kg_m2: Array) -> tuple[Array, Array]:
    """Return principal moments (3,) of a tensor (3, 3), and the rotation (3, 3) from their axes to the tensor's.

    Jacobi's method: turns by at most 45° about one axis after the other, so that the rotation is a small one where the
    tensor is nearly diagonal (Golub and Van Loan, Matrix Computations, section 8.5).
    """
    a, axes = inertia_kg_m2.tolist(), np.eye(3).tolist()
    nothing = 1e-17 * (abs(a[0][0]) + abs(a[1][1]) + abs(a[2][2]))
    while max(abs(a[0][1]), abs(a[0][2]), abs(a[1][2])) > nothing:
        for i, j, k in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
            if (off := a[i][j]) == 0.0:
                continue
            half = (a[j][j] - a[i][i]) / (2.0 * off)
            tan = math.copysign(1.0, half) / (abs(half) + math.hypot(1.0, half))
            cos = 1.0 / math.hypot(1.0, tan)
            sin = tan * cos
            a[i][i], a[j][j] = a[i][i] - tan * off, a[j][j] + tan * off
            a[i][j] = a[j][i] = 0.0
            a[i][k], a[j][k] = cos * a[i][k] - sin * a[j][k], sin * a[i][k] + cos * a[j][k]
            a[k][i], a[k][j] = a[i][k], a[j][k]
            for row in axes:
                row[i], row[j] = cos * row[i] - sin * row[j], sin * row[i] + cos * row[j]
    return np.array([a[i][i] for i in range(3)]), np.array(axes)
