"""wiring.svg for both kits, traced as a circuit, and the list of wires."""

import itertools
import xml.etree.ElementTree as ET

import pytest
import shapely
from support.built import of_kit

from jumpcad.bundle.drawings.wiring import wires, wiring_svg
from jumpcad.electronics.nets import wiring_of
from jumpcad.electronics.supply import chosen_parts
from jumpcad.robot.robot import Robot

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
