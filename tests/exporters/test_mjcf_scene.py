"""The scene around the robot as MuJoCo compiles it, and notes that say what is beside them."""

import ast
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import needs
from support.built import built
from support.machines import let_go

from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.exporters.mjcf_scene import HOLD, MUJOCO, NOTES, readme, write_scene
from jumpcad.mechanism.model import BODY, FOOT, Friction
from jumpcad.robot import Robot
from jumpcad.settings import Settings, coefficients

mujoco = needs.package("mujoco")
STAND_IN = b'<mujoco><worldbody><body name="stand_in"><geom size="0.01"/></body></worldbody></mujoco>'
"""What the scene includes instead of a robot."""


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


@pytest.fixture(scope="module")
def scene(robot: Robot) -> Any:
    return mujoco.MjModel.from_xml_string(write_scene(robot), {f"{robot.name}.xml": STAND_IN})


def attributes(robot: Robot, tag: str) -> dict[str, str]:
    """Return the attributes of the scene's only element of a kind."""
    (element,) = ET.fromstring(write_scene(robot)).iter(tag)
    return element.attrib


def test_the_scene_adds_a_floor_and_a_light_to_what_it_includes(robot: Robot, scene: Any) -> None:
    """Nothing else, and nothing that moves; the name is the robot's, also where XML has to escape it."""
    assert (scene.nbody, scene.ngeom, scene.nlight, scene.nq) == (2, 2, 1, 0)
    assert scene.body("stand_in").id == 1
    odd = replace(robot, name='a & "b" <c>')
    root = ET.fromstring(write_scene(odd))
    assert root.tag == "mujoco"
    assert root.get("model") == 'a & "b" <c> scene'
    (included,) = root.iter("include")
    assert included.attrib == {"file": 'a & "b" <c>.xml'}


def test_the_floor_is_endless_and_shows_squares_of_five_centimetres(scene: Any) -> None:
    """Each repeat of MuJoCo's checker has two squares to a side; there are ten repeats to a metre."""
    floor = scene.geom("floor")
    assert floor.size[:2].tolist() == [0.0, 0.0]  # MuJoCo's word for endless
    assert floor.type[0] == mujoco.mjtGeom.mjGEOM_PLANE
    (material,) = floor.matid
    assert scene.mat_texuniform[material] == 1
    assert scene.mat_texrepeat[material].tolist() == [10.0, 10.0]
    assert 1.0 / scene.mat_texrepeat[material][0] / 2.0 == pytest.approx(0.05)
    assert 0.0 <= scene.mat_reflectance[material] <= 0.2  # no mirror


def pixels(scene: Any, kind: int) -> np.ndarray:
    """Return the picture (height, width, channels) of the only texture of a kind, with its parts between 0 and 1."""
    (index,) = (number for number in range(scene.ntex) if scene.tex_type[number] == kind)
    shape = scene.tex_height[index], scene.tex_width[index], scene.tex_nchannel[index]
    first = scene.tex_adr[index]
    return scene.tex_data[first : first + int(np.prod(shape))].reshape(shape) / 255.0


def test_the_floors_squares_are_light_and_a_little_apart(scene: Any) -> None:
    """Half of the floor in either of two light greys, on which red, blue and black are seen."""
    shown = pixels(scene, mujoco.mjtTexture.mjTEXTURE_2D)
    colours, counts = np.unique(shown.reshape(-1, 3), axis=0, return_counts=True)
    assert shown.shape == (256, 256, 3)
    assert counts.tolist() == [256 * 256 / 2] * 2
    assert 0.03 < np.ptp(colours, axis=0).max() < 0.2
    assert colours.min() > 0.7


def test_the_sky_is_blue_above_and_white_below(scene: Any) -> None:
    """Six square faces above each other; MuJoCo's order is right, left, up, down, front, back."""
    shown = pixels(scene, mujoco.mjtTexture.mjTEXTURE_SKYBOX)
    assert shown.shape == (6 * 256, 256, 3)
    up, down = (shown[256 * face : 256 * (face + 1)].mean(axis=(0, 1)) for face in (2, 3))
    assert up[2] - up[0] > 0.1
    assert up.sum() < down.sum()
    assert down.max() <= 1.0


def test_the_light_comes_from_above_as_the_suns_does(scene: Any) -> None:
    """Of one direction, and as far from its place as from anywhere else: down, and from the right, where -y is."""
    light = scene.light(0)
    assert scene.light_type[0] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    assert light.dir[2] < -0.9
    assert light.dir[1] > 0.1
    # it is aimed at the robot, which stands about the origin
    aimed = light.pos - light.pos[2] / light.dir[2] * light.dir
    assert np.hypot(aimed[0], aimed[1]) < 0.2


def test_the_camera_starts_where_a_robot_of_some_decimetres_fills_the_view(robot: Robot, scene: Any) -> None:
    """About a point at half of its height, from above and from the side; the sky fades to its lower colour."""
    assert scene.stat.center.tolist() == [0.0, 0.0, 0.05]
    assert scene.stat.extent == pytest.approx(0.3)
    assert -30.0 < scene.vis.global_.elevation < 0.0
    head = scene.vis.headlight
    assert max(head.diffuse) + max(head.ambient) <= 1.0  # nothing is overexposed
    down = pixels(scene, mujoco.mjtTexture.mjTEXTURE_SKYBOX)[256 * 3 : 256 * 4].mean(axis=(0, 1))
    assert scene.vis.rgba.haze[:3] == pytest.approx(down, abs=0.05)
    assert attributes(robot, "visual") == {}


def test_the_notes_are_of_the_robot_that_they_name(robot: Robot) -> None:
    """Its file, in which nothing of another name is left; every place of the text is filled."""
    notes = readme(replace(robot, name="my-robot"))
    assert notes.startswith("# my-robot in MuJoCo\n")
    assert "- `my-robot.xml`: the robot alone" in notes
    assert 'mujoco.MjSpec.from_file("my-robot.xml")' in notes
    assert "kenan" not in notes
    assert not re.search(r"\{\w*\}", notes)
    assert set(re.findall(r"\{(\w+)", NOTES)) == {"name", "released", "hold", "mujoco", "foot", "body"}


@pytest.mark.parametrize("times", [1.0, 2.0])
def test_the_motor_holds_by_a_quarter_more_than_the_springs_push(robot: Robot, times: float) -> None:
    """Against their opening, which is positive: the control is negative."""
    spring = replace(robot.spring, stiffness_nm_per_rad=times * robot.spring.stiffness_nm_per_rad)
    (held,) = re.findall(
        r"Its control (\S+) N·m holds the loaded leg, 0 releases it", readme(replace(robot, spring=spring))
    )
    assert float(held) == pytest.approx(-1.25 * times * robot.spring.peak_torque_nm, rel=5e-3)
    assert HOLD == 1.25


def test_the_moment_of_release_is_spoken_of_where_the_robot_has_one(robot: Robot) -> None:
    assert "`released` (the moment when the roller leaves the cam)" in readme(let_go(robot))
    assert "`released`" not in readme(replace(robot, roller_off=None))
    assert "held by the motor).\n" in readme(replace(robot, roller_off=None))


def test_friction_is_that_of_the_robots_own_pads_and_plates_on_its_ground(robot: Robot) -> None:
    """Contacts that have priority 1 do without the floor's: theirs is the product of both."""
    rubbing = replace(robot, friction=Friction(0.9, 0.4, 0.2, (0.0015,) * 4))
    foot, body = re.findall(r"\(priority 1\): (\S+) under the feet, (\S+)\s+elsewhere", readme(rubbing))[0]
    rubs = coefficients(rubbing, Settings())
    assert (float(foot), float(body)) == pytest.approx((rubs.ground * rubs.foot, rubs.ground * rubs.body))
    assert float(foot) > float(body)


def test_the_notes_programs_are_python_and_use_what_there_is(robot: Robot) -> None:
    """Key, actuator, equality and sensor have the names that they have in the robot's file."""
    jump, attach = re.findall(r"```python\n(.*?)```", readme(robot), re.DOTALL)
    for program in (jump, attach):
        ast.parse(program)
    root = ET.fromstring(write_robot(robot))
    sensors = {one.get("name") for sensor in root.iter("sensor") for one in sensor}
    named = {tag: {one.get("name") for one in root.iter(tag)} for tag in ("key", "motor", "general")}
    assert 'model.key("wound")' in jump
    assert "wound" in named["key"]
    assert set(re.findall(r'data\.sensor\("(\w+)"\)', jump)) == {"com"} <= sensors
    assert set(re.findall(r'data\.actuator\("(\w+)"\)', jump)) == {"cam"}
    assert "cam" in named["motor"] | named["general"]
    held, until = map(float, re.findall(r"data\.time < ([\d.]+)", jump))
    assert held < until


@pytest.mark.filterwarnings("ignore:Attach conflict")  # MuJoCo 4 says which options it does not take
def test_the_notes_programs_run_and_the_robot_jumps_when_the_motor_lets_go(
    robot: Robot, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Held for 0.1 s, it is in the air 0.3 s after; in another scene it has a prefix. From texts instead of files."""
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log
    jump, attach = re.findall(r"```python\n(.*?)```", readme(robot), re.DOTALL)
    alone, held = write_robot(robot), at_key(mujoco.MjModel.from_xml_string(write_robot(robot)), "wound")
    given = {"scene": write_scene(robot), "files": {f"{robot.name}.xml": alone.encode()}, "alone": alone}
    own = "<mujoco><worldbody><geom type='plane' size='0 0 0.05'/></worldbody></mujoco>"
    exec(jump.replace('from_xml_path("scene.xml")', "from_xml_string(scene, files)"), given)
    place = np.array([float(one) for one in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", capsys.readouterr().out)])
    assert place.shape == (3,)
    assert place[2] > held.sensor("com").data[2] + 0.01
    assert place[0] > held.sensor("com").data[0] + 0.05  # x is forward
    program = attach.replace('from_file("your_scene.xml")', "from_string(own)")
    exec(
        program.replace(f'from_file("{robot.name}.xml")', "from_string(alone)"),
        found := given | {"own": own, "mujoco": mujoco},
    )
    assert found["model"].joint("jumper-leg").id >= 0
    assert found["model"].ngeom == mujoco.MjModel.from_xml_string(alone).ngeom + 1


def test_the_versions_that_the_notes_name_reach_up_to_the_installed_one(robot: Robot) -> None:
    least, newest = (tuple(map(int, one.split("."))) for one in MUJOCO.split(" and "))
    assert (3, 2) <= least < newest
    assert int(mujoco.__version__.split(".")[0]) <= newest[0]
    assert f"Tested with MuJoCo {MUJOCO}. Attached" in readme(robot)


def at_key(model: Any, key: str) -> Any:
    """Return the data of a key frame."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    return data


def test_in_its_scene_the_robot_stands_on_the_floor_alone(robot: Robot) -> None:
    """A plane through the world's origin, up; the robot touches it with its foot and rests there."""
    scene, alone = write_scene(robot), write_robot(robot)
    model = mujoco.MjModel.from_xml_string(scene, {f"{robot.name}.xml": alone.encode()})
    floor = model.geom("floor")
    assert mujoco.mjtGeom(int(floor.type[0])) == mujoco.mjtGeom.mjGEOM_PLANE
    assert (floor.pos.tolist(), floor.quat.tolist()) == ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0])
    assert floor.bodyid[0] == 0
    data = at_key(model, "home")
    start = data.body(BODY).xpos.copy()
    for _ in range(400):  # in which it would fall by 49 mm
        mujoco.mj_step(model, data)
    assert data.body(BODY).xpos == pytest.approx(start, abs=0.001)
    assert data.ncon > 0
    for contact in data.contact:
        assert floor.id in contact.geom
        (other,) = set(contact.geom.tolist()) - {floor.id}
        assert model.body(model.geom_bodyid[other]).name == FOOT
    names = [one.split(b"\0", 1)[0].decode() for one in (model.names, mujoco.MjModel.from_xml_string(alone).names)]
    assert names == [f"{robot.name} scene", robot.name]
