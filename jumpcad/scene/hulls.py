"""Convex hulls of what is there: the collision shapes of a robot's bodies."""

from collections.abc import Sequence

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, FOOT, Mechanism
from jumpcad.scene.visuals import Visual
from jumpcad.transforms import Array

SOLE_M = 0.0005
"""How far the foot's hull stays above its sole, so that a standing robot stands on its contact spheres alone."""
DIGITS = 7
"""Of a corner's coordinates (m)."""


def body_hulls_m(mechanism: Mechanism, visible: Sequence[Visual]) -> dict[str, Array]:
    """Return the corners (n, 3) of each body's convex hull in its own frame (m); no entry for a body without parts."""
    from scipy.spatial import ConvexHull

    found = {}
    for body in BODY_NAMES:
        placed = [
            shape.mesh.vertices / 1000.0 @ shape.T_body_mesh[:3, :3].T + shape.T_body_mesh[:3, 3]
            for shape in visible
            if shape.body == body
        ]
        if not placed:
            continue
        corners = np.concatenate(placed)
        if body == FOOT:
            corners[:, 2] = np.maximum(corners[:, 2], SOLE_M - mechanism.foot_depth_m)
        corners = np.unique(np.round(corners, DIGITS), axis=0)
        found[body] = corners[ConvexHull(corners).vertices]
    return found
