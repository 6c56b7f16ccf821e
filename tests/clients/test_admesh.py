"""ADMesh finds nothing to repair in any STL file; it always exits with 0, so its report is read."""

import re

import numpy as np
import pytest
from support.clients import Case, run

REPAIRS = (
    "Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
    "Normals fixed",
)  # fmt: skip


def test_every_part_is_closed_and_as_large_as_meant(case: Case) -> None:
    for part in case.robot.parts:
        said = run("admesh", case.bundle.folder / "stl" / f"{part.name}.stl")
        numbers = {key.strip(): float(value) for key, value in re.findall(r"([A-Z][\w ]+?)\s*:\s*(-?[\d.]+)", said)}
        assert {key: numbers[key] for key in REPAIRS} == dict.fromkeys(REPAIRS, 0.0), part.name
        assert numbers["Number of parts"] == 1
        assert numbers["Volume"] == pytest.approx(part.mesh.volume, rel=1e-4)
        bounds = re.findall(r"Min ([XYZ]) =\s*(-?[\d.]+), Max [XYZ] =\s*(-?[\d.]+)", said)
        read = np.array([[float(low), float(high)] for _, low, high in bounds]).T
        assert np.allclose(read, part.mesh.bounds, atol=1e-4)
