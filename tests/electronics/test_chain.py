"""Voltages from the battery to the motor's winding, part by part, by Ohm's law."""

import re
from dataclasses import replace

import pytest
from support.built import with_kit

from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.chain import Link, chain, supply_pin
from jumpcad.electronics.chosen import Chosen, chosen_parts
from jumpcad.electronics.supply import supply_of

PEAK_A, TORQUE_NM, MOTOR = 0.5, 0.2, load_catalogue().motors["n20-298"]


def links(kit: str) -> tuple[dict[str, Link], Chosen]:
    chosen = chosen_parts(with_kit(kit))
    return of(chosen), chosen


def of(chosen: Chosen) -> dict[str, Link]:
    return {one.role: one for one in chain(chosen, MOTOR, supply_of(chosen), PEAK_A, TORQUE_NM)}


def test_one_cell_feeds_controller_and_driver() -> None:
    """3.3 V less the drop of the battery's own resistance at the motor's largest current, to 4.2 V."""
    found, chosen = links("light-1s")
    low = 3.3 - PEAK_A * chosen.battery.ohm
    for role in ("controller", "driver", "switch", "plug", "capacitor"):
        if role in found:
            assert found[role].gets_v == pytest.approx((low, 4.2)), role
    assert found["controller"].bears_v == chosen.controller.supply_v[found["controller"].pin]
    assert found["driver"].bears_v == chosen.driver.supply_v[found["driver"].pin]
    assert "regulator" not in found
    for role in ("switch", "plug", "capacitor"):
        part = chosen.components.get(role)
        assert (role in found) == (part is not None and part.rated_v is not None)
        if role in found:
            assert found[role].bears_v == (0.0, part.rated_v)


def test_a_part_whose_voltage_nobody_states_is_not_compared() -> None:
    _, chosen = links("light-1s")
    plain = {role: part.model_copy(update={"rated_v": None}) for role, part in chosen.components.items()}
    unrated = replace(chosen, components=plain)
    assert plain
    assert of(unrated).keys() == {"controller", "driver", "motor"}


def test_two_cells_pass_a_regulator_and_a_diode_to_the_controller() -> None:
    found, chosen = links("strong-2s")
    low = 6.6 - PEAK_A * chosen.battery.ohm
    assert found["regulator"].gets_v == pytest.approx((low, 8.4))
    assert found["driver"].gets_v == pytest.approx((low, 8.4))
    for role in ("switch", "plug", "capacitor"):  # before the regulator
        assert found[role].gets_v == pytest.approx((low, 8.4)), role
    logic = chosen.regulator.output_v - (chosen.diode.drop_v if chosen.diode else 0.0)
    assert found["controller"].gets_v == pytest.approx((logic, logic))
    alone = replace(chosen, components={name: one for name, one in chosen.components.items() if name != "diode"})
    assert of(alone)["controller"].gets_v == pytest.approx((chosen.regulator.output_v,) * 2)


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_what_gets_another_voltage_than_it_bears_is_to_be_exchanged(kit: str) -> None:
    """Each remedy names the key of the part itself in `[bought]`, or of what feeds it."""
    found, _ = links(kit)
    for role, link in found.items():
        own = {"motor": "motors", "controller": "regulator"}.get(role, role)  # a controller has one put before it
        assert f"bought.{own}" in link.remedy
        named = set(re.findall(r"bought\.(\w+)", link.remedy))
        assert named <= {own, "kit", "battery"}, role
        assert ("battery" in named) == (role not in ("switch", "plug", "capacitor"))


def test_the_winding_gets_the_mean_of_the_pwm() -> None:
    """A motor of 6 V on 8.4 V: no more than the highest voltage that it bears, the same share of an empty battery."""
    found, chosen = links("strong-2s")
    low, high = found["motor"].gets_v
    assert high <= MOTOR.range_v[1] + 1e-9
    assert low / high == pytest.approx(chosen.battery.range_v[0] / chosen.battery.range_v[1])
    assert found["motor"].bears_v == MOTOR.range_v
    assert found["motor"].name == "n20-298"


def test_the_input_is_the_first_that_bears_the_range() -> None:
    board = load_catalogue().boards["xiao-esp32c3"].model_copy(
        update={"supply_v": {"A": (3.0, 4.0), "B": (3.0, 6.0), "C": (2.0, 9.0)}}
    )  # fmt: skip
    assert supply_pin(board, (3.0, 4.0)) == "A"
    assert supply_pin(board, (3.0, 4.1)) == "B"
    assert supply_pin(board, (2.9, 4.0)) == "C"
    assert supply_pin(board, (1.0, 4.0)) == "A"
    assert supply_pin(board.model_copy(update={"supply_v": {}}), (3.0, 4.0)) == ""
