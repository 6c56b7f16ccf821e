"""Diameters of bores: what the default workshop's fits make of what is bought, and what is measured (mm)."""

import numpy as np

from jumpcad.robot import Robot
from support.built import cut, inscribed_diameter, placed

PRESS, SLIDING, LOOSE = 0.10, 0.20, 0.30
"""Per side, in the default workshop."""
TOLERANCE_MM = 0.003
AXLE, MR63_OUTER, N20_SHAFT, N20_FLAT = 3.0, 6.0, 3.0, 2.5

RUNNING, PRESSED = AXLE + 2 * SLIDING, AXLE + 2 * PRESS


def measured(robot: Robot, name: str, y: float, centre: np.ndarray, copy: int = 0) -> float:
    """Return the diameter of the bore about a place in a section of a part."""
    return inscribed_diameter(cut(placed(robot, name, copy), y), centre)
