"""STEP files read back: volume, box, faces, one valid solid."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.places import ROOT, TESTS
from support.stacks import HOLED

from jumpcad.bundle.export import export
from jumpcad.bundle.manifest import verify
from jumpcad.errors import JumpcadError
from jumpcad.exporters import step
from jumpcad.exporters.step import Arc, Circle, Curve, Line, curves_of
from jumpcad.parts.part import Drawing
from jumpcad.robot.robot import Robot
from jumpcad.solids.blocks import Blocks, Finger
from jumpcad.solids.outline import disc, hole, rectangle, stadium, text
from jumpcad.solids.stack import Stack

needs_step = pytest.mark.skipif(not step.is_installed(), reason='build123d is not installed: pip install ".[step]"')


def drawn(shape: Stack | Blocks, name: str = "plate") -> Drawing:
    return Drawing(name, "body", shape, ())


def read(data: bytes, folder: Path):
    """Return the one solid of a STEP file."""
    from build123d import import_step

    (folder / "part.step").write_bytes(data)
    (solid,) = import_step(folder / "part.step").solids()
    assert solid.is_valid
    return solid


@needs_step
def test_outlines_become_planes_and_true_cylinders(tmp_path: Path) -> None:
    solid = read(step.write_step(drawn(HOLED)), tmp_path)
    volume = 3.0 * (40.0 * 30.0 - math.pi * 1.7**2) + 6.0 * math.pi * 6.0**2
    assert solid.volume == pytest.approx(volume, rel=1e-5)
    kinds = sorted(face.geom_type.name for face in solid.faces())
    assert kinds == ["CYLINDER"] * 2 + ["PLANE"] * 7
    radii = sorted(face.radius for face in solid.faces() if face.geom_type.name == "CYLINDER")
    assert radii == pytest.approx([1.7, 6.0], abs=1e-4)
    box = solid.bounding_box()
    assert [*box.min, *box.max] == pytest.approx([-15.0, -15.0, 0.0, 25.0, 15.0, 9.0], abs=1e-4)


@needs_step
def test_a_part_that_is_no_stack_keeps_its_facets(tmp_path: Path) -> None:
    toe = drawn(Blocks((Finger(np.array([0.0, 8.0]), 7.0, 7.5, np.array([-70.0, 60.0]), 5.0, 4.5),)), "toe")
    solid = read(step.write_step(toe), tmp_path)
    assert solid.volume == pytest.approx(toe.mesh.volume, rel=1e-6)
    assert {face.geom_type.name for face in solid.faces()} == {"PLANE"}
    assert len(solid.faces()) < len(toe.mesh.faces)


@needs_step
def test_parts_of_a_bundle_keep_volume_and_box(small_robot: Robot, tmp_path: Path) -> None:
    bundle = export(small_robot, tmp_path / "b", pictures=False, step=True)
    assert verify(bundle.folder) == []
    for part in small_robot.parts:
        text = (bundle.folder / "step" / f"{part.name}.step").read_bytes()
        assert f"PRODUCT('{part.name}'".encode() in text
        solid = read(text, tmp_path)
        assert solid.volume == pytest.approx(part.mesh.volume, rel=5e-3)  # circles are rounder than polygons
        box = solid.bounding_box()
        np.testing.assert_allclose([[*box.min], [*box.max]], part.mesh.bounds, atol=5e-3)


@needs_step
def test_engraved_plates_close(tmp_path: Path) -> None:
    """The letters' many small faces are the hardest."""
    label = text("jump 8", 8.0).translate((-20.0, -4.0))
    plate = drawn(Stack.of([(0, 3, rectangle((60, 20)))]).minus([(2.6, 3, label)]))
    solid = read(step.write_step(plate), tmp_path)
    assert solid.volume == pytest.approx(plate.mesh.volume, rel=1e-3)
    assert len(solid.faces()) < len(plate.mesh.faces) / 3


@pytest.mark.thorough
@needs_step
def test_the_same_bytes_in_another_process(tmp_path: Path) -> None:
    here = step.write_step(drawn(HOLED))
    code = (
        "import sys; from pathlib import Path; from support.stacks import HOLED\n"
        "from jumpcad.exporters.step import write_step; from jumpcad.parts.part import Drawing\n"
        "other, plate = (write_step(Drawing(name, 'body', HOLED, ())) for name in ('other', 'plate'))\n"
        "Path(sys.argv[1]).write_bytes(plate)"
    )
    paths = os.pathsep.join([str(TESTS), str(ROOT)])
    subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "there.step")], check=True, env=os.environ | {"PYTHONPATH": paths}
    )
    assert (tmp_path / "there.step").read_bytes() == here == step.write_step(drawn(HOLED))


def test_a_missing_library_is_named_before_anything_is_written(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(step, "find_spec", lambda name: None)
    with pytest.raises(
        JumpcadError, match=r'STEP needs build123d, which is not installed: pip install "jumpcad\[step\]"'
    ):
        export(small_robot, tmp_path / "b", pictures=False, step=True)
    assert list(tmp_path.iterdir()) == []


def radius(arc: Arc) -> float:
    """Return the radius of an arc from its sides and Heron's formula."""
    a, b, c = (math.dist(*pair) for pair in ((arc.start, arc.middle), (arc.middle, arc.end), (arc.end, arc.start)))
    s = (a + b + c) / 2.0
    return a * b * c / (4.0 * math.sqrt(s * (s - a) * (s - b) * (s - c)))


def ends(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    assert not isinstance(curve, Circle)
    return curve.start, curve.end


@pytest.mark.parametrize("diameter", [1.6, 3.2, 22.0, 180.0])
def test_discs_and_holes_have_the_diameter_that_was_asked_for(diameter: float) -> None:
    place = (12.345, -6.789)
    region = rectangle((400.0, 400.0)) - hole(diameter, place)
    (outer,) = map(curves_of, disc(diameter, place).to_polygons())
    assert [type(curve) for curve in outer] == [Circle]
    inner = next(curves for curves in map(curves_of, region.to_polygons()) if isinstance(curves[0], Circle))
    for (circle,) in (outer, inner):
        assert isinstance(circle, Circle)
        assert 2.0 * circle.radius_mm == pytest.approx(diameter, abs=2e-4)
    assert outer[0].centre == pytest.approx(place, abs=1e-4)


def test_a_bar_with_round_ends_is_two_lines_and_two_arcs() -> None:
    (contour,) = stadium((0.0, 0.0), (40.0, 15.0), 9.0).to_polygons()
    curves = curves_of(contour)
    assert sorted(type(curve).__name__ for curve in curves) == ["Arc", "Arc", "Line", "Line"]
    assert [radius(curve) for curve in curves if isinstance(curve, Arc)] == pytest.approx([4.5, 4.5], abs=1e-3)
    lines = [math.dist(*ends(curve)) for curve in curves if isinstance(curve, Line)]
    assert lines == pytest.approx([math.hypot(40.0, 15.0)] * 2, abs=0.5)  # to within a side of the arcs
