"""Which electrical parts a workshop has."""

from dataclasses import replace

from support.built import with_kit

from jumpcad.electronics.chosen import chosen_parts
from jumpcad.workshop import load_workshop


def test_what_is_named_is_there_and_what_is_not_named_is_left_out() -> None:
    shop = with_kit("strong-2s", plug="", switch="")
    bought, chosen = shop.bought, chosen_parts(shop)
    assert (chosen.battery.name, chosen.controller.name, chosen.driver.name) == (
        bought.battery, bought.controller, bought.driver,
    )  # fmt: skip
    assert chosen.components.keys() == {"sensor", "capacitor", "diode", "wire"}
    assert {role: part.name for role, part in chosen.components.items()} == {
        role: getattr(bought, role) for role in chosen.components
    }


def test_a_diode_lies_behind_a_regulator_alone() -> None:
    """A controller that the battery feeds itself has none, whatever the workshop names."""
    shop = with_kit("strong-2s")
    regulated, bare = chosen_parts(shop), chosen_parts(with_kit("strong-2s", regulator=""))
    assert regulated.boards.keys() == {"controller", "driver", "regulator"}
    assert {role: one.name for role, one in regulated.boards.items()} == {
        role: getattr(shop.bought, role) for role in ("controller", "driver", "regulator")
    }
    assert regulated.diode is not None
    assert regulated.diode.name == shop.bought.diode
    assert bare.boards.keys() == {"controller", "driver"}
    assert "diode" in bare.components
    assert bare.diode is None


def test_usb_charges_one_cell_that_lies_at_a_charger_and_no_other() -> None:
    """Two cells need 8.4 V; a regulator lets no current back; a board without charger or pads for a cell has 5 V."""
    shop = load_workshop()
    one = chosen_parts(shop)
    assert one.charged_by_usb
    two = shop.catalogue.batteries["lipo-2s-180"]
    assert (one.battery.cells, two.cells) == (1, 2)
    regulator = shop.catalogue.boards[shop.catalogue.kits["strong-2s"].regulator]
    bare = {name: tuple(f for f in able if f != "battery") for name, able in one.controller.pins.items()}
    rated = one.controller.model_copy(update={"pins": bare})
    unrated = one.controller.model_copy(update={"charge_ma": None})
    for charged in (replace(one, controller=rated), replace(one, controller=unrated)):
        assert charged.charged_by_usb
    neither = rated.model_copy(update={"charge_ma": None})
    for other in ({"battery": two}, {"regulator": regulator}, {"controller": neither}):
        assert not replace(one, **other).charged_by_usb
