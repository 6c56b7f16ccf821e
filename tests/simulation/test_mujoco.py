"""The MuJoCo back end: settings that it does not have are rejected."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.robot import Robot
from jumpcad.simulation import Settings, simulate


@pytest.mark.parametrize("key", ["restitution", "drag_per_s"])
def test_mujoco_refuses_what_it_does_not_have(kenan: Robot, key: str) -> None:
    pytest.importorskip("mujoco")
    with pytest.raises(JumpcadError, match=f"{key} = 0.5.*pybullet"):
        simulate(kenan, Settings(**{key: 0.5}), "mujoco")
