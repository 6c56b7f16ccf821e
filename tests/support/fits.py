"""Diameters of bores: what the default workshop's fits make of what is bought, and what is measured (mm)."""

import numpy as np

from jumpcad.robot import Robot
from support.built import cut, inscribed_diameter, placed

PRESS, SLIDING, LOOSE, EYE, LYING, RIB = 0.10, 0.20, 0.30, 0.10, 0.10, 0.05
"""Per side, in the default workshop."""
TOLERANCE_MM = 0.003
AXLE, MR63_OUTER, N20_SHAFT, N20_FLAT = 3.0, 6.0, 3.0, 2.5

RUNNING, PRESSED, EYES, LYING_HOLE = (AXLE + 2 * fit for fit in (SLIDING, PRESS, EYE, LYING))

LOADS = 1.1 * 1.05
"""Stiffest springs within ±10 %, and a reserve of 5 %, in the default workshop's [safety]."""


def measured(robot: Robot, name: str, y: float, centre: np.ndarray, copy: int = 0) -> float:
    """Return the diameter of the bore about a place in a section of a part."""
    return inscribed_diameter(cut(placed(robot, name, copy), y), centre)
