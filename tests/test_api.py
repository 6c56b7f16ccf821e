"""The public function that writes a bundle; that designs are taken for robots is in `test_arguments.py`."""

from pathlib import Path

import pytest
from support.pictures import with_few_pictures

import jumpcad
from jumpcad import checks
from jumpcad.robot import Robot


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


def test_limits_that_are_kept_are_told_too(small_robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "CHECKS", tuple(check for check in checks.CHECKS if check.cheap))  # without solids
    found = jumpcad.check(small_robot)
    assert found == checks.check(small_robot)
    assert "info" in {finding.severity for finding in found}
