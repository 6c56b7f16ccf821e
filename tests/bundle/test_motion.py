"""The motion in the viewer: the cam winds, runs ahead of its gear by the dog's play at most, and never back."""

import numpy as np
import pytest
from support.built import built, geared

from jumpcad.bundle.motion import motion
from jumpcad.bundle.viewer import viewer_data
from jumpcad.simulation import Settings, simulate


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo"])
def test_the_cam_runs_on_over_the_drop_while_its_gear_stands(name: str) -> None:
    robot = built(name)
    jump = simulate(robot, Settings(flight="simulated", trajectory=True), "planar")
    found = motion(robot, jump.trajectory, jump.takeoff_time_s)
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
