"""order/spring-*-hand.svg and .dxf: drawings of the left-hand and the right-hand spring, for makers and dealers (mm).

The first shows the relaxed spring along its axis and from the side, at the largest scale at which all of it is on the
sheet, and a table of its requirements. The second, for makers who read DXF, is the relaxed spring along its axis, 1:1:
layer `WIRE` holds the coil's inside and outside and the arms' middle lines with their width, `LOADED` the farther arm
where the robot loads the spring, `TEXT` the requirements.
"""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from jumpcad.bundle.facts import PAIR_PERCENT, arms_off_deg, loaded_arms, torque_shares
from jumpcad.drive import TorsionSpring
from jumpcad.exporters.dxf import dxf_document
from jumpcad.exporters.xml import allowed
from jumpcad.files.templates import fill
from jumpcad.robot.robot import Robot
from jumpcad.robot.springs.thing import ORDERED
from jumpcad.transforms import Array

FOLDER = "order"
SCALES = (3.0, 2.0, 1.0, 0.5, 0.2, 0.1)
"""Those of ISO 5455, and 3:1, at which usual springs fill the sheet."""
PAGE_MM = (297.0, 210.0)
END_VIEW_MM, SIDE_VIEW_MM = (75.0, 70.0), (200.0, 70.0)
ROOM_MM = (8.0, 21.0, 284.0, 116.5)
"""Left, upper, right and lower edge of the room for both views, between their titles and the table."""
CROSS_MM = 30.0
"""Reach of the middle lines of the side view."""
VIEWS_APART_MM = 5.0
LENGTH_TOLERANCE_MM = 0.5
"""Judgement."""


def spring_sheets(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield path and drawing of both springs."""
    spring = robot.layout.drive.spring
    for side, hand in zip(("left", "right"), spring.hands, strict=True):
        yield f"{FOLDER}/spring-{hand}-hand.svg", _sheet(robot, spring, side, hand)


def scale_of(spring: TorsionSpring) -> float:
    """Return the scale of both drawings of a robot's springs."""
    fitting = (scale for scale in SCALES if all(_fits(spring, hand, scale) for hand in spring.hands))
    return next(fitting, SCALES[-1])


def scale_in_words(spring: TorsionSpring) -> str:
    """Return the scale as it stands on the drawings: `3:1`."""
    scale = scale_of(spring)
    return f"{scale:g}:1" if scale >= 1.0 else f"1:{1.0 / scale:g}"


def _sheet(robot: Robot, spring: TorsionSpring, side: str, hand: str) -> str:
    scale = scale_of(spring)
    middle = _middle_mm(spring, hand, scale)
    lines = (*arms_of(spring, hand), arms_of(spring, hand, spring.wound_rad)[0])
    far, near, loaded = ((scale * line + middle).ravel().tolist() for line in lines)
    values = {
        "spring": spring, "page_mm": PAGE_MM,
        "rows": [(name, allowed(value)) for name, value in requirements(robot, spring, side, hand)],
        "middle": middle.tolist(), "side_view": SIDE_VIEW_MM, "cross_mm": CROSS_MM, "mean": scale * spring.arms.mean_mm,
        "wire": scale * spring.wire_mm, "outer": scale * spring.outer_diameter_mm, "turns": math.ceil(spring.turns),
        "far": far, "near": near, "loaded": loaded, "free_deg": math.degrees(spring.free_arm_angle_rad),
        "scale": scale_in_words(spring), "hand": hand,
    }  # fmt: skip
    return fill("drawings/spring_sheet.svg.j2", values)


def requirements(robot: Robot, spring: TorsionSpring, side: str, hand: str) -> list[tuple[str, str]]:
    """Return what a drawing of one spring asks for: name and value of each requirement."""
    stock = robot.workshop.stock_spring
    scatter = 100.0 * robot.workshop.safety.spring_rate_scatter
    free, wound = math.degrees(spring.free_arm_angle_rad), math.degrees(spring.wound_rad)
    narrower, wider = arms_off_deg(robot)
    least, most = (100.0 * abs(share - 1.0) for share in torque_shares(robot))
    return [
        ("robot", f"{robot.name}, spring on its {side} side: 1 needed, order {ORDERED} and choose"),
        ("article", stock.article(hand) if stock else "torsion spring, close-coiled, made to order"),
        ("hand", f"{hand}-hand wound"),
        (
            "LOADED (requirement)",
            f"{spring.torque_nmm:.0f} N·mm, +{most:.0f} % / -{least:.0f} %, closed by {wound:.1f}°: arms "
            f"{loaded_arms(robot)}",
        ),
        ("right- and left-hand spring", f"their loaded torques agree within {PAIR_PERCENT} %"),
        ("rate", f"{spring.rate_nmm_per_deg:.2f} N·mm/° ±{scatter:.0f} %"),
        ("wire", f"{spring.wire_mm:g} mm, EN 10270-1 SM" if not spring.stock else f"{spring.wire_mm:g} mm"),
        ("inside diameter", f"{spring.inside_diameter_mm:.2f} mm; may change to meet the rate"),
        ("turns of the body, relaxed", f"{spring.turns:.2f}"),
        ("arms, straight, tangent", f"{spring.arm_length_mm:.1f} ±{LENGTH_TOLERANCE_MM:g} mm from the coil"),
        ("angle between arms, relaxed", f"{free:.0f}° +{wider:.0f}° / -{narrower:.0f}°; 180° is opposite directions"),
        ("body length, loaded", f"{spring.body_length_mm:.1f} mm at most"),
        ("inside, loaded", f"runs on a mandrel of {spring.mandrel_mm:.2f} mm"),
    ]


def _drawn_mm(spring: TorsionSpring, hand: str, scale: float) -> Array:
    """Return points (n, 2) of coil, arms and the loaded arm along their middle lines, about the coil's middle."""
    share = np.linspace(0.0, 1.0, 60)[:, None]
    angle = 2.0 * math.pi * share
    lines = (*arms_of(spring, hand), arms_of(spring, hand, spring.wound_rad)[0])
    coil = spring.arms.mean_mm / 2.0 * np.hstack([np.cos(angle), np.sin(angle)])
    return scale * np.vstack([coil, *(line[0] + share * (line[1] - line[0]) for line in lines)])


def _room_mm(spring: TorsionSpring, scale: float) -> tuple[Array, Array]:
    """Return the corners of the end view's room: what the side view leaves."""
    left, top, _, bottom = ROOM_MM
    return np.array([left, top]), np.array([_side_box_mm(spring, scale)[0][0] - VIEWS_APART_MM, bottom])


def _side_box_mm(spring: TorsionSpring, scale: float) -> tuple[Array, Array]:
    """Return the corners of the side view."""
    size = np.array([spring.outer_diameter_mm, (math.ceil(spring.turns) + 1.0) * spring.wire_mm])
    half = np.maximum(scale * size / 2.0, CROSS_MM)
    return SIDE_VIEW_MM - half, SIDE_VIEW_MM + half


def _middle_mm(spring: TorsionSpring, hand: str, scale: float) -> Array:
    """Return the coil's middle in the end view: its usual place, moved as far as the arms need."""
    points, half = _drawn_mm(spring, hand, scale), scale * spring.wire_mm / 2.0
    (low, high), usual = _room_mm(spring, scale), np.array(END_VIEW_MM)
    before, beyond = low - (usual + points.min(axis=0) - half), usual + points.max(axis=0) + half - high
    return np.asarray(usual + np.maximum(before, 0.0) - np.maximum(beyond, 0.0))


def _fits(spring: TorsionSpring, hand: str, scale: float) -> bool:
    """Tell whether both views are on the sheet, apart from each other."""
    points, half = _drawn_mm(spring, hand, scale), scale * spring.wire_mm / 2.0
    low, high = _room_mm(spring, scale)
    first, last = _side_box_mm(spring, scale)
    beside = bool((np.ptp(points, axis=0) + 2.0 * half <= high - low).all())
    return beside and bool((first[1] >= ROOM_MM[1]) and (last <= ROOM_MM[2:]).all())


def arms_of(spring: TorsionSpring, hand: str, closed_rad: float = 0.0) -> tuple[Array, Array]:
    """Return farther and nearer arm, each from its tangent point to its end (2, 2), from the axis, y down (mm).

    The farther one has turned by `closed_rad` from where it is relaxed; the coil is drawn relaxed.
    """
    sense = -1.0 if hand == "right" else 1.0
    turn = 2.0 * math.pi * spring.turns + closed_rad
    radius, length = spring.arms.mean_mm / 2.0, spring.arm_length_mm
    made = []
    for angle, outwards in ((math.pi / 2.0 + sense * turn, 1.0), (math.pi / 2.0, -1.0)):
        point = radius * np.array([math.cos(angle), math.sin(angle)])
        along = sense * np.array([-math.sin(angle), math.cos(angle)])
        made.append(np.stack([point, point + outwards * length * along]) * (1.0, -1.0))
    return made[0], made[1]


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
