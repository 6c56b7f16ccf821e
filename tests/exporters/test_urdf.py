"""The URDF says what the robot is: read back, and loaded and simulated by PyBullet itself, it is the same robot."""

import json
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.loaded import loaded_range_m

from jumpcad.design import load_design
from jumpcad.errors import JumpcadError
from jumpcad.exporters.loop_file import write_loop
from jumpcad.exporters.urdf import urdf_files, write_urdf
from jumpcad.mechanism.model import BODY_NAMES, FOOT
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.simulation import simulate
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.transforms import pose_about_y

TEMPLATES = ("kenan-1.0", "kenan-2.0", "best-ga", "best-bo")


def write(robot: Robot, folder: Path) -> Path:
    path = folder / f"{robot.name}.urdf"
    path.write_text(write_urdf(robot), encoding="utf-8")
    path.with_suffix(".loop.json").write_text(write_loop(robot), encoding="utf-8")
    return path


def test_read_back_is_the_same_robot(small_robot: Robot, tmp_path: Path) -> None:
    again = robot_from_urdf(write(small_robot, tmp_path))
    assert again.design == small_robot.design
    assert again.spring == small_robot.spring
    assert again.foot_depth_m == small_robot.foot_depth_m
    for name in BODY_NAMES:
        body, same = small_robot.bodies[name], again.bodies[name]
        assert same.mass_kg == body.mass_kg
        assert np.array_equal(same.com_m, body.com_m)
        assert np.allclose(same.inertia_kg_m2, body.inertia_kg_m2, rtol=1e-12, atol=1e-18)
        for contact, twin in zip(body.contacts, same.contacts, strict=True):
            assert (twin.name, twin.radius_m, twin.surface) == (contact.name, contact.radius_m, contact.surface)
            assert np.array_equal(twin.centre_m, contact.centre_m)
    for joint in small_robot.joints:
        twin = again.joint(joint.name)
        assert twin.rest_angle_rad == pytest.approx(joint.rest_angle_rad, abs=1e-15)
        assert np.array_equal(twin.origin_m, joint.origin_m)
        assert (twin.parent, twin.child, twin.lower_rad, twin.upper_rad, twin.effort_nm, twin.velocity_rad_s) == (
            joint.parent, joint.child, joint.lower_rad, joint.upper_rad, joint.effort_nm, joint.velocity_rad_s,
        )  # fmt: skip


@pytest.mark.parametrize("name", TEMPLATES)
def test_pybullet_loads_and_simulates_the_file_like_the_robot_in_memory(name: str, tmp_path: Path) -> None:
    needs.package("pybullet")
    robot = capsule_robot(load_design(name))
    assert loaded_range_m(write(robot, tmp_path)) == pytest.approx(simulate(robot).ballistic_range_m, rel=1e-9)


@pytest.mark.parametrize("name", ["kenan-2.0", "best-ga"])
def test_at_the_loop_files_release_the_loop_is_closed_and_the_foot_stands_on_the_ground(name: str) -> None:
    """Both ends of the loop, carried to the world, are one point, and all spheres of the foot touch z = 0.

    Pitch, then the joints of the tree; the body of Best GA is turned.
    """
    robot = capsule_robot(load_design(name))
    data = json.loads(write_loop(robot))
    release, loop = data["release"], data["loop"]
    assert name != "best-ga" or abs(release["body_pitch_rad"]) > 0.005
    poses = {"body": pose_about_y(release["body_pitch_rad"], (0.0, 0.0))}
    poses["body"][:3, 3] = release["body_position_m"]
    for joint in robot.joints:
        turned = pose_about_y(joint.rest_angle_rad + release["joint_rad"][joint.name], (0.0, 0.0))
        turned[:3, 3] = joint.origin_m
        poses[joint.child] = poses[joint.parent] @ turned
    ends = [(poses[loop[f"body_{side}"]] @ [*loop[f"point_{side}_m"], 1.0])[:3] for side in ("a", "b")]
    assert np.linalg.norm(ends[0] - ends[1]) < 1e-12
    for contact in robot.bodies[FOOT].contacts:
        assert (poses[FOOT] @ [*contact.centre_m, 1.0])[2] == pytest.approx(contact.radius_m, abs=1e-9)


def test_missing_or_foreign_files_are_refused_in_one_line(small_robot: Robot, tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match=r"nothing\.urdf: no such file"):
        robot_from_urdf(tmp_path / "nothing.urdf")
    urdf = write(small_robot, tmp_path)
    urdf.with_suffix(".loop.json").write_text("{}")
    with pytest.raises(JumpcadError, match="not a robot that jumpcad build wrote"):
        robot_from_urdf(urdf)
    urdf.write_text("<robot name='x'><link")
    with pytest.raises(JumpcadError, match="not a robot that jumpcad build wrote") as error:
        robot_from_urdf(urdf)
    assert "\n" not in str(error.value)


def test_mujoco_loads_the_files_with_the_mass_of_the_root_and_what_is_seen(small_robot: Robot) -> None:
    """Meshes lie in a folder beside the URDF, which would drop them, and the body, unless it is told not to."""
    mujoco = needs.package("mujoco")
    files = {path.removeprefix("urdf/"): content for path, content in urdf_files(small_robot)}
    assert {f"{small_robot.name}.urdf", f"{small_robot.name}.loop.json"} <= files.keys()
    meshes = {path: content for path, content in files.items() if path.startswith("meshes/")}
    assert set(files) - set(meshes) == {f"{small_robot.name}.urdf", f"{small_robot.name}.loop.json"}
    model = mujoco.MjModel.from_xml_string(files[f"{small_robot.name}.urdf"], meshes)
    for name, body in small_robot.bodies.items():
        assert model.body(name).mass[0] == pytest.approx(body.mass_kg)
    seen = visuals(small_robot)
    assert set(meshes) == {f"meshes/{shape.mesh_name}.stl" for shape in seen}
    spheres = sum(len(body.contacts) for body in small_robot.bodies.values())
    assert model.ngeom == len(seen) + spheres
