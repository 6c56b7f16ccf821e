"""A bundle's parts as a slicer weighs them and as the mass model does."""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import trimesh
from support.slicers import OBEDIENT, pretend_slicer, three_parts
from support.workshops import workshop_with

from jumpcad.bundle import sliced
from jumpcad.bundle.atomic_write import write_folder
from jumpcad.bundle.export import export
from jumpcad.bundle.sliced import SlicedBundle, SlicedPart, _modelled_grams, _StlPart, slice_bundle, write_times
from jumpcad.errors import JumpcadError
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop


def test_the_model_weighs_the_same_from_a_file_as_from_a_drawing(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a workshop that is equal to the bundle's, whose times belong in its bill; plates alone lose a setting."""
    tamper = 'settings |= {"perimeters": "9"} if arguments[-1].endswith(".3mf") else {}'
    pretend_slicer(OBEDIENT.replace("TAMPER", tamper), tmp_path, monkeypatch)
    made = export(three_parts(small_robot), tmp_path / "frog", pictures=False)
    found = slice_bundle(made.folder, load_workshop("default"))
    assert found.billed
    assert found.ignored == {"perimeters": (str(found.workshop.process.perimeters), "9")}
    assert write_times(found).manifest["versions"] == made.manifest["versions"] | {"PrusaSlicer": "2.9.1"}
    files = {f"print/{plate.name}.3mf" for plate in found.plates}
    assert files == {name for name in found.bundle.files if re.fullmatch(r"print/.*\.3mf", name)}
    assert all(plate.name.endswith(f"-{plate.material}") for plate in found.plates)
    parts = {part.name: part for part in small_robot.parts}
    for part in found.parts:
        density = found.workshop.materials[part.material].density_g_cm3
        shape, printer = parts[part.name].shape, found.workshop.printer
        drawn = mass_properties(shape, density, found.workshop.process, printer.nozzle_mm).mass_kg
        assert part.modelled_grams == pytest.approx(1000.0 * drawn, rel=2e-3)


def test_plates_of_printed_pads_are_left_out() -> None:
    """They are of a filament that the workshop's slicer settings do not know."""
    files = ("print/plate-1-PETG.3mf", "print/pads-1-tpu-2.3mf", "print/README.md", "stl/stop_pad.stl")
    found = SlicedBundle(SimpleNamespace(files=files), "2.5.0", load_workshop(), True, (), (), {})
    assert found.left_out == ("print/pads-1-tpu-2.3mf",)


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_no_part_reaches_further_than_two_metres(tmp_path: Path, axis: int, sign: float) -> None:
    """A cube of 10 mm, volume and bounds as it was placed, or one line that names the limit."""
    for reach, allowed in ((1999.0, True), (2001.0, False)):
        cube = trimesh.creation.box((10.0, 10.0, 10.0))
        cube.apply_translation(np.eye(3)[axis] * sign * (reach - 5.0))
        cube.export(tmp_path / "part.stl")
        if allowed:
            part = _StlPart(tmp_path / "part.stl")
            assert part.moments[0] == pytest.approx(1000.0, rel=1e-3)
            assert part.bounds_mm == pytest.approx(cube.bounds, abs=1e-3)
        else:
            with pytest.raises(JumpcadError, match=r"part\.stl: reaches further than 2000 mm, so it is no part"):
                _StlPart(tmp_path / "part.stl")


def test_a_part_with_a_corner_that_is_no_number_is_none(tmp_path: Path) -> None:
    """An STL file has its first corner at byte 96: header, count, normal."""
    data = trimesh.creation.box((10.0, 10.0, 10.0)).export(file_type="stl")
    (tmp_path / "part.stl").write_bytes(data[:96] + np.array([np.nan], "<f4").tobytes() + data[100:])
    with pytest.raises(JumpcadError, match=r"part\.stl: reaches further than 2000 mm, so it is no part"):
        _StlPart(tmp_path / "part.stl")


def test_a_plate_of_a_material_that_the_workshop_lacks_is_told_before_it_is_sliced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sliced, "slicer_version", lambda: "2.9.1")
    line = {"kind": "printed", "name": "a", "quantity": 1, "material": "PLA", "mass_kg": 0.1, "source": "printed"}
    files = {"workshop.toml": load_workshop("default").to_toml(), "stl/a.stl": "", "print/plate-1-ABS.3mf": ""}
    write_folder(tmp_path / "b", "frog", {"masses": [line]}, files.items())
    with pytest.raises(JumpcadError, match="the bundle has parts of ABS, but the workshop only PETG, PLA"):
        slice_bundle(tmp_path / "b")


def test_a_sliced_workshop_has_the_slicers_grams_to_a_milligram() -> None:
    """Instead of what was weighed before; other parts keep theirs."""
    shop = workshop_with(mass={"weighed_g": {"cam": 1.5, "foot": 9.0}})
    part = SlicedPart("cam", "PETG", 1, grams=2.34567, modelled_grams=2.3, time_s=60.0)
    found = SlicedBundle(SimpleNamespace(), "2.5.0", shop, True, (part,), (), {})
    assert found.weighed.mass.weighed_g == {"cam": 2.346, "foot": 9.0}
    assert shop.mass.weighed_g["cam"] == 1.5
    assert found.weighed.process == shop.process


def test_a_file_is_modelled_with_the_printers_own_nozzle(tmp_path: Path) -> None:
    """A wider one bridges the infill of a block with thicker threads."""
    path, workshop = tmp_path / "block.stl", load_workshop()
    path.write_bytes(trimesh.creation.box((30.0, 20.0, 6.0)).export(file_type="stl"))
    wide = workshop_with(workshop, printer={"nozzle_mm": 0.6})
    usual, more = (_modelled_grams(path, shop, shop.material("body")) for shop in (workshop, wide))
    assert more > 1.001 * usual
