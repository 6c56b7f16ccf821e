"""The MJCF files as MuJoCo's users take them: held, released, put into another scene, driven at random."""

import re
from pathlib import Path

import numpy as np
import pytest
from support import needs
from support.clients import Case

from jumpcad.simulation import simulate

mujoco = needs.package("mujoco")

OWN_SCENE = """<mujoco><option timestep="0.00025" integrator="implicitfast" cone="elliptic" impratio="100"/><worldbody>
<geom name="floor" type="box" size="2 2 0.1" pos="0 0 0.2"/><geom type="sphere" size="0.1" pos="-1 0 1"/>
</worldbody></mujoco>"""
FLOOR_M = 0.3
OPTIONS_DIFFER = pytest.mark.filterwarnings("ignore:Attach conflict")
"""MuJoCo 4 says which options of an attached model it does not take."""


def ground_force_n(model, data) -> float:
    force, total = np.zeros(6), 0.0
    for index in range(data.ncon):
        mujoco.mj_contactForce(model, data, index, force)
        total += force[0]
    return total


def jump_m(model, data, prefix: str = "") -> float:
    """Return the range of the centre of mass from where the robot is, when the motor lets go."""
    start = data.sensor(f"{prefix}com").data.copy()
    data.actuator(f"{prefix}cam").ctrl = 0.0
    begin, airborne = data.time, 0.0
    while airborne < 0.004:
        mujoco.mj_step(model, data)
        airborne = 0.0 if ground_force_n(model, data) else airborne + model.opt.timestep
        assert data.time < begin + 1.0
    mujoco.mj_forward(model, data)
    rise = data.sensor(f"{prefix}com").data - start
    speed = data.sensor(f"{prefix}com_velocity").data
    time = (speed[2] + np.sqrt(speed[2] ** 2 + 2.0 * 9.81 * rise[2])) / 9.81
    return float(rise[0] + speed[0] * time)


def wound(model, prefix: str = ""):
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(f"{prefix}wound").id)
    mujoco.mj_forward(model, data)
    return data


def test_the_motor_holds_the_loaded_leg_and_releases_it(case: Case) -> None:
    model = mujoco.MjModel.from_xml_path(str(case.scene))
    data = wound(model)
    while data.time < 0.2:
        mujoco.mj_step(model, data)
    assert data.sensor("leg_angle").data[0] == pytest.approx(-case.robot.spring.wind_rad, abs=2e-4)
    assert abs(data.qvel).max() < 0.02
    assert ground_force_n(model, data) == pytest.approx(9.81 * case.robot.mass_kg, rel=0.01)
    assert jump_m(model, data) == pytest.approx(simulate(case.robot, engine="mujoco").ballistic_range_m, rel=0.015)


def test_the_latch_holds_it_too(case: Case) -> None:
    model = mujoco.MjModel.from_xml_path(str(case.scene))
    data, latch = wound(model), model.equality("latch").id
    data.ctrl[:], data.eq_active[latch] = 0.0, 1
    while data.time < 0.1:
        mujoco.mj_step(model, data)
    assert data.sensor("leg_angle").data[0] == pytest.approx(-case.robot.spring.wind_rad, abs=2e-3)
    data.eq_active[latch] = 0
    while data.time < 0.2:
        mujoco.mj_step(model, data)
    assert data.sensor("com_velocity").data[0] > 0.2


@OPTIONS_DIFFER
def test_attached_to_another_scene_it_stands_on_its_floor_and_jumps_as_far(case: Case) -> None:
    scene = mujoco.MjSpec.from_string(OWN_SCENE)
    robot = mujoco.MjSpec.from_file(str(case.mjcf))
    scene.attach(robot, prefix="jumper-", frame=scene.worldbody.add_frame(pos=[0.2, 0.0, FLOOR_M]))
    model = scene.compile()
    data = mujoco.MjData(model)
    height = model.body("jumper-body").pos[2]
    while data.time < 0.5:
        mujoco.mj_step(model, data)
    assert data.body("jumper-body").xpos[2] == pytest.approx(height, abs=0.002)
    assert ground_force_n(model, data) == pytest.approx(9.81 * case.robot.mass_kg, rel=0.02)
    data = wound(model, "jumper-")
    data.joint("jumper-free").qpos[:3] += [0.2, 0.0, FLOOR_M]
    mujoco.mj_forward(model, data)
    alone = mujoco.MjModel.from_xml_path(str(case.scene))
    assert jump_m(model, data, "jumper-") == pytest.approx(jump_m(alone, wound(alone)), rel=0.003)


def test_it_lands_on_its_body_and_stays_above_the_floor(case: Case) -> None:
    """After a jump it lies somewhere: hulls carry it where no foot does."""
    model = mujoco.MjModel.from_xml_path(str(case.scene))
    data = wound(model)
    data.qpos[2], data.qpos[3:7] = 0.3, [0.0, 1.0, 0.0, 0.0]  # on its back
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    assert 0.0 < data.body("body").xipos[2] < 0.15
    assert ground_force_n(model, data) > 0.0


def test_driven_at_random_it_gives_no_warning(case: Case) -> None:
    """Menagerie's test of every scene, for 0.1 s from the model's own pose."""
    model = mujoco.MjModel.from_xml_path(str(case.scene))
    data, random = mujoco.MjData(model), np.random.default_rng(0)
    while data.time < 0.1:
        data.ctrl = random.uniform(*model.actuator_ctrlrange.T)
        mujoco.mj_step(model, data)
    assert not any(warning.number for warning in data.warning)
    assert np.isfinite(data.sensordata).all()


def test_the_robot_alone_brings_no_floor_and_does_not_touch_itself(case: Case) -> None:
    model = mujoco.MjModel.from_xml_path(str(case.mjcf))
    assert (model.geom_bodyid > 0).all()
    assert mujoco.mjtGeom.mjGEOM_PLANE not in set(model.geom_type)
    for loaded in ("home", "wound"):
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, model.key(loaded).id)
        mujoco.mj_forward(model, data)
        assert data.ncon == 0
    colours = {tuple(rgba) for rgba in model.mat_rgba}
    assert len(colours) == model.nmat


@OPTIONS_DIFFER
def test_the_notes_program_runs(case: Case, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    notes = case.mjcf.with_name("README.md").read_text()
    jump, again, attach = re.findall(r"```python\n(.*?)```", notes, re.DOTALL)
    monkeypatch.chdir(case.mjcf.parent)
    exec(jump, {})
    assert float(re.findall(r"-?\d\.\d+", capsys.readouterr().out)[0]) > 0.05
    exec(again, {})
    first, *others = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"1 on its feet (\d\.\d\d) m", first)
    assert len(others) == 9
    Path("your_scene.xml").write_text(OWN_SCENE)
    exec(attach, {"mujoco": mujoco})
    Path("your_scene.xml").unlink()
