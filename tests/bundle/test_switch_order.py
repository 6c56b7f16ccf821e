"""The line on the slide switch: sizes of the catalogue's, the plate that it must reach through, the blocked motor."""

import re
from dataclasses import replace

import pytest
from support.built import built

from jumpcad.bundle.expected import expected
from jumpcad.bundle.switch_order import switch_order
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.workshop import Workshop, load_workshop


def numbers(words: str, line: str) -> list[float]:
    found = re.search(words, line)
    assert found is not None, line
    return [float(one) for one in found.groups()]


def of_kit(name: str) -> Workshop:
    shop = load_workshop()
    kit = shop.catalogue.kits[name].model_dump() | {"kit": name}
    return shop.model_copy(update={"bought": shop.bought.model_copy(update=kit)})


def test_the_switch_asked_for_is_that_of_the_drawing() -> None:
    """15 mm between holes (SS-12F15); it goes through the plate, and 1.5 mm of slider are left for a finger."""
    robot = built("kenan-2.0")
    (line,) = switch_order(robot)
    switch = load_workshop().catalogue.components[robot.workshop.bought.switch]
    sizes = numbers(r"at most ([\d.]+) x ([\d.]+) mm, ([\d.]+) mm high behind its ears, ([\d.]+) A or more", line)
    assert sizes == [switch.length_mm, switch.width_mm, switch.height_mm, switch.rated_a]
    assert numbers(r"slide switch: ([\d.]+) mm between", line) == [15.0]
    plate, out = numbers(r"in a plate of ([\d.]+) mm: it must stand out of the ears by ([\d.]+) mm", line)
    assert plate == pytest.approx(robot.workshop.body.plate_mm, abs=0.05)
    assert out == pytest.approx(plate + 1.5)


@pytest.mark.parametrize("kit", ["light-1s", "strong-2s"])
def test_a_switch_bears_the_blocked_motor_on_a_full_battery(kit: str) -> None:
    """Half an ampere, which sellers state, is enough or not; two cells are not built without a switch."""
    robot = replace(built("kenan-2.0"), workshop=of_kit(kit))
    (line,) = switch_order(robot)
    volts, amperes = numbers(r"A or more at ([\d.]+) V \(the blocked motor draws ([\d.]+) A\)", line)
    cells = 2 if kit == "strong-2s" else 1
    assert volts == pytest.approx(4.2 * cells)
    motor, supply = robot.layout.drive.train.motor, supply_of(chosen_parts(robot.workshop))
    driven = supply.driven(motor, volts, robot.workshop.safety.motor_torque_max_nm)
    assert amperes == pytest.approx(driven.stall_current_a, abs=0.005)
    assert ("one rated 0.5 A bears that" in line) == (amperes <= 0.5)
    assert ("too little for this motor" in line) == (amperes > 0.5)
    assert ("is not built without a switch" in line) == (cells == 2)
    assert ("leave the switch and its two screws out" in line) == (cells == 1)


def test_a_robot_without_a_switch_orders_none() -> None:
    robot = built("kenan-2.0")
    for gone in ({"switch": None}, {"switch_mm": None}):
        fittings = replace(robot.layout.fittings, **gone)
        assert list(switch_order(replace(robot, layout=replace(robot.layout, fittings=fittings)))) == []


@pytest.mark.parametrize(
    ("plate_mm", "screw", "reaches"), [(2.4, "M2 x 5", True), (3.6, "M2 x 6", False), (4.0, "M2 x 8", False)]
)
def test_thick_plates_need_longer_screws_and_sliders(plate_mm: float, screw: str, reaches: bool) -> None:
    """Plate, an ear of 0.5 mm and a nut of 1.6 mm (ISO 4032); the nearest switch's slider is 5 mm, 1.5 are needed."""
    robot = built("kenan-2.0")
    lateral = robot.layout.lateral
    plate = (lateral.inside[0] - plate_mm, lateral.inside[0])
    thick = replace(robot, layout=replace(robot.layout, lateral=replace(lateral, right_plate=plate)))
    (line,) = switch_order(thick)
    assert f"two screws {screw} ISO 14580 and two nuts M2" in line
    assert ("Its slider is too short for this plate" in line) is not reaches
    assert expected(thick, [])["nutted_screws"] == f"screws {screw} ISO 14580"
