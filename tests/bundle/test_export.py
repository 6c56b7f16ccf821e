"""A bundle is whole or not there, and the same bytes for the same robot."""

import hashlib
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from support.elsewhere import environment
from support.pictures import with_few_pictures
from support.places import ROOT, TESTS
from support.workshops import workshop_with

from jumpcad.bundle import export as bundle_module
from jumpcad.bundle.export import export
from jumpcad.bundle.manifest import Bundle, verify
from jumpcad.errors import JumpcadError
from jumpcad.robot.robot import Robot
from jumpcad.simulation import headline, uncertain


def exported(robot: Robot, folder: Path) -> Bundle:
    return export(robot, folder, pictures=False)


def bytes_of(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_manifest_knows_every_file(small_robot: Robot, tmp_path: Path) -> None:
    bundle = exported(small_robot, tmp_path / "deep" / "kenan")
    found = bytes_of(bundle.folder)
    manifest = json.loads(found.pop("manifest.json"))
    assert manifest["files"] == {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}
    assert manifest["mass_kg"] == small_robot.mass_kg
    assert verify(bundle.folder) == []
    assert bundle.urdf.is_file()


@pytest.mark.parametrize(("pad", "friction"), [("sj5616", 0.7), ("", 0.3)])
def test_the_manifest_says_on_which_ground_the_robot_stands_and_with_which_friction(
    small_robot: Robot, pad: str, friction: float
) -> None:
    """Its pads', or that of bare feet; the simulation of a bundle by another program needs it."""
    ground = {"surface": "dry oak", "pad": pad, "friction": 0.7, "bare_friction": 0.3}
    robot = replace(small_robot, workshop=workshop_with(small_robot.workshop, ground=ground))
    jump = headline(robot)
    assert bundle_module._facts(robot, jump)["ground"] == {"friction": friction, "pad": pad, "surface": "dry oak"}


@pytest.mark.thorough
def test_same_bytes_on_another_machine(small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With few pictures of jump and steps, and few jumps for its uncertainty."""
    with_few_pictures(monkeypatch)
    monkeypatch.setattr(uncertain, "AS_MADE", 16)
    monkeypatch.setattr(bundle_module, "uncertainty_of", uncertain.uncertainty_of)  # not one that is known
    export(small_robot, tmp_path / "here")
    code = (
        "from support.robots import make_small_robot; from jumpcad.bundle.export import export; import sys;"
        "from jumpcad.simulation import uncertain; uncertain.AS_MADE = 16;"
        "from support.pictures import with_few_pictures; import pytest; with_few_pictures(pytest.MonkeyPatch());"
        "export(make_small_robot(), sys.argv[1])"
    )
    paths = os.pathsep.join([str(TESTS), str(ROOT)])
    subprocess.run([sys.executable, "-c", code, str(tmp_path / "there")], check=True, env=environment(PYTHONPATH=paths))
    assert bytes_of(tmp_path / "here") == bytes_of(tmp_path / "there")


@pytest.mark.parametrize("name", ["", "../up", "a/b", ".hidden", "a\nb"])
def test_names_that_cannot_be_files_are_refused(name: str, small_robot: Robot, tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match="is used in file names"):
        exported(replace(small_robot, name=name), tmp_path / "b")
    assert list(tmp_path.iterdir()) == []
