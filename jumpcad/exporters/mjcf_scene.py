"""MJCF: a scene around the robot, with floor, light and sky, and a README on how to use it in other scenes."""

import xml.etree.ElementTree as ET

from jumpcad.exporters.xml import add, document
from jumpcad.robot import Robot
from jumpcad.settings import Settings, coefficients

NOTES = """# {name} in MuJoCo

- `{name}.xml`: the robot alone, standing at rest with its lowest point at z = 0, x forward. Meshes: `../urdf/meshes`.
- `scene.xml`: the robot on a floor. `python -m mujoco.viewer --mjcf=scene.xml`, then load the key `wound`.

## Jump

Key frames: `home` (springs at rest), `wound` (springs loaded, held by the motor){released}.
The motor `cam` acts on the joint `leg`. Its control {hold:.3g} N·m holds the loaded leg, 0 releases it.

```python
import mujoco

model = mujoco.MjModel.from_xml_path("scene.xml")
data = mujoco.MjData(model)
mujoco.mj_resetDataKeyframe(model, data, model.key("wound").id)
while data.time < 0.1:
    mujoco.mj_step(model, data)         # held
data.actuator("cam").ctrl = 0           # released
while data.time < 0.4:
    mujoco.mj_step(model, data)
print(data.sensor("com").data)          # of the centre of mass, m
```

The equality `latch` holds the leg as well: set `data.eq_active[model.equality("latch").id] = 1` in the pose `wound`,
and 0 to release. Key frames do not store it.

## In your own scene

```python
scene = mujoco.MjSpec.from_file("your_scene.xml")
robot = mujoco.MjSpec.from_file("{name}.xml")
scene.attach(robot, prefix="jumper-", frame=scene.worldbody.add_frame(pos=[0, 0, 0]))
model = scene.compile()
```

Needs MuJoCo {least} or later, tested up to {newest}.
Attached, the robot keeps its contacts, joints and springs, but the scene's options hold. For the figures of the bundle
set `timestep` to 0.00025, `integrator` to `implicitfast`, `cone` to `elliptic` and `impratio` to 100. The five
templates jump shorter with others, since feet creep or steps are too long:

| options | step | held for 0.1 s before | released at once from the key `wound` |
|---|--:|--:|--:|
| these | 1 ms | up to 4 % | up to 12 % |
| these | 2 ms | up to 6 % | up to 21 % |
| MuJoCo's own | 0.25 ms | 3 to 9 % | 3 to 9 % |
| MuJoCo's own | 2 ms | 4 to 7 % | 7 to 22 % |

A key frame poses the robot alone, in the world and not in your frame: add the frame's position to
`data.joint("jumper-free").qpos[:3]`.

## What it is

Contacts: spheres under nose, toes and body, and the convex hull of each body's parts; they touch everything in a
scene but the robot itself. Friction and stiffness are the robot's (priority 1): {foot:g} under the feet, {body:g}
elsewhere. Springs that only push are the tendon `springs`; the rest stop is the upper limit of the joint `leg`; the
loop is the equality `loop`. The motor, its gears and the cam's turn are not modelled: winding takes no time here.
"""
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
    released = ", `released` (the moment when the roller leaves the cam)" if robot.roller_off else ""
    rubs = coefficients(robot, Settings())
    return NOTES.format(
        name=robot.name,
        released=released,
        hold=-HOLD * robot.spring.peak_torque_nm,
        least=LEAST_MUJOCO,
        newest=NEWEST_MUJOCO,
        foot=rubs.contact("foot"),
        body=rubs.contact("body"),
    )
