"""MJCF for simulations by others: the robot alone, a scene with a floor, and a README on how to use both.

Names and classes follow MuJoCo Menagerie: class `visual` in group 2, `collision` in group 3, sites in group 5, the
floor in `scene.xml` alone. The robot collides with everything in a scene, with its own friction and stiffness (priority
1): spheres where it stands, and the convex hull of each body's parts; without parts, capsules along the links. Its
bodies do not collide with each other.

The motor `cam` holds the loaded leg against a limit and releases it; the equality `latch` does the same as a constraint
that is switched off. MuJoCo's key frames do not store whether a constraint is active, so `wound` uses the motor.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from jumpcad.dimensions import MESH_FOLDER, MESHES_FROM_BESIDE
from jumpcad.exporters.collision import capsules
from jumpcad.exporters.mjcf import (
    CONTACT_IMPEDANCE,
    FREE_RAD,
    IMPEDANCE,
    SUBSTEPS,
    add_bodies,
    add_key,
    add_loop,
    add_options,
    add_springs,
    stiff,
)
from jumpcad.exporters.mjcf_scene import HOLD, readme, write_scene
from jumpcad.exporters.xml import Value, add, document, shorten, wxyz
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, Body, Mechanism
from jumpcad.mechanism.poses import release_pose, standing
from jumpcad.robot import Robot
from jumpcad.scene.hulls import Capsule, body_hulls, cage_capsules
from jumpcad.scene.visuals import Colour, Visual, visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.solids.stl import write_stl

if TYPE_CHECKING:
    import trimesh

STEP_S = 0.00025
"""Time step: twice that of the project's own runs; templates jump as far within 0.2 %, at 1 ms up to 12 % less far."""
HULL = "_hull"
"""Ends the names of the hulls' meshes."""
ROD_DAMPING = 0.3
"""Damping ratio of the cage's rods; judgement: their ties and sockets rub."""
TOUCH = 1.2
"""Radius of a touch sensor's volume over that of the contact sphere in it."""


def mjcf_files(robot: Robot) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of hulls, robot, scene and notes; the other meshes are those of the URDF."""
    for name, hull in body_hulls(robot, visuals(robot)).items():
        yield f"urdf/{MESH_FOLDER}/{name}{HULL}.stl", write_stl(hull)
    yield f"mjcf/{robot.name}.xml", write_robot(robot, visuals(robot))
    yield "mjcf/scene.xml", write_scene(robot)
    yield "mjcf/README.md", readme(robot)


def write_robot(mechanism: Mechanism, visible: Sequence[Visual] = (), looks: bool = True, floor: bool = False) -> str:
    """Return the document of the robot alone, with the friction, damping and stiffness of the default settings.

    Without `looks` it has no files of meshes beside it; with `floor` it stands on one.
    """
    settings = Settings(dt_s=SUBSTEPS * STEP_S)
    root = ET.Element("mujoco", model=mechanism.name)
    add(root, "compiler", angle="radian", meshdir=MESHES_FROM_BESIDE, inertiafromgeom="false")
    add_options(root, settings)
    hulls = body_hulls(mechanism, visible)
    seen = visible if looks else ()
    _assets(root, seen, hulls)
    _defaults(root, mechanism, settings)

    def dress(node: ET.Element, body: Body) -> None:
        for shape in (shape for shape in seen if shape.body == body.name):
            _visual(node, shape)
        if body.name in hulls:
            _collision(node, body.name, body, type="mesh", mesh=f"{body.name}{HULL}")
        else:
            for number, link in enumerate(capsules(mechanism, body.name), start=1):
                _collision(node, f"{body.name}_{number}", body, type="capsule", fromto=(*link.start_m, *link.end_m),
                           size=link.radius_m)  # fmt: skip
        for number, link in enumerate(cage_capsules(mechanism) if body.name == BODY else (), start=1):
            _collision(node, f"cage_{number}", body, type="capsule", fromto=(*link.start_m, *link.end_m),
                       size=link.radius_m, **_softness(link, mechanism.mass_kg))  # fmt: skip
        for contact in body.contacts:
            _collision(node, f"{body.name}_{contact.name}", body, type="sphere", pos=contact.centre_m,
                       size=contact.radius_m)  # fmt: skip
        for contact in (contact for contact in body.contacts if contact.surface == FOOT):
            add(node, "site", name=contact.name, pos=contact.centre_m, size=TOUCH * contact.radius_m)

    world = add(root, "worldbody")
    if floor:
        add(world, "geom", name="floor", type="plane", size="0 0 0.05")
    base, order = add_bodies(world, mechanism, settings, dress)
    base.set("childclass", "robot")
    base.insert(1, ET.Element("site", name="imu", size="0.005"))
    contact = add(root, "contact")
    for one, other in _excluded(mechanism):
        add(contact, "exclude", body1=one, body2=other)
    tendons, spring = add(root, "tendon"), mechanism.spring
    add_springs(tendons, spring)
    limit = add(tendons, "fixed", name="wound", limited="true", range=(-spring.wind_rad, FREE_RAD),
                solreflimit=stiff(settings)["solref"], solimplimit=IMPEDANCE)  # fmt: skip
    add(limit, "joint", joint=spring.joint, coef=1.0)
    equality = add(root, "equality")
    add_loop(root, equality, mechanism, settings)
    add(equality, "joint", name="latch", joint1=spring.joint, polycoef=(-spring.wind_rad, 0.0, 0.0, 0.0, 0.0),
        active="false", **stiff(settings))  # fmt: skip
    hold = HOLD * spring.peak_torque_nm
    add(add(root, "actuator"), "motor", name="cam", joint=spring.joint, ctrlrange=(-hold, 0.0))
    _sensors(root, mechanism)
    keys = add(root, "keyframe")
    add_key(keys, "home", standing(mechanism, 0.0), order, ctrl=0.0)
    add_key(keys, "wound", standing(mechanism, 1.0), order, ctrl=-hold)
    if mechanism.roller_off:
        add_key(keys, "released", release_pose(mechanism), order, ctrl=0.0)
    shorten(root)
    return document(root)


def _assets(root: ET.Element, visible: Sequence[Visual], hulls: "Mapping[str, trimesh.Trimesh]") -> None:
    """Append one material for each colour, the meshes, and the hulls: by their corners where nothing is seen."""
    asset = add(root, "asset")
    for colour in dict.fromkeys(shape.colour for shape in visible):
        add(asset, "material", name=_material(colour), rgba=(*colour, 1.0))
    for name in dict.fromkeys(shape.mesh_name for shape in visible):
        add(asset, "mesh", name=name, file=f"{name}.stl", scale="0.001 0.001 0.001")
    for name, hull in hulls.items():
        if visible:
            add(asset, "mesh", name=f"{name}{HULL}", file=f"{name}{HULL}.stl", scale="0.001 0.001 0.001")
        else:
            add(asset, "mesh", name=f"{name}{HULL}", vertex=hull.vertices.ravel() / 1000.0)


def _defaults(root: ET.Element, mechanism: Mechanism, settings: Settings) -> None:
    """Append the classes `visual`, `collision`, and `grip`: collision geometry with the friction of the foot's pads."""
    rubs = coefficients(mechanism, settings)
    whole = add(add(root, "default"), "default", class_="robot")
    add(whole, "site", group="5")
    add(add(whole, "default", class_="visual"), "geom", type="mesh", contype="0", conaffinity="0", group="2")
    collision = add(whole, "default", class_="collision")
    add(collision, "geom", group="3", condim="3", priority="1", friction=rubs.contact("body"),
        solref=stiff(settings)["solref"], solimp=CONTACT_IMPEDANCE)  # fmt: skip
    add(add(collision, "default", class_="grip"), "geom", friction=rubs.contact("foot"))


def _visual(node: ET.Element, shape: Visual) -> None:
    pose = shape.T_body_mesh
    add(node, "geom", name=shape.name, class_="visual", mesh=shape.mesh_name, material=_material(shape.colour),
        pos=pose[:3, 3], quat=wxyz(pose[:3, :3]))  # fmt: skip


def _collision(node: ET.Element, name: str, body: Body, **shape: Value) -> None:
    kind = "grip" if body.surface == FOOT else "collision"
    add(node, "geom", name=f"{name}_collision", class_=kind, **shape)


def _softness(link: Capsule, mass_kg: float) -> dict[str, Value]:
    """Return MuJoCo's `solref` of a rod that gives: the time constant √(m/k)/ζ of the robot on it."""
    if not math.isfinite(link.n_per_m):
        return {}
    return {"solref": (math.sqrt(mass_kg / link.n_per_m) / ROD_DAMPING, ROD_DAMPING)}


def _material(colour: Colour) -> str:
    return "colour_" + "".join(f"{round(255.0 * part):02x}" for part in colour)


def _excluded(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies without a common joint: between others MuJoCo has no contacts anyway."""
    joined = {frozenset((joint.parent, joint.child)) for joint in mechanism.joints}
    for index, one in enumerate(BODY_NAMES):
        yield from ((one, other) for other in BODY_NAMES[index + 1 :] if frozenset((one, other)) not in joined)


def _sensors(root: ET.Element, mechanism: Mechanism) -> None:
    """Append sensors that a robot could have, and position and velocity of the centre of mass."""
    sensor = add(root, "sensor")
    for kind in ("accelerometer", "gyro"):
        add(sensor, kind, name=kind, site="imu")
    add(sensor, "framequat", name="attitude", objtype="site", objname="imu")
    for contact in mechanism.bodies[FOOT].contacts:
        add(sensor, "touch", name=f"{contact.name}_touch", site=contact.name)
    for joint in mechanism.joints:
        add(sensor, "jointpos", name=f"{joint.name}_angle", joint=joint.name)
    add(sensor, "actuatorfrc", name="cam_torque", actuator="cam")
    add(sensor, "subtreecom", name="com", body=BODY)
    add(sensor, "subtreelinvel", name="com_velocity", body=BODY)
