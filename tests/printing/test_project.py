"""What a slicer's project and its instructions say of temperatures and settings."""

import pytest

from jumpcad.printing.project import settings_in_words, temperatures_in_words
from jumpcad.workshop import load_workshop


@pytest.mark.parametrize(
    ("nozzle_c", "bed_c", "words"),
    [(240.0, 85.0, "nozzle 240 °C, bed 85 °C"), (None, 60.0, "bed 60 °C"), (215.0, None, "nozzle 215 °C")],
)
def test_temperatures_that_are_known_are_said(nozzle_c: float | None, bed_c: float | None, words: str) -> None:
    material = load_workshop().material("links").model_copy(update={"nozzle_c": nozzle_c, "bed_c": bed_c})
    assert temperatures_in_words(material) == words


def test_unknown_temperatures_are_the_users_to_enter() -> None:
    material = load_workshop().material("links").model_copy(update={"nozzle_c": None, "bed_c": None})
    assert "enter your filament's" in temperatures_in_words(material)


def test_instructions_have_the_numbers_of_the_process() -> None:
    shop = load_workshop()
    process = shop.process.model_copy(update={"infill": 0.35, "perimeters": 5, "solid_below_area_mm2": 12.0})
    lines = settings_in_words(shop.printer, process)
    assert "perimeters (walls): 5" in lines
    assert any(line.startswith("infill: 35 %") for line in lines)
    assert any("areas below 12 mm² filled solid" in line for line in lines)
    solid = settings_in_words(shop.printer, process.model_copy(update={"infill": 1.0, "solid_below_area_mm2": 0.0}))
    assert "infill: 100 %, rectilinear" in solid
    assert any("filled like the others" in line for line in solid)
    hollow = settings_in_words(shop.printer, process.model_copy(update={"infill": 0.0}))
    assert any(line.startswith("infill: none but solid layers") for line in hollow)
