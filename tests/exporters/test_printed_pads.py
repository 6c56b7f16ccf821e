"""Pads of printed TPU: a file for each, as heavy as it is drawn."""

import io

import pytest
import trimesh

from jumpcad import build, load_design, load_workshop
from jumpcad.exporters.stl import stl_files
from jumpcad.workshop import Workshop


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
        assert f"{item.name}.stl" in item.article


def test_a_stop_is_printed_though_the_feet_are_cut() -> None:
    shop = load_workshop()
    body = shop.body.model_copy(update={"stop_pad": "tpu-2"})
    files = dict(stl_files(build(load_design("kenan-2.0"), shop.model_copy(update={"body": body}))))
    assert [name for name in files if "_pad" in name] == ["stl/stop_pad.stl"]


def test_pads_that_are_cut_have_none() -> None:
    files = dict(stl_files(build(load_design("kenan-2.0"))))
    assert not [name for name in files if "_pad" in name]
