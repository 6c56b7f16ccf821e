"""Workshops with some values changed."""

import pytest
from support.each import each

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop, varied

DEFAULT = load_workshop()


@pytest.mark.parametrize(("asked", "whole"), [(2.4, 2), (2.6, 3), (3.0, 3)])
def test_whole_numbers_are_the_nearest_ones(asked, whole):
    """A search varies numbers evenly: half of what lies between 2 and 3 perimeters is nearer to 3."""
    found = varied(DEFAULT, {"process.perimeters": asked}).process.perimeters
    assert (found, type(found)) == (whole, int)


def test_a_varied_workshop_is_read_back_from_its_file(tmp_path):
    changed = varied(
        DEFAULT, {"roles.links": "PLA", "roles.gears": "PLA", "bought.kit": "strong-2s", "process.infill": 0.15}
    )
    path = tmp_path / "w.toml"
    path.write_text(changed.to_toml())
    assert load_workshop(path) == changed
    assert sorted(changed.materials) == ["PLA"]


def test_a_kit_brings_its_parts_and_other_choices_override_them():
    kit = load_catalogue().kits["strong-2s"]
    changed = varied(DEFAULT, {"bought.battery": "lipo-1s-300", "bought.kit": "strong-2s"}).bought
    assert (changed.regulator, changed.diode, changed.battery) == (kit.regulator, kit.diode, "lipo-1s-300")
    own = varied(DEFAULT, {"bought.kit": ""}).bought  # no kit: the parts stay as they are
    assert own == DEFAULT.bought.model_copy(update={"kit": ""})


def test_a_material_of_the_workshop_keeps_its_own_figures():
    own = varied(DEFAULT, {"materials.PLA.density_g_cm3": 1.3, "roles.links": "PLA", "roles.gears": "PLA"})
    assert own.materials["PLA"].density_g_cm3 == 1.3
    assert varied(own, {"body.plate_mm": 2.0}).materials == own.materials
    assert DEFAULT.materials["PLA"].density_g_cm3 != 1.3


@each(
    ("values", "message"),
    [
        ({"body.plate": 2.0}, r"did you mean body.plate_mm\?"),
        ({"nonsense": 2.0}, "TABLE.NAME"),
        ({"bought.motors": "n20-298"}, "cannot vary: in the workshop it is a list"),
        ({"body": 2.0}, "no single number or name"),
        ({"printer.name": "mine"}, "cannot vary"),
        ({"printer.source": "mine"}, "cannot vary"),
        ({"ground.surface": "ice"}, "cannot vary"),
        ({"body.plate_mm": 0.1}, "body.plate_mm = 0.1: must be at least 1"),
        ({"body.plate_mm": "thick"}, "body.plate_mm"),
        ({"bought.battery": "lipo-1s-30"}, r"did you mean lipo-1s-300\?"),
        ({"roles.links": "wood"}, "'wood' is no material of this workshop, nor one of"),
        ({"process.layer_height_mm": 0.5}, "0.8 of the nozzle"),
    ],
)
def test_what_cannot_vary_is_said_in_one_line(values, message):
    with pytest.raises(JumpcadError, match=message) as refused:
        varied(DEFAULT, values)
    assert "\n" not in str(refused.value)
