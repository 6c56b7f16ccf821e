"""A strict 3MF reader reports nothing about our plates, and reads the same parts."""

from dataclasses import dataclass

import trimesh
from support import needs

from jumpcad.exporters.threemf import write_threemf
from jumpcad.parts.plates import packed
from jumpcad.solids.outline import hole, ring, stadium
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import to_trimesh

lib3mf = needs.package("lib3mf")

SETTINGS, PICTURE = {"perimeters": "3"}, b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Part:
    name: str
    mesh: trimesh.Trimesh
    quantity: int
    material: str = "PETG"


def test_the_strict_reader_accepts_a_plate_without_a_warning():
    link = Stack.of([(0, 6, stadium((0, 0), (100, 0), 10.0))]).through(hole(3.4), hole(3.4, (100, 0)))
    parts = [
        Part("main leg", to_trimesh(link.chamfered(0.35, 0.2).solid()), 1),
        Part("spacer", to_trimesh(Stack.of([(0, 4, ring(7.0, 3.4))]).solid()), 3),
    ]
    (plate,) = packed(parts, (180.0, 180.0, 180.0), 5.0)
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromBuffer(write_threemf(plate, SETTINGS, PICTURE))
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    assert model.GetBuildItems().Count() == 4
    found = {}
    objects = model.GetMeshObjects()
    while objects.MoveNext():
        mesh = objects.GetCurrentMeshObject()
        assert mesh.IsManifoldAndOriented()
        found[mesh.GetName()] = mesh.GetTriangleCount()
    assert found == {part.name: len(part.mesh.faces) for part in parts}
    box = model.GetOutbox()
    assert all(low >= -1e-3 for low in box.MinCoordinate)
    assert all(high <= 180.0 for high in box.MaxCoordinate)
