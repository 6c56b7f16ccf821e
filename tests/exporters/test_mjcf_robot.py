"""MJCF for simulations by others, as MuJoCo compiles it: key frames, motor, latch, sensors, who touches whom, notes."""

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import needs
from support.machines import one_sided

from jumpcad.exporters.mjcf_robot import HOLD, mjcf_files, readme, write_robot
from jumpcad.mechanism.model import BODY, BODY_NAMES, FOOT, body_poses, release_pose
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.settings import Settings, coefficients

mujoco = needs.package("mujoco")
JOINTS = ("leg", "front", "ankle")


def compiled(robot: Robot) -> Any:
    """Return the model without what is seen, whose meshes are files."""
    return mujoco.MjModel.from_xml_string(write_robot(robot, visuals(robot), looks=False))


@pytest.fixture(scope="module")
def model(kenan: Robot) -> Any:
    return compiled(kenan)


def at_key(model: Any, key: str) -> Any:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    return data


@pytest.mark.parametrize(("key", "loaded"), [("home", 0.0), ("wound", 1.0)])
def test_keys_are_poses_of_the_standing_robot_which_the_motor_lets_go_or_holds(
    kenan: Robot, model: Any, key: str, loaded: float
) -> None:
    """The motor holds the loaded leg with 1.25 times the springs' torque, and pulls at nothing else."""
    data = at_key(model, key)
    for name, pose in body_poses(kenan, loaded).items():
        np.testing.assert_allclose(data.body(name).xpos, pose[:3, 3], atol=1e-7)
        np.testing.assert_allclose(data.body(name).xmat.reshape(3, 3), pose[:3, :3], atol=1e-6)
    hold = -1.25 * kenan.spring.peak_torque_nm
    assert data.ctrl.tolist() == pytest.approx([hold * loaded])
    assert np.abs(data.qvel).max() == 0.0
    assert model.actuator("cam").ctrlrange.tolist() == pytest.approx([hold, 0.0])
    assert model.actuator("cam").trnid[0] == model.joint("leg").id


def test_the_last_key_is_the_moment_at_which_the_roller_leaves_the_cam(kenan: Robot, model: Any) -> None:
    release, data = release_pose(kenan), at_key(model, "released")
    assert model.nkey == 3
    for joint in JOINTS:
        assert data.joint(joint).qpos[0] == pytest.approx(release.joint_rad[joint], abs=1e-9)
        assert data.joint(joint).qvel[0] == pytest.approx(release.joint_rad_s[joint], rel=1e-9)
    assert data.ctrl.tolist() == [0.0]
    speeds = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, data.body(FOOT).id, speeds, 0)
    assert speeds == pytest.approx(np.zeros(6), abs=1e-5)  # the foot still stands, while all else turns and moves
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, data.body(BODY).id, speeds, 0)
    assert np.hypot(*speeds[[3, 5]]) > 0.01
    assert compiled(replace(kenan, roller_off=None)).nkey == 2


def test_leg_and_latch_end_where_the_springs_are_loaded(kenan: Robot, model: Any) -> None:
    """The tendon `wound` is a limit there; the latch, which is off, holds the leg there."""
    wind = kenan.spring.wind_rad
    tendon = model.tendon("wound").id
    assert model.tendon_range[tendon, 0] == pytest.approx(-wind)
    assert model.tendon_range[tendon, 1] > math.pi  # past rest nothing but the stop is in the leg's way
    assert model.tendon_limited[tendon] == 1
    assert at_key(model, "wound").ten_length[tendon] == pytest.approx(-wind)  # it is as long as the joint's angle
    latch = model.equality("latch")
    assert latch.data[:5].tolist() == pytest.approx([-wind, 0.0, 0.0, 0.0, 0.0])
    assert latch.active0[0] == 0
    assert model.equality("loop").active0[0] == 1
    pushing = compiled(one_sided(kenan))
    assert pushing.tendon_stiffness[pushing.tendon("springs").id] == pytest.approx(kenan.spring.stiffness_nm_per_rad)


def test_collisions_have_the_robots_friction_and_priority(kenan: Robot, model: Any) -> None:
    """The foot's are those of its pads; spheres where it stands."""
    rubs = coefficients(kenan, Settings())
    count = 0
    for index in range(model.ngeom):
        geom = model.geom(index)
        assert geom.group[0] == 3
        assert geom.priority[0] == 1
        surface = "foot" if model.body(geom.bodyid[0]).name == FOOT else "body"
        assert geom.friction[0] == pytest.approx(rubs.contact(surface))
    for name, body in kenan.bodies.items():
        for contact in body.contacts:
            sphere = model.geom(f"{name}_{contact.name}_collision")
            assert sphere.pos.tolist() == pytest.approx(contact.centre_m.tolist(), abs=1e-9)
            assert sphere.size[0] == pytest.approx(contact.radius_m)
            count += 1
    assert count + len(BODY_NAMES) == model.ngeom  # and a hull for each


def test_bodies_do_not_touch_each_other(model: Any) -> None:
    """Of six pairs three have a joint in common, and the others are excluded: nothing but a scene is touched."""
    assert model.nexclude == 3
    for key in ("home", "wound"):
        assert at_key(model, key).ncon == 0


def test_the_velocity_of_the_centre_of_mass_is_how_its_place_changes(model: Any) -> None:
    """Of the whole robot, all of which moves here; an angle's sensor is that of its own joint."""
    data, step = at_key(model, "wound"), 1e-6
    data.qvel[:] = np.random.default_rng(0).normal(size=model.nv)
    mujoco.mj_forward(model, data)
    velocity, before, places = (
        one.copy() for one in (data.sensor("com_velocity").data, data.sensor("com").data, data.qpos)
    )
    mujoco.mj_integratePos(model, places, data.qvel, step)
    data.qpos[:] = places
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose((data.sensor("com").data - before) / step, velocity, rtol=1e-4, atol=1e-4)
    for joint in JOINTS:
        assert data.sensor(f"{joint}_angle").data[0] == data.joint(joint).qpos[0]
    assert len({round(float(data.joint(joint).qpos[0]), 6) for joint in JOINTS}) == 3


def test_bodies_collide_by_the_convex_hull_of_their_parts(kenan: Robot, model: Any) -> None:
    """It reaches as far as they do along the axes, within 2 mm otherwise; the foot's stays above its sole by 0.5 mm."""
    directions = np.random.default_rng(0).normal(size=(500, 3))
    directions = np.concatenate([np.eye(3), -np.eye(3), directions / np.linalg.norm(directions, axis=1)[:, None]])
    for name in BODY_NAMES:
        geom = model.geom(f"{name}_collision")
        first = model.mesh_vertadr[geom.dataid[0]]
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, geom.quat)
        hull = model.mesh_vert[first : first + model.mesh_vertnum[geom.dataid[0]]] @ turn.reshape(3, 3).T + geom.pos
        parts = np.concatenate([
            one.mesh.vertices / 1000.0 @ one.T_body_mesh[:3, :3].T + one.T_body_mesh[:3, 3]
            for one in visuals(kenan) if one.body == name
        ])  # fmt: skip
        upward = directions[directions[:, 2] > 0.0] if name == FOOT else directions
        short = (parts @ upward.T).max(axis=0) - (hull @ upward.T).max(axis=0)
        assert -2e-5 < short.min() <= short.max() < 0.002
        assert short[np.abs(upward).max(axis=1) == 1.0].max() < 2e-5
        faces = model.mesh_polyadr[geom.dataid[0]] + np.arange(model.mesh_polynum[geom.dataid[0]])
        assert len(hull) <= 32
        assert model.mesh_polyvertnum[faces].max() <= 12
        if name == FOOT:
            assert hull[:, 2].min() == pytest.approx(parts[:, 2].min() + 0.0005, abs=2e-5)


@pytest.mark.parametrize("times", [1.0, 2.0])
def test_the_motor_holds_by_a_quarter_more_than_the_springs_push(kenan: Robot, times: float) -> None:
    """Against their opening, which is positive: the control is negative."""
    spring = replace(kenan.spring, stiffness_nm_per_rad=times * kenan.spring.stiffness_nm_per_rad)
    (held,) = re.findall(
        r"Its control (\S+) N·m holds the loaded leg, 0 releases it", readme(replace(kenan, springs=(spring,)))
    )
    assert float(held) == pytest.approx(-1.25 * times * kenan.spring.peak_torque_nm, rel=5e-3)
    assert HOLD == 1.25


@pytest.mark.filterwarnings("ignore:Attach conflict")  # MuJoCo 4 says which options it does not take
def test_the_notes_programs_run_and_the_robot_jumps_when_the_motor_lets_go(
    kenan: Robot, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Held for 0.1 s, it is in the air 0.3 s after; in another scene it has a prefix. From texts instead of files."""
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log
    jump, _, attach = re.findall(r"```python\n(.*?)```", readme(kenan), re.DOTALL)
    alone = write_robot(kenan, visuals(kenan), looks=False)
    held = at_key(compiled(kenan), "wound")
    given = {
        "scene": dict(mjcf_files(kenan))["mjcf/scene.xml"],
        "files": {f"{kenan.name}.xml": alone.encode()},
        "alone": alone,
    }
    own = "<mujoco><worldbody><geom type='plane' size='0 0 0.05'/></worldbody></mujoco>"
    exec(jump.replace('from_xml_path("scene.xml")', "from_xml_string(scene, files)"), given)
    place = np.array([float(one) for one in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", capsys.readouterr().out)])
    assert place.shape == (3,)
    assert place[2] > held.sensor("com").data[2] + 0.01
    assert place[0] > held.sensor("com").data[0] + 0.05  # x is forward
    program = attach.replace('from_file("your_scene.xml")', "from_string(own)")
    exec(
        program.replace(f'from_file("{kenan.name}.xml")', "from_string(alone)"),
        found := given | {"own": own, "mujoco": mujoco},
    )
    assert found["model"].joint("jumper-leg").id >= 0
    assert found["model"].ngeom == mujoco.MjModel.from_xml_string(alone).ngeom + 1
