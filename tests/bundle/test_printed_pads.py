"""Pads of printed TPU: a file for each, as heavy as it is drawn, a plate, and what the guide says of them."""

import io
import re
import zipfile
from functools import cache

import pytest
import trimesh
from support.workshops import workshop_with

from jumpcad import build, load_design, load_workshop
from jumpcad.building.bom import bill_of_facts, bill_of_materials, mass_facts
from jumpcad.bundle.guide.markdown import write_guide
from jumpcad.exporters.stl import stl_files
from jumpcad.exporters.threemf import plate_files, threemf_files
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop


@pytest.mark.thorough
def test_each_printed_pad_has_a_closed_file_of_its_mass() -> None:
    shop = load_workshop()
    printed = {"ground": {"pad": "tpu-2"}, "body": {"stop_pad": "tpu-2"}}
    data = shop.model_dump()
    robot = build(load_design("kenan-2.0"), Workshop(**(data | {key: data[key] | printed[key] for key in printed})))
    files = dict(stl_files(robot))
    pads = [item for item in robot.hardware if "_pad" in item.name]
    assert len(pads) == 5, "stop, two at the nose, two at the toes"
    for item in pads:
        mesh = trimesh.load(io.BytesIO(files[f"stl/{item.name}.stl"]), file_type="stl")
        assert mesh.is_watertight
        assert 1.22e-6 * mesh.volume == pytest.approx(item.mass_kg, rel=0.01)
        assert mesh.bounds[0, 2] == pytest.approx(0.0, abs=1e-6), "it lies on the bed"
        assert item.article == item.name


@cache
def soled() -> Robot:
    return build(load_design("kenan-2.0"), workshop_with(ground={"pad": "tpu-2"}), "kenan-2.0")


@pytest.mark.thorough
def test_printed_pads_have_a_plate_of_their_own() -> None:
    """As heavy as the robot's, of TPU of 1.22 g/cm³, filled solid; the plates of the parts are as without them."""
    robot = soled()
    files, plain = dict(threemf_files(robot)), dict(plate_files(robot.parts, robot.workshop))
    (new,) = set(files) - set(plain)
    assert new == "print/pads-1-tpu-2.3mf"
    assert [path for path in plain if path.endswith(".3mf") and plain[path] != files[path]] == []
    scene = trimesh.load(io.BytesIO(files[new]), file_type="3mf")
    names = {"nose_pad_left", "nose_pad_right", "toe_left_pad", "toe_right_pad"}
    assert set(scene.geometry) == names
    mass_kg = sum(item.mass_kg for item in robot.hardware if item.name in names)
    assert 1.22e-6 * sum(mesh.volume for mesh in scene.dump()) == pytest.approx(mass_kg, rel=0.01)
    with zipfile.ZipFile(io.BytesIO(files[new])) as package:
        settings = package.read("Metadata/Slic3r_PE.config").decode()
    assert "; fill_density = 100%\n" in settings
    assert "; filament_density = 1.22\n" in settings
    assert "start_gcode" not in settings
    said = files["print/README.md"].split("## pads-1-tpu-2.3mf\n\nTPU 95A: solid (100 % infill)")[1]
    assert all(f"- 1 × {name}\n" in said for name in names)
    assert "pads" not in plain["print/README.md"]


def test_the_guide_prints_and_glues_pads_and_does_not_order_them() -> None:
    robot = soled()
    order = write_guide(robot)["order.md"]
    printed, buy = order.split("## Print\n")[1].split("## Print settings\n")[0].split("## Buy\n")
    assert re.search(r"\|TPU 95A, 0\.[1-9] g\|nose_pad_left, nose_pad_right, toe_left_pad, toe_right_pad\|", printed)
    assert "TPU" not in buy
    assert "self-adhesive" in buy  # the stop's is cut
    bill = bill_of_materials(robot)
    assert bill.mass_kg == pytest.approx(robot.mass_kg)
    assert bill_of_facts(mass_facts(bill.items), robot.workshop, bill.used) == bill


@pytest.mark.thorough
def test_a_stop_is_printed_though_the_feet_are_cut() -> None:
    files = dict(stl_files(build(load_design("kenan-2.0"), workshop_with(body={"stop_pad": "tpu-2"}))))
    assert [name for name in files if "_pad" in name] == ["stl/stop_pad.stl"]
