"""A bundle's parts as a slicer weighs them and as the mass model does."""

from pathlib import Path

import pytest
from support.slicers import OBEDIENT, pretend_slicer, three_parts

from jumpcad.bundle.export import export
from jumpcad.bundle.sliced import SlicedPart, slice_bundle
from jumpcad.printing.layer_mass import mass_properties
from jumpcad.robot import Robot


def test_the_model_weighs_the_same_from_a_file_as_from_a_drawing(
    small_robot: Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pretend_slicer(OBEDIENT.replace("TAMPER", ""), tmp_path, monkeypatch)
    found = slice_bundle(export(three_parts(small_robot), tmp_path / "frog", pictures=False).folder)
    parts = {part.name: part for part in small_robot.parts}
    for part in found.parts:
        density = found.workshop.materials[part.material].density_g_cm3
        shape, printer = parts[part.name].drawing.shape, found.workshop.printer
        drawn = mass_properties(shape, density, found.workshop.process, printer.nozzle_mm).mass_kg
        assert part.modelled_grams == pytest.approx(1000.0 * drawn, rel=2e-3)


def test_a_model_that_is_a_tenth_heavier_says_so() -> None:
    part = SlicedPart("main_leg", "PETG", 1, grams=10.0, modelled_grams=11.0, time_s=600.0)
    assert part.difference == pytest.approx(0.10)
