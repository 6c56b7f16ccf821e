"""MJCF: a scene around the robot, with floor, light and sky, and a README on how to use it in other scenes."""

from jumpcad.exporters.xml import allowed
from jumpcad.files.rendering import fill, render
from jumpcad.robot import Robot
from jumpcad.settings import Settings, coefficients

HOLD = 1.25
"""Torque of the motor that holds the leg against its limit, over that of the loaded springs; judgement."""
LEAST_MUJOCO, NEWEST_MUJOCO = "3.3.1", "4.0.0"
"""Versions that the notes' code runs with: 3.2.4 aborts while it loads the scene, 3.2.7 has no `attach`."""


def write_scene(robot: Robot) -> str:
    """Return the document of the scene; it includes the robot's file beside it."""
    return allowed(fill("mjcf/scene.xml.j2", {"name": robot.name}))


def readme(robot: Robot) -> str:
    """Return the text of README.md."""
    rubs = coefficients(robot, Settings())
    values = {
        "name": robot.name,
        "released": bool(robot.roller_off),
        "hold_nm": -HOLD * robot.spring.peak_torque_nm,
        "wind_s": robot.layout.drive.train.winding_s,
        "least": LEAST_MUJOCO,
        "newest": NEWEST_MUJOCO,
        "foot": rubs.contact("foot"),
        "body": rubs.contact("body"),
    }
    return render("mjcf/README.md.j2", values)
