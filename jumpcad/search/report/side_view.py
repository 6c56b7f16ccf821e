"""The linkage of a design from the side, at rest and with loaded springs.

Drawn from the eight numbers alone: links are the lines between their joints. Both poses stand on the same flat foot.
"""

from collections.abc import Iterable

import numpy as np

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.scene.parameters import standing_joints

POINTS = {"toe tip": "toe", "ankle": "ankle", "front eye": "eye", "front pivot": "front", "back pivot": "back"}
"""Joints, and their names in `standing_joints`."""
LINKS = {
    "toes": ("toe tip", "ankle"),
    "foot": ("ankle", "front eye"),
    "front link": ("front eye", "front pivot"),
    "main leg": ("ankle", "back pivot"),
    "body": ("back pivot", "front pivot"),
}
POSES = {"loaded": "springs loaded", "rest": "at rest"}
"""Poses in the order in which they are drawn, and their labels."""
EDGE_MM = 12.0

Box = tuple[float, float, float, float]
"""Lowest x and z, highest x and z (mm)."""


def joints_mm(design: Design) -> dict[str, dict[str, tuple[float, float]]]:
    """Return the `POINTS` of each pose in mm: x forward from the ankle, z up from the ground.

    Raises
    ------
    CannotBuildError
        If the design has no assembled pose, or its loop does not close when loaded.
    """
    found = {}
    for name, leg_rad in zip(POSES, (-design.compression_rad, 0.0), strict=True):
        # Toes spread sideways, so that from the side they look shorter.
        at = standing_joints(Linkage(design), leg_rad)
        corners = (at[one] for one in POINTS.values())
        places = np.round([(point.real, point.imag) for point in corners], 1) + 0.0
        found[name] = dict(zip(POINTS, map(tuple, places.tolist()), strict=True))
    return found


def box_mm(designs: Iterable[Design]) -> Box:
    """Return the common bounding box of designs in both poses, so that they are drawn to one scale."""
    corners = [(0.0, 0.0)]
    for design in designs:
        try:
            corners += [place for pose in joints_mm(design).values() for place in pose.values()]
        except CannotBuildError:
            continue
    every = np.array(corners)
    low, high = every.min(axis=0) - EDGE_MM, every.max(axis=0) + EDGE_MM
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
