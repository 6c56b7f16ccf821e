"""Public functions that take a robot take a design too."""

from pathlib import Path

import pytest

import jumpcad
from jumpcad.robot import Robot


@pytest.mark.parametrize("name", ["simulate", "check"])
def test_a_design_is_built_where_a_robot_is_taken(name):
    design = jumpcad.load_design("kenan-2.0")
    function = getattr(jumpcad, name)
    assert repr(function(design)) == repr(function(jumpcad.build(design)))


@pytest.mark.parametrize("pictures", [True, False])
def test_a_bundle_has_pictures_and_step_files_as_it_is_told(small_robot: Robot, tmp_path: Path, pictures: bool) -> None:
    bundle = jumpcad.export(small_robot, tmp_path / "bundle", pictures=pictures, step=False)
    suffixes = {Path(name).suffix for name in bundle.files}
    assert (".png" in suffixes) == pictures
    assert ".step" not in suffixes
