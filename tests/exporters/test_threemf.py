"""3MF files: the package, and the geometry read again with nothing but the standard."""

import io
import re
import zipfile
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from jumpcad.exporters.threemf import write_threemf
from jumpcad.printing.plates import packed

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


@dataclass(frozen=True)
class Part:
    name: str
    mesh: trimesh.Trimesh
    material: str = "PETG"
    quantity: int = 1


@pytest.fixture(scope="module")
def plate():
    parts = [
        Part("leg & lever", trimesh.creation.box((100, 12, 6))),
        Part("gear", trimesh.creation.cylinder(10, 5), quantity=2),
    ]
    (only,) = packed(parts, (180.0, 180.0, 180.0), 5.0)
    return only


@pytest.fixture(scope="module")
def model(plate):
    with zipfile.ZipFile(io.BytesIO(write_threemf(plate))) as package:
        assert package.testzip() is None
        return ElementTree.fromstring(package.read("3D/3dmodel.model"))


def test_parts_are_named_objects_in_millimetres_and_copies_are_items(model):
    assert model.get("unit") == "millimeter"
    names = {o.get("id"): o.get("name") for o in model.iter(f"{CORE}object")}
    assert sorted(names.values()) == ["gear", "leg & lever"]
    assert sorted(names[item.get("objectid")] for item in model.iter(f"{CORE}item")) == ["gear", "gear", "leg & lever"]


def test_items_lie_where_they_were_packed(model, plate):
    points = {}
    for item in model.iter(f"{CORE}object"):
        corners = [[float(v.get(axis)) for axis in "xyz"] for v in item.iter(f"{CORE}vertex")]
        points[item.get("id")] = np.array(corners)
    for item, placed in zip(model.iter(f"{CORE}item"), plate.items, strict=True):
        matrix = np.array([float(value) for value in item.get("transform").split()]).reshape(4, 3)
        found = points[item.get("objectid")] @ matrix[:3] + matrix[3]
        expected = trimesh.transform_points(placed.part.mesh.vertices, placed.T_bed_part)
        np.testing.assert_allclose(found, expected, atol=1e-5)


def test_the_same_plate_gives_the_same_bytes_without_a_date(plate):
    data = write_threemf(plate)
    assert data == write_threemf(plate)
    with zipfile.ZipFile(io.BytesIO(data)) as package:
        assert {entry.date_time for entry in package.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert not re.search(rb"20\d\d-\d\d-\d\d", package.read("3D/3dmodel.model"))
