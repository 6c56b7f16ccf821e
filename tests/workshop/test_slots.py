"""Keys of a workshop that name parts: what fits there, and what is said of what does not."""

import pytest
from support.each import each

from jumpcad.catalogue import Board, load_catalogue
from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop
from jumpcad.workshop.slots import SLOTS

ELECTRICAL = ("batteries", "boards", "components")
OF_A_KIT = [key for key in SLOTS if key.startswith("bought.") and SLOTS[key].table in ELECTRICAL]
SMALL = [key for key in SLOTS if SLOTS[key].table == "components"]


@each("kit", load_catalogue().kits)
@each("key", OF_A_KIT)
def test_parts_of_a_kit_fit_their_keys(kit: str, key: str) -> None:
    catalogue = load_catalogue()
    assert SLOTS[key].misfit(catalogue, getattr(catalogue.kits[kit], key.split(".")[1])) == ""


@pytest.mark.parametrize("key", SMALL)
def test_a_small_part_is_of_one_kind(key: str) -> None:
    """A kit has one part of each kind: that of another key is refused, with its kind and the way out."""
    catalogue = load_catalogue()
    kit, own = catalogue.kits["strong-2s"], key.split(".")[1]
    for other in (one.split(".")[1] for one in SMALL if one != key):
        said = SLOTS[key].misfit(catalogue, getattr(kit, other))
        assert said.startswith(f"is a {other}, no {own}: choose ")
        assert getattr(kit, own) in said


@pytest.mark.parametrize(
    ("key", "name", "said"),
    [
        ("wire", "omron-d2hw", r"'omron-d2hw': is a sensor, no wire: choose awg28-silicone or \"\" for none$"),
        ("driver", "xiao-esp32c3", "is a controller, no driver: choose drv8833$"),
        ("controller", "s7v7f5", "is a regulator, no controller: choose xiao-esp32c3$"),
        ("regulator", "drv8833", "is a driver, no regulator: choose s7v7f5 or "),
        ("battery", "drv8833", "is no battery in the catalogue: choose lipo-"),
        ("roller", "any", "is no bearing in the catalogue: choose 623, "),
        ("leg", "carbon-tube-6x5", r"printed legs \(did you mean carbon-tube-6x4\?\)$"),
    ],
)
def test_a_part_of_another_kind_is_refused_with_its_line(tmp_path, key, name, said):
    file = tmp_path / "w.toml"
    file.write_text(f'[bought]\n{key} = "{name}"\n')
    with pytest.raises(JumpcadError, match=rf"w.toml:2: bought.{key} = '{name}': .*{said.split(': ', 1)[-1]}"):
        load_workshop(file)


def test_a_board_of_one_s_own_is_what_its_pins_make_it():
    """A board whose pins are not given may be anything; one that controls and drives may be named for both."""
    drv8833 = load_catalogue().boards["drv8833"]

    def uses(pins: dict[str, tuple[str, ...]]) -> tuple[str, ...]:
        return Board(**drv8833.model_dump() | {"name": "own", "pins": pins}).uses

    assert uses({}) == uses({"G": ("ground",)}) == ()
    assert uses({"D1": ("gpio1",), "3V3": ("out",)}) == ("controller",)
    assert uses({"D1": ("gpio1",), "A": ("motor+",), "B": ("motor-",)}) == ("controller", "driver")
    assert uses({"VOUT": ("out",)}) == ("regulator",)
    assert uses({"VOUT": ("out",), "A": ("motor+",), "B": ("motor-",)}) == ("driver",)  # that feeds something else too


@each("key", SLOTS)
def test_an_empty_name_leaves_out_what_a_robot_can_be_without(key: str) -> None:
    """It winds with a motor, a roller on its cam, a battery and two boards, and turns on axles; all else may lack.

    Who names something unknown is told all that fits there: parts, "any" for a leg's bearing, and an empty name.
    """
    needed, catalogue = {"motors", "roller", "battery", "controller", "driver", "axle"}, load_catalogue()
    table, name = key.split(".")
    is_needed = (table == "bought" and name in needed) or key == "steering.motor"
    assert (SLOTS[key].misfit(catalogue, "") == "") is not is_needed
    said = SLOTS[key].misfit(catalogue, "nothing of this name")
    assert ('"" for ' in said) is not is_needed
    words = said.partition(": choose ")[2].replace(" or ", ", ").split(", ")
    assert set(words) >= set(SLOTS[key].fitting(catalogue)) | ({"any"} if name == "leg_bearing" else set())
