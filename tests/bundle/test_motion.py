"""The motion in the viewer: the cam winds, runs ahead of its gear by the dog's play at most, and never back."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.built import built, geared
from support.decimals import decimals

from jumpcad.bundle.motion import SHOWN_S, _seven, motion
from jumpcad.bundle.viewer import viewer_data
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.scene.visuals import extent_m
from jumpcad.simulation import Settings, simulate


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_cam_runs_on_over_the_drop_while_its_gear_stands(name: str) -> None:
    robot = built(name)
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), "planar")
    found = motion(robot, jump.trajectory, jump.takeoff_time_s)
    assert decimals([found["time_s"], found["show_s"]]) == 4
    cam, gear, phase = (np.array(found[key]) for key in ("cam_rad", "gear_rad", "phase"))
    drive = robot.layout.drive
    assert (np.diff(cam) >= 0.0).all()
    assert (np.diff(gear) >= 0.0).all()
    assert cam[phase == "winding"] == pytest.approx(gear[phase == "winding"])
    assert gear[phase == "drop"] == pytest.approx(drive.cam.law.lift_rad, abs=1e-4)
    ahead = (cam - gear)[phase == "drop"]
    assert ahead[0] == 0.0
    assert 0.0 < ahead[-1] <= drive.dog.play_rad


@pytest.mark.parametrize("stages", [1, 2])
def test_teeth_in_mesh_run_past_each_other_without_slip(stages: int) -> None:
    """Turns times teeth of two wheels in mesh are equal and opposite; an idler's two wheels turn as one."""
    robot = built("kenan-2.0") if stages == 1 else geared()
    pairs = robot.layout.drive.train.stages
    assert len(pairs) == stages
    turns = {one["node"]: one["per_cam"] for one in viewer_data(robot, simulate(robot, engine="planar"))["turning"]}
    axles = [turns[node] for node in (("motor_pinion", "cam_gear"), ("motor_pinion", "idler", "cam_gear"))[stages - 1]]
    for pair, quick, slow in zip(pairs, axles[:-1], axles[1:], strict=True):
        assert quick * pair.pinion.teeth == pytest.approx(-slow * pair.wheel.teeth, rel=1e-4)
    assert turns["motor_shaft"] == turns["motor_pinion"]
    assert turns["cam"] == turns["cam_gear"] == 1.0


@pytest.fixture(scope="module")
def shown() -> dict[str, np.ndarray]:
    robot = built("kenan-2.0")
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), "planar")
    found = motion(robot, jump.trajectory, jump.takeoff_time_s)
    found["words"] = found.pop("phases")
    return {name: column if isinstance(column, dict) else np.array(column) for name, column in found.items()}


def leg_deg(shown: dict[str, np.ndarray]) -> np.ndarray:
    """The leg's angle against the body, from their turns in the world; quaternions are about y alone."""
    body, leg = (np.array(shown["frames"][name])[:, 3:] for name in (BODY, MAIN_LEG))
    assert np.abs(body[:, [0, 2]]).max() < 1e-6
    return np.degrees(2.0 * (np.arctan2(leg[:, 1], leg[:, 3]) - np.arctan2(body[:, 1], body[:, 3])))


def test_the_leg_is_loaded_by_winding_and_let_go_in_the_drop(shown: dict[str, np.ndarray]) -> None:
    """From rest to the design's compression, and from there to where the roller comes off the cam."""
    robot, phase, leg = built("kenan-2.0"), shown["phase"], leg_deg(shown)
    assert list(dict.fromkeys(phase)) == ["winding", "drop", "push-off", "flight"]
    winding, drop, push = (leg[phase == name] - leg[0] for name in ("winding", "drop", "push-off"))
    loaded_deg = np.degrees(robot.design.compression_rad)
    sense = np.sign(winding[-1])
    assert sense * winding[-1] == pytest.approx(loaded_deg, abs=0.01)
    assert (np.diff(sense * winding) >= -1e-3).all()
    assert sense * drop[0] == pytest.approx(loaded_deg, abs=0.01)
    assert (np.diff(sense * drop) <= 1e-3).all()
    assert sense * drop[-1] == pytest.approx(-np.degrees(robot.roller_off.leg_rad), abs=0.01)
    assert push[0] == pytest.approx(drop[-1], abs=1.5)
    assert (np.diff(shown["cam_rad"][phase == "drop"]) > 0.0).all()
    assert shown["cam_rad"][phase == "drop"][-1] == pytest.approx(robot.layout.drive.cam.geometry.free_rad, abs=1e-4)


def test_times_are_real_and_each_phase_is_shown_at_one_scale(shown: dict[str, np.ndarray]) -> None:
    robot, phase, real, seen = built("kenan-2.0"), shown["phase"], shown["time_s"], shown["show_s"]
    assert (np.diff(seen) >= 0.0).all()
    assert seen[0] == 0.0
    train, left_rad = robot.layout.drive.train, 2.0 * np.pi - robot.layout.drive.cam.law.lift_rad
    free_rad_s = train.driven.no_load_rpm * 2.0 * np.pi / 60.0 / train.ratio
    assert real[phase == "winding"][-1] == pytest.approx(train.winding_s - left_rad / free_rad_s, abs=1e-4)
    turned = robot.release.roll_over_rad / robot.layout.drive.train.cam_speed_rad_s
    assert real[phase == "drop"][-1] == pytest.approx(turned, abs=1e-4)
    for name in ("winding", "drop", "push-off", "flight"):
        at = phase == name
        assert np.ptp(seen[at]) == pytest.approx(SHOWN_S[name], abs=2e-4)
        scale = np.ptp(seen[at]) / np.ptp(real[at])
        assert seen[at] - seen[at][0] == pytest.approx(scale * (real[at] - real[at][0]), abs=2e-3 * scale)
        words = shown["words"][name]
        if 0.95 < scale < 1.05:
            assert words == " (at real speed)"
            continue
        way, number = re.findall(r"\((.+), ([\d.]+) times", words)[0]
        assert way == ("slow motion" if scale > 1.0 else "sped up")
        assert float(number) == pytest.approx(max(scale, 1.0 / scale), rel=0.01)
    assert real[phase == "flight"][0] > real[phase == "push-off"][-1] - 1e-9


def test_the_centre_of_mass_is_that_of_the_bodies_and_falls_freely(shown: dict[str, np.ndarray]) -> None:
    robot, at = built("kenan-2.0"), shown["phase"] == "flight"
    places = {name: np.array(rows) for name, rows in shown["frames"].items()}
    assert all((rows[:, 6] >= 0.0).all() for rows in places.values())
    centre = sum(
        body.mass_kg * (Rotation.from_quat(places[name][:, 3:]).apply(body.com_m) + places[name][:, :3])
        for name, body in robot.bodies.items()
    )
    assert shown["com_m"] == pytest.approx(centre[:, [0, 2]] / robot.mass_kg, abs=2e-5)
    fall = np.polyfit(shown["time_s"][at], shown["com_m"][at, 1], 2)
    assert fall[0] == pytest.approx(-9.81 / 2.0, rel=0.01)


def test_what_a_click_on_a_part_shows_weighs_as_much_as_the_robot() -> None:
    robot = built("kenan-2.0")
    data = viewer_data(robot, simulate(robot, engine="planar"))
    grams = sum(one["mass_g"] for one in data["parts"].values())
    assert grams == pytest.approx(1000.0 * robot.mass_kg, abs=0.05)
    assert data["parts"]["foot"]["file"] == "stl/foot.stl"
    assert data["parts"]["foot"]["label"] == "foot"
    assert data["parts"]["leg_axle"]["file"] == ""
    assert data["size_m"] == pytest.approx(max(extent_m(robot)), abs=1e-6)
    aside = data["explode_m"]
    assert sorted(aside) == sorted(data["parts"])
    assert aside["body_plate_left"] > 0.02 > 0.0 == aside["main_leg"] > -0.02 > aside["body_plate_right"]  # y: left
    named = [name for step in data["steps"] for name in step["parts"]]
    assert sorted(named) == sorted(data["parts"])


def test_the_flight_is_shown_to_its_last_moment() -> None:
    """However many moments were recorded, of which every fourth is shown."""
    robot = built("kenan-2.0")
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), "planar")
    assert jump.trajectory is not None
    whole = len(jump.trajectory.time_s)
    for count in range(whole - 4, whole):
        cut = {name: value[:count] for name, value in vars(jump.trajectory).items() if name != "body_names"}
        found = motion(robot, replace(jump.trajectory, **cut), jump.takeoff_time_s)
        assert found["time_s"][-1] == pytest.approx(cut["time_s"][-1], abs=1e-4)


def test_a_pose_is_a_place_and_a_quaternion_whose_last_number_is_not_negative() -> None:
    """Either sign is the same turn; of half a turn and more, and about any axis, the shorter way is written."""
    for axis in ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1.0, 1.0, -1.0]):
        for degrees in range(0, 360, 15):
            turn = Rotation.from_rotvec(np.radians(degrees) * np.array(axis) / np.linalg.norm(axis))
            pose = np.eye(4)
            pose[:3, :3], pose[:3, 3] = turn.as_matrix(), [0.1, -0.2, 0.3]
            *place, x, y, z, w = _seven(pose)
            assert place == [0.1, -0.2, 0.3]
            assert w >= 0.0
            np.testing.assert_allclose(Rotation.from_quat([x, y, z, w]).as_matrix(), turn.as_matrix(), atol=1e-4)
