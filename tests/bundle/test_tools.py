"""Tools: sizes that pass the robot's holes, and a charger where the robot has none."""

import re
from dataclasses import replace

import pytest
from support.built import built

from jumpcad.bundle import tools
from jumpcad.bundle.tools import tool_lines
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.scene.assembly_steps import assembly_steps


def test_a_charger_is_needed_for_two_cells_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    robot = built("kenan-2.0")
    one = "\n".join(tool_lines(robot, []))
    assert "charger" not in one
    assert "plug body at most 12.5 x 6.9 mm" in one  # a window of 13 x 7.4 mm
    assert "reamer 3.1 mm" in one
    kit = robot.workshop.catalogue.kits["strong-2s"].model_dump() | {"kit": "strong-2s"}
    shop = robot.workshop.model_copy(update={"bought": robot.workshop.bought.model_copy(update=kit)})
    fittings = replace(robot.layout.fittings, usb_mm=None)
    two = "\n".join(tool_lines(replace(robot, workshop=shop, layout=replace(robot.layout, fittings=fittings)), []))
    assert "LiPo charger with a balance lead" in two
    assert "plug body" not in two
    unplugged = chosen_parts(shop).battery.model_copy(update={"plug": ""})
    monkeypatch.setattr(tools, "chosen_parts", lambda shop: replace(chosen_parts(shop), battery=unplugged))
    assert "with a balance lead\n" in "\n".join(tool_lines(replace(robot, workshop=shop), []))


@pytest.mark.parametrize("hole_mm", [3.2, 3.4, 3.5, 3.9, 4.1])
def test_a_rod_for_the_springs_pin_passes_its_hole(hole_mm: float) -> None:
    """In halves of a millimetre, half a millimetre thinner than the hole or a little more."""
    robot = built("kenan-2.0")
    through = replace(robot.layout.pin_hole, diameter_mm=hole_mm)
    text = "\n".join(tool_lines(replace(robot, layout=replace(robot.layout, pin_hole=through)), []))
    (rod,) = re.findall(r"rod of at most ([\d.]+) mm", text)
    assert hole_mm - 1.0 < float(rod) <= hole_mm - 0.5 + 1e-9
    assert 2.0 * float(rod) % 1.0 == 0.0


def test_the_tools_of_all_steps_are_in_one_list() -> None:
    """Each once, in the order of the alphabet."""
    robot = built("kenan-2.0")
    steps = assembly_steps(robot)
    tools = {placed.move.tool.name for step in steps for placed in step.placed if placed.move.tool}
    assert len(tools) > 3
    (line,) = (line for line in tool_lines(robot, steps) if line.startswith(f"- {min(tools)}"))
    assert line == f"- {', '.join(sorted(tools))}"
