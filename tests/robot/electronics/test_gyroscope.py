"""A gyroscope that measures the turns of a robot with a steering wheel: its seat, wires, order and firmware."""

from functools import lru_cache

import pytest

import jumpcad
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide.markdown import write_guide
from jumpcad.bundle.manifest import own_path
from jumpcad.checks import check
from jumpcad.errors import JumpcadError
from jumpcad.robot.electronics.limits import electronics_findings
from jumpcad.robot.robot import Robot
from jumpcad.workshop import load_workshop, varied


@lru_cache(maxsize=4)
def measuring(name: str = "kenan-2.0", **more: str) -> Robot:
    """Return a template with a wheel and a gyroscope."""
    values = {"steering.wheel": "o-ring", "steering.gyroscope": "lsm6dso"} | more
    design = jumpcad.load_design(name)
    return jumpcad.build(design, varied(load_workshop(design.workshop_name or "default"), values))


@pytest.mark.thorough
def test_it_has_a_seat_four_wires_a_line_in_the_bill_and_a_step() -> None:
    """The carrier weighs 0.6 g. Lines that are pulled up fit GPIO 2 and 8 of an ESP32-C3, which choose how it boots."""
    robot = measuring()
    (board,) = (one for one in robot.hardware if one.name == "gyroscope")
    assert 1000.0 * board.mass_kg == pytest.approx(0.6)
    nets = {net.name: [str(end) for end in net.terminals] for net in robot.wiring.nets}
    ends = {end: name for name, wired in nets.items() for end in wired if end.startswith("gyroscope ")}
    assert ends == {
        "gyroscope VIN": "logic supply",
        "gyroscope GND": "ground",
        "gyroscope SDA": "gyro_data",
        "gyroscope SCL": "gyro_clock",
    }
    assert "controller 3V3" in nets["logic supply"]
    used = [value for name, value in numbers(robot).items() if name.startswith("PIN_") and value is not None]
    assert len(set(used)) == len(used)
    assert (numbers(robot)["PIN_GYRO_CLOCK"], numbers(robot)["PIN_GYRO_DATA"]) == (2, 8)
    (supply,) = (one for one in electronics_findings(robot) if one.name == "supply_voltage_gyroscope")
    assert (supply.value, supply.severity) == (pytest.approx(3.3), "info")
    (item,) = (one for one in bill_of_materials(robot).items if "Pololu 2798" in one.name)
    assert item.quantity == 1
    guide = write_guide(robot)
    wiring = next(text for name, text in guide.items() if name == "wiring.md")
    assert "gyroscope" in wiring.partition("Upper tray with the boards")[2]
    assert "VDD, SA0, CS, INT1 and INT2 stay empty" in wiring


@pytest.mark.thorough
def test_its_firmware_compiles_and_that_of_robots_without_stays_as_it_is() -> None:
    files, plain = (dict(firmware_files(robot)) for robot in (measuring(), measuring(**{"steering.gyroscope": ""})))
    assert "firmware/gyroscope.py" in files
    assert [own_path(path) for path in files] == list(files)  # what a manifest may list
    assert "firmware/gyroscope.py" not in plain
    assert "from gyroscope import Wheel\n" in files["firmware/main.py"]
    assert "GYRO" not in "".join(plain.values()).upper()
    assert "gyroscope.py :`" in files["firmware/README.md"]
    compile(files["firmware/robot.py"], "robot.py", "exec")


@pytest.mark.thorough
def test_both_kits_keep_all_limits_with_it() -> None:
    for kit in ("light-1s", "strong-2s"):
        robot = measuring("best-steered", **{"bought.kit": kit})
        assert [one.message for one in check(robot) if one.severity == "error"] == []


def test_a_gyroscope_without_a_wheel_and_a_board_that_is_none_are_refused() -> None:
    shop = load_workshop()
    with pytest.raises(JumpcadError, match=r'steering.gyroscope.*lsm6dso.*wheel = "o-ring"'):
        varied(shop, {"steering.gyroscope": "lsm6dso"})
    with pytest.raises(JumpcadError, match=r"is a driver, no gyroscope.*lsm6dso"):
        varied(shop, {"steering.wheel": "o-ring", "steering.gyroscope": "drv8833"})
