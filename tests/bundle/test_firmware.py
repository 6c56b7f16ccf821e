"""A robot's numbers for its firmware: times by a DC machine's line, rounded to the safe side, and fixed ones."""

import math
from dataclasses import replace

import pytest
from support.built import built, of_kit
from support.decimals import decimals

from jumpcad.bundle.firmware import firmware_files
from jumpcad.bundle.firmware_numbers import numbers, release_share, start_v
from jumpcad.catalogue import load_catalogue
from jumpcad.electronics.supply import chosen_parts, supply_of
from jumpcad.robot.robot import Robot


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return built("kenan-2.0") if request.param == "light-1s" else of_kit("strong-2s", "best-bo")


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


def test_a_battery_is_wound_from_0_2_v_a_cell_over_empty_or_from_its_nominal_voltage() -> None:
    battery = load_catalogue().batteries["lipo-2s-180"]
    assert start_v(battery) == pytest.approx(6.6 + 2 * 0.2)
    assert start_v(battery.model_copy(update={"empty_v": 7.3})) == 7.4
    assert decimals(start_v(battery.model_copy(update={"empty_v": 6.12345}))) == 3


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
    without = ("PIN_GYRO_DATA", "PIN_GYRO_CLOCK")  # this robot has no gyroscope
    said = {key: value for key, value in numbers(robot).items() if key not in without}
    said |= {"NAME": robot.name, "BLUETOOTH": True}
    assert {key: value for key, value in space.items() if key.isupper()} == said
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
