"""Mass properties as far as motion in the plane depends on them."""

import numpy as np

from jumpcad.mechanism.mass import MassProperties


def in_plane(mass_kg: float, com_mm: tuple[float, float], gyration_mm: float) -> MassProperties:
    """Return a body's by its centre of mass (x, z) and its radius of gyration about y."""
    com_m, about_y = np.array([com_mm[0], 0.0, com_mm[1]]) / 1000.0, mass_kg * (gyration_mm / 1000.0) ** 2
    return MassProperties(mass_kg, com_m, np.diag([0.0, about_y, 0.0]))
