"""Every part as its file is read again: one closed piece on the bed that prints without support."""

import numpy as np
import pytest
import shapely
from manifold3d import Manifold, Mesh
from support.built import LONG_TOES, built, geared

from jumpcad.robot.robot import Robot
from jumpcad.solids.stl import faults, write_stl

FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""Of a binary STL file, after a header of 80 bytes and the number of facets (4 bytes)."""
LAYER_MM = 0.2
BRIDGE_MM, LINES_MM = 10.0, 0.9
"""What holds without support: a bridge between two sides, and two lines beyond an edge."""


def robot_called(name: str) -> Robot:
    return {"geared": geared, "fine": lambda: built("best-bo", "fine")}.get(name, lambda: built(name))()


@pytest.mark.parametrize("name", ["kenan-2.0", "best-bo", LONG_TOES, "geared", "fine"])
def test_files_are_closed_parts_on_the_bed(name: str) -> None:
    for part in robot_called(name).parts:
        stl = write_stl(part.mesh)
        assert faults(stl) == [], part.name
        corners = np.frombuffer(stl[84:], FACET)["corners"].astype(float)
        assert corners[..., 2].min() == pytest.approx(0.0, abs=1e-6), part.name
        volume = np.linalg.det(corners).sum() / 6.0
        assert volume == pytest.approx(part.solid.volume(), rel=1e-5), part.name


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("name", "of"), [("kenan-2.0", ""), (LONG_TOES, "foot toe_left"), ("geared", "idler cam_gear")], ids=str
)
def test_parts_print_without_support(name: str, of: str) -> None:
    """What reaches beyond the layer below at more than 45° is a short bridge or a ledge of two lines."""
    for part in robot_called(name).parts:
        if of and part.name not in of.split():
            continue
        mesh = part.mesh
        solid = Manifold(Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)))
        assert solid.volume() == pytest.approx(mesh.volume, rel=1e-4)
        below = None
        for z in np.arange(LAYER_MM / 2, mesh.bounds[1, 2], LAYER_MM):
            layer = section(solid, z + 1e-4)
            if below is not None:
                hanging = layer.difference(below.buffer(LAYER_MM + 0.02))
                for piece in getattr(hanging, "geoms", [hanging]):
                    if piece.area < 0.05:
                        continue
                    sides = np.hypot(*np.diff(np.array(piece.minimum_rotated_rectangle.exterior.coords), axis=0).T)
                    ledge = piece.difference(below.buffer(LINES_MM)).area < 0.05
                    held = not isinstance(piece.buffer(0.3).intersection(below), shapely.Polygon)
                    assert ledge or (held and min(sides) <= BRIDGE_MM) or rounds_over(piece, below), (part.name, z)
            below = layer


def section(solid: Manifold, z_mm: float) -> shapely.Geometry:
    """Return the area of a solid at a height: what lies within an odd number of rings."""
    rings = [shapely.LinearRing(ring) for ring in solid.slice(z_mm).to_polygons()]
    return shapely.build_area(shapely.geometrycollections(rings))


def rounds_over(piece: shapely.Polygon, below: shapely.Geometry) -> bool:
    """Tell whether a piece spans a hole: it is held all the way around."""
    return bool(below.buffer(0.3).convex_hull.contains(piece)) and len(piece.interiors) > 0
