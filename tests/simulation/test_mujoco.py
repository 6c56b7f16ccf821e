"""The MuJoCo back end: settings that it does not have are rejected; it begins where the planar engine does."""

import numpy as np
import pytest
from support import needs
from support.machines import let_go, rubbing, stopped

from jumpcad.errors import JumpcadError
from jumpcad.exporters.mjcf import write_mjcf
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Settings, simulate
from jumpcad.simulation.engines import engine_named
from jumpcad.strength.loads import pin_torque_nm


def test_mujoco_refuses_what_it_does_not_have(kenan: Robot) -> None:
    needs.package("mujoco")
    with pytest.raises(JumpcadError, match=r"restitution = 0\.5.*pybullet"):
        simulate(kenan, Settings(restitution=0.5), "mujoco")


@pytest.mark.parametrize("turning", [False, True])
def test_mujoco_begins_where_the_planar_engine_does(kenan: Robot, turning: bool) -> None:
    """Places, turns and both velocities of all four bodies; standing loaded, and as the roller leaves the cam."""
    needs.package("mujoco")
    robot = let_go(kenan) if turning else kenan
    states = []
    for name in ("mujoco", "planar"):
        with engine_named(name).world(robot, Settings()) as world:
            states.append(world.state())
    one, other = states
    for key in ("com_m", "rotation", "velocity_m_s", "angular_rad_s"):
        np.testing.assert_allclose(getattr(one, key), getattr(other, key), atol=1e-5, err_msg=key)
    assert one.leg_rad == pytest.approx(other.leg_rad, abs=1e-9)
    assert (np.abs(one.velocity_m_s).max() > 0.01) == turning


def test_the_pad_stops_the_leg_in_mujoco_and_not_its_limit(kenan: Robot) -> None:
    """A limit with critical damping would throw the leg back; every contact has a row for its normal, two to slide."""
    mujoco, robot = needs.package("mujoco"), stopped(kenan)
    assert mujoco.MjModel.from_xml_string(write_mjcf(robot)).joint("leg").limited[0]
    with engine_named("mujoco").world(robot, Settings()) as world:
        assert int(world.model.joint("leg").limited[0]) == 0
        assert world.loaded()
        world.advance(40)
        assert world.loaded()
        assert abs(world.slip_j) < 0.01 * kenan.spring.energy_j
        contacts = world.data.nefc - world.data.ne - world.data.nf - world.data.nl
        assert contacts == world._rows * world.data.ncon


def test_the_pins_rub_once_and_at_the_leg(kenan: Robot) -> None:
    """Their torque is that of the leg's joint (`pin_torque_nm`), beside what the settings ask of every joint."""
    needs.package("mujoco")
    robot = rubbing(kenan, pin=0.2)
    pins = pin_torque_nm(robot, 0.2)
    assert pins > 1e-4
    with engine_named("mujoco").world(robot, Settings(joint_friction_nm=0.003)) as world:
        assert world._dry_nm == pytest.approx([0.003 + pins, 0.003, 0.003])
    with engine_named("mujoco").world(kenan, Settings()) as world:
        assert world._dry_nm.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    "rubs",
    [
        {"joint_damping_nms_per_rad": 0.0, "joint_friction_nm": 0.002}, {"joint_damping_nms_per_rad": 1e-4},
        {"joint_damping_nms_per_rad": 0.0, "ground_friction": 0.4},
    ],
    ids=["dry joints", "damped joints", "slip"],
)  # fmt: skip
def test_what_is_lost_is_what_the_planar_engine_loses(kenan: Robot, rubs: dict[str, float]) -> None:
    """Each loss by itself; what is left of the springs' energy for impacts and rounding is hardly any of it."""
    needs.package("mujoco")
    ours, theirs = (simulate(kenan, Settings(**rubs), engine).energy for engine in ("planar", "mujoco"))
    assert ours is not None
    assert theirs is not None
    assert theirs.joint_damping_j == pytest.approx(ours.joint_damping_j, rel=0.03)
    assert theirs.slip_j == pytest.approx(ours.slip_j, rel=0.02, abs=1e-4)
    assert max(theirs.joint_damping_j, theirs.slip_j) > 0.02 * kenan.spring.energy_j
    assert abs(theirs.contact_j) < 1e-3 * kenan.spring.energy_j
