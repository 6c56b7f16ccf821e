"""firmware/: what the controller runs. Logic and use of pins are templates; `robot.py` has this robot's numbers."""

from collections.abc import Iterator

from jumpcad.bundle.firmware_numbers import numbers
from jumpcad.bundle.guide.operation_values import operation_values
from jumpcad.files import templates_folder
from jumpcad.files.templates import fill, render
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.place import Steering

FOLDER = "firmware"
COPIED = ("main.py", "winder.py")
PLAIN, MEASURED = "Row, Wheel, Winder\n", "Row, Winder\n\nfrom gyroscope import Wheel\n"
"""What main.py imports; with a gyroscope its wheel is another."""


def firmware_files(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and text of every file of the firmware."""
    values = {"name": robot.name, "motor": robot.layout.drive.train.motor.name, **numbers(robot)}
    measured = bool(robot.workshop.steering.gyroscope)
    for name in (*COPIED, "gyroscope.py")[: 2 + measured]:
        text = (templates_folder() / FOLDER / name).read_text(encoding="utf-8")
        yield f"{FOLDER}/{name}", text.replace(PLAIN, MEASURED) if measured else text
    if robot.layout.of(Steering) is not None:
        yield f"{FOLDER}/remote.html", fill(f"{FOLDER}/remote.html.j2", {"name": robot.name})
    yield f"{FOLDER}/robot.py", fill(f"{FOLDER}/robot.py.j2", values)
    yield f"{FOLDER}/README.md", render(f"{FOLDER}/README.md.j2", operation_values(robot))
