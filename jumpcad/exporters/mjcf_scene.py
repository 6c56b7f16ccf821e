"""MJCF: a scene around the robot, with floor, light and sky, and a README on how to use it in other scenes."""

import xml.etree.ElementTree as ET

from jumpcad.exporters.xml import add, document
from jumpcad.files.rendering import render
from jumpcad.robot import Robot
from jumpcad.settings import Settings, coefficients

HOLD = 1.25
"""Torque of the motor that holds the leg against its limit, over that of the loaded springs; judgement."""
LEAST_MUJOCO, NEWEST_MUJOCO = "3.3.1", "4.0.0"
"""Versions that the notes' code runs with: 3.2.4 aborts while it loads the scene, 3.2.7 has no `attach`."""


def write_scene(robot: Robot) -> str:
    """Return the document of the scene; it includes the robot's file beside it."""
    root = ET.Element("mujoco", model=f"{robot.name} scene")
    add(root, "include", file=f"{robot.name}.xml")
    add(root, "statistic", center="0 0 0.05", extent="0.3")
    visual = add(root, "visual")
    add(visual, "headlight", diffuse="0.6 0.6 0.6", ambient="0.3 0.3 0.3", specular="0 0 0")
    add(visual, "rgba", haze="0.85 0.88 0.92 1")
    add(visual, "global", azimuth="120", elevation="-15")
    asset = add(root, "asset")
    add(asset, "texture", type="skybox", builtin="gradient", rgb1="0.55 0.68 0.8", rgb2="0.95 0.97 1", width="256",
        height="1536")  # fmt: skip
    add(asset, "texture", name="floor", type="2d", builtin="checker", rgb1="0.85 0.86 0.88", rgb2="0.75 0.77 0.8",
        width="256", height="256")  # fmt: skip
    add(asset, "material", name="floor", texture="floor", texuniform="true", texrepeat="10 10", reflectance="0.1")
    world = add(root, "worldbody")
    add(world, "light", pos="0.2 -0.5 1.5", dir="-0.1 0.3 -1", directional="true")
    add(world, "geom", name="floor", type="plane", size="0 0 0.05", material="floor")
    return document(root)


def readme(robot: Robot) -> str:
    """Return the text of README.md."""
    rubs = coefficients(robot, Settings())
    values = {
        "name": robot.name,
        "released": bool(robot.roller_off),
        "hold_nm": -HOLD * robot.spring.peak_torque_nm,
        "least": LEAST_MUJOCO,
        "newest": NEWEST_MUJOCO,
        "foot": rubs.contact("foot"),
        "body": rubs.contact("body"),
    }
    return render("mjcf/README.md.j2", values)
