"""Numbers of one robot for its controller: times of gear train, cam and battery, thresholds of the battery."""

import math

from jumpcad.catalogue import Battery
from jumpcad.drive.motor import free_speed_rad_s
from jumpcad.electronics.nets import gpio
from jumpcad.landing.series import LANDING_S, REST_S
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.robot.sensor.limits import RUN_ON_S
from jumpcad.robot.sensor.place import SensorPlace
from jumpcad.robot.steering.limits import steers
from jumpcad.robot.steering.place import Steering

BUTTON_DELAY_MS = 3000
"""Time to step back after the button was pressed; judgement."""
SLOWEST = 1.5
"""Time allowed for winding over that on an empty battery; judgement: cold grease and scatter of the motor."""
TOO_EARLY = 0.5
"""Share of the shortest time for a turn, or a release, before which the sensor is not believed; judgement."""
SETTLE_MS = 10
"""How long a switch must keep its state; usual of small switches: they bounce for 1 to 5 ms."""
AFTER_RELEASE_MS = round(1000.0 * RUN_ON_S)
"""Motor runs on after the sensor has opened: twice the leg's fall, and past the switch's bounce; judgement."""
LANDING_MS = round(1000.0 * LANDING_S)
"""How long after a jump commands and sensor are ignored: the flight, and the landing's 300 m/s² and more."""
REST_MS = round(1000.0 * REST_S)
"""How long a robot that jumps in a row is left alone after a landing, and when it is wound."""
RAMP_MS = 100
"""In which the motor gets its power; judgement."""
LOW_MS = 200
"""How long the loaded battery must be low; judgement: longer than the motor's start."""
WATCHDOG_MS = 1000
"""The least that MicroPython's `machine.WDT` takes on every board; a step takes 2 ms, a blocked USB port 200 ms."""
PWM_HZ = 20_000
RESERVE_V = 0.2
"""Per cell, over the empty voltage at rest, with which winding begins: what is begun is not to be refused half-way.
Judgement: a winding lowers the voltage by less, also with an old battery of three times the resistance."""


@decided_once
def numbers(robot: Robot) -> dict[str, float | int | None]:
    """Return this robot's numbers, by the names that the firmware uses."""
    workshop, train = robot.workshop, robot.layout.drive.train
    chosen = robot.layout.electronics
    supply, wiring = robot.supply, robot.wiring
    torque_max = workshop.safety.motor_torque_max_nm
    slow = supply.driven(train.motor, supply.empty_v, torque_max)
    fast = supply.driven(train.motor, supply.full_v, torque_max)
    fastest_s = 2.0 * math.pi * train.ratio / (fast.no_load_rpm * math.pi / 30.0)
    share = min(train.motor_torque_nm / slow.stall_torque_nm, 0.9)
    slowest_s = 2.0 * math.pi * train.ratio / (slow.no_load_rpm * math.pi / 30.0) / (1.0 - share)
    controller, sensor = chosen.controller, robot.layout.sensor
    pins = {signal: gpio(controller, pin) for signal, pin in wiring.pins.items()}
    return {
        "PIN_MOTOR": pins.get("motor"),
        "PIN_SLEEP": pins.get("sleep"),
        "PIN_READY": pins.get("ready"),
        "READY_LEVEL": wiring.ready_level,
        "PIN_BATTERY": pins.get("battery"),
        "PIN_BUTTON": gpio(controller, controller.button) if controller.button else None,
        "PIN_STEER_LEFT": pins.get("steer"),
        "PIN_STEER_RIGHT": pins.get("steer_reverse"),
        "PIN_GYRO_DATA": pins.get("gyro_data"),
        "PIN_GYRO_CLOCK": pins.get("gyro_clock"),
        **_steering_numbers(robot),
        "PWM_HZ": PWM_HZ,
        "PWM_CAP": math.floor(1000.0 * supply.pwm(train.motor, torque_max)) / 1000.0,
        "BATTERY_DIVIDER": round(wiring.divider, 4),
        "BATTERY_MIN_V": start_v(chosen.battery),
        "BATTERY_EMPTY_V": supply.empty_v,
        "BATTERY_SAG_V": round(train.peak_current_a * chosen.battery.ohm, 3),
        "LOW_MS": LOW_MS,
        "WIND_MIN_MS": math.floor(TOO_EARLY * fastest_s * 10.0) * 100,
        "WIND_MAX_MS": math.ceil(SLOWEST * slowest_s * 10.0) * 100,
        "RELEASE_MIN_MS": _release_min_ms(robot.layout.sensor, 2.0 * math.pi / fastest_s),
        "RELEASE_MAX_MS": math.ceil(SLOWEST * slowest_s * release_share(robot) * 10.0) * 100,
        "READY_DEG": None if sensor is None else round(math.degrees(sensor.ready_rad), 1),
        "AFTER_RELEASE_MS": AFTER_RELEASE_MS,
        "SETTLE_MS": SETTLE_MS,
        "LANDING_MS": LANDING_MS,
        "REST_MS": REST_MS,
        "BUTTON_DELAY_MS": BUTTON_DELAY_MS,
        "RIGHTS_ITSELF": robot.layout.of(Cage) is not None,
        "RAMP_MS": RAMP_MS,
        "WATCHDOG_MS": WATCHDOG_MS,
    }


def _steering_numbers(robot: Robot) -> dict[str, float | int | None]:
    """Return voltage and time of the steering wheel's motor, as on an empty battery; None without one."""
    if (place := robot.layout.of(Steering)) is None:
        return dict.fromkeys(("STEER_V", "STEER_MS_PER_DEG"))
    slow, does = robot.supply.driven(place.motor, robot.supply.empty_v, math.inf), steers(robot)
    speed = free_speed_rad_s(slow) * max(1.0 - does.need_nm / slow.stall_torque_nm, 0.1)
    ms = float(1000.0 * 2.0 * math.pi / speed / does.turn_per_rev_deg)
    return {"STEER_V": round(slow.voltage_v, 2), "STEER_MS_PER_DEG": round(ms, 1)}


def start_v(battery: Battery) -> float:
    """Return the voltage at rest from which the robot winds (V): the reserve over empty, at most the nominal one."""
    return round(min(battery.range_v[0] + RESERVE_V * battery.cells, battery.voltage_v), 3)


def _release_min_ms(sensor: SensorPlace | None, fastest_rad_s: float) -> int:
    """Return the share `TOO_EARLY` of the shortest time from the ready position until the sensor opens (ms)."""
    if sensor is None:
        return 0
    shortest_rad = sensor.ready_rad + sensor.open_rad - 2.0 * sensor.scatter_rad - sensor.needs.stop_rad
    return math.floor(1000.0 * TOO_EARLY * max(shortest_rad, 0.0) / fastest_rad_s)


def release_share(robot: Robot) -> float:
    """Return the share of a turn from the earliest ready position until the sensor opens at the latest."""
    sensor = robot.layout.sensor
    if sensor is None:
        return 0.25
    return (sensor.ready_rad + sensor.open_rad + 2.0 * sensor.scatter_rad) / (2.0 * math.pi)
