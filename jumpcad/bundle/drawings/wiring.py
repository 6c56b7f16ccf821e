"""wiring.svg: every net with its terminals as the boards name them; the list of wires."""

from collections.abc import Iterator
from html import escape

from jumpcad.bundle.drawings.lead_drawing import STROKES, leads_svg
from jumpcad.bundle.drawings.soldering import soldering_svg
from jumpcad.electronics.chosen import Chosen
from jumpcad.electronics.nets import Net, Terminal, Wiring
from jumpcad.parts.leads import lead_lengths
from jumpcad.robot import Robot

ROW_MM, BOX_MM, COLUMN_MM, MARGIN_MM = 7.0, 50.0, 68.0, 8.0
COLUMNS = (("battery", "plug", "switch"), ("capacitor", "driver", "motor", "regulator", "diode"),
           ("controller", "sensor", "upper resistor", "lower resistor", "pull-up resistor"))  # fmt: skip
"""Where the drawing has its parts, from the left."""


def drawings_of(robot: Robot) -> dict[str, str]:
    """Return the drawings of the wiring by their files; an empty one is not written."""
    return {"wiring.svg": wiring_svg(robot), "leads.svg": leads_svg(robot), "soldering.svg": soldering_svg(robot)}


def wires(robot: Robot) -> list[tuple[str, Terminal, Terminal, str, float]]:
    """Return every wire: its net, both ends, colour and length to cut (mm)."""
    return lead_lengths(robot.layout, robot.wiring)


def wiring_svg(robot: Robot) -> str:
    """Return a drawing of the net list: parts as boxes with their terminals, every net in a lane of its own (mm)."""
    chosen = robot.electrical_parts
    wiring = robot.wiring
    boxes, ends, height = _boxes(wiring.nets, _titles(chosen, wiring, robot))
    lanes = {net.name: index for index, net in enumerate(wiring.nets)}
    width = MARGIN_MM + COLUMN_MM * (len(COLUMNS) - 1) + BOX_MM + 4.0 * len(lanes) + 2.0 * MARGIN_MM
    width += 2.0 * 2.0 * len(lanes)
    lines = [line for net in wiring.nets for line in _net_lines(net, ends, lanes[net.name])]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.1f} {height:.1f}" width="{4 * width:.0f}" '
            'font-family="sans-serif" font-size="3.2">',
            f'<rect width="{width:.1f}" height="{height:.1f}" fill="#ffffff"/>',
            *lines,
            *boxes,
            "</svg>",
            "",
        ]
    )


def _titles(chosen: Chosen, wiring: Wiring, robot: Robot) -> dict[str, str]:
    """Return what each part is called."""
    titles = {role: f"{role}: {board.name}" for role, board in chosen.boards.items()}
    titles |= {role: f"{role}: {part.name}" for role, part in chosen.components.items()}
    titles |= {"battery": f"battery: {chosen.battery.name}", "motor": f"motor: {robot.layout.drive.train.motor.name}"}
    return titles | {name: f"{name}: {ohm / 1000:g} kΩ" for name, ohm in wiring.resistors.items()}


def _boxes(
    nets: tuple[Net, ...], titles: dict[str, str]
) -> tuple[list[str], dict[Terminal, tuple[float, float]], float]:
    """Return the boxes, where each terminal's wire starts (right edge of its box), and the drawing's height."""
    terminals: dict[str, list[Terminal]] = {}
    for terminal in dict.fromkeys(terminal for net in nets for terminal in net.terminals):
        terminals.setdefault(terminal.part, []).append(terminal)
    pitch = COLUMN_MM + 2.0 * len(nets)
    boxes, ends, height = [], {}, 0.0
    for column, parts in enumerate(COLUMNS):
        x, y = MARGIN_MM + column * pitch, MARGIN_MM
        for part in (part for part in parts if part in terminals):
            size = ROW_MM * (len(terminals[part]) + 1)
            boxes.append(
                f'<rect x="{x:.1f}" y="{y:.1f}" width="{BOX_MM:.1f}" height="{size:.1f}" fill="#f4f4f4" '
                'stroke="#444444" stroke-width="0.3"/>'
            )
            boxes.append(f'<text x="{x + 2:.1f}" y="{y + 4.5:.1f}" font-weight="bold">{escape(titles[part])}</text>')
            for row, terminal in enumerate(terminals[part], start=1):
                at = (x + BOX_MM, y + ROW_MM * (row + 0.3))
                ends[terminal] = at
                boxes.append(f'<text x="{at[0] - 2:.1f}" y="{at[1] + 1:.1f}" text-anchor="end">{terminal.pin}</text>')
            y += size + ROW_MM
        height = max(height, y)
    return boxes, ends, height + 4.0 * len(nets) + MARGIN_MM


def _net_lines(net: Net, ends: dict[Terminal, tuple[float, float]], lane: int) -> Iterator[str]:
    """Yield a net's lines: from each terminal to the right, down a track of its own, along a lane below all parts."""
    stroke = STROKES[net.colour]
    places = [ends[terminal] for terminal in net.terminals]
    tracks = sorted({x + 4.0 + 2.0 * lane for x, _ in places})
    below = max(y for _, y in ends.values()) + ROW_MM + 4.0 * lane
    bottom = below if len(tracks) > 1 else max(y for _, y in places)
    for terminal in net.terminals:
        x, y = ends[terminal]
        track = x + 4.0 + 2.0 * lane
        yield _path([(x, y), (track, y), (track, bottom)], stroke)
        yield f'<circle cx="{track:.1f}" cy="{y:.1f}" r="0.6" fill="{stroke}"/>'
    if len(tracks) > 1:
        yield _path([(tracks[0], bottom), (tracks[-1], bottom)], stroke)
        at = f'x="{tracks[0] + 1:.1f}" y="{bottom - 0.8:.1f}"'
        yield f'<text {at} font-size="2.6" fill="{stroke}">{escape(net.name)}</text>'


def _path(points: list[tuple[float, float]], stroke: str) -> str:
    shown = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{shown}" fill="none" stroke="{stroke}" stroke-width="0.6"/>'
