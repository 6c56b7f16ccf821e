"""3MF files: the package, and the geometry read again with nothing but the standard."""

import io
import re
import zipfile
from dataclasses import dataclass
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from jumpcad.exporters.threemf import _in_words, write_threemf
from jumpcad.parts.plates import packed
from jumpcad.workshop import load_workshop

SETTINGS, PICTURE = {"perimeters": "3", "fill_density": "40%"}, b"\x89PNG"
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


@dataclass(frozen=True)
class Part:
    name: str
    mesh: trimesh.Trimesh
    material: str = "PETG"
    quantity: int = 1

    @property
    def shown_mesh(self):
        return self.mesh


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
    with zipfile.ZipFile(io.BytesIO(write_threemf(plate, SETTINGS, PICTURE))) as package:
        assert package.testzip() is None
        return ElementTree.fromstring(package.read("3D/3dmodel.model"))


def test_parts_are_named_objects_in_millimetres_and_copies_are_items(model):
    assert model.get("unit") == "millimeter"
    said = {one.get("name"): one.text for one in model.iter(f"{CORE}metadata")}
    assert said == {"Title": "plate-1-PETG", "Application": "jumpcad"}
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


def test_triangles_face_outwards(model, plate):
    """Counter-clockwise from outside, as the standard asks: the volume that they enclose is positive, the part's."""
    meshes = {placed.part.name: placed.part.mesh for placed in plate.items}
    for item in model.iter(f"{CORE}object"):
        corners = np.array([[float(v.get(axis)) for axis in "xyz"] for v in item.iter(f"{CORE}vertex")])
        faces = np.array([[int(t.get(name)) for name in ("v1", "v2", "v3")] for t in item.iter(f"{CORE}triangle")])
        a, b, c = corners[faces].transpose(1, 0, 2)
        volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
        assert volume == pytest.approx(meshes[item.get("name")].volume, rel=1e-4)
        assert volume > 0.0


def test_the_picture_and_the_settings_are_where_slicers_look_for_them(plate):
    """Open Packaging Conventions: a relationship names the thumbnail, and every suffix has a content type."""
    with zipfile.ZipFile(io.BytesIO(write_threemf(plate, SETTINGS, PICTURE))) as package:
        related = ElementTree.fromstring(package.read("_rels/.rels"))
        (target,) = [one.get("Target") for one in related if one.get("Type").endswith("/metadata/thumbnail")]
        assert package.read(target.lstrip("/")) == PICTURE
        assert package.read("Metadata/Slic3r_PE.config") == b"; perimeters = 3\n; fill_density = 40%\n"
        types = ElementTree.fromstring(package.read("[Content_Types].xml"))
        suffixes = {name.rsplit(".", 1)[1] for name in package.namelist() if not name.startswith("[")}
        assert suffixes <= {one.get("Extension") for one in types}


def test_each_plate_has_the_heat_of_its_own_material(plate):
    """Temperatures that the workshop does not know are the user's to enter."""
    shop = load_workshop("default")
    petg = shop.materials["PETG"]
    heats = {"cold": (190.0, 50.0), "hot": (260.0, 100.0), "mine": (None, None)}
    materials = {
        name: petg.model_copy(update={"nozzle_c": nozzle, "bed_c": bed}) for name, (nozzle, bed) in heats.items()
    }
    plates = [SimpleNamespace(name=f"plate-{name}", material=name, items=plate.items) for name in heats]
    said = _in_words(plates, shop.model_copy(update={"materials": materials}))
    assert "## plate-cold.3mf\n\ncold: nozzle 190 °C, bed 50 °C\n" in said
    assert "## plate-hot.3mf\n\nhot: nozzle 260 °C, bed 100 °C\n" in said
    assert "## plate-mine.3mf\n\nmine: no temperatures in the workshop" in said


def test_the_same_plate_gives_the_same_bytes_without_a_date(plate):
    data = write_threemf(plate, SETTINGS, PICTURE)
    assert data == write_threemf(plate, SETTINGS, PICTURE)
    with zipfile.ZipFile(io.BytesIO(data)) as package:
        assert {entry.date_time for entry in package.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert {entry.external_attr >> 16 for entry in package.infolist()} == {0o644}  # unpacked, all may read them
        assert not re.search(rb"20\d\d-\d\d-\d\d", package.read("3D/3dmodel.model"))
