"""order/spring-*-hand.dxf: the relaxed spring along its axis, 1:1, for makers who read DXF (mm).

Layer `WIRE` holds the coil's inside and outside and the arms' middle lines with their width, `LOADED` the farther arm
where the robot loads the spring, `TEXT` the requirements of the drawing in SVG beside it.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from jumpcad.bundle.drawings.spring_sheet import FOLDER, arms_of, requirements
from jumpcad.drive import TorsionSpring
from jumpcad.exporters.dxf import dxf_document
from jumpcad.robot.robot import Robot
from jumpcad.transforms import Array

if TYPE_CHECKING:
    from ezdxf.layouts.layout import Modelspace

WIRE, LOADED, TEXT = "WIRE", "LOADED", "TEXT"
LAYERS = {WIRE: 7, LOADED: 8, TEXT: 5}
"""Colours by AutoCAD's index: black or white, grey, blue."""
LETTER_MM, LINE_MM = 2.0, 3.5


def spring_dxfs(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and drawing of both springs."""
    spring = robot.layout.drive.spring
    for side, hand in zip(("left", "right"), spring.hands, strict=True):
        words = [f"{name}: {value}" for name, value in requirements(robot, spring, side, hand)]
        yield f"{FOLDER}/spring-{hand}-hand.dxf", _drawing(spring, hand, words)


def _drawing(spring: TorsionSpring, hand: str, words: list[str]) -> str:
    def draw(space: "Modelspace") -> None:
        for diameter in (spring.inside_diameter_mm, spring.outer_diameter_mm):
            space.add_circle((0.0, 0.0), diameter / 2.0, dxfattribs={"layer": WIRE})
        for arm in arms_of(spring, hand):
            _line(space, arm, WIRE, spring.wire_mm)
        _line(space, arms_of(spring, hand, spring.wound_rad)[0], LOADED, 0.0)
        left = spring.outer_diameter_mm / 2.0 + spring.arm_length_mm + 2.0 * LETTER_MM
        for number, word in enumerate(words):
            at = (left, -number * LINE_MM)
            space.add_text(word, height=LETTER_MM, dxfattribs={"layer": TEXT, "insert": at})

    return dxf_document(LAYERS, draw)


def _line(space: "Modelspace", ends_mm: Array, layer: str, width_mm: float) -> None:
    """Draw an arm's middle line with its width; `ends_mm` (2, 2) has y down."""
    points = (ends_mm * (1.0, -1.0)).tolist()
    space.add_lwpolyline(points, dxfattribs={"layer": layer, "const_width": width_mm})
