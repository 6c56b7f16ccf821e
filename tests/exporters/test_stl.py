"""STL files: every printed part once, in its printing orientation; none that is not closed."""

import io
from dataclasses import replace

import pytest
import trimesh

from jumpcad.errors import CannotBuildError
from jumpcad.exporters.stl import stl_files
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import disc
from jumpcad.solids.stack import Stack


def test_every_part_has_one_file_of_its_volume(small_robot: Robot) -> None:
    files = dict(stl_files(small_robot))
    assert list(files) == [f"stl/{part.name}.stl" for part in small_robot.parts]
    for part in small_robot.parts:
        read = trimesh.load_mesh(io.BytesIO(files[f"stl/{part.name}.stl"]), file_type="stl")
        assert read.is_watertight
        assert read.volume == pytest.approx(part.mesh.volume, rel=1e-5)
        assert read.bounds == pytest.approx(part.mesh.bounds, abs=1e-4)


def test_a_part_in_two_pieces_is_refused_by_its_name(small_robot: Robot) -> None:
    part = small_robot.parts[0]
    apart = Stack.of([(0.0, 3.0, disc(5.0) + disc(5.0, (20.0, 0.0)))])
    broken = replace(part, shape=apart)
    with pytest.raises(CannotBuildError, match=f"part {part.name} cannot be printed: it is 2 pieces"):
        list(stl_files(replace(small_robot, parts=(broken,))))
