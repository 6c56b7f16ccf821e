"""What PrusaSlicer is asked and how it answers, by a stand-in program; the real one is in tests/clients."""

import os

import pytest

from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.exporters.threemf import plate_files
from jumpcad.printing import prusaslicer
from jumpcad.printing.prusaslicer import (
    project_settings,
    slice_model,
    slicer_program,
    slicer_settings,
    slicer_version,
)
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop

WORKSHOP = load_workshop("default")
MATERIAL = WORKSHOP.material("links")
GCODE = """M83
;HEIGHT:0.2
;TYPE:Perimeter
G1 X0 Y0 Z.2 F600
G1 X100 Y0 E10
; filament used [mm] = 10.00
; estimated printing time (normal mode) = 1h 2m 3s
; perimeters = 99
"""

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the stand-in is a shell script")


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """Return a function that puts a shell script in PrusaSlicer's place."""

    def put(script):
        program = tmp_path / "bin" / "prusa-slicer"
        program.parent.mkdir(exist_ok=True)
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", f"{program.parent}:/usr/bin:/bin")

    return put


def sliced(tmp_path):
    model = tmp_path / "leg.stl"
    model.touch()
    return slice_model(model, WORKSHOP.printer, WORKSHOP.process, MATERIAL)


def writing(gcode):
    """Return a script that writes G-code where `--output` says."""
    return f'while [ "$1" != --output ]; do shift; done\ncat > "$2" <<\'END\'\n{gcode}END'


def test_the_bed_is_a_rectangle_of_the_printers_sides():
    """Four corners in turn, in PrusaSlicer's order; beds are not all square."""
    printer = WORKSHOP.printer.model_copy(update={"bed_mm": (250.0, 210.0, 200.0)})
    settings = slicer_settings(printer, WORKSHOP.process, MATERIAL)
    assert settings["bed_shape"] == "0x0,250x0,250x210,0x210"
    assert settings["max_print_height"] == "200"


def test_grams_and_time_are_those_of_the_gcode(stand_in, tmp_path):
    stand_in(writing(GCODE))
    found = sliced(tmp_path)
    # 10 mm of 1.75 mm filament are 24.05 mm³
    assert found.grams == pytest.approx(0.02405 * MATERIAL.density_g_cm3, rel=1e-3)
    assert found.time_s == 3723.0
    assert found.ignored["perimeters"] == (str(WORKSHOP.process.perimeters), "99")


def test_a_part_lies_in_the_middle_of_the_bed_and_a_plate_as_it_is(stand_in, tmp_path):
    """PrusaSlicer's `--center` and `--dont-arrange`; the model comes last, with the settings in the file to load."""
    stand_in(f'echo "$@" > {tmp_path}/asked; cat "$(echo "$@" | sed "s/.*--load //; s/ .*//")" > {tmp_path}/settings\n'
             + writing(GCODE))  # fmt: skip
    printer = WORKSHOP.printer.model_copy(update={"bed_mm": (250.0, 210.0, 200.0)})
    for name, place in (("leg.stl", "--center 125,105 "), ("plate-1-PETG.3mf", "--dont-arrange ")):
        slice_model(tmp_path / name, printer, WORKSHOP.process, MATERIAL)
        asked = (tmp_path / "asked").read_text()
        assert asked.startswith(f"--export-gcode {place}--load ")
        assert asked.endswith(f" {tmp_path}/{name}\n")
        settings = dict(line.split(" = ") for line in (tmp_path / "settings").read_text().splitlines())
        assert settings["bed_shape"] == "0x0,250x0,250x210,0x210"
        assert settings.keys() == slicer_settings(printer, WORKSHOP.process, MATERIAL).keys()


def test_a_refusal_is_the_parts_fault_and_a_crash_is_not(stand_in, tmp_path):
    stand_in("echo 'slicing'; echo 'no layers were detected'; exit 1")
    with pytest.raises(CannotBuildError, match=r"refused leg\.stl: no layers were detected"):
        sliced(tmp_path)
    stand_in("echo 'no layers were detected' >&2; echo 'slicing'; exit 1")  # errors are told apart from progress
    with pytest.raises(CannotBuildError, match=r"refused leg\.stl: no layers were detected"):
        sliced(tmp_path)
    stand_in("echo 'slicing'; echo 'Segmentation fault'; echo; exit 139")
    with pytest.raises(JumpcadError, match=r"crashed on leg\.stl with exit code 139: Segmentation fault$"):
        sliced(tmp_path)
    stand_in("exit 139")
    with pytest.raises(JumpcadError, match="exit code 139: it printed no message") as crash:
        sliced(tmp_path)
    assert not isinstance(crash.value, CannotBuildError)


def test_a_slicer_that_does_not_finish_is_ended(stand_in, monkeypatch, tmp_path):
    monkeypatch.setattr(prusaslicer, "TIMEOUT_S", 0.1)
    stand_in("exec sleep 5")
    with pytest.raises(JumpcadError, match=r"did not finish leg\.stl within 0\.1 s"):
        sliced(tmp_path)


STRANGE = {
    "comma": GCODE.replace("10.00", "10,00"),
    "no number": GCODE.replace("10.00", "much"),
    "infinite": GCODE.replace("10.00", "9" * 400),
    "no time": GCODE.replace("1h 2m 3s", "soon"),
    "endless": GCODE.replace("1h", "9" * 400 + "d"),
}


def test_what_is_no_gcode_of_the_slicer_is_told_in_one_line(stand_in, tmp_path):
    scripts = {name: writing(gcode) for name, gcode in STRANGE.items()}
    place = 'while [ "$1" != --output ]; do shift; done; '
    scripts |= {"of the kernel": f'{place}ln -s /proc/kallsyms "$2"', "huge": f'{place}truncate -s 1G "$2"'}
    for name, script in scripts.items():
        stand_in(script)
        with pytest.raises(JumpcadError, match=r"usual remarks|not G-code|for G-code") as wrong:
            sliced(tmp_path)
        assert "\n" not in str(wrong.value), name


def test_a_child_of_the_slicer_is_not_waited_for(stand_in, monkeypatch, tmp_path):
    monkeypatch.setattr(prusaslicer, "TIMEOUT_S", 3.0)
    stand_in(f"sleep 5 &\n{writing(GCODE)}")
    assert sliced(tmp_path).time_s == 3723.0


def test_versions_of_which_settings_are_known_are_taken(stand_in):
    stand_in("echo PrusaSlicer-2.5.0+linux-x64")
    assert slicer_version().startswith("2.5.0")
    stand_in("echo PrusaSlicer-3.0.1")
    with pytest.raises(JumpcadError, match=r"version 3\.0\.1.*install version 2"):
        slicer_version()
    stand_in("echo PrusaSlicer-2.7.1 >&2")
    assert slicer_version() == "2.7.1"
    stand_in("echo something else")
    with pytest.raises(JumpcadError, match="does not say that it is PrusaSlicer: install PrusaSlicer 2 "):
        slicer_version()


def test_without_the_program_there_is_a_way_out(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert slicer_program() is None
    with pytest.raises(JumpcadError, match="not installed: install PrusaSlicer, or leave the printed masses"):
        slicer_version()


def test_each_setting_of_the_slicer_has_the_workshops_own_number() -> None:
    """By PrusaSlicer's names (its command line reference); no two numbers are alike here."""
    shop = load_workshop()
    printer = shop.printer.model_copy(update={"bed_mm": (211.0, 199.0, 187.0), "nozzle_mm": 0.5})
    figures = {
        "layer_height_mm": 0.15, "first_layer_mm": 0.25, "line_width_mm": 0.44, "perimeters": 5, "top_layers": 7,
        "bottom_layers": 6, "infill": 0.35, "solid_below_area_mm2": 12.0,
    }  # fmt: skip
    material = shop.material("links").model_copy(update={"density_g_cm3": 1.31})
    settings = slicer_settings(printer, shop.process.model_copy(update=figures), material)
    said = {
        "max_print_height": 187.0, "nozzle_diameter": 0.5, "filament_diameter": 1.75, "filament_density": 1.31,
        "layer_height": 0.15, "first_layer_height": 0.25, "perimeters": 5, "top_solid_layers": 7,
        "bottom_solid_layers": 6, "solid_infill_below_area": 12.0, "skirts": 0, "brim_width": 0, "support_material": 0,
        "elefant_foot_compensation": 0, "ensure_vertical_shell_thickness": 0,
        "top_solid_min_thickness": 0, "bottom_solid_min_thickness": 0,  # else thin layers have more solid ones
    }  # fmt: skip
    assert {key: float(settings[key]) for key in said} == said
    assert settings["bed_shape"] == "0x0,211x0,211x199,0x199"
    assert settings["fill_density"] == "35%"
    widths = {key: value for key, value in settings.items() if key.endswith("extrusion_width")}
    assert len(widths) == 7
    assert set(widths.values()) == {"0.44"}


def test_temperatures_that_are_known_are_said(small_robot: Robot) -> None:
    workshop, links = small_robot.workshop, small_robot.workshop.material_name("links")
    for nozzle_c, bed_c, words in (
        (240.0, 85.0, "nozzle 240 °C, bed 85 °C"), (None, 60.0, "bed 60 °C"), (215.0, None, "nozzle 215 °C"),
        (215.0, 0.0, "nozzle 215 °C, bed 0 °C"), (None, None, "no temperatures in the workshop: enter your filament's"),
    ):  # fmt: skip
        material = workshop.materials[links].model_copy(update={"nozzle_c": nozzle_c, "bed_c": bed_c})
        own = workshop.model_copy(update={"materials": dict.fromkeys(workshop.materials, material)})
        readme = dict(plate_files(small_robot.parts[:1], own))["print/README.md"]
        assert f": {words}\n" in str(readme)


@pytest.mark.parametrize("name", ["PETG", "PLA"])
def test_a_project_has_the_materials_temperatures_of_every_layer(name: str) -> None:
    """A nozzle is hotter than a bed; of a material that is not known there are none."""
    shop = load_workshop()
    material = shop.materials[name]
    settings = project_settings(shop.printer, shop.process, material, name)
    for layer in ("", "first_layer_"):
        assert float(settings[f"{layer}temperature"]) == material.nozzle_c
        assert float(settings[f"{layer}bed_temperature"]) == material.bed_c
        assert float(settings[f"{layer}temperature"]) > 150.0 > float(settings[f"{layer}bed_temperature"])
    cold = project_settings(shop.printer, shop.process, material.model_copy(update={"bed_c": 0.0}), name)
    assert cold["bed_temperature"] == cold["first_layer_bed_temperature"] == "0"  # not PrusaSlicer's default
    unknown = material.model_copy(update={"nozzle_c": None, "bed_c": None})
    assert not any("temperature" in key for key in project_settings(shop.printer, shop.process, unknown, name))
    assert settings["filament_type"] == name
    assert not {"start_gcode", "end_gcode"} & settings.keys()


def test_a_pad_is_printed_as_parts_are_but_solid_and_of_its_own_filament() -> None:
    """A pad weighs its volume times its density: none of it may be left open."""
    shop = load_workshop()
    pad = shop.catalogue.pads["tpu-2"]
    process = shop.process.model_copy(update={"infill": 0.35, "infill_pattern": "grid"})
    unknown = shop.material("links").model_copy(update={"nozzle_c": None, "bed_c": None})
    part = project_settings(shop.printer, process, unknown, "PETG")
    assert (part["fill_density"], part["fill_pattern"]) == ("35%", "grid")
    own = {
        "fill_density": "100%", "fill_pattern": "rectilinear",
        "filament_density": f"{pad.density_g_cm3:g}", "filament_type": "tpu-2",
    }  # fmt: skip
    assert project_settings(shop.printer, process, pad, pad.name) == part | own
