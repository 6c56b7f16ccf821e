"""Firmware, drawings of leads and the manifest's `electronics` of a bundle, for both kits."""

import math
from typing import Any

import numpy as np
import pytest
from support.built import of_kit

from jumpcad.bundle.drawings.lead_lines import leads_of
from jumpcad.bundle.facts import electronics_facts
from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.dimensions import TIE_SLOT_MM
from jumpcad.electronics.supply import chosen_parts, supply_of
from jumpcad.mechanism.model import BODY, body_poses
from jumpcad.robot.electronics.limits import jumps_per_charge
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from jumpcad.transforms import chained


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return of_kit(request.param)


def test_the_manifest_says_what_each_part_gets_and_bears(robot: Robot) -> None:
    facts = electronics_facts(robot)
    cells = 2 if robot.workshop.bought.regulator else 1
    assert facts["kit"] == {1: "light-1s", 2: "strong-2s"}[cells]
    assert facts["battery"] == robot.workshop.bought.battery == {1: "lipo-1s-300", 2: "lipo-2s-180"}[cells]
    assert facts["battery_v"] == [pytest.approx(3.3 * cells), pytest.approx(4.2 * cells)]
    for part in (*facts["boards"], facts["motor"]):
        assert part["bears_v"][0] <= part["gets_v"][0] <= part["gets_v"][1] <= part["bears_v"][1]
    assert {board["role"] for board in facts["boards"]} == {"controller", "driver"} | (
        {"regulator"} if cells == 2 else set()
    )
    train, safety = robot.layout.drive.train, robot.workshop.safety
    assert 0.0 < facts["pwm_cap"] <= 1.0
    assert 2.0 * facts["pwm_cap"] - 1.0 == pytest.approx(
        supply_of(chosen_parts(robot.workshop)).duty(train.motor, safety.motor_torque_max_nm), abs=1e-3
    )
    boards_w = supply_of(chosen_parts(robot.workshop)).boards_w
    assert facts["energy_j"]["boards"] == pytest.approx(boards_w * train.winding_s, abs=1e-4)
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
    cells = 2 if robot.workshop.bought.regulator else 1
    assert found["BATTERY_MIN_V"] == pytest.approx(3.5 * cells)
    assert found["BATTERY_EMPTY_V"] == pytest.approx(3.3 * cells)
    driver = next(board for board in electronics_facts(robot)["boards"] if board["role"] == "driver")
    assert found["BATTERY_EMPTY_V"] - found["BATTERY_SAG_V"] == pytest.approx(driver["gets_v"][0], abs=0.001)


def test_drawn_leads_pass_the_plates_but_do_not_run_in_them(robot: Robot) -> None:
    """A lead of AWG 28 in silicone is 1.2 mm thick: no corner of its line is nearer to a plate's face.

    Those of sensor and motor pass one plate, once and square to it; the others none.
    """
    lateral = robot.layout.lateral
    for lead in leads_of(robot):
        passed = 0
        for low, high in (lateral.left_plate, lateral.right_plate):
            y = lead.points_mm[:, 1]
            assert ((y < low - 0.6) | (y > high + 0.6)).all(), (lead.number, lead.parts)
            (through,) = np.nonzero(np.diff(y > high))
            passed += len(through)
            assert np.diff(lead.points_mm, axis=0)[through][:, ::2] == pytest.approx(0.0), (lead.number, lead.parts)
        assert passed == len({"sensor", "motor"} & set(lead.parts)), (lead.number, lead.parts)


def test_a_turn_against_the_largest_torque_on_an_empty_battery_ends_in_time(robot: Robot) -> None:
    """Current from the torque, speed from what it leaves of the voltage; half as long again before the motor is off."""
    train, found = robot.layout.drive.train, numbers(robot)
    motor, supply = train.motor, supply_of(chosen_parts(robot.workshop))
    winding = motor.voltage_v / motor.stall_current_a
    k = (motor.voltage_v - motor.no_load_current_a * winding) / (motor.no_load_rpm * math.pi / 30.0)
    per_nm = (motor.stall_current_a - motor.no_load_current_a) / motor.stall_torque_nm
    current = motor.no_load_current_a + per_nm * train.motor_torque_nm
    empty = 6.6 if robot.workshop.bought.regulator else 3.3
    speed = ((2.0 * found["PWM_CAP"] - 1.0) * empty - current * (winding + supply.ohm)) / k
    seconds = 2.0 * math.pi * train.ratio / speed
    assert 1.49 * seconds <= found["WIND_MAX_MS"] / 1000.0 <= 1.52 * seconds + 0.1


def test_a_quick_turn_on_a_full_battery_is_not_taken_for_a_broken_lead(robot: Robot) -> None:
    """No turn of the cam is quicker than that of the unloaded motor on a full battery, by Kirchhoff's law.

    The sensor is believed from half of that time on; below a quarter a broken lead would hardly ever be noticed.
    """
    motor, found = robot.layout.drive.train.motor, numbers(robot)
    full = 8.4 if robot.workshop.bought.regulator else 4.2
    supply, winding = supply_of(chosen_parts(robot.workshop)), motor.voltage_v / motor.stall_current_a
    lost, rated = (motor.no_load_current_a * ohm for ohm in (winding + supply.ohm, winding))
    rpm = motor.no_load_rpm * ((2.0 * found["PWM_CAP"] - 1.0) * full - lost) / (motor.voltage_v - rated)
    quickest_ms = 60_000.0 * robot.layout.drive.train.ratio / rpm
    assert 0.25 * quickest_ms < found["WIND_MIN_MS"] <= 0.5 * quickest_ms * 1.01


def test_a_release_has_time_from_the_earliest_ready_position_until_the_sensor_opens_at_the_latest(robot: Robot) -> None:
    """As a whole turn has: at the same slow speed, and the same reserve; both are rounded up to 0.1 s."""
    found, sensor = numbers(robot), robot.layout.sensor
    assert sensor is not None
    earliest, latest = sensor.ready_rad + sensor.scatter_rad, sensor.open_rad + sensor.scatter_rad
    share = math.degrees(earliest + latest) / 360.0
    assert share * (found["WIND_MAX_MS"] - 100.0) <= found["RELEASE_MAX_MS"] <= share * found["WIND_MAX_MS"] + 100.0


def test_the_tie_over_the_balance_lead_has_walls_beside_its_slots(robot: Robot) -> None:
    """Before the battery with its play of 0.5 mm and a stop of 1.2 mm, behind the tray's end: 1.6 mm to either side."""
    things = {item.name: 1000.0 * item.mass.com_m[0] for item in robot.hardware}
    if not robot.workshop.bought.regulator:
        assert "tie_balance_lead" not in things
        return
    electronics = robot.layout.electronics
    stop = things["battery"] + electronics.battery.length_mm / 2.0 + 0.5 + 1.2
    end = robot.layout.tray_mm[0] + electronics.length_mm / 2.0
    slot = TIE_SLOT_MM[1] / 2.0
    assert things["tie_balance_lead"] - slot - stop >= 1.6 - 1e-6
    assert end - things["tie_balance_lead"] - slot >= 1.6 - 1e-6


def test_small_parts_lie_beside_the_controller_and_apart(robot: Robot) -> None:
    """Bodies of 6.3 x 2.3 mm between the boards, outside their seats and their ties' slots."""
    electronics, inside = robot.layout.electronics, robot.layout.lateral.inside
    seats, slots = electronics.seats(inside), electronics.tie_slots(inside)
    places = electronics.small_seats(inside)[: 4 if robot.workshop.bought.regulator else 3]
    assert len(places) >= 3
    boxes = [(place.x_mm, place.y_mm, 2.3, 6.3) for place in places]
    kept = [(s.x_mm, s.y_mm, s.size_mm[0], s.size_mm[1]) for role, s in seats.items() if role != "battery"]
    kept += [(x, y, *size) for role in ("controller", "driver") for x, y, size in slots[role]]
    for index, box in enumerate(boxes):
        for other in (*boxes[index + 1 :], *kept):
            apart = [abs(box[i] - other[i]) - (box[i + 2] + other[i + 2]) / 2.0 for i in (0, 1)]
            assert max(apart) > -1e-9
    names = {item.name for item in robot.hardware}
    assert {"wiring_resistor_upper", "wiring_resistor_lower", "wiring_resistor_pull_up"} <= names
    assert ("tie_balance_lead" in names) == bool(robot.workshop.bought.regulator)


@pytest.mark.thorough
def test_the_battery_leaves_the_finished_robot_to_the_front(robot: Robot) -> None:
    """Lifted over the stops of 2 mm: nothing but its strap and its lead's tie is in the way of its box."""
    poses, shown = body_poses(robot), {thing.name: thing for thing in visuals(robot)}
    T_body_world = np.linalg.inv(poses[BODY])

    def triangles(name: str) -> Any:
        thing = shown[name]
        pose = T_body_world @ chained(poses[thing.body], thing.T_body_mesh)
        points = np.asarray(thing.mesh.vertices) / 1000.0 @ pose[:3, :3].T + pose[:3, 3]
        return 1000.0 * points[np.asarray(thing.mesh.faces)]

    corners = triangles("battery").reshape(-1, 3)
    lifted, out = np.array([0.0, 0.0, 2.1]), np.array([150.0, 0.0, 0.0])
    low, high = corners.min(axis=0) + lifted, corners.max(axis=0) + lifted + out
    for name in shown.keys() - {"battery", "strap_battery", "tie_balance_lead"}:
        mesh = triangles(name)
        beside = (mesh.min(axis=1) >= high - 1e-6) | (mesh.max(axis=1) <= low + 1e-6)
        assert beside.any(axis=1).all(), name
