"""The workshop as a whole: it reads back as written, its values go together, and it cannot be changed."""

import re

import pytest
from pydantic import ValidationError
from support.each import each

import jumpcad
from jumpcad.catalogue import load_catalogue
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names
from jumpcad.workshop import Workshop, load_workshop


@pytest.mark.parametrize("name", template_names("workshops"))
def test_a_written_workshop_reads_back_the_same(name, written):
    workshop = load_workshop(name)
    path = written(workshop.to_toml())
    assert load_workshop(path) == workshop
    assert load_workshop(path).to_toml() == workshop.to_toml()


def test_parts_of_ones_own_are_written_too(written):
    """Those alone: what is shipped, and may change with the next version, is not."""
    own = load_workshop(written('[springs.own]\nlike = "9271K619"\nsource = "a test"\n'))
    text = own.to_toml()
    assert re.findall(r"^\[(?:springs|motors|boards|bearings|batteries)\.(\w+)\]", text, re.M) == ["own"]
    assert load_workshop(written(text)) == own


def test_values_that_do_not_go_together_are_one_line(refusal):
    text = "[process]\nlayer_height_mm = 0.35\n[fits]\nsliding_mm = 0.05"
    assert re.search(r"my.toml:2: process.layer_height_mm = 0.35: must be at most 0.32", refusal(text))
    assert re.search(r"my.toml:4: fits.sliding_mm = 0.05: must be at least fits.press_mm = 0.1", refusal(text))


def test_a_workshop_cannot_be_changed():
    workshop = jumpcad.load_workshop()
    assert isinstance(workshop, Workshop)
    with pytest.raises(JumpcadError, match=r"^Fits\.loose_mm cannot be changed: make a copy that differs, "):
        workshop.fits.loose_mm = 1.0


def test_own_parts_are_checked_in_python_too() -> None:
    data = load_workshop().model_dump()
    n20 = load_catalogue().motors["n20-298"]
    workshop = Workshop(**data | {"motors": {"mine": n20.model_copy(update={"name": "mine", "mass_g": 9.0})}})
    assert workshop.catalogue.motors["mine"].mass_g == 9.0
    with pytest.raises(JumpcadError, match=r"motors\.mine\.name = 'n20-298': a part has its table's name"):
        Workshop(**data | {"motors": {"mine": n20}})


@each(
    ("table", "values", "key"),
    [
        ("process", {"line_width_mm": 0.32, "first_layer_mm": 0.32}, "process.line_width_mm"),
        ("process", {"line_width_mm": 0.32, "layer_height_mm": 0.32}, "process.line_width_mm"),
        ("process", {"line_width_mm": 0.81, "first_layer_mm": 0.2}, "process.line_width_mm"),
        ("process", {"line_width_mm": 0.31, "layer_height_mm": 0.1}, "process.line_width_mm"),
        ("process", {"first_layer_mm": 0.33}, "process.first_layer_mm"),
        ("process", {"layer_height_mm": 0.33}, "process.layer_height_mm"),
        ("fits", {"wall_mm": 0.89, "wall_min_mm": 0.8}, "fits.wall_mm"),
        ("fits", {"wall_mm": 1.2, "wall_min_mm": 1.3}, "fits.wall_min_mm"),
        ("fits", {"wall_mm": 1.2, "first_layer_chamfer_mm": 0.6}, "fits.first_layer_chamfer_mm"),
        ("fits", {"press_mm": 0.21, "sliding_mm": 0.2}, "fits.sliding_mm"),
        ("fits", {"m3_tap_mm": 3.1, "m3_clearance_mm": 3.0}, "fits.m3_clearance_mm"),
        ("release", {"rotor_kg_m2": (2e-9, 1e-9)}, "release.rotor_kg_m2"),
        ("release", {"backlash_deg": (5.0, 3.0)}, "release.backlash_deg"),
    ],
)
def test_values_that_do_not_go_together_are_refused(table: str, values: dict[str, object], key: str) -> None:
    """A nozzle of 0.4 mm: lines of 0.8 to 2 times that, layers of at most 0.8 of it, walls of two lines of 0.45 mm."""
    data = load_workshop().model_dump(exclude_none=True)
    with pytest.raises((ValidationError, JumpcadError), match=key.split(".")[1]):
        Workshop.model_validate(data | {table: data[table] | values})


def test_a_material_is_weakest_between_its_layers_and_its_modulus_is_in_megapascals():
    """Data sheets give moduli in GPa: 2.5 of PLA, which is 2500 MPa."""
    shop = load_workshop()
    for key, inside, beyond in (
        ("strength_interlayer_mpa", 54.0, 54.1), ("modulus_mpa", 54.0, 2.5), ("modulus_mpa", 54.0, 53.9),
    ):  # fmt: skip
        for value, places in ((inside, []), (beyond, [("materials", "PLA", key)])):
            own = shop.materials["PLA"].model_copy(update={"strength_in_plane_mpa": 54.0, key: value})
            found = shop.model_copy(update={"materials": {**shop.materials, "PLA": own}}).contradictions()
            assert [place for place, *_ in found] == places


def test_materials_whose_plates_would_be_one_file_are_refused(refusal):
    """Windows and macOS take print/plate-1-petg.3mf and print/plate-1-PETG.3mf for one file."""
    own = '[materials."%s"]\ndensity_g_cm3 = 1.2\nstrength_in_plane_mpa = 40.0\nstrength_interlayer_mpa = 20.0\n' \
        'modulus_mpa = 2000.0\nsource = "a test"\n'  # fmt: skip
    for text in ('[roles]\nlinks = "petg"', '[roles]\nlinks = "Öko"\nbody = "öko"\n' + own % "Öko" + own % "öko"):
        assert "write both alike, or choose another name" in refusal(text)
