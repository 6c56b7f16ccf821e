"""firmware/: what the controller runs. Logic and use of pins are templates; `robot.py` has this robot's numbers."""

from collections.abc import Iterator, Mapping

from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide.operation_values import operation_values
from jumpcad.files import templates_folder
from jumpcad.files.rendering import render
from jumpcad.robot import Robot

FOLDER = "firmware"
COPIED = ("main.py", "winder.py")
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


def firmware_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and text of every file of the firmware.

    Raises
    ------
    CannotBuildError
        If a pin that the workshop names is none of the controller's GPIOs.
    """
    values = numbers(robot)
    for name in COPIED:
        yield f"{FOLDER}/{name}", (templates_folder() / FOLDER / name).read_text(encoding="utf-8")
    yield f"{FOLDER}/robot.py", _module(robot, values)
    yield f"{FOLDER}/README.md", render(f"{FOLDER}/README.md.j2", operation_values(robot))


def _module(robot: Robot, values: Mapping[str, float | int | None]) -> str:
    lines = [f'"""Numbers of one robot, computed by jumpcad: motor {robot.layout.drive.train.motor.name}."""', ""]
    for key, value in values.items():
        lines.append(f"{key} = {value!r}{f'  # {WORDS[key]}' if key in WORDS else ''}")
    return "\n".join(lines) + "\n"
