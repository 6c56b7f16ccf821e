"""`jumpcad new`: a copy of a template with comments, and nothing replaced unasked."""

import re
from pathlib import Path
from unittest.mock import ANY

import pytest
from support.commands import Run

from jumpcad.design import load_design
from jumpcad.files import template_names
from jumpcad.workshop import load_workshop


def test_new_writes_a_copy_that_can_be_loaded(run: Run, tmp_path: Path) -> None:
    code, out, err = run("new", "frog.toml", "--from", "best-bo")
    assert (code, err) == (0, "")
    assert out.startswith("frog.toml: a copy of best-bo")
    assert load_design(tmp_path / "frog.toml") == load_design("best-bo")


def test_new_keeps_what_is_there(run: Run, tmp_path: Path) -> None:
    (tmp_path / "frog.toml").write_text("mine")
    code, _, err = run("new", "frog.toml")
    assert code == 2
    assert "exists already" in err
    assert (tmp_path / "frog.toml").read_text() == "mine"


@pytest.mark.parametrize("name", template_names("workshops"))
def test_a_new_workshop_is_the_one_that_it_was_copied_from_with_comments(run: Run, tmp_path: Path, name: str) -> None:
    assert run("new", "w.toml", "--workshop", name)[0] == 0
    assert load_workshop(tmp_path / "w.toml") == load_workshop(name)
    text = (tmp_path / "w.toml").read_text()
    assert text.count("#") > 50
    assert max(map(len, text.splitlines())) < 160


OWN = """
printer = "ender-3"
[process]
perimeters = 4
[roles]
links = "PETG"
body = "mine"
gears = "PETG"
[materials.mine]
density_g_cm3 = 1.1
strength_in_plane_mpa = 40.0
strength_interlayer_mpa = 20.0
modulus_mpa = 1500.0
price_eur_per_kg = 20.0
[materials.PETG]
density_g_cm3 = 1.3
[bought]
kit = "strong-2s"
battery = "pack"
pins = { motor = "D2" }
[batteries.pack]
like = "lipo-2s-180"
source = "my scale"
mass_g = 14.0
[mass.weighed_g]
cam = 1.5
[prices_eur]
"screw M3" = 0.05
"""


def test_a_workshop_of_ones_own_is_copied_with_all_that_it_says(run: Run, tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(OWN)
    assert run("new", "again.toml", "--workshop", "own.toml") == (0, ANY, "")
    assert load_workshop(tmp_path / "again.toml") == load_workshop(tmp_path / "own.toml")
    text = (tmp_path / "again.toml").read_text()
    assert 'printer = "ender-3"' in text
    assert re.search(r"perimeters = 4 +# judgement", text)


def test_a_printer_and_a_material_go_into_a_new_workshop(run: Run, tmp_path: Path) -> None:
    assert run("new", "w.toml", "--printer", "ender-3", "--material", "pla")[0] == 0
    workshop = load_workshop(tmp_path / "w.toml")
    assert workshop.printer.name == "Creality Ender-3"
    assert set(workshop.materials) == {"PLA"}
    assert workshop == load_workshop("default", "ender-3", "PLA")


def test_a_printer_of_ones_own_is_written_as_a_table(run: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "mine"\nbed_mm = [300, 300, 300]\nnozzle_mm = 0.4\n')
    assert run("new", "w.toml", "--printer", "./mine.toml")[0] == 0
    assert load_workshop(tmp_path / "w.toml").printer.bed_mm == (300.0, 300.0, 300.0)
