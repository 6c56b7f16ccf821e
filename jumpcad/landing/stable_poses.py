"""The poses in which a wound robot lies still, from the convex hull of all of it: a quick bound on righting itself."""

import math

import numpy as np

from jumpcad.mechanism.model import BODY_NAMES, FOOT
from jumpcad.mechanism.poses import body_poses
from jumpcad.robot import Robot
from jumpcad.scene.hulls import body_hulls
from jumpcad.scene.visuals import visuals
from jumpcad.simulation.mechanics import Mechanics, loaded_state

UPRIGHT = math.cos(math.radians(20.0))


def share_on_feet(robot: Robot) -> float:
    """Return the probability that the loaded robot, put down in any attitude, lies on its feet.

    The quasi-static probabilities of Goldberg et al., Part pose statistics (1999), as trimesh has them: a lower bound
    of what a robot does that is righted while it winds.
    """
    import trimesh

    poses, hulls = body_poses(robot, 1.0), body_hulls(robot, visuals(robot))
    corners = [hulls[name].vertices / 1000.0 @ poses[name][:3, :3].T + poses[name][:3, 3] for name in BODY_NAMES]
    hull = trimesh.Trimesh(np.concatenate(corners)).convex_hull
    centre = Mechanics(robot, 9.81).centre_of_mass_m(loaded_state(robot))
    stable, share = trimesh.poses.compute_stable_poses(hull, center_mass=centre, sigma=0.0, n_samples=1)
    upright = stable[:, 2, :3] @ poses[FOOT][:3, 2] > UPRIGHT
    return float(share[upright].sum())
