"""Convex hulls of what is there: the collision shapes of a robot's bodies."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, FOOT, Mechanism
from jumpcad.scene.visuals import Visual

if TYPE_CHECKING:
    import trimesh

SOLE_MM = 0.5
"""How far the foot's hull stays above its sole, so that a standing robot stands on its contact spheres alone."""
DIGITS = 4
"""Of a corner's coordinates (mm)."""


def body_hulls(mechanism: Mechanism, visible: Sequence[Visual]) -> "dict[str, trimesh.Trimesh]":
    """Return the convex hull of each body's parts in its own frame (mm); no entry for a body without parts."""
    from trimesh.convex import convex_hull

    found = {}
    for body in BODY_NAMES:
        placed = [
            shape.mesh.vertices @ shape.T_body_mesh[:3, :3].T + 1000.0 * shape.T_body_mesh[:3, 3]
            for shape in visible
            if shape.body == body
        ]
        if not placed:
            continue
        corners = np.concatenate(placed)
        if body == FOOT:
            corners[:, 2] = np.maximum(corners[:, 2], SOLE_MM - 1000.0 * mechanism.foot_depth_m)
        found[body] = convex_hull(np.unique(np.round(corners, DIGITS), axis=0))
    return found
