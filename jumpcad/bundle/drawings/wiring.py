"""wiring.svg: every net with its terminals as the boards name them; the list of wires."""

from typing import Any

from jumpcad.bundle.drawings.lead_drawing import STROKES, leads_svg
from jumpcad.bundle.drawings.soldering import soldering_svg
from jumpcad.electronics.chosen import Chosen
from jumpcad.electronics.nets import Net, Terminal, Wiring
from jumpcad.files.rendering import fill
from jumpcad.robot.electronics.leads import has_own_legs, lead_lengths
from jumpcad.robot.robot import Robot

ROW_MM, BOX_MM, COLUMN_MM, MARGIN_MM = 7.0, 50.0, 68.0, 8.0
COLUMNS = (("battery", "plug", "switch"), ("capacitor", "driver", "motor", "steering motor", "regulator", "diode"),
           ("controller", "sensor", "upper resistor", "lower resistor", "pull-up resistor"))  # fmt: skip
"""Where the drawing has its parts, from the left."""
OWN_LEGS = "#8a8f96"
"""Of nets without a wire: parts' own legs."""
Point = tuple[float, float]


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
    boxes, ends, height = _boxes(nets, _titles(robot.electrical_parts, robot.wiring, robot))
    width = COLUMN_MM * (len(COLUMNS) - 1) + BOX_MM + 8.0 * len(nets) + 3.0 * MARGIN_MM
    wired = {name for name, *_, colour, _ in wires(robot) if colour}
    drawn = [
        _lines(net, ends, lane, STROKES[net.colour] if net.name in wired else OWN_LEGS) for lane, net in enumerate(nets)
    ]
    return fill("drawings/wiring.svg.j2", {"width": width, "height": height, "nets": drawn, "boxes": boxes})


def _titles(chosen: Chosen, wiring: Wiring, robot: Robot) -> dict[str, str]:
    """Return what each part is called."""
    titles = {role: f"{role}: {board.name}" for role, board in chosen.boards.items()}
    titles |= {role: f"{role}: {part.name}" for role, part in chosen.components.items()}
    titles |= {"battery": f"battery: {chosen.battery.name}", "motor": f"motor: {robot.layout.drive.train.motor.name}",
               "steering motor": f"steering: {robot.workshop.steering.motor}"}  # fmt: skip
    return titles | {name: f"{name}: {ohm / 1000:g} kΩ" for name, ohm in wiring.resistors.items()}


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
    return {"name": net.name, "stroke": stroke, "wires": wires, "lane": along}
