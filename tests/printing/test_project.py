"""What a slicer's project and its instructions say of temperatures and settings."""

import pytest

from jumpcad.exporters.threemf import plate_files
from jumpcad.printing.project import project_settings
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop


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
