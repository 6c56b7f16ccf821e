"""PrusaSlicer prints a plate's 3MF file with the workshop's settings, without being given any."""

import io
import subprocess
from pathlib import Path

import pytest
import trimesh
from support import needs
from support.gcode import read_gcode

from jumpcad.exporters.threemf import plate_files
from jumpcad.parts.part import Drawing, Part, Placement, upright
from jumpcad.printing.prusaslicer import slice_model, slicer_program, slicer_settings
from jumpcad.solids.outline import hole, rectangle, stadium
from jumpcad.solids.stack import Stack
from jumpcad.workshop import Workshop, load_workshop

pytestmark = needs.without("prusa-slicer")

LEFT_OUT = "start_gcode", "end_gcode", "bed_shape"
"""What a print needs and the mass model does not; and the bed, which PrusaSlicer 2.5 takes from no project on the
command line: it says 200 x 200 mm whatever the file says, and places the parts as they lie."""


def part_of(drawing: Drawing, material: str) -> Part:
    drawn = drawing.name, drawing.role, drawing.shape, drawing.placements
    return Part(*drawn, material, drawing.shape.mass_properties(1.0), "solid")


def plate(workshop: Workshop, material: str, folder: Path) -> Path:
    """Return the 3MF file of a link and two blocks."""
    link = Stack.of([(0, 4, stadium((0, 0), (50, 0), 10.0))]).through(hole(3.4), hole(3.4, (50, 0)))
    block = Stack.of([(0, 5, rectangle((15, 12)))])
    once, twice = (tuple(Placement("body", upright(0.0)) for _ in range(count)) for count in (1, 2))
    drawings = (Drawing("link & lever", "links", link, once), Drawing("block", "links", block, twice))
    parts = [
        Part(one.name, one.role, one.shape, one.placements, material, one.shape.mass_properties(1.0), "solid")
        for one in drawings
    ]
    path, content = next(iter(plate_files(parts, workshop)))
    file = folder / Path(path).name
    file.write_bytes(content)
    return file


def sliced(file: Path) -> dict[str, str]:
    """Return what PrusaSlicer says at the end of its G-code, given nothing but the file."""
    gcode = file.with_suffix(".gcode")
    command = [slicer_program(), "--export-gcode", "--dont-arrange", "--output", str(gcode), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return read_gcode(gcode.read_text()).remarks


@pytest.mark.parametrize(("shop", "material"), [("default", "PETG"), ("fine", "PLA")])
def test_it_prints_with_the_workshops_settings(shop: str, material: str, tmp_path: Path) -> None:
    workshop = load_workshop(shop)
    file = plate(workshop, material, tmp_path)
    used = sliced(file)
    asked = slicer_settings(workshop.printer, workshop.process, workshop.materials[material])
    wanted = {key: value for key, value in asked.items() if key not in LEFT_OUT}
    assert {key: used.get(key) for key in wanted} == wanted
    modelled = slice_model(file, workshop.printer, workshop.process, workshop.materials[material])
    assert float(used["filament used [g]"]) == pytest.approx(modelled.grams, abs=0.01)


def test_it_heats_as_the_material_needs_and_homes(tmp_path: Path) -> None:
    workshop = load_workshop()
    file = plate(workshop, "PETG", tmp_path)
    used = sliced(file)
    hot, warm = (f"{heat:g}" for heat in (workshop.materials["PETG"].nozzle_c, workshop.materials["PETG"].bed_c))
    assert (used["temperature"], used["first_layer_temperature"]) == (hot, hot)
    assert (used["bed_temperature"], used["filament_type"]) == (warm, "PETG")
    lines = file.with_suffix(".gcode").read_text().splitlines()
    first = next(index for index, line in enumerate(lines) if line.startswith("G1 X"))
    started = "\n".join(lines[:first])
    assert all(word in started for word in (f"M109 S{hot}", f"M190 S{warm}", "G28"))


def test_settings_that_are_given_take_the_place_of_the_files(tmp_path: Path) -> None:
    workshop = load_workshop()
    file = plate(workshop, "PETG", tmp_path)
    process = workshop.process.model_copy(update={"perimeters": 1, "infill": 0.1})
    thin = slice_model(file, workshop.printer, process, workshop.materials["PETG"])
    thick = slice_model(file, workshop.printer, workshop.process, workshop.materials["PETG"])
    assert thin.ignored == {}
    assert thin.grams < 0.8 * thick.grams


def test_trimesh_reads_the_same_parts(tmp_path: Path) -> None:
    file = plate(load_workshop(), "PETG", tmp_path)
    scene = trimesh.load_scene(io.BytesIO(file.read_bytes()), file_type="3mf")
    assert len(scene.graph.nodes_geometry) == 3
    assert sorted(round(mesh.volume) for mesh in scene.geometry.values())[0] == 900


def test_what_is_tall_on_a_small_foot_gets_a_brim(tmp_path: Path) -> None:
    """A tube of 6.4 mm has one from twice its width on, a plate has none."""
    for size, height, has in (((6.4, 6.4), 20.0, True), ((6.4, 6.4), 12.0, False), ((60.0, 30.0), 3.0, False)):
        drawing = Drawing("tall", "links", Stack.of([(0, height, rectangle(size))]), (Placement("body", upright(0.0)),))
        part = Part(
            drawing.name,
            drawing.role,
            drawing.shape,
            drawing.placements,
            "PETG",
            drawing.shape.mass_properties(1.0),
            "solid",
        )
        file = tmp_path / f"{height:g}.3mf"
        file.write_bytes(next(iter(plate_files([part], load_workshop())))[1])
        sliced(file)
        assert ("Brim" in file.with_suffix(".gcode").read_text()) == has
