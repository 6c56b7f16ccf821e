"""The scene around the robot as MuJoCo compiles it, and notes that say what is beside them."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import needs
from support.built import built

from jumpcad.exporters.mjcf_robot import write_robot
from jumpcad.exporters.mjcf_scene import HOLD, readme, write_scene
from jumpcad.robot import Robot

mujoco = needs.package("mujoco")
STAND_IN = b'<mujoco><worldbody><body name="stand_in"><geom size="0.01"/></body></worldbody></mujoco>'
"""What the scene includes instead of a robot."""


@pytest.fixture(scope="module")
def robot() -> Robot:
    return built("kenan-2.0")


@pytest.fixture(scope="module")
def scene(robot: Robot) -> Any:
    return mujoco.MjModel.from_xml_string(write_scene(robot), {f"{robot.name}.xml": STAND_IN})


@pytest.mark.parametrize("times", [1.0, 2.0])
def test_the_motor_holds_by_a_quarter_more_than_the_springs_push(robot: Robot, times: float) -> None:
    """Against their opening, which is positive: the control is negative."""
    spring = replace(robot.spring, stiffness_nm_per_rad=times * robot.spring.stiffness_nm_per_rad)
    (held,) = re.findall(
        r"Its control (\S+) N·m holds the loaded leg, 0 releases it", readme(replace(robot, spring=spring))
    )
    assert float(held) == pytest.approx(-1.25 * times * robot.spring.peak_torque_nm, rel=5e-3)
    assert HOLD == 1.25


@pytest.mark.filterwarnings("ignore:Attach conflict")  # MuJoCo 4 says which options it does not take
def test_the_notes_programs_run_and_the_robot_jumps_when_the_motor_lets_go(
    robot: Robot, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Held for 0.1 s, it is in the air 0.3 s after; in another scene it has a prefix. From texts instead of files."""
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log
    jump, _, attach = re.findall(r"```python\n(.*?)```", readme(robot), re.DOTALL)
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


def at_key(model: Any, key: str) -> Any:
    """Return the data of a key frame."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    return data
