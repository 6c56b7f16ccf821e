"""wiring.svg for both kits, traced as a circuit, and the list of wires."""

import itertools
import re
import xml.etree.ElementTree as ET

import pytest
import shapely
from support.built import of_kit

from jumpcad.bundle.drawings.wiring import _boxes, _net_lines, wires, wiring_svg
from jumpcad.electronics.chosen import Chosen, chosen_parts
from jumpcad.electronics.nets import Net, Terminal, Wiring, wiring_of
from jumpcad.robot import Robot

SPACE = "{http://www.w3.org/2000/svg}"
NO_LEADS = {"upper resistor", "lower resistor", "pull-up resistor", "diode"}
"""Parts whose own legs reach the controller, where they lie; the battery's plug is on its own cable."""
STROKES = {"red": "#c62828", "orange": "#ef6c00", "black": "#222222", "blue": "#1565c0", "yellow": "#c9a400"}


@pytest.fixture(scope="module", params=["light-1s", "strong-2s"])
def robot(request: pytest.FixtureRequest) -> Robot:
    return of_kit(request.param)


def net_list(robot: Robot) -> tuple[Chosen, Wiring]:
    """Return a robot's electrical parts and their nets."""
    chosen = chosen_parts(robot.workshop)
    return chosen, wiring_of(chosen, robot.workshop.bought.pins)


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

    A net has the colour of its wires, and no line of another net lies on one of it.
    """
    root, (_, wiring) = ET.fromstring(wiring_svg(robot)), net_list(robot)
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
    expected = {frozenset((one.part, one.pin) for one in net.terminals): STROKES[net.colour] for net in wiring.nets}
    assert traced == expected


def test_boxes_are_apart_and_no_line_runs_through_one(robot: Robot) -> None:
    """Parts in columns from the left: what comes from the battery, what works with it, what steers it."""
    root = ET.fromstring(wiring_svg(robot))
    boxes, starts = boxes_of(root), starts_of(root)
    for (_, one), (_, other) in itertools.combinations(boxes.items(), 2):
        assert one.distance(other) >= 6.9
    for _, line in lines_of(root):
        for box in boxes.values():
            assert line.intersection(box).length == 0.0
    columns = sorted({box.bounds[0] for box in boxes.values()})
    at = [{role for role, box in boxes.items() if box.bounds[0] == column} for column in columns]
    assert [at[0] >= {"battery", "plug"}, at[1] >= {"driver", "motor"}, at[2] >= {"controller", "sensor"}] == [True] * 3
    assert columns[1] - columns[0] == pytest.approx(columns[2] - columns[1])
    assert min(box.bounds[0] for box in boxes.values()) == min(box.bounds[1] for box in boxes.values()) == 8.0
    for role, box in boxes.items():
        left, top, right, bottom = box.bounds
        heights = sorted(y for (part, _), (_, y) in starts.items() if part == role)
        assert right - left == 50.0
        assert bottom - top == pytest.approx(7.0 * (len(heights) + 1))  # a row for the title
        assert heights == pytest.approx([top + 7.0 * row + 2.1 for row in range(1, len(heights) + 1)])


def test_all_is_on_the_white_page_which_is_shown_at_four_times_its_size(robot: Robot) -> None:
    root = ET.fromstring(wiring_svg(robot))
    left, top, width, height = map(float, root.get("viewBox", "").split())
    page = next(root.iter(f"{SPACE}rect"))
    assert (left, top, numbers(page, "width", "height"), page.get("fill")) == (0.0, 0.0, [width, height], "#ffffff")
    assert float(root.get("width", "")) == 4.0 * width
    drawn = shapely.union_all([*boxes_of(root).values(), *(line for _, line in lines_of(root))])
    low_x, low_y, high_x, high_y = drawn.bounds
    assert (low_x, low_y) == (8.0, 8.0)
    boxes, (_, wiring) = boxes_of(root).values(), net_list(robot)
    nets = len(wiring.nets)
    assert width == pytest.approx(max(box.bounds[2] for box in boxes) + 4.0 * nets + 16.0)  # tracks, and two margins
    assert height == pytest.approx(max(box.bounds[3] for box in boxes) + 7.0 + 4.0 * nets + 8.0)  # lanes, and a margin
    assert high_x <= width - 8.0
    assert high_y <= height - 8.0


def test_a_net_that_leaves_its_column_is_named_above_its_lane(robot: Robot) -> None:
    """In its colour, at the lane's left end; lanes are 4 mm apart in the order of the nets, the letters 2.6 mm high."""
    root, (_, wiring) = ET.fromstring(wiring_svg(robot)), net_list(robot)
    starts = starts_of(root)
    names = {one.text: one for one in root.iter(f"{SPACE}text") if one.get("font-size") == "2.6"}
    across = {
        net.name: (index, net)
        for index, net in enumerate(wiring.nets)
        if len({starts[one.part, one.pin][0] for one in net.terminals}) > 1
    }
    assert names.keys() == across.keys()
    assert len(names) > 2
    lowest = max(y for _, y in starts.values())
    for name, (index, net) in across.items():
        (lane,) = (
            line for stroke, line in lines_of(root) if len(line.coords) == 2 and stroke == STROKES[net.colour]
            and line.bounds[1] == pytest.approx(lowest + 7.0 + 4.0 * index)
        )  # fmt: skip
        x, y = numbers(names[name], "x", "y")
        assert names[name].get("fill") == STROKES[net.colour]
        assert (x - lane.bounds[0], lane.bounds[1] - y) == pytest.approx((1.0, 0.8))


def test_a_dot_is_where_each_wire_meets_its_track() -> None:
    """Tracks of nets are 2 mm apart, from 4 mm beside the box on; a net of one column goes down to its lowest end."""
    one, two, three = Terminal("driver", "a"), Terminal("driver", "b"), Terminal("controller", "c")
    ends = {one: (50.0, 10.0), two: (50.0, 17.0), three: (120.0, 38.0)}
    root = ET.fromstring(f"<svg>{''.join(_net_lines(Net('n', 'motor', (two, one)), ends, 3))}</svg>")
    assert [tuple(numbers(dot, "cx", "cy", "r")) for dot in root.iter("circle")] == [
        (60.0, 17.0, 0.6),
        (60.0, 10.0, 0.6),
    ]
    assert {dot.get("fill") for dot in root.iter("circle")} == {"#1565c0"}
    assert [line.get("points") for line in root.iter("polyline")] == [
        "50.0,17.0 60.0,17.0 60.0,17.0", "50.0,10.0 60.0,10.0 60.0,17.0",
    ]  # fmt: skip
    assert not list(root.iter("text"))
    root = ET.fromstring(f"<svg>{''.join(_net_lines(Net('<&>', 'ground', (one, three)), ends, 2))}</svg>")
    assert [text.text for text in root.iter("text")] == ["<&>"]
    *_, lane = (line.get("points") for line in root.iter("polyline"))
    assert lane == "58.0,53.0 128.0,53.0"  # 7 mm below the lowest end, and two lanes of 4 mm
    assert all(line.get("fill") == "none" for line in root.iter("polyline"))


def test_a_part_without_terminals_has_no_box_and_names_are_escaped() -> None:
    plus, minus = Terminal("battery", "+"), Terminal("motor", "-")
    boxes, ends, height = _boxes((Net("n", "supply", (plus, minus)),), {"battery": "a<b & c", "motor": "m"})
    root = ET.fromstring(f"<svg>{''.join(boxes)}</svg>")
    assert [one.text for one in root.iter("text") if one.get("font-weight")] == ["a<b & c", "m"]
    assert len(list(root.iter("rect"))) == 2
    assert ends.keys() == {plus, minus}
    assert ends[minus][0] - ends[plus][0] == pytest.approx(68.0 + 2.0)  # a column, and a track of each net
    assert height == pytest.approx(8.0 + 2 * 7.0 + 7.0 + 4.0 + 8.0)  # margins, title and row, a row free, a lane


def test_every_net_has_one_wire_less_than_terminals(robot: Robot) -> None:
    _, wiring = net_list(robot)
    found = wires(robot)
    for net in wiring.nets:
        of_net = [one for one in found if one[0] == net.name]
        assert len(of_net) == len(net.terminals) - 1
        assert {end for _, start, end, *_ in of_net for end in (start, end)} == {*net.terminals}
        assert {colour for *_, colour, _ in of_net} == {net.colour}


def test_the_drawing_names_every_terminal_and_is_the_same_each_time(robot: Robot) -> None:
    drawing = wiring_svg(robot)
    assert drawing == wiring_svg(robot)
    words = [element.text for element in ET.fromstring(drawing).iter("{http://www.w3.org/2000/svg}text")]
    for _, start, end, _, length in wires(robot):
        assert start.pin in words
        assert end.pin in words
        ends = {start.part, end.part}
        if (ends & NO_LEADS and "controller" in ends) or ends == {"battery", "plug"}:
            assert length == 0.0
        else:
            assert 30.0 <= length <= 250.0
    resistors = [end for _, start, end, _, _ in wires(robot) if end.part == "pull-up resistor"]
    assert {(end.pin) for end in resistors} == {"1", "2"}


def test_the_drawing_names_resistors_in_kiloohms(robot: Robot) -> None:
    wiring = wiring_of(chosen_parts(robot.workshop), robot.workshop.bought.pins)
    drawn = wiring_svg(robot)
    for name, ohm in wiring.resistors.items():
        (said,) = set(re.findall(rf"{name}: ([\d.]+) kΩ", drawn))
        assert 1000.0 * float(said) == ohm


def test_parts_are_called_by_their_articles_in_the_drawing(robot: Robot) -> None:
    chosen, texts = (
        chosen_parts(robot.workshop),
        ET.fromstring(wiring_svg(robot)).iter("{http://www.w3.org/2000/svg}text"),
    )
    titles = {element.text for element in texts if element.get("font-weight") == "bold"}
    named = {"battery": chosen.battery, "motor": robot.layout.drive.train.motor, **chosen.boards, **chosen.components}
    assert titles >= {f"{role}: {named[role].name}" for role in ("battery", "motor", "controller", "driver", "plug")}
    assert {title.partition(": ")[0] for title in titles if title} <= {
        *named,
        *wiring_of(chosen, robot.workshop.bought.pins).resistors,
    }
