"""wiring.svg for both kits, traced as a circuit, the list of wires, and soldering.svg as one solders by it."""

import itertools
import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np
import pytest
import shapely
from support.built import built, of_kit, with_kit
from support.workshops import rewired

from jumpcad.bundle.drawings.wiring import soldering_svg, wires, wiring_svg
from jumpcad.electronics.nets import Wiring, wiring_of
from jumpcad.electronics.supply import chosen_parts
from jumpcad.robot.robot import Robot
from jumpcad.workshop import DEFAULT, Workshop, load_workshop

SPACE = "{http://www.w3.org/2000/svg}"
STROKES = {"red": "#c62828", "orange": "#ef6c00", "black": "#222222", "blue": "#1565c0", "yellow": "#c9a400",
           "own legs": "#8a8f96"}  # fmt: skip


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return of_kit(request.param)


def numbers(element: ET.Element, *keys: str) -> list[float]:
    """Return attributes of an element as numbers."""
    return [float(element.get(key, "nan")) for key in keys]


def boxes_of(root: ET.Element) -> dict[str, shapely.Polygon]:
    """Return the box of every part by its role: the box that its bold title is in."""
    rects = [numbers(one, "x", "y", "width", "height") for one in root.iter(f"{SPACE}rect") if one.get("x")]
    areas, found = [shapely.box(x, y, x + width, y + height) for x, y, width, height in rects], {}
    for text in root.iter(f"{SPACE}text"):
        if text.get("font-weight") == "bold":
            (area,) = (one for one in areas if one.contains(shapely.Point(numbers(text, "x", "y"))))
            found[(text.text or "").partition(": ")[0]] = area
    assert len(found) == len(areas)
    return found


def starts_of(root: ET.Element) -> dict[tuple[str, str], tuple[float, float]]:
    """Return where the wire of every terminal, by part and pin, begins: beside its name, at the right edge of its box.

    The line is a third of the letters' height of 3.2 mm above their foot.
    """
    found = {}
    for part, area in boxes_of(root).items():
        for text in root.iter(f"{SPACE}text"):
            x, y = numbers(text, "x", "y")
            if text.get("text-anchor") == "end" and area.contains(shapely.Point(x, y)):
                found[part, text.text or ""] = (area.bounds[2], round(y - 1.0, 1))
                assert area.bounds[2] - x == pytest.approx(2.0)
    return found


def lines_of(root: ET.Element) -> list[tuple[str, shapely.LineString]]:
    """Return colour and course of every line."""
    lines = []
    for one in root.iter(f"{SPACE}polyline"):
        points = [tuple(map(float, pair.split(","))) for pair in one.get("points", "").split()]
        lines.append((one.get("stroke", ""), shapely.LineString(points)))
    return lines


def test_the_drawing_traced_along_its_lines_is_the_net_list(robot: Robot) -> None:
    """Lines that have an end or a corner in common, or run along each other, are one net; crossings connect nothing.

    A net has the colour of its wires in the table, grey where parts' own legs need none; no line of another net lies on
    one of it.
    """
    root = ET.fromstring(wiring_svg(robot))
    wiring = wiring_of(chosen_parts(robot.workshop), robot.workshop.bought.pins)
    starts, lines = starts_of(root), lines_of(root)
    group = list(range(len(lines)))
    for (i, (_, one)), (j, (_, other)) in itertools.combinations(enumerate(lines), 2):
        ends = [(one, other.coords), (other, one.coords)]
        if one.intersection(other).length > 0.0 or any(
            line.distance(shapely.Point(end)) == 0.0 for line, corners in ends for end in corners
        ):
            group = [group[i] if kept == group[j] else kept for kept in group]
    traced = {}
    for number in set(group):
        of_net = [line for line, kept in zip(lines, group, strict=True) if kept == number]
        (stroke,) = {stroke for stroke, _ in of_net}
        ends = {end for _, line in of_net for end in line.coords}
        traced[frozenset(terminal for terminal, at in starts.items() if at in ends)] = stroke
    colours = {
        name: {one[3] for one in wires(robot) if one[0] == name and one[3]} for name in (n.name for n in wiring.nets)
    }
    expected = {
        frozenset((one.part, one.pin) for one in net.terminals): STROKES[colour]
        for net in wiring.nets
        for colour in colours[net.name] or {"own legs"}
    }
    assert traced == expected
    assert STROKES["own legs"] in traced.values()


LETTER = 0.5
"""Width of a letter over its height, about."""


def left_board() -> Workshop:
    data = load_workshop(DEFAULT).model_dump(exclude_none=True)
    board = load_workshop(DEFAULT).catalogue.boards["xiao-esp32c3"].model_dump(exclude_none=True)
    sides = {"left": ("D5", "BAT+", "D1", "GND", "3V3", "D4"), "right": ("D9",)}
    return Workshop(**data | {"boards": {"own": board | sides}, "bought": data["bought"] | {"controller": "own"}})


@dataclass(frozen=True)
class Drawn:
    """What a reader sees: `pins` and `words` by their texts, lines as their corners, rectangles as two corners."""

    shop: Workshop
    wiring: Wiring
    page: ET.Element

    def numbers(self, tag: str, *keys: str) -> list[tuple[ET.Element, np.ndarray]]:
        return [(one, np.array([float(one.get(key, "0")) for key in keys])) for one in self.page.iter(SPACE + tag)]

    @property
    def board(self) -> np.ndarray:
        """Its corners (2, 2)."""
        x, y, width, height = self.numbers("rect", "x", "y", "width", "height")[1][1]
        return np.array([[x, y], [x + width, y + height]])

    @property
    def words(self) -> dict[str, np.ndarray]:
        """Every text with its box (2, 2); letters stand on their place."""
        found = {}
        for one, (x, y, size) in self.numbers("text", "x", "y", "font-size"):
            wide = LETTER * size * len(one.text or "")
            left = x - {"start": 0.0, "middle": wide / 2.0, "end": wide}[one.get("text-anchor", "")]
            found[one.text or ""] = np.array([[left, y - 0.7 * size], [left + wide, y]])
        return found

    @property
    def pins(self) -> dict[str, np.ndarray]:
        """Every pin's place: its name is the word beside it."""
        found = {}
        for _, at in self.numbers("circle", "cx", "cy"):
            beside = {words: box for words, box in self.words.items() if box[0, 1] < at[1] < box[1, 1]}
            name = min(beside, key=lambda words: np.abs(beside[words][:, 0] - at[0]).min())
            assert inside(beside[name], self.board)
            found[name.removesuffix(" (underneath)")] = at
        return found

    @property
    def lines(self) -> list[np.ndarray]:
        """The legs."""
        texts = [one.get("points", "") for one in self.page.iter(f"{SPACE}polyline")]
        return [np.array([pair.split(",") for pair in text.split()], dtype=float) for text in texts]

    @property
    def bodies(self) -> dict[str, np.ndarray]:
        """Corners (2, 2) of each small part by what is written in it."""
        found = {}
        for _, (x, y, width, height) in self.numbers("rect", "x", "y", "width", "height")[2:]:
            box = np.array([[x, y], [x + width, y + height]])
            (name,) = (words for words, other in self.words.items() if inside(other, box))
            found[name] = box
        return found


@pytest.fixture(scope="module", params=["light-1s", "strong-2s", "left"])
def drawn(request: pytest.FixtureRequest) -> Drawn:
    shop = left_board() if request.param == "left" else with_kit(request.param)
    svg = soldering_svg(rewired(built("kenan-2.0"), shop))
    return Drawn(shop, wiring_of(chosen_parts(shop), shop.bought.pins), ET.fromstring(svg))


def inside(box: np.ndarray, other: np.ndarray) -> bool:
    return bool((box[0] >= other[0] - 1e-6).all() and (box[1] <= other[1] + 1e-6).all())


def test_every_leg_goes_from_its_pin_to_an_end_of_its_body(drawn: Drawn) -> None:
    """Both ends of a body have a leg; one to no pin says where its wire goes."""
    wanted = []
    for part in ("upper resistor", "lower resistor", "pull-up resistor", "diode"):
        for net in drawn.wiring.nets:
            for own in (end for end in net.terminals if end.part == part):
                others = [end for end in net.terminals if end.part not in ("diode", "upper resistor", "lower resistor")]
                at = next((end for end in others if end.part == "controller"), others[0])
                wanted.append((part.removesuffix(" resistor"), own.pin, at))
    assert len(drawn.lines) == len(wanted) == 2 * len(drawn.bodies)
    found = []
    for name, ((left, top), (right, bottom)) in drawn.bodies.items():
        middle = (top + bottom) / 2.0
        for end in ([left, middle], [right, middle]):
            (line,) = (line for line in drawn.lines if end in line[[0, -1]].tolist())
            pin = next((pin for pin, at in drawn.pins.items() if (at == line[0]).all()), "")
            if not pin:
                ((_, tip),) = (line,) if line[0].tolist() == end else (line[::-1],)
                (words,) = (
                    words
                    for words, box in drawn.words.items()
                    if words.startswith("wire to") and box[0, 1] < tip[1] < box[1, 1]
                )
                box = drawn.words[words]
                gap = box[0, 0] - tip[0] if end[0] == right else tip[0] - box[1, 0]
                assert 0.0 < gap < 2.0
                assert box[:, 1].mean() == pytest.approx(tip[1], abs=0.25)
                assert abs(tip[0] - end[0]) > 2.0
                pin = words.removeprefix("wire to ")
            found.append((name.split()[0], pin))
    assert sorted(found) == sorted((part, at.pin if at.part == "controller" else str(at)) for part, _, at in wanted)


def test_the_ends_of_a_diode_are_named_where_they_are(drawn: Drawn) -> None:
    """The letter stands above its leg, beside the body, the ring on the body at K; a resistor may be turned around."""
    rings = drawn.numbers("line", "x1", "y1", "x2", "y2")
    assert len(rings) == sum(line.startswith("diode") for line in drawn.bodies)
    if not rings:
        assert not {"A", "K"} & drawn.words.keys()
        return
    (left, top), (right, bottom) = drawn.bodies["diode"]
    (net,) = (net for net in drawn.wiring.nets if net.name == "behind the diode")
    k_at = next(end.pin for end in net.terminals if end.part == "controller")
    (leg,) = (line for line in drawn.lines if (line[0] == drawn.pins[k_at]).all() and line[-1, 1] == (top + bottom) / 2)
    for letter, is_right in (("K", leg[-1, 0] == right), ("A", leg[-1, 0] != right)):
        box = drawn.words[letter]
        assert 0.0 < (box[0, 0] - right if is_right else left - box[1, 0]) < 2.0
        assert 0.3 < (top + bottom) / 2.0 - box[1, 1] < 2.0
    ((_, (x, low, same, high)),) = rings
    assert (x, low, high) == (same, top, bottom)
    assert 0.05 < abs(x - leg[-1, 0]) / (right - left) < 0.2
    assert left < x < right


def with_sides(left: tuple[str, ...], right: tuple[str, ...]) -> Workshop:
    shop = left_board()
    board = shop.boards["own"].model_dump(exclude_none=True) | {"left": left, "right": right}
    return Workshop(**shop.model_dump(exclude_none=True) | {"boards": {"own": board}})


def test_nothing_is_drawn_of_a_board_whose_sides_are_not_known() -> None:
    """One side is enough; pins that are on none are then drawn underneath."""
    sides = ((), ("D5", "D1", "D4"))
    drawn = [soldering_svg(rewired(built("kenan-2.0"), with_sides(left, ()))) for left in sides]
    assert drawn[0] == ""
    assert "BAT+ (underneath)" in drawn[1]
    assert "D1 (underneath)" not in drawn[1]
