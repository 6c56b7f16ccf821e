"""SDF 1.9: the robot for Gazebo, the loop as a joint of its own, the spring on its hinge.

The model stands with springs at rest. Links' frames are the body frames of `Robot`. The leg's limit is the stop, with
the stiffness of its pad and critical damping. SDF has no spring that only pushes: beyond rest, in flight, that of the
hinge pulls the leg back. Pin friction is one dry torque at the leg joint.
"""

import math
from collections.abc import Iterator, Sequence

from jumpcad.collision.hulls import cage_capsules
from jumpcad.dimensions import MESHES_FROM_BESIDE
from jumpcad.exporters.steered import steered
from jumpcad.exporters.xml import allowed, friction_nm, limits, rpy, written
from jumpcad.files.templates import fill
from jumpcad.mechanism.model import Joint, Mechanism, body_poses
from jumpcad.mechanism.planar import leg_inertia_kg_m2
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import Visual, visuals
from jumpcad.settings import Coefficients, Settings, coefficients
from jumpcad.transforms import Array

SDF = "1.9"


def sdf_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and content of the model and of the file by which Gazebo finds it; meshes are those of the URDF."""
    yield f"sdf/{robot.name}.sdf", write_sdf(*steered(robot, visuals(robot)))
    yield "sdf/model.config", write_config(robot.name, f"{robot.name}.sdf")


def write_config(name: str, file: str) -> str:
    """Return the `model.config` of a folder whose `file` is the SDF document of the robot `name`."""
    return allowed(fill("sdf/model.config.j2", {"name": name, "file": file, "version": SDF}))


def write_sdf(
    mechanism: Mechanism,
    visible: Sequence[Visual] = (),
    settings: Settings | None = None,
    meshes: str = MESHES_FROM_BESIDE,
) -> str:
    """Return the SDF document of a robot, with the settings' friction and damping.

    `meshes` is the folder of the visible meshes, relative to the document's.
    """
    settings = settings or Settings()
    rubs = coefficients(mechanism, settings)
    values = {
        "version": SDF,
        "name": mechanism.name,
        "links": [
            (mechanism.bodies[name], pose, [shape for shape in visible if shape.body == name])
            for name, pose in body_poses(mechanism).items()
        ],
        "cage": cage_capsules(mechanism),
        "joints": [
            (joint, _limit(joint, mechanism), _dynamics(joint, mechanism, settings, rubs)) for joint in mechanism.joints
        ],
        "closure": mechanism.loop,
        "rubs": rubs,
        "meshes": meshes,
        "six": _six,
        "w": written,
    }
    return allowed(fill("sdf/model.sdf.j2", values))


def _limit(joint: Joint, mechanism: Mechanism) -> dict[str, float]:
    """Return what SDF says of a joint's limits: of the leg's also how stiff the stop is."""
    stop = mechanism.stop
    if stop is None or stop.joint != joint.name:
        return limits(joint, mechanism)
    damping = 2.0 * math.sqrt(stop.stiffness_nm_per_rad * leg_inertia_kg_m2(mechanism, stop.angle_rad))
    return limits(joint, mechanism) | {"stiffness": stop.stiffness_nm_per_rad, "dissipation": damping}


def _dynamics(joint: Joint, mechanism: Mechanism, settings: Settings, rubs: Coefficients) -> dict[str, float]:
    """Return damping and friction of a joint, of the leg's also its springs."""
    spring = mechanism.spring
    rubbed = {"damping": rubs.joint_damping_nms_per_rad, "friction": friction_nm(joint, mechanism, settings)}
    if joint.name != spring.joint:
        return rubbed
    return rubbed | {"spring_reference": spring.preload_rad, "spring_stiffness": spring.stiffness_nm_per_rad}


def _six(pose: Array) -> tuple[float, ...]:
    """Return x, y, z, roll, pitch, yaw of a pose (4, 4)."""
    return (*pose[:3, 3], *rpy(pose[:3, :3]))
