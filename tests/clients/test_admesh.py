"""ADMesh finds nothing to repair in any STL file; it always exits with 0, so its report is read.

Normals are compared here: ADMesh computes them in single precision, too coarse for facets less than 1 µm high.
"""

import re

import numpy as np
import pytest
from support.clients import Case, run

REPAIRS = (
    "Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
)  # fmt: skip
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""Of a binary STL file, after a header of 80 bytes and the number of facets (4 bytes)."""


def test_every_part_is_closed_and_as_large_as_meant(case: Case) -> None:
    for part in case.robot.parts:
        path = case.bundle.folder / "stl" / f"{part.name}.stl"
        said = run("admesh", path)
        numbers = {key.strip(): float(value) for key, value in re.findall(r"([A-Z][\w ]+?)\s*:\s*(-?[\d.]+)", said)}
        assert {key: numbers[key] for key in REPAIRS} == dict.fromkeys(REPAIRS, 0.0), part.name
        assert numbers["Number of parts"] == 1
        assert numbers["Volume"] == pytest.approx(part.mesh.volume, rel=1e-4)
        bounds = re.findall(r"Min ([XYZ]) =\s*(-?[\d.]+), Max [XYZ] =\s*(-?[\d.]+)", said)
        read = np.array([[float(low), float(high)] for _, low, high in bounds]).T
        assert np.allclose(read, part.mesh.bounds, atol=1e-4)


def test_normals_are_those_of_the_written_corners(case: Case) -> None:
    for path in (case.bundle.folder / "stl").glob("*.stl"):
        facets = np.frombuffer(path.read_bytes()[84:], dtype=FACET)
        first, second, third = facets["corners"].astype(float).transpose(1, 0, 2)
        normals = np.cross(second - first, third - first)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        np.testing.assert_allclose(facets["normal"], normals, atol=1e-6, err_msg=path.name)
