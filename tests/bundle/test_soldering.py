"""soldering.svg as one solders by it: pins in the board's order, free legs to their ends, words at their things.

Three boards: that of a kit with a cell, that of two cells, whose small parts have wires too, and one of which all pins
in use are on its left.
"""

import itertools
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace

import numpy as np
import pytest
from support.built import built

from jumpcad.bundle.drawings.soldering import soldering_svg
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import Wiring, wiring_of
from jumpcad.workshop import DEFAULT, Workshop, load_workshop

SPACE = "{http://www.w3.org/2000/svg}"
LETTER = 0.5
"""Width of a letter over its height, about."""


def of_kit(name: str) -> Workshop:
    shop = load_workshop(DEFAULT)
    kit = shop.catalogue.kits[name].model_dump() | {"kit": name}
    return shop.model_copy(update={"bought": shop.bought.model_copy(update=kit)})


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
    shop = left_board() if request.param == "left" else of_kit(request.param)
    svg = soldering_svg(replace(built("kenan-2.0"), workshop=shop))
    return Drawn(shop, wiring_of(chosen_parts(shop), shop.bought.pins), ET.fromstring(svg))


def inside(box: np.ndarray, other: np.ndarray) -> bool:
    return bool((box[0] >= other[0] - 1e-6).all() and (box[1] <= other[1] + 1e-6).all())


def pieces(line: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    return [(np.minimum(a, b), np.maximum(a, b)) for a, b in itertools.pairwise(line)]


def test_pins_stand_at_the_board_s_edges_in_its_order(drawn: Drawn) -> None:
    """What is underneath comes last on the right; rows are as far apart as the last one is from the board's end."""
    controller = chosen_parts(drawn.shop).controller
    used = {end.pin for net in drawn.wiring.nets for end in net.terminals if end.part == "controller"}
    below = [name for name in drawn.pins if name not in {*controller.left, *controller.right}]
    assert [name.split()[0] for name in drawn.words if name.endswith("(underneath)")] == below == sorted(below)
    assert set(below) <= used
    (left, top), (right, bottom) = drawn.board
    for edge, names in ((left, controller.left), (right, [*controller.right, *below])):
        places = np.array([drawn.pins[name] for name in names])
        assert (places[:, 0] == edge).all()
        steps = np.diff([top, *places[:, 1]])
        assert (steps == steps[0]).all()
        assert steps[0] >= 1.4 * 3.4  # a line of text
    assert bottom - max(y for _, y in drawn.pins.values()) == steps[0]


def test_pins_with_a_leg_are_filled_and_have_their_names_on_the_board(drawn: Drawn) -> None:
    starts = {tuple(line[0]) for line in drawn.lines}
    fills = {tuple(at): one.get("fill") for one, at in drawn.numbers("circle", "cx", "cy")}
    colours = {at: fills[at] for at in starts & fills.keys()}
    assert len({*colours.values()}) == 1
    assert {fill for at, fill in fills.items() if at not in starts} == {"#ffffff"} != {*colours.values()}
    gaps = []
    for name, at in drawn.pins.items():
        (box,) = (box for words, box in drawn.words.items() if words.removesuffix(" (underneath)") == name)
        gaps.append(box[0, 0] - at[0] if at[0] == drawn.board[0, 0] else at[0] - box[1, 0])
        assert box[:, 1].mean() == pytest.approx(at[1], abs=0.25)
    assert max(gaps) - min(gaps) < 1e-6
    assert 1.5 < gaps[0] < 4.0  # beside the circle


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


def test_legs_run_square_outside_the_board_and_never_along_each_other(drawn: Drawn) -> None:
    """Where two meet, they cross, or begin at the same pin; bodies are as far apart as a line of text is high."""
    board, (_, bottom) = drawn.board, drawn.board[1]
    for line in drawn.lines:
        for low, high in pieces(line):
            assert (low == high).any()
            assert (low == high).sum() == 1
            assert (low >= board[1]).any() or (high <= board[0]).any()
        for box in drawn.bodies.values():
            for low, high in pieces(line):
                assert not ((low < box[1] - 1e-6) & (high > box[0] + 1e-6)).all()
    for one, other in itertools.combinations(drawn.lines, 2):
        shared = (one[0] == other[0]).all()
        for index, (low, high) in enumerate(pieces(one)):
            for number, (least, most) in enumerate(pieces(other)):
                if shared and index == number == 0:
                    continue
                along = low[0] == high[0] == least[0] == most[0], low[1] == high[1] == least[1] == most[1]
                overlap = np.minimum(high, most) - np.maximum(low, least)
                assert not (along[0] and overlap[1] >= 0.0)
                assert not (along[1] and overlap[0] >= 0.0)
    boxes = list(drawn.bodies.values())
    for one, other in itertools.pairwise(boxes):
        assert other[0, 1] - one[1, 1] > 3.4  # a letter stands between them
    assert boxes[0][0, 1] > bottom


def test_a_leg_leaves_on_the_side_of_its_pin(drawn: Drawn) -> None:
    """So none goes around the board; the lower the part, the farther out its legs run."""
    middle = drawn.board[:, 0].mean()
    ways = [line for line in drawn.lines if len(line) > 2]
    for line in ways:
        side = np.sign(line[0, 0] - middle)
        assert side * (line[1, 0] - line[0, 0]) > 2.0
        others = [one for one in ways if one[-1, 1] == line[-1, 1] and one is not line]
        if not others or np.sign(others[0][0, 0] - middle) != side:
            assert side * (line[-1, 0] - middle) > 0.0
    assert len(ways) + sum(words.startswith("wire to") for words in drawn.words) == len(drawn.lines)
    for sign in (-1.0, 1.0):
        outer = [(line[-1, 1], sign * line[1, 0]) for line in ways if sign * (line[0, 0] - middle) > 0.0]
        rows = sorted({row for row, _ in outer})
        reach = [max(far for row, far in outer if row == at) for at in rows]
        assert (np.diff(reach) > 0.0).all()


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


def test_resistors_have_their_ohms_on_them(drawn: Drawn) -> None:
    """kΩ are ohms over a thousand."""
    said = {name.removesuffix(" kΩ") for name in drawn.bodies if "kΩ" in name}
    assert said == {f"{name.split()[0]} {ohm / 1000.0:g}" for name, ohm in drawn.wiring.resistors.items()}
    assert len(drawn.bodies) == len(drawn.wiring.resistors) + ("diode" in drawn.bodies)
    for name, box in drawn.bodies.items():
        assert drawn.words[name].mean(axis=0) == pytest.approx(box.mean(axis=0), abs=0.25)
        assert np.ptp(drawn.words[name][:, 1]) > np.ptp(box[:, 1]) / 3.0  # as large as fits


def test_the_page_has_room_for_every_word(drawn: Drawn) -> None:
    """On both sides alike, and no more than a tenth of it is empty at the bottom; four pixels a millimetre."""
    _, _, width, height = map(float, drawn.page.get("viewBox", "").split())
    boxes = np.array(list(drawn.words.values()))
    assert boxes.min() >= 0.0
    assert (boxes.max(axis=(0, 1)) <= [width, height]).all()
    assert drawn.board[:, 0].mean() == width / 2.0
    assert np.mean([box[:, 0].mean() for box in drawn.bodies.values()]) == width / 2.0
    assert 0.9 * height < max(box[1, 1] for box in drawn.bodies.values()) < height
    assert float(drawn.page.get("width", "0")) == 4.0 * width
    titles = [box for words, box in drawn.words.items() if "above" in words or "USB" in words]
    assert all(box[1, 1] < drawn.board[0, 1] for box in titles)


def with_sides(left: tuple[str, ...], right: tuple[str, ...]) -> Workshop:
    shop = left_board()
    board = shop.boards["own"].model_dump(exclude_none=True) | {"left": left, "right": right}
    return Workshop(**shop.model_dump(exclude_none=True) | {"boards": {"own": board}})


def test_nothing_is_drawn_of_a_board_whose_sides_are_not_known() -> None:
    """One side is enough; pins that are on none are then drawn underneath."""
    drawn = [
        soldering_svg(replace(built("kenan-2.0"), workshop=with_sides(left, ()))) for left in ((), ("D5", "D1", "D4"))
    ]
    assert drawn[0] == ""
    assert "BAT+ (underneath)" in drawn[1]
    assert "D1 (underneath)" not in drawn[1]
