"""firmware/: what the controller runs. The logic and the pins' use are templates; `robot.py` has this robot's numbers.

Times follow from the gear train, the cam and the battery; thresholds from the battery.
"""

import math
import re
from collections.abc import Iterator, Mapping

from jumpcad.bundle.battery_reading import state_off_v
from jumpcad.bundle.operation import (
    BUTTON_DELAY_MS,
    bootloader,
    by_button,
    cable,
    charging,
    charging_loaded,
    stops_the_motor,
    to_stop,
)
from jumpcad.bundle.stuck import UNTRIED, stuck_items
from jumpcad.catalogue import Battery
from jumpcad.checks.sensor import RUN_ON_S
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import gpio, wiring_of
from jumpcad.electronics.supply import supply_of
from jumpcad.files import templates_folder
from jumpcad.files.markdown import plain
from jumpcad.robot import Robot

FOLDER = "firmware"
COPIED = ("main.py", "winder.py")
SLOWEST = 1.5
"""Time allowed for winding over that on an empty battery; judgement: cold grease and scatter of the motor."""
TOO_EARLY = 0.5
"""Share of the shortest time for a turn before which the sensor is not believed after a release; judgement."""
SETTLE_MS = 10
"""How long a switch must keep its state; usual of small switches: they bounce for 1 to 5 ms."""
AFTER_RELEASE_MS = round(1000.0 * RUN_ON_S)
"""Motor runs on after the sensor has opened: twice the leg's fall, and past the switch's bounce; judgement."""
LANDING_MS = 1500
"""How long after a jump commands and sensor are ignored: the flight, and the landing's 300 m/s² and more; judgement."""
RAMP_MS = 100
"""In which the motor gets its power; judgement."""
LOW_MS = 200
"""How long the loaded battery must be low; judgement: longer than the motor's start."""
PWM_HZ = 20_000
RESERVE_V = 0.2
"""Per cell, over the empty voltage at rest, with which winding begins: what is begun is not to be refused half-way.
Judgement: a winding lowers the voltage by less, also with an old battery of three times the resistance."""


def numbers(robot: Robot) -> dict[str, float | int | None]:
    """Return this robot's numbers, by the names that the firmware uses."""
    workshop, train = robot.workshop, robot.layout.drive.train
    chosen = chosen_parts(workshop)
    supply, wiring = supply_of(chosen), wiring_of(chosen, workshop.bought.pins)
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
        "PWM_HZ": PWM_HZ,
        "PWM_CAP": math.floor(1000.0 * supply.pwm(train.motor, torque_max)) / 1000.0,
        "BATTERY_DIVIDER": round(wiring.divider, 4),
        "BATTERY_MIN_V": start_v(chosen.battery),
        "BATTERY_EMPTY_V": supply.empty_v,
        "BATTERY_SAG_V": round(train.peak_current_a * chosen.battery.ohm, 3),
        "LOW_MS": LOW_MS,
        "WIND_MIN_MS": math.floor(TOO_EARLY * fastest_s * 10.0) * 100,
        "WIND_MAX_MS": math.ceil(SLOWEST * slowest_s * 10.0) * 100,
        "RELEASE_MAX_MS": math.ceil(SLOWEST * slowest_s * release_share(robot) * 10.0) * 100,
        "READY_DEG": None if sensor is None else round(math.degrees(sensor.ready_rad), 1),
        "AFTER_RELEASE_MS": AFTER_RELEASE_MS,
        "SETTLE_MS": SETTLE_MS,
        "LANDING_MS": LANDING_MS,
        "BUTTON_DELAY_MS": BUTTON_DELAY_MS,
        "RAMP_MS": RAMP_MS,
    }


def start_v(battery: Battery) -> float:
    """Return the voltage at rest from which the robot winds (V): the reserve over empty, at most the nominal one."""
    return round(min(battery.range_v[0] + RESERVE_V * battery.cells, battery.voltage_v), 3)


def release_share(robot: Robot) -> float:
    """Return the share of a turn from the earliest ready position until the sensor opens at the latest."""
    sensor = robot.layout.sensor
    if sensor is None:
        return 0.25
    return (sensor.ready_rad + sensor.open_rad + 2.0 * sensor.scatter_rad) / (2.0 * math.pi)


WORDS = {
    "PIN_MOTOR": "GPIO numbers",
    "READY_LEVEL": "of the sensor's pin at the ready position: 1 with a contact that opens there (NC)",
    "PIN_BATTERY": "None: not measured",
    "PIN_BUTTON": "on the board; None: serial commands alone",
    "PWM_CAP": "largest share of PWM: keeps gearbox and winding within their limits on a full battery",
    "BATTERY_DIVIDER": "battery's voltage over that at its pin; to calibrate it, see README.md",
    "BATTERY_MIN_V": "below this, at rest, it does not begin to wind",
    "BATTERY_EMPTY_V": "below this, at rest, it does not finish either what was begun",
    "BATTERY_SAG_V": "by this below the last, while it winds, it stops: the least voltage that the boards are checked "
    "for",
    "LOW_MS": "when it is so low for so long",
    "WIND_MIN_MS": "right after a jump the sensor is not believed before this",
    "WIND_MAX_MS": "a blocked motor is off after this at the latest",
    "RELEASE_MAX_MS": "as above, from the ready position over the drop",
    "READY_DEG": "cam angle before the drop at which the sensor is pressed; for information",
    "AFTER_RELEASE_MS": "motor runs on after the sensor is free",
    "SETTLE_MS": "a switch counts after this",
    "LANDING_MS": "ignored after a jump",
    "BUTTON_DELAY_MS": "to step back",
}


CALIBRATE = """The battery's voltage that `state` prints may be off by {off} V. Calibrate it once: measure the
  voltage at the plug with a multimeter, motor off, multiply `BATTERY_DIVIDER` in `robot.py` by the multimeter's voltage
  over that of `state`, and copy the file again (2). Without that the limits below are off by as much."""
LOW = "Below {:g} V at rest it does not begin to wind: charge the battery."
UNMEASURED = (
    "Nothing stops it on an empty battery, which is spoiled then: measure the battery at its plug before use, and "
    "charge it below {:g} V at rest."
)
"""Of a battery that the controller measures, and of one that it does not."""
OPENING = """The sensor's contact opens when it is pressed, so a broken lead, a dirty contact or a missing ground reads
  as pressed: the motor stops. `wind` that says `ready` at once, or `fault: sensor pressed too early`, means a broken
  lead where the springs are not loaded. To unload springs that are: `wind`, `jump`, `wind`, `jump`, until the leg
  falls; each `jump` turns the cam a little and ends in `fault`. A lead that is shorted to ground reads as free: the
  motor releases the springs by itself and runs until the time-out."""
CLOSING = """The sensor's contact closes when it is pressed. With a lead broken the motor does not stop when ready: it
  releases the springs by itself and runs until the time-out."""


def firmware_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and text of every file of the firmware.

    Raises
    ------
    CannotBuildError
        If a pin that the workshop names is none of the controller's GPIOs.
    """
    values = numbers(robot)
    folder = templates_folder() / FOLDER
    for name in COPIED:
        yield f"{FOLDER}/{name}", (folder / name).read_text(encoding="utf-8")
    yield f"{FOLDER}/robot.py", _module(robot, values)
    yield f"{FOLDER}/README.md", _filled((folder / "README.md").read_text(encoding="utf-8"), robot, values)


def _module(robot: Robot, values: Mapping[str, float | int | None]) -> str:
    lines = [f'"""Numbers of one robot, computed by jumpcad: motor {robot.layout.drive.train.motor.name}."""', ""]
    for key, value in values.items():
        lines.append(f"{key} = {value!r}{f'  # {WORDS[key]}' if key in WORDS else ''}")
    return "\n".join(lines) + "\n"


def _calibrate(robot: Robot) -> str:
    """Return how the battery's reading is calibrated, where it is measured."""
    chosen = chosen_parts(robot.workshop)
    wiring = wiring_of(chosen, robot.workshop.bought.pins)
    if wiring.upper_ohm is None:
        return "The battery's voltage is not measured: a robot that winds slowly needs charging."
    return CALIBRATE.format(off=f"{state_off_v(wiring, chosen.battery.voltage_v):.1f}")


def _filled(text: str, robot: Robot, values: Mapping[str, float | int | None]) -> str:
    chosen = chosen_parts(robot.workshop)
    facts = {
        "CONTROLLER": plain(chosen.controller.description),
        "WIND_S": f"{robot.layout.drive.train.winding_s:.1f}",
        "WIND_MAX_S": f"{(values['WIND_MAX_MS'] or 0) / 1000.0:.1f}",
        "SENSOR": OPENING if values["READY_LEVEL"] else CLOSING,
        "MIN_V": f"{values['BATTERY_MIN_V']:g}",
        "LOW": (LOW if values["PIN_BATTERY"] is not None else UNMEASURED).format(values["BATTERY_MIN_V"] or 0.0),
        "EMPTY_V": f"{values['BATTERY_EMPTY_V']:g}",
        "STOPS": stops_the_motor(chosen),
        "STOP_BY": to_stop(chosen),
        "BOOT": bootloader(chosen.controller),
        "LANDING_S": f"{LANDING_MS / 1000.0:g}",
        "CALIBRATE": _calibrate(robot),
        "IMAGE": chosen.controller.micropython or "look for the board's name or its chip",
        "CAP": f"{100.0 * (values['PWM_CAP'] or 0.0):g}",
        "CABLE": cable(chosen.controller),
        "WIND_BY": by_button("wind", chosen.controller),
        "JUMP_BY": by_button("jump", chosen.controller),
        "CHARGE": charging(chosen),
        "CHARGE_LOADED": charging_loaded(chosen),
        "STUCK": "\n".join((UNTRIED, *(f"  {n}. {item}" for n, item in enumerate(stuck_items(robot), start=1)))),
    }
    return re.sub(r"\{([A-Z_]+)\}", lambda found: facts[found[1]], text)
