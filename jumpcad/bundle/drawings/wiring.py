"""wiring.svg: every net with its terminals as the boards name them; the list of wires. And soldering.svg.

That is the controller from above with the small parts that are soldered to its pins by their own legs.
"""

import math
from typing import Any

from jumpcad.bundle.drawings.lead_drawing import STROKES, leads_svg
from jumpcad.electronics.nets import AT, Net, Terminal, Wiring
from jumpcad.files.templates import fill
from jumpcad.robot.electronics.leads import OWN_LEGS, has_own_legs, lead_lengths
from jumpcad.robot.robot import Robot, decided_once

Point = tuple[float, float]
PITCH_MM, WIDE_MM, TOP_MM, BESIDE_MM, FREE_MM = 7.0, 46.0, 18.0, 80.0, 20.0
LEG_ROW_MM, TRACK_MM, GAP_MM, BODY_MM = 9.0, 3.0, 15.0, (22.0, 4.0)
"""Of the drawing, which is not to scale: between pins, the board, room above it, beside it where bodies lie and where
none do; between bodies and legs, from the board to bodies."""
CONTROLLER = "controller"


@decided_once
def soldering_svg(robot: Robot) -> str:
    """Return the drawing; empty where nothing is soldered so, or where the board's sides are not known."""
    board, wiring = robot.layout.electronics.controller, robot.wiring
    legs = {name: legs for name in OWN_LEGS if (legs := _legs(wiring, name))}
    if not legs or not (board.left or board.right):
        return ""
    used = {end.pin for pair in legs.values() for _, end in pair if end.part == CONTROLLER}
    below = tuple(sorted(used - {*board.left, *board.right}))
    side = -robot.layout.electronics.inwards(CONTROLLER)  # of the row that faces the next board; USB is above
    beside = next((role for role in robot.layout.electronics.boards if role != CONTROLLER), "front")
    x = BESIDE_MM if side < 0.0 else FREE_MM
    pins = _pins(x, board.left, board.right, below)
    height = PITCH_MM * (max(len(board.left), len(board.right) + len(below)) + 1)
    bottom, y, parts = TOP_MM + height, TOP_MM, []
    for count, name in zip(range(len(legs), 0, -1), legs, strict=True):
        across = [side * pins[end.pin][0] if end.part == CONTROLLER else -math.inf for _, end in legs[name]]
        ends = legs[name] if across[0] >= across[-1] else legs[name][::-1]
        y = max(y + LEG_ROW_MM, pins[ends[0][1].pin][1])
        parts.append(_part(name, ends, wiring, pins, side, count, (x + WIDE_MM / 2.0, y, bottom)))
    values = {
        "board": board.name, "x": x, "y": TOP_MM, "wide": WIDE_MM, "high": height,
        "width": WIDE_MM + BESIDE_MM + FREE_MM, "height": bottom + TRACK_MM * (len(legs) + 2),
        "middle": x + WIDE_MM / 2.0, "towards": f"← to the {beside}" if side < 0.0 else f"to the {beside} →",
        "body": BODY_MM, "parts": parts,
        "pins": [
            {"at": at, "used": pin in used, "words": f"{pin} (underneath)" if pin in below else pin}
            for pin, at in pins.items()
        ],
    }  # fmt: skip
    return fill("drawings/soldering.svg.j2", values)


def _legs(wiring: Wiring, part: str) -> list[tuple[str, Terminal]]:
    """Return the terminals of a part, each with what it is connected to: a pin of its board, or a wire's other end."""
    found = []
    for net in wiring.nets:
        for own in (terminal for terminal in net.terminals if terminal.part == part):
            others = [terminal for terminal in net.terminals if terminal.part not in OWN_LEGS]
            at_board = (terminal for terminal in others if terminal.part == AT[part])
            found.append((own.pin, next(at_board, others[0])))
    return sorted(found)


def _pins(x: float, left: tuple[str, ...], right: tuple[str, ...], below: tuple[str, ...]) -> dict[str, Point]:
    """Return where the pins are drawn; those underneath after the right ones."""
    sides = ((x, left), (x + WIDE_MM, (*right, *below)))
    return {pin: (at, TOP_MM + PITCH_MM * (row + 1)) for at, names in sides for row, pin in enumerate(names)}


def _part(
    name: str, legs: list[tuple[str, Terminal]], wiring: Wiring, pins: dict[str, Point], side: float, track: int,
    at: tuple[float, float, float],
) -> dict[str, Any]:  # fmt: skip
    """Return a part's name, the middle of its body beside the board, and its legs, that to its nearer end first.

    `at` are the board's middle, the body's height, and the board's lower edge.
    """
    (middle, y, bottom), apart = at, TRACK_MM * track
    x = middle + side * (WIDE_MM / 2.0 + GAP_MM + BODY_MM[0] / 2.0)
    drawn = []
    for way, (own, end) in zip((-side, side), legs, strict=False):
        body = (x + way * BODY_MM[0] / 2.0, y)
        pin = pins[end.pin] if end.part == CONTROLLER else None
        if pin is None:
            points = [body, (body[0] + way * 4.0, y)]
        elif (pin[0] - middle) * side < 0.0:  # from the other row, below the board
            out, turn = (
                pin[0] - side * apart,
                (body[0] if way == side else middle + side * WIDE_MM / 2.0) + side * apart,
            )
            points = [pin, (out, pin[1]), (out, bottom + apart), (turn, bottom + apart), (turn, y), body]
        elif way != side:
            points = [pin, (pin[0] + side * apart, pin[1]), (pin[0] + side * apart, y), body]
        else:  # around the body
            out, turn = pin[0] + side * (apart - TRACK_MM / 2.0), body[0] + 3.0 * side
            points = [pin, (out, pin[1]), (out, y + 3.4), (turn, y + 3.4), (turn, y), body]
        wire = "" if pin else f"wire to {end}"
        drawn.append({"x": body[0], "side": way, "points": points, "wire": wire, "own": own})
    ohm = wiring.resistors.get(name)
    words = name.removesuffix(" resistor") + (f" {ohm / 1000:g} kΩ" if ohm else "")
    return {"x": x, "y": y, "words": words, "legs": drawn}


ROW_MM, BOX_MM, COLUMN_MM, MARGIN_MM = 7.0, 50.0, 68.0, 8.0
COLUMNS = (("battery", "plug", "switch"), ("capacitor", "driver", "motor", "steering motor", "regulator", "diode"),
           ("controller", "sensor", "upper resistor", "lower resistor", "pull-up resistor",
            "gyroscope"))  # fmt: skip
"""Where the drawing has its parts, from the left."""
UNWIRED = "#8a8f96"
"""Of nets without a wire: parts' own legs."""


def drawings_of(robot: Robot) -> dict[str, str]:
    """Return the drawings of the wiring by their files; an empty one is not written."""
    return {"wiring.svg": wiring_svg(robot), "leads.svg": leads_svg(robot), "soldering.svg": soldering_svg(robot)}


def wires(robot: Robot) -> list[tuple[str, Terminal, Terminal, str, float]]:
    """Return every wire: its net, both ends, colour (none of a part's own leg) and length to cut (mm)."""
    return [
        (net, start, end, "" if has_own_legs(start.part, end.part) else colour, length)
        for net, start, end, colour, length in lead_lengths(robot.layout, robot.wiring)
    ]


def wiring_svg(robot: Robot) -> str:
    """Return a drawing of the net list: parts as boxes with their terminals, every net in a lane of its own (mm)."""
    nets = robot.wiring.nets
    boxes, ends, height = _boxes(nets, _titles(robot))
    width = COLUMN_MM * (len(COLUMNS) - 1) + BOX_MM + 8.0 * len(nets) + 3.0 * MARGIN_MM
    wired = {name for name, *_, colour, _ in wires(robot) if colour}
    drawn = [
        _lines(net, ends, lane, STROKES[net.colour] if net.name in wired else UNWIRED) for lane, net in enumerate(nets)
    ]
    return fill("drawings/wiring.svg.j2", {"width": width, "height": height, "nets": drawn, "boxes": boxes})


def _titles(robot: Robot) -> dict[str, str]:
    """Return what each part is called."""
    chosen = robot.layout.electronics
    titles = {role: f"{role}: {board.name}" for role, board in chosen.boards.items()}
    titles |= {role: f"{role}: {part.name}" for role, part in chosen.components.items()}
    titles |= {"battery": f"battery: {chosen.battery.name}", "motor": f"motor: {robot.layout.drive.train.motor.name}",
               "steering motor": f"steering: {robot.workshop.steering.motor}"}  # fmt: skip
    return titles | {name: f"{name}: {ohm / 1000:g} kΩ" for name, ohm in robot.wiring.resistors.items()}


def _boxes(nets: tuple[Net, ...], titles: dict[str, str]) -> tuple[list[dict[str, Any]], dict[Terminal, Point], float]:
    """Return the boxes, where each terminal's wire starts (right edge of its box), and the drawing's height."""
    terminals: dict[str, list[Terminal]] = {}
    for terminal in dict.fromkeys(terminal for net in nets for terminal in net.terminals):
        terminals.setdefault(terminal.part, []).append(terminal)
    pitch = COLUMN_MM + 2.0 * len(nets)
    boxes: list[dict[str, Any]] = []
    ends: dict[Terminal, Point] = {}
    height = 0.0
    for column, parts in enumerate(COLUMNS):
        x, y = MARGIN_MM + column * pitch, MARGIN_MM
        for part in (part for part in parts if part in terminals):
            starts = {one: (x + BOX_MM, y + ROW_MM * (row + 1.3)) for row, one in enumerate(terminals[part])}
            ends |= starts
            size = BOX_MM, ROW_MM * (len(starts) + 1)
            pins = [(one.pin, *at) for one, at in starts.items()]
            boxes.append({"x": x, "y": y, "size": size, "title": titles[part], "pins": pins})
            y += size[1] + ROW_MM
        height = max(height, y)
    return boxes, ends, height + 4.0 * len(nets) + MARGIN_MM


def _lines(net: Net, ends: dict[Terminal, Point], lane: int, stroke: str) -> dict[str, Any]:
    """Return a net's lines: from each terminal to the right, down a track of its own, along a lane below all parts."""
    starts = [ends[terminal] for terminal in net.terminals]
    tracks = [x + 4.0 + 2.0 * lane for x, _ in starts]
    several = len(set(tracks)) > 1
    bottom = max(y for _, y in ends.values()) + ROW_MM + 4.0 * lane if several else max(y for _, y in starts)
    wires = [[(x, y), (track, y), (track, bottom)] for (x, y), track in zip(starts, tracks, strict=True)]
    along = [(min(tracks), bottom), (max(tracks), bottom)] if several else []
    aside = next((one.pin for one in net.terminals if one.part == "gyroscope"), "")  # of a net without a lane
    return {"name": net.name, "stroke": stroke, "wires": wires, "lane": along, "aside": "" if along else aside}
