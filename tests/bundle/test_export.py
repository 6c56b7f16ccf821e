"""A bundle is whole or not there, and the same bytes for the same robot."""

import hashlib
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.elsewhere import environment
from support.pictures import with_few_pictures
from support.places import ROOT, TESTS

from jumpcad.bundle import export as bundle_module
from jumpcad.bundle import uncertainty
from jumpcad.bundle.export import export
from jumpcad.bundle.manifest import Bundle, verify
from jumpcad.errors import JumpcadError
from jumpcad.robot import Robot


def exported(robot: Robot, folder: Path) -> Bundle:
    return export(robot, folder, pictures=False)


def bytes_of(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_folder_that_takes_no_files_is_told_before_any_is_made(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[object] = []
    monkeypatch.setattr(bundle_module, "contents", lambda *_: made.append(1) or ())
    (tmp_path / "file").write_text("a user's")
    with pytest.raises(JumpcadError, match=r"no file can be made in .*file"):
        exported(small_robot, tmp_path / "file" / "kenan")
    assert not made
    assert (tmp_path / "file").read_text() == "a user's"


def test_manifest_knows_every_file(small_robot: Robot, tmp_path: Path) -> None:
    bundle = exported(small_robot, tmp_path / "deep" / "kenan")
    found = bytes_of(bundle.folder)
    manifest = json.loads(found.pop("manifest.json"))
    assert manifest["files"] == {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}
    assert manifest["mass_kg"] == small_robot.mass_kg
    assert verify(bundle.folder) == []
    assert bundle.urdf.is_file()


def test_masses_in_the_manifest_add_up(small_robot: Robot, tmp_path: Path) -> None:
    manifest = exported(small_robot, tmp_path / "b").manifest
    lines = sum(line["quantity"] * line["mass_kg"] for line in manifest["masses"])
    bodies = sum(body["mass_kg"] for body in manifest["bodies"].values())
    assert lines == pytest.approx(manifest["mass_kg"], rel=1e-12)
    assert bodies == pytest.approx(manifest["mass_kg"], rel=1e-12)
    assert {line["source"] for line in manifest["masses"]} == {"solid", "catalogue"}


@pytest.mark.parametrize(("pad", "friction"), [("sj5616", 0.7), ("", 0.3)])
def test_the_manifest_says_on_which_ground_the_robot_stands_and_with_which_friction(
    small_robot: Robot, pad: str, friction: float
) -> None:
    """Its pads', or that of bare feet; the simulation of a bundle by another program needs it."""
    changed = {"surface": "dry oak", "pad": pad, "friction": 0.7, "bare_friction": 0.3}
    ground = small_robot.workshop.ground.model_copy(update=changed)
    robot = replace(small_robot, workshop=small_robot.workshop.model_copy(update={"ground": ground}))
    assert bundle_module._facts(robot)["ground"] == {"friction": friction, "pad": pad, "surface": "dry oak"}


@pytest.mark.parametrize(("step", "ros2"), [(False, False), (True, False), (False, True), (True, True)])
def test_formats_are_written_on_request_each_by_its_own_option(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: bool, ros2: bool
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(bundle_module, "chosen", lambda names: asked.extend(names) or [])
    monkeypatch.setattr(bundle_module, "write_folder", lambda *_: None)
    export(small_robot, tmp_path / "b", step=step, ros2=ros2)
    assert asked == ["step"] * step + ["ros2"] * ros2


def test_a_bundle_with_pictures_shows_them_in_its_guide(small_robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """By their names, and on the guide's page with the drawings, as the files that are written."""
    told: dict[str, object] = {}
    monkeypatch.setattr(bundle_module, "jump_motion", lambda robot: None)
    monkeypatch.setattr(bundle_module, "all_pictures", lambda robot: {"rest": b"r", "step-1": b"1"})
    monkeypatch.setattr(bundle_module, "drawings_of", lambda robot: {"wiring.svg": "<svg/>", "soldering.svg": ""})
    monkeypatch.setattr(bundle_module, "write_guide", lambda robot, names=(): told.update(names=names) or "guide")
    monkeypatch.setattr(bundle_module, "write_page", lambda guide, name, files: told.update(files=files) or "page")
    seen: dict[str, bytes] = {}
    written = dict(bundle_module._files_before_report(small_robot, [], True, seen))
    assert list(seen) == told["names"] == ["rest", "step-1"]
    shown = {"pictures/rest.png": b"r", "pictures/step-1.png": b"1", "wiring.svg": b"<svg/>"}
    assert told["files"] == shown
    assert {path for path in written if path.endswith((".png", ".svg")) and "order/" not in path} == set(shown)
    assert (written["assembly.md"], written["assembly.html"]) == ("guide", "page")


def test_the_manifest_has_every_body_with_its_mass_centre_and_inertia(small_robot: Robot) -> None:
    bodies = bundle_module._facts(small_robot)["bodies"]
    assert bodies == {
        name: {"mass_kg": body.mass_kg, "com_m": [*body.com_m], "inertia_kg_m2": [[*row] for row in body.inertia_kg_m2]}
        for name, body in small_robot.bodies.items()
    }


@pytest.mark.parametrize("jumps", [True, False])
def test_only_of_a_jump_it_is_said_how_sure_it_is(
    small_robot: Robot, monkeypatch: pytest.MonkeyPatch, jumps: bool
) -> None:
    """And with the motion alone, which needs the robot's GLB file and its recorded trajectory."""
    jump, asked, sure = SimpleNamespace(verdict="jump" if jumps else "tips"), [], object()
    monkeypatch.setattr(bundle_module, "simulate", lambda robot, settings, engine: asked.append(settings) or jump)
    monkeypatch.setattr(bundle_module, "uncertainty_of", lambda robot: sure)
    monkeypatch.setattr(bundle_module, "write_report", lambda robot, pictures, jump, glb, files, sure: sure)
    assert bundle_module._page(small_robot, {}, b"glb", []) is (sure if jumps else None)
    assert bundle_module._page(small_robot, {}, None, []) is None
    shown: list[object] = []
    monkeypatch.setattr(bundle_module, "write_report", lambda robot, *rest: shown.extend(rest))
    bundle_module._page(small_robot, {"step-1": b"1", "exploded": b"e", "rest": b"r"}, None, iter(["bom.csv"]))
    assert shown == [{"rest": b"r", "exploded": b"e"}, jump, None, ("bom.csv",), None]  # no steps of the assembly
    del asked[2:]
    assert [(one.flight, one.trajectory) for one in asked] == [("simulated", True), ("simulated", False)]


@pytest.mark.thorough
def test_same_bytes_on_another_machine(small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With few pictures of jump and steps, and few jumps for its uncertainty."""
    with_few_pictures(monkeypatch)
    monkeypatch.setattr(uncertainty, "JUMPS", 16)
    monkeypatch.setattr(bundle_module, "uncertainty_of", uncertainty.uncertainty_of)  # not one that is known
    export(small_robot, tmp_path / "here")
    code = (
        "from support.robots import make_small_robot; from jumpcad.bundle.export import export; import sys;"
        "from jumpcad.bundle import uncertainty; uncertainty.JUMPS = 16;"
        "from support.pictures import with_few_pictures; import pytest; with_few_pictures(pytest.MonkeyPatch());"
        "export(make_small_robot(), sys.argv[1])"
    )
    paths = os.pathsep.join([str(TESTS), str(ROOT)])
    subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "there")],
        check=True,
        env=environment(PYTHONPATH=paths),
    )
    assert bytes_of(tmp_path / "here") == bytes_of(tmp_path / "there")


def test_a_build_that_breaks_leaves_the_old_bundle(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "b"
    exported(small_robot, folder)
    before = bytes_of(tmp_path)
    whole = Path.write_bytes

    def full_disk(self: Path, data: bytes) -> int:
        if self.suffix == ".glb":
            raise OSError(28, "No space left on device")
        return whole(self, data)

    monkeypatch.setattr(bundle_module.Path, "write_bytes", full_disk)
    with pytest.raises(JumpcadError, match="No space left on device"):
        exported(small_robot, folder)
    monkeypatch.undo()
    assert bytes_of(tmp_path) == before


@pytest.mark.parametrize("name", ["", "../up", "a/b", ".hidden", "a\nb"])
def test_names_that_cannot_be_files_are_refused(name: str, small_robot: Robot, tmp_path: Path) -> None:
    with pytest.raises(JumpcadError, match="is used in file names"):
        exported(replace(small_robot, name=name), tmp_path / "b")
    assert list(tmp_path.iterdir()) == []
