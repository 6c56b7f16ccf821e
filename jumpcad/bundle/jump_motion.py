"""The jump of a robot as a motion for the GLB file's animations."""

from jumpcad.errors import JumpcadError
from jumpcad.exporters.animation import BodyMotion
from jumpcad.robot import Robot
from jumpcad.simulation import Settings, simulate

ENGINE = "planar"
"""Available on every platform, so that a bundle has the same bytes on each."""


def jump_motion(robot: Robot) -> BodyMotion | None:
    """Return the motion from release to touchdown; None if the engine finds no jump or cannot simulate the robot."""
    try:
        path = simulate(robot, Settings(flight="simulated", trajectory=True), ENGINE).trajectory
    except JumpcadError:
        return None
    if path is None:
        return None
    places = {name: path.position_m[:, index] for index, name in enumerate(path.body_names)}
    turns = {name: path.quaternion_xyzw[:, index] for index, name in enumerate(path.body_names)}
    return BodyMotion(path.time_s, places, turns)
