"""Firmware, wiring and the manifest's `electronics` of a bundle, for both kits."""

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from support.built import built

from jumpcad.building import build
from jumpcad.bundle.electronics import electronics_facts, jumps_per_charge
from jumpcad.bundle.export import export
from jumpcad.bundle.firmware import numbers
from jumpcad.bundle.wiring import wires, wiring_lines, wiring_svg
from jumpcad.design import load_design
from jumpcad.errors import CannotBuildError
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop

NO_LEADS = {"upper resistor", "lower resistor", "pull-up resistor", "diode"}
"""Parts whose own legs reach the controller, where they lie; the battery's plug is on its own cable."""


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Robot:
    path = tmp_path_factory.mktemp("kit") / "my.toml"
    path.write_text(f'[bought]\nkit = "{request.param}"', encoding="utf-8")
    return build(load_design("best-printable"), load_workshop(path), "best-printable")


def test_the_manifest_says_what_each_part_gets_and_bears(robot: Robot) -> None:
    facts = electronics_facts(robot)
    cells = 2 if robot.workshop.bought.regulator else 1
    assert facts["battery_v"] == [pytest.approx(3.3 * cells), pytest.approx(4.2 * cells)]
    for part in (*facts["boards"], facts["motor"]):
        assert part["bears_v"][0] <= part["gets_v"][0] <= part["gets_v"][1] <= part["bears_v"][1]
    assert {board["role"] for board in facts["boards"]} == {"controller", "driver"} | (
        {"regulator"} if cells == 2 else set()
    )
    assert sum(facts["energy_j"].values()) == pytest.approx(robot.layout.drive.train.electrical_j, abs=1e-5)


def test_a_charge_lasts_for_its_energy_over_that_of_a_jump(robot: Robot) -> None:
    charge = {False: 3.7 * 0.3, True: 7.4 * 0.18}[bool(robot.workshop.bought.regulator)] * 3600.0
    assert jumps_per_charge(robot) == int(0.8 * charge / robot.layout.drive.train.electrical_j)


def test_the_firmware_has_time_to_wind_on_an_empty_battery_and_pins_of_the_chip(robot: Robot) -> None:
    found, train = numbers(robot), robot.layout.drive.train
    assert 1500.0 * train.winding_s < found["WIND_MAX_MS"] < 4000.0 * train.winding_s
    assert 0.5 < found["PWM_CAP"] <= 1.0
    pins = [found[f"PIN_{name}"] for name in ("MOTOR", "SLEEP", "READY", "BATTERY", "BUTTON")]
    assert len({*pins}) == 5
    assert not {*pins[:4]} & {2, 8, 9}
    assert found["BATTERY_MIN_V"] == pytest.approx(6.6 if robot.workshop.bought.regulator else 3.3)


def test_the_drawing_names_every_terminal_and_is_the_same_each_time(robot: Robot) -> None:
    drawing = wiring_svg(robot)
    assert drawing == wiring_svg(robot)
    words = [element.text for element in ET.fromstring(drawing).iter("{http://www.w3.org/2000/svg}text")]
    for _, start, end, _, length in wires(robot):
        assert start.pin in words
        assert end.pin in words
        ends = {start.part, end.part}
        if (ends & NO_LEADS and "controller" in ends) or ends == {"battery", "plug"}:
            assert length == 0.0
        else:
            assert 30.0 <= length <= 250.0
    resistors = [end for _, start, end, _, _ in wires(robot) if end.part == "pull-up resistor"]
    assert {(end.pin) for end in resistors} == {"1", "2"}
    table = [line for line in wiring_lines(robot) if line.startswith("| ")]
    assert len(table) == len(wires(robot)) + 1


def test_parts_that_do_not_fit_together_are_not_written(tmp_path: Path) -> None:
    shop = built("kenan-2.0").workshop
    bought = shop.bought.model_copy(update={"battery": "lipo-2s-180"})
    robot = build(load_design("kenan-2.0"), shop.model_copy(update={"bought": bought}), "kenan-2.0")
    with pytest.raises(CannotBuildError, match=r"BAT\+ gets .* 8\.40 V and bears 3\.20 to 4\.20 V: choose a "):
        export(robot, tmp_path / "out", pictures=False)
    assert not (tmp_path / "out").exists()
