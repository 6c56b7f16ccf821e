"""Robots side by side: their figures, what differs, and the page's one scale."""

import re
from pathlib import Path

import numpy as np
import pytest
from support.built import built
from support.flights import com_x_m
from support.studies import IDENTITY, trials

import jumpcad
from jumpcad.bundle.viewer import lane, lanes_values
from jumpcad.errors import JumpcadError
from jumpcad.search.study.store import StudyStore
from jumpcad.settings import Settings
from jumpcad.simulation import simulate
from jumpcad.workshop import load_workshop


def test_lanes_have_one_scale_and_robots_start_on_the_ground_and_end_on_it() -> None:
    settings = Settings(flight="simulated", trajectory=True)
    robots = [built(name) for name in ("kenan-2.0", "best-printable")]
    tracks = [simulate(robot, settings, "planar").trajectory for robot in robots]
    lanes = [lane("a", robot, track) for robot, track in zip(robots, tracks, strict=True)]
    for robot, drawn, track in zip(robots, lanes, tracks, strict=True):
        assert track is not None
        assert drawn.high[1] == pytest.approx(0.0, abs=1.1)  # y points down: nothing lies below the ground
        ends_mm = 1000.0 * com_x_m(robot, track)[[0, -1]]  # that of the table, between start and touchdown
        assert [drawn.path[0][0], drawn.path[-1][0]] == pytest.approx(ends_mm, abs=0.06)
        assert drawn.time_s[-1] == pytest.approx(track.time_s[-1], abs=1e-5)
    values = lanes_values(lanes)
    assert values["left"] < min(one.low[0] for one in lanes)
    assert values["left"] + values["width"] > max(one.high[0] for one in lanes)


def test_a_drawn_leg_reaches_from_hub_to_ankle() -> None:
    """Over the whole jump the frames of body and foot stay where the outlines of main leg and foot are turned."""
    robot = built("kenan-2.0")
    track = simulate(robot, Settings(flight="simulated", trajectory=True), "planar").trajectory
    drawn = lane("a", robot, track)
    leg, foot = (drawn.poses[:, list(drawn.outlines).index(name)] for name in ("main_leg", "foot"))
    turn = np.radians(leg[:, 2])
    ankle = leg[:, :2] + robot.design.l2_mm * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    assert np.abs(ankle - foot[:, :2]).max() < 0.5


def test_a_trial_is_named_by_its_number(tmp_path: Path) -> None:
    study = tmp_path / "s.db"
    with StudyStore.write(study, IDENTITY) as store:
        store.append(trials(4))
    for wrong, words in (
        ((f"{study}#9", "kenan-2.0"), "has no trial 9: its trials are 1 to 4"),
        ((f"{study}#first", "kenan-2.0"), "a trial is named by its number"),
        ((str(study), "kenan-2.0"), f"a trial of it is named by its number, as in {study}#28"),
        (("kenan-2.0",), "two robots or more, not 1"),
        (("kenan-2.0", "kenan-3.0"), "kenan-3.0"),
    ):
        with pytest.raises(JumpcadError, match=re.escape(words)):
            jumpcad.compare(wrong)


@pytest.mark.thorough
@pytest.mark.usefixtures("checked_once")
def test_a_robot_of_a_study_is_that_of_its_trial(tmp_path: Path) -> None:
    study = tmp_path / "s.db"
    numbers = built("kenan-2.0").design.model_dump(exclude={"stiffness_nmm_per_deg"})
    best = jumpcad.optimize(
        "ga", model="printed", evaluations=2, fixed=numbers,
        bounds={"stiffness_nmm_per_deg": (9.0, 10.0)}, study=study, workers=0,
    )  # fmt: skip
    assert best.design is not None
    with StudyStore.read(study) as store:
        first = store.trials()[0]
    found = jumpcad.compare([f"{study}#1", "kenan-2.0"], load_workshop())
    assert found.robots[0].robot.design == first.design


@pytest.mark.thorough
@pytest.mark.usefixtures("checked_once")
def test_springs_from_stock_are_compared_by_the_stiffness_that_they_have() -> None:
    found = jumpcad.compare([built("kenan-2.0"), built("first-robot", "first-robot")])
    bought = load_workshop("first-robot").stock_spring
    assert bought is not None
    (row,) = [row for row in found.rows() if row[0] == "stiffness (N·mm/°)"]
    assert row[1:] == ["9.20", f"{2.0 * bought.rate_nmm_per_deg:.2f}"]
    assert found.differs["stiffness_nmm_per_deg"] == [9.2, None]
