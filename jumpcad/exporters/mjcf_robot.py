"""MJCF for simulations by others: the robot alone, a scene with a floor, and a README on how to use both.

Names and classes follow MuJoCo Menagerie: class `visual` in group 2, `collision` in group 3, sites in group 5, the
floor in `scene.xml` alone. The robot collides with everything in a scene, with its own friction and stiffness (priority
1): spheres where it stands, and a hull of each body's parts, of few corners. Its bodies do not touch each other.

The motor `cam` holds the loaded leg against a limit and releases it; the equality `latch` does the same as a constraint
that is switched off. MuJoCo's key frames do not store whether a constraint is active, so `wound` uses the motor.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

from jumpcad.collision.hulls import body_hulls, cage_capsules
from jumpcad.dimensions import MESH_FOLDER, MESHES_FROM_BESIDE
from jumpcad.exporters.mjcf import CONTACT_IMPEDANCE, FREE_RAD, IMPEDANCE, SUBSTEPS, Attributes, filled, springs, stiff
from jumpcad.exporters.steered import WHEEL, on_its_wheel, steered, wheel_of
from jumpcad.exporters.xml import Value, allowed, shortened, wxyz
from jumpcad.files.templates import fill, render
from jumpcad.mechanism.model import BODY, FOOT, Body, Mechanism, release_pose, standing
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steers
from jumpcad.scene.visuals import Colour, Visual, visuals
from jumpcad.settings import Settings, coefficients
from jumpcad.solids.stl import write_stl
from jumpcad.transforms import Trimesh

STEP_S = 0.00025
"""Time step: twice that of the project's own runs; templates jump as far within 0.2 %, at 1 ms up to 12 % less far."""
HULL = "_hull"
"""Ends the names of the hulls' meshes."""
ROD_DAMPING = 0.3
"""Damping ratio of the cage's rods; judgement: their ties and sockets rub."""
TOUCH = 1.2
"""Radius of a touch sensor's volume over that of the contact sphere in it."""
HOLD = 1.25
"""Torque of the motor that holds the leg against its limit, over that of the loaded springs; judgement."""
LEAST_MUJOCO, NEWEST_MUJOCO = "3.3.1", "4.0.0"
"""Versions that the notes' code runs with: 3.2.4 aborts while it loads the scene, 3.2.7 has no `attach`."""
MILLIMETRES: Attributes = {"scale": "0.001 0.001 0.001"}
FLOOR: Attributes = {"name": "floor", "type": "plane", "size": "0 0 0.05"}


def mjcf_files(robot: Robot) -> Iterator[tuple[str, str | bytes]]:
    """Yield path and content of hulls, robot, scene and notes; the other meshes are those of the URDF."""
    for name, hull in body_hulls(*steered(robot, visuals(robot))).items():
        yield f"urdf/{MESH_FOLDER}/{name}{HULL}.stl", write_stl(hull)
    yield f"mjcf/{robot.name}.xml", write_robot(robot, visuals(robot))
    yield "mjcf/scene.xml", allowed(fill("mjcf/scene.xml.j2", {"name": robot.name}))
    yield "mjcf/README.md", readme(robot)


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
        "steer": steers(robot) if wheel_of(robot) else None,
    }
    return render("mjcf/README.md.j2", values)


def write_robot(mechanism: Mechanism, visible: Sequence[Visual] = (), looks: bool = True, floor: bool = False) -> str:
    """Return the document of the robot alone, with the friction, damping and stiffness of the default settings.

    Without `looks` it has no files of meshes beside it; with `floor` it stands on one.
    """
    settings, steer = (
        Settings(dt_s=SUBSTEPS * STEP_S),
        steers(mechanism) if isinstance(mechanism, Robot) and wheel_of(mechanism) else None,
    )
    mechanism, visible = steered(mechanism, visible)
    hulls, seen = body_hulls(mechanism, visible), visible if looks else ()
    spring, hold = mechanism.spring, HOLD * mechanism.spring.peak_torque_nm
    limit: Attributes = {"name": "wound", "limited": "true", "range": (-spring.wind_rad, FREE_RAD),
                         "solreflimit": stiff(settings)["solref"], "solimplimit": IMPEDANCE}  # fmt: skip
    still = (0.0,) if steer else ()
    wound = on_its_wheel(mechanism, standing(mechanism, 1.0))
    keys = {"home": (standing(mechanism, 0.0), (0.0, *still)), "wound": (wound, (-hold, *still))}
    if mechanism.roller_off:
        keys["released"] = on_its_wheel(mechanism, release_pose(mechanism)), (0.0, *still)
    return filled(
        mechanism, settings, shortened,
        {name: [*_shapes(mechanism, body, seen, name in hulls)] for name, body in mechanism.bodies.items()},
        {name: (pose, {"ctrl": ctrl}) for name, (pose, ctrl) in keys.items()},
        tendons=[*springs(mechanism), (spring.joint, limit)],
        floor=FLOOR if floor else {},
        excluded=list(_excluded(mechanism)),
        hold_nm=hold,
        steer=steer,
        meshes=MESHES_FROM_BESIDE,
        colours={_material(colour): colour for colour in dict.fromkeys(shape.colour for shape in seen)},
        assets=[*_assets(seen, hulls)],
        contact_impedance=CONTACT_IMPEDANCE,
    )  # fmt: skip


def _shapes(
    mechanism: Mechanism, body: Body, visible: Sequence[Visual], has_hull: bool
) -> Iterator[tuple[str, Attributes]]:
    """Yield what is seen of a body, what collides, and the volumes of its touch sensors."""

    def collides(name: str, **shape: Value) -> tuple[str, Attributes]:
        return "geom", {"name": f"{name}_collision", "class": "grip" if body.surface == FOOT else "collision", **shape}

    for shape in (shape for shape in visible if shape.body == body.name):
        pose = shape.T_body_mesh
        yield "geom", {"name": shape.name, "class": "visual", "mesh": shape.mesh_name,
                       "material": _material(shape.colour), "pos": pose[:3, 3],
                       "quat": wxyz(pose[:3, :3])}  # fmt: skip
    if has_hull:
        yield collides(body.name, type="mesh", mesh=f"{body.name}{HULL}")
    for number, rod in enumerate(cage_capsules(mechanism) if body.name == BODY else (), start=1):
        along, gives = (*rod.start_m, *rod.end_m), math.isfinite(rod.n_per_m)
        time_s = math.sqrt(mechanism.mass_kg / rod.n_per_m) / ROD_DAMPING  # √(m/k)/ζ of the robot on a rod that gives
        soft: Attributes = {"solref": (time_s, ROD_DAMPING)} if gives else {}
        yield collides(f"cage_{number}", type="capsule", fromto=along, size=rod.radius_m, **soft)
    for one in body.contacts:
        rolls: Attributes = {"type": "sphere", "pos": one.centre_m, "size": one.radius_m}
        if body.name == WHEEL and (place := wheel_of(mechanism)):  # round across its rim too
            rolls = {"type": "ellipsoid", "size": (place.half_width_mm / 1000.0, one.radius_m, one.radius_m)}
        yield collides(f"{body.name}_{one.name}", **rolls)
    for one in (contact for contact in body.contacts if contact.surface == FOOT):
        yield "site", {"name": one.name, "pos": one.centre_m, "size": TOUCH * one.radius_m}


def _assets(visible: Sequence[Visual], hulls: Mapping[str, Trimesh]) -> Iterator[Attributes]:
    """Yield the meshes, and the hulls: by their corners where nothing is seen."""
    for name in dict.fromkeys(shape.mesh_name for shape in visible):
        yield {"name": name, "file": f"{name}.stl"} | MILLIMETRES
    for name, hull in hulls.items():
        file: Attributes = {"file": f"{name}{HULL}.stl"} | MILLIMETRES
        corners: Attributes = {"vertex": hull.vertices.ravel() / 1000.0}
        yield {"name": f"{name}{HULL}"} | (file if visible else corners)


def _material(colour: Colour) -> str:
    return "colour_" + "".join(f"{round(255.0 * part):02x}" for part in colour)


def _excluded(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies without a common joint: between others MuJoCo has no contacts anyway."""
    joined = {frozenset((joint.parent, joint.child)) for joint in mechanism.joints}
    yield from (pair for pair in itertools.combinations(mechanism.bodies, 2) if frozenset(pair) not in joined)
