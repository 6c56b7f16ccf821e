"""A robot's numbers for its firmware: times by a DC machine's line, rounded to the safe side, and fixed ones."""

import math
import re
from dataclasses import replace

import pytest
from support.built import built
from support.decimals import decimals

from jumpcad.building import build
from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.firmware_numbers import numbers, release_share, start_v
from jumpcad.bundle.guide.operation_values import operation_values
from jumpcad.catalogue import load_catalogue
from jumpcad.checks.sensor import RUN_ON_S
from jumpcad.design import load_design
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.files.rendering import render
from jumpcad.robot import Robot
from jumpcad.workshop import load_workshop


def strong() -> Robot:
    shop = load_workshop()
    kit = shop.catalogue.kits["strong-2s"].model_dump() | {"kit": "strong-2s"}
    return build(load_design("best-bo"), shop.model_copy(update={"bought": shop.bought.model_copy(update=kit)}), "b")


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built("kenan-2.0") if request.param == "light-1s" else strong()


def seconds_a_turn(robot: Robot, volts: float, torque_nm: float) -> float:
    """The motor's line from idle to stall at its rated voltage, with the supply's resistance and the cap of PWM."""
    motor, found = robot.layout.drive.train.motor, numbers(robot)
    winding = motor.voltage_v / motor.stall_current_a
    per_rad_s = (motor.voltage_v - motor.no_load_current_a * winding) / (motor.no_load_rpm * math.pi / 30.0)
    current = motor.no_load_current_a + (motor.stall_current_a - motor.no_load_current_a) * torque_nm / (
        motor.stall_torque_nm
    )
    ohm = winding + supply_of(chosen_parts(robot.workshop)).ohm
    cap = found["PWM_CAP"]
    assert cap is not None
    mean_v = (2.0 * cap - 1.0) * volts  # in the pauses the current flows on against the battery
    return 2.0 * math.pi * robot.layout.drive.train.ratio / ((mean_v - current * ohm) / per_rad_s)


def test_times_are_whole_tenths_of_a_second_on_the_safe_side(robot: Robot) -> None:
    """Half of the shortest turn or less, one and a half of the longest or more."""
    found, low_v, high_v = numbers(robot), *chosen_parts(robot.workshop).battery.range_v
    quickest = 1000.0 * 0.5 * seconds_a_turn(robot, high_v, 0.0)
    slowest = 1000.0 * 1.5 * seconds_a_turn(robot, low_v, robot.layout.drive.train.motor_torque_nm)
    assert quickest - 100.0 < found["WIND_MIN_MS"] <= 1.002 * quickest
    assert 0.99 * slowest <= found["WIND_MAX_MS"] < 1.01 * slowest + 100.0
    released = slowest * release_share(robot)
    assert 0.99 * released <= found["RELEASE_MAX_MS"] < 1.01 * released + 100.0
    assert {found[key] % 100 for key in ("WIND_MIN_MS", "WIND_MAX_MS", "RELEASE_MAX_MS")} == {0}


def test_the_cap_of_pwm_is_rounded_down_and_readings_have_few_decimals(robot: Robot) -> None:
    found, chosen = numbers(robot), chosen_parts(robot.workshop)
    motor, most = robot.layout.drive.train.motor, robot.workshop.safety.motor_torque_max_nm
    share = (1.0 + supply_of(chosen).duty(motor, most)) / 2.0
    assert share - 0.001 < found["PWM_CAP"] <= share
    assert decimals(found["PWM_CAP"]) <= 3
    assert decimals(found["BATTERY_DIVIDER"]) <= 4
    peak = robot.layout.drive.train.peak_current_a * chosen.battery.ohm
    assert found["BATTERY_SAG_V"] == round(peak, 3)
    sensor = robot.layout.sensor
    assert sensor is not None
    assert found["READY_DEG"] == round(math.degrees(sensor.ready_rad), 1)


def test_switches_and_ramps_take_their_time(robot: Robot) -> None:
    """Above what is heard for PWM; 10 ms for a bounce of 5 ms, 0.1 s to full power, 1.5 s in flight and landing."""
    found = numbers(robot)
    usual = {"PWM_HZ": 20000, "SETTLE_MS": 10, "RAMP_MS": 100, "LOW_MS": 200, "LANDING_MS": 1500}
    assert {key: found[key] for key in usual} == usual
    assert found["BUTTON_DELAY_MS"] == 3000
    assert found["LOW_MS"] > found["RAMP_MS"] > found["SETTLE_MS"]


def test_a_battery_is_wound_from_0_2_v_a_cell_over_empty_or_from_its_nominal_voltage() -> None:
    battery = load_catalogue().batteries["lipo-2s-180"]
    assert start_v(battery) == pytest.approx(6.6 + 2 * 0.2)
    assert start_v(battery.model_copy(update={"empty_v": 7.3})) == 7.4
    assert decimals(start_v(battery.model_copy(update={"empty_v": 6.12345}))) == 3


def test_the_motor_runs_on_as_long_as_the_check_of_the_sensor_allows_for(robot: Robot) -> None:
    assert numbers(robot)["AFTER_RELEASE_MS"] / 1000.0 == RUN_ON_S
    assert 0.02 < RUN_ON_S < 0.2  # longer than a switch bounces, and a small part of a turn of the cam


def test_without_a_sensor_a_quarter_of_a_turn_is_a_release(robot: Robot) -> None:
    """With one: from the earliest ready position until it opens at the latest, which is less."""
    assert release_share(replace(robot, layout=replace(robot.layout, sensor=None))) == 0.25
    sensor = robot.layout.sensor
    assert sensor is not None
    turn = sensor.ready_rad + sensor.open_rad + 2.0 * sensor.scatter_rad
    assert release_share(robot) == pytest.approx(turn / (2.0 * math.pi))


def test_the_module_is_python_with_every_number_and_what_it_means(robot: Robot) -> None:
    files = dict(firmware_files(robot))
    assert set(files) == {f"firmware/{name}" for name in ("main.py", "winder.py", "robot.py", "README.md")}
    assert all(text.endswith("\n") for text in files.values())
    space: dict[str, object] = {}
    exec(files["firmware/robot.py"], space)
    assert {key: value for key, value in space.items() if key.isupper()} == numbers(robot)
    assert "# a blocked motor is off after this" in files["firmware/robot.py"]
    readme = files["firmware/README.md"]
    measured = numbers(robot)["PIN_BATTERY"] is not None
    assert ("multiply `BATTERY_DIVIDER` in `robot.py`" in readme) == measured
    assert ("voltage is not measured" in readme) == (not measured)


def test_a_motor_that_hardly_turns_is_given_ten_times_as_long_as_without_a_load(robot: Robot) -> None:
    """At 0.9 of the stall torque a DC machine has a tenth of its idle speed; time is not without an end."""
    drive, battery = robot.layout.drive, chosen_parts(robot.workshop).battery
    train = replace(drive.train, motor_torque_nm=10.0 * drive.train.motor.stall_torque_nm)
    weak = replace(robot, layout=replace(robot.layout, drive=replace(drive, train=train)))
    idle_ms = 1000.0 * seconds_a_turn(robot, battery.range_v[0], 0.0)
    assert numbers(weak)["WIND_MAX_MS"] == pytest.approx(1.5 * 10.0 * idle_ms, rel=0.01)


def test_the_notes_say_what_the_sensors_contact_does(robot: Robot) -> None:
    """It joins its pin to ground, and a resistor pulls the pin up: an open contact reads 1."""
    assert numbers(robot)["READY_LEVEL"] == 1
    for opens in (True, False):
        text = render("firmware/README.md.j2", operation_values(robot) | {"opens": opens})
        assert f"Its contact {'opens' if opens else 'closes'} when it is pressed" in text
    assert operation_values(robot)["opens"]


def test_the_notes_are_for_the_controller(robot: Robot) -> None:
    """Its name, its image among MicroPython's downloads, its button or commands in its place."""
    shop, name = robot.workshop, robot.workshop.bought.controller
    bare = {"button": "", "micropython": "", "description": "A board of mine"}
    board = shop.catalogue.boards[name].model_copy(update=bare)
    own = replace(robot, workshop=shop.model_copy(update={"boards": shop.boards | {name: board}}))
    for one, said, image, button in (
        (robot, "XIAO", chosen_parts(shop).controller.micropython, True),
        (own, "A board of mine", "look for the board's name or its chip", False),
    ):
        text = dict(firmware_files(one))["firmware/README.md"]
        assert re.search(rf"For the .*{said}.*, in MicroPython\.", text)
        assert f"micropython.org/download ({image});" in text
        for words in ("Put the board into its bootloader: hold the button", "press the same button once more"):
            assert (words in text) == button, words
        assert ("Put the board into its bootloader as its maker says" in text) != button
        assert ("Type `wind`. Type `jump`." in text) != button


def test_the_notes_have_the_numbers_of_the_program(robot: Robot) -> None:
    """Times in seconds, voltages as they are, the cap of PWM in percent."""
    values = numbers(robot)
    text = dict(firmware_files(robot))["firmware/README.md"]
    for pattern, key, factor in (
        (r"after ([\d.]+) s without the sensor", "WIND_MAX_MS", 1000.0),
        (r"at most ([\d.]+) % of PWM", "PWM_CAP", 0.01),
        (r"from ([\d.]+) V at rest it finishes", "BATTERY_EMPTY_V", 1.0),
        (r"For ([\d.]+) s after a jump", "LANDING_MS", 1000.0),
        (r"[Bb]elow ([\d.]+) V at rest", "BATTERY_MIN_V", 1.0),
        (r"releases after ([\d.]+) s", "BUTTON_DELAY_MS", 1000.0),
    ):  # fmt: skip
        found = re.search(pattern, text)
        assert found is not None, pattern
        assert factor * float(found[1]) == pytest.approx(values[key]), pattern
    unmeasured = operation_values(robot) | {"program": values | {"PIN_BATTERY": None}}
    assert "nothing stops the robot on an empty battery" in render("firmware/README.md.j2", unmeasured)
    on_pin_0 = operation_values(robot) | {"program": values | {"PIN_BATTERY": 0}}
    assert render("firmware/README.md.j2", on_pin_0) == text  # GPIO 0 is a pin
