"""The public function that writes a bundle; that designs are taken for robots is in `test_arguments.py`."""

import math
from pathlib import Path
from typing import Any

import pytest
from support.pictures import with_few_pictures

import jumpcad
from jumpcad import checks
from jumpcad.errors import JumpcadError
from jumpcad.robot.robot import Robot
from jumpcad.search.models import robot_model


@pytest.mark.thorough
def test_a_bundle_has_pictures_and_no_step_files_unless_it_is_told_otherwise(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_few_pictures(monkeypatch)
    monkeypatch.setattr("jumpcad.bundle.export.uncertainty_of", lambda _: None)
    for folder, pictures in (("with", True), ("without", False)):
        bundle = jumpcad.export(small_robot, tmp_path / folder, pictures=pictures, step=False)
        suffixes = {Path(name).suffix for name in bundle.files}
        assert (".png" in suffixes) == pictures
        assert ".step" not in suffixes


def test_a_robot_jumps_in_the_engine_and_with_the_settings_that_are_asked_for() -> None:
    robot, moon = jumpcad.capsule_robot(jumpcad.load_design("kenan-2.0")), jumpcad.Settings(gravity_m_s2=1.62)
    here, there = (jumpcad.simulate(robot, settings, "planar") for settings in (None, moon))
    assert (here.engine, there.engine) == ("planar", "planar")
    assert there.com_rise_m > 4.0 * here.com_rise_m


def test_limits_that_are_kept_are_told_too(small_robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))  # without solids
    found = jumpcad.check(small_robot)
    assert found == checks.check(small_robot)
    assert "info" in {finding.severity for finding in found}


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"dt_s": -1.0}, "dt_s"), ({"gravity_m_s2": 0.0}, "gravity_m_s2"),
        ({"ground_friction": -1.0}, "ground_friction"),
        ({"dt_s": math.nan}, "dt_s"), ({"spring_efficiency": -1.0}, "spring_efficiency"),
    ],
)  # fmt: skip
def test_settings_changed_to_what_they_cannot_be_are_refused(wrong: dict[str, float], said: str) -> None:
    """`model_copy` of pydantic checks nothing."""
    settings = jumpcad.load_settings("default").model_copy(update=wrong)
    design = jumpcad.load_design("kenan-2.0")
    calls = [
        lambda: jumpcad.simulate(jumpcad.capsule_robot(design), settings),
        lambda: jumpcad.evaluate(design, settings=settings),
        lambda: jumpcad.optimize(settings=settings, evaluations=8),
        lambda: robot_model("capsule", settings=settings),  # before a study is opened
    ]
    for call in calls:
        with pytest.raises(JumpcadError, match=said):
            call()


@pytest.mark.parametrize("length", ["a", -5.0, math.nan])
def test_designs_changed_to_what_they_cannot_be_are_refused(length: Any) -> None:
    design = jumpcad.load_design("kenan-2.0").model_copy(update={"carrying_link_mm": length})
    for call in (jumpcad.build, jumpcad.capsule_robot, jumpcad.evaluate):
        with pytest.raises(JumpcadError, match="carrying_link_mm"):
            call(design)
