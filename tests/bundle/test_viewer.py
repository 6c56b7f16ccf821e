"""What a click on a part of the report's picture shows."""

import json
from collections.abc import Callable

import pytest
from support.built import built, geared, placed

from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.viewer import _embedded, parts_facts, turning_parts
from jumpcad.robot.robot import Robot


def test_what_is_bought_in_one_piece_and_seen_as_several_has_the_mass_of_the_whole() -> None:
    """A motor with its shaft, a spring with its second arm: pieces that no scale shows alone."""
    robot = built("kenan-2.0")
    facts, bill = parts_facts(robot), {line.name: line for line in bill_of_materials(robot).items}
    apart = {name for name, one in facts.items() if "as bought" in one["material"]}
    wholes = (("motor", "motor_shaft"), *((f"spring_{side}", f"spring_{side}_leg_arm") for side in ("left", "right")))
    assert apart == {name for pieces in wholes for name in pieces}
    for pieces in wholes:
        (words,) = {facts[name]["material"] for name in pieces}
        article, grams = words.removesuffix(" g").split("; as bought ")
        assert float(grams) == pytest.approx(1000.0 * bill[article].mass_kg, abs=0.006)
        assert float(grams) == pytest.approx(sum(facts[name]["mass_g"] for name in pieces), abs=0.007)


def test_data_in_a_page_can_neither_end_their_script_nor_begin_markup() -> None:
    """HTML ends a script at `</script`, XML knows `&`; both read JSON's escapes as the same characters."""
    data = {"a <b>": "</script><!-- & -->"}
    text = _embedded(data)
    assert not set("<>&") & set(text)
    assert json.loads(text) == data


@pytest.mark.parametrize("robot", [lambda: built("kenan-2.0"), geared], ids=["one pair", "two pairs"])
def test_what_turns_turns_about_its_own_middle(robot: Callable[[], Robot]) -> None:
    """Gears are round: the middle of a mesh, seen from the side, is its axle, in metres."""
    axes = {one["node"]: one["axis_m"] for one in turning_parts(robot())}
    assert axes["cam"] == axes["cam_gear"]
    assert axes["motor_shaft"] == axes["motor_pinion"]
    for node in axes.keys() & {"cam_gear", "motor_pinion", "idler"}:
        middle = placed(robot(), node).bounds.mean(axis=0)[[0, 2]] / 1000.0
        assert axes[node] == pytest.approx(middle, abs=4e-4), node
