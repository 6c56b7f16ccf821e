"""The ROS 2 package, read by xacro, urdfdom, sdformat, ROS's own package format, and yourdfpy."""

import ast
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yourdfpy
from support import needs
from support.built import built
from support.clients import run

from jumpcad.exporters.ros2 import ros2_files
from jumpcad.robot.robot import Robot

xacro, yaml = needs.package("xacro"), needs.package("yaml")


@pytest.fixture(scope="module", params=["kenan-2.0", "best-printable"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built(request.param)


@pytest.fixture(scope="module")
def package(robot: Robot, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package, written to a folder."""
    folder = tmp_path_factory.mktemp("a workspace")  # with a space in its path
    for path, content in ros2_files(robot):
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
    (found,) = (folder / "ros2").iterdir()
    return found


def urdf(package: Path, *arguments: str) -> Path:
    """Return the URDF file that xacro makes with arguments."""
    (top,) = (package / "urdf").glob("*.urdf.xacro")
    written = package / f"{len(arguments)}.urdf"
    command = [sys.executable, "-c", "import xacro; xacro.main()", str(top), *arguments, "-o", str(written)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    return written


def test_urdfdom_reads_a_tree_from_base_link(package: Path) -> None:
    said = run("check_urdf", urdf(package))
    assert "Successfully Parsed XML" in said
    assert "root Link: base_link has 1 child(ren)" in said
    assert "child(1):  body" in said


def test_every_mesh_is_in_the_package(package: Path) -> None:
    links = (package / "urdf" / "links.xacro").read_text()
    named = {part.split('"')[0] for part in links.split(f"package://{package.name}/")[1:]}
    assert named == {f"meshes/{mesh.name}" for mesh in (package / "meshes").iterdir()}


def test_with_mimic_the_loop_stays_closed_as_well_as_the_readme_says(robot: Robot, package: Path) -> None:
    """yourdfpy poses the tree by its leg alone; front link and foot then meet within the angles' error."""
    model = yourdfpy.URDF.load(str(urdf(package)), load_meshes=False, build_scene_graph=True)
    assert model.actuated_joint_names == ["leg"]
    said = re.search(r"right within ([\d.]+)° and ([\d.]+)°", (package / "README.md").read_text())
    assert said is not None
    front, ankle = map(float, said.groups())
    lengths = robot.design.l3_mm / 1000.0, robot.design.l4_mm / 1000.0
    allowed = sum(math.radians(error + 0.005) * length for error, length in zip((front, ankle), lengths, strict=True))
    for leg in np.linspace(-robot.spring.wind_rad, 0.0, 9):
        model.update_cfg([leg])
        eyes = [
            (model.get_transform(link) @ [length, 0.0, 0.0, 1.0])[:3]
            for link, length in zip(("front_link", "foot"), lengths, strict=True)
        ]
        assert np.linalg.norm(eyes[0] - eyes[1]) <= allowed + 1e-9


def test_gazebo_reads_springs_friction_and_the_controller(robot: Robot, package: Path) -> None:
    said = run("ign", "sdf", "--print", urdf(package, "gazebo:=true", "mimic:=false", "controllers:=/a/b.yaml"))
    assert f"<spring_stiffness>{robot.spring.stiffness_nm_per_rad:.6f}"[:-2] in said
    assert f"<mu>{robot.workshop.ground.foot_friction:g}</mu>" in said
    assert "<parameters>/a/b.yaml</parameters>" in said
    assert "GazeboSimSystem" not in said  # ros2_control reads it from the URDF
    mass = sum(float(part.split("<")[0]) for part in said.split("<mass>")[1:])
    assert mass == pytest.approx(robot.mass_kg, rel=1e-5)


def test_the_hardware_is_gazebos_or_a_mock(package: Path) -> None:
    assert "mock_components/GenericSystem" in urdf(package).read_text()
    real = urdf(package, "gazebo:=true").read_text()
    assert "gz_ros2_control/GazeboSimSystem" in real
    assert "mock_components" not in real


def test_the_model_is_valid_and_found(package: Path) -> None:
    (folder,) = (package / "models").iterdir()
    assert "Valid." in run("ign", "sdf", "--check", folder / "model.sdf")
    assert f">{'model.sdf'}</sdf>" in (folder / "model.config").read_text()
    uris = {part.split("<")[0] for part in (folder / "model.sdf").read_text().split("<uri>")[1:]}
    assert all((folder / uri).resolve().is_file() for uri in uris)


def test_the_package_format_is_ros_own(package: Path) -> None:
    packages = needs.package("catkin_pkg.package")
    read = packages.parse_package(str(package))
    read.validate()
    assert read.name == package.name
    assert {"xacro", "rviz2", "robot_state_publisher"} <= {one.name for one in read.exec_depends}
    assert read.get_build_type() == "ament_cmake"
    installed = (package / "CMakeLists.txt").read_text().split("DIRECTORY")[1].split("\n")[0].split()
    assert {one.name for one in package.iterdir() if one.is_dir()} == set(installed)


def test_launch_files_compile_and_settings_are_yaml(robot: Robot, package: Path) -> None:
    for file in (package / "launch").iterdir():
        assert not re.search("@[A-Z_]+@", file.read_text())
        ast.parse(file.read_text())
    controllers = yaml.safe_load((package / "config" / "controllers.yaml").read_text())
    assert controllers["cam"]["ros__parameters"] == {"joints": [robot.spring.joint], "interface_name": "effort"}
    (view,) = (package / "rviz").iterdir()
    assert yaml.safe_load(view.read_text())["Visualization Manager"]["Global Options"]["Fixed Frame"] == "base_link"
