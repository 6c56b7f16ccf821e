"""wiring.svg and the guide's wiring table: every wire with its ends as the boards name them, colour, length and way."""

from collections.abc import Iterator
from html import escape

from jumpcad.bundle.electronics import jumps_per_charge
from jumpcad.bundle.lead_drawing import STROKES, leads_svg
from jumpcad.bundle.operation import charging
from jumpcad.bundle.soldering import soldering_svg
from jumpcad.electronics.chosen import Chosen, chosen_parts
from jumpcad.electronics.nets import Net, Terminal, Wiring, wiring_of
from jumpcad.parts.lead_ways import way_words
from jumpcad.parts.leads import lead_lengths
from jumpcad.robot import Robot

ROW_MM, BOX_MM, COLUMN_MM, MARGIN_MM = 7.0, 50.0, 68.0, 8.0
COLUMNS = (("battery", "plug", "switch"), ("capacitor", "driver", "motor", "regulator", "diode"),
           ("controller", "sensor", "upper resistor", "lower resistor", "pull-up resistor"))  # fmt: skip
"""Where the drawing has its parts, from the left."""
SOLDERED = (
    "The drawing shows what is connected, not where bodies lie: those are bent around the board to its end without USB "
    "socket, between controller and driver, as the picture of the upper tray shows."
)
BY_METER = (
    "- sensor, by multimeter: COM and NC have contact only while the plunger is free, COM and NO only while it is",
    "  pressed. Switch: 1 and 2 are the two terminals that have contact in one position only",
)
WAYS = (
    "- numbers are those of the table. Lines end in the middle of a part; its terminals are in the table and under",
    "  wiring.svg. Seen from above, a lead beside a plate runs above the boards, at the height of wire hole or switch",
    "- wire hole: the round one, one in each plate. A cable tie through the two slots above it holds the leads,",
    "  outside, as strain relief; inside they are tied together beside the boards",
)
OPENS = (
    "- use COM and NC: pressed, the contact opens and the pin goes high. A broken lead or a dirty contact reads as",
    "  ready too, so the motor stops instead of releasing the springs by itself",
)
CLOSES = (
    "- known limit: this sensor has no contact that opens. With a lead broken the motor does not stop when ready: it",
    "  releases the springs by itself and runs until the time-out",
)


def drawings_of(robot: Robot) -> dict[str, str]:
    """Return the drawings of the wiring by their files; an empty one is not written."""
    return {"wiring.svg": wiring_svg(robot), "leads.svg": leads_svg(robot), "soldering.svg": soldering_svg(robot)}


def wires(robot: Robot) -> list[tuple[str, Terminal, Terminal, str, float]]:
    """Return every wire: its net, both ends, colour and length to cut (mm)."""
    return lead_lengths(robot.layout, wiring_of(chosen_parts(robot.workshop), robot.workshop.bought.pins))


def wiring_lines(robot: Robot) -> Iterator[str]:
    """Yield the guide's section on wiring."""
    chosen = chosen_parts(robot.workshop)
    wiring, train = wiring_of(chosen, robot.workshop.bought.pins), robot.layout.drive.train
    yield from ("", "## Wiring", "", "![wiring](wiring.svg)", "")
    yield from ("| no. | from | to | colour | mm | way |", "|--:|---|---|---|--:|---|")
    for number, (_, start, end, colour, length) in enumerate(wires(robot), start=1):
        way, cut = way_words(robot.layout, start.part, end.part), f"{length:.0f}" if length else "none"
        yield f"| {number} | {start} | {end} | {colour} | {cut} | {way} |"
    yield from ("", "![leads](leads.svg)", "", *WAYS)
    if soldering_svg(robot):
        yield from ("", "![soldering](soldering.svg)", "", SOLDERED)
    yield from ("", *_notes(chosen, wiring), "")
    yield (
        f"One jump takes {train.electrical_j:.2f} J from the battery: {train.motor_j:.2f} J the motor, "
        f"{train.boards_j:.2f} J the boards while it winds for {train.winding_s:.1f} s; waiting takes more. A charge "
        f"lasts for about {float(f'{jumps_per_charge(robot):.2g}'):.0f} jumps."
    )


def _notes(chosen: Chosen, wiring: Wiring) -> Iterator[str]:
    """Yield what a table does not say."""
    yield "- lengths follow the trays, those of sensor and motor pass the plates' holes; 30 mm are for bends and"
    yield "  solder, 40 mm more at sensor and switch, which are soldered beside the robot and then put in their places"
    yield "- none: the part's own legs or leads, each leg in a piece of heat-shrink tube"
    yield "- a leg too short for its way around the board: solder 40 mm of wire to it, of that colour where it is there"
    yield "- joints of more than two wires, as at the plug's minus: in heat-shrink tube of 4 mm"
    beep = ""
    if "capacitor" in chosen.components:
        yield "- capacitor: its wires start at the driver's supply pins; its minus is marked"
        beep = "; a short beep is the capacitor"
    if wiring.resistors:
        values = ", ".join(
            f"{name.removesuffix(' resistor')} {ohm / 1000:g} kΩ" for name, ohm in wiring.resistors.items()
        )
        yield f"- resistors: {values}, 0.1 W or more; their bodies lie between controller and driver"
    grounds = chosen.controller.with_function("ground")
    if chosen.regulator is None and len(grounds) > 1:
        yield f"- {' and '.join(grounds)} of the controller are connected on the board: use the one that is nearer"
    if chosen.regulator is None:
        yield f"- {charging(chosen)}"
    else:
        pads = chosen.controller.with_function("battery")
        yield f"- {charging(chosen)}" + (" The controller's battery pads stay empty" if pads else "")
    if chosen.diode is not None:
        yield "- diode: K is the end with the ring, at the controller"
    if "sensor" in chosen.components:
        yield from (*BY_METER, *(OPENS if wiring.ready_level else CLOSES))
    yield "- the driver's reverse input is at ground: the cam must not turn back against its drop"
    yield "- red and black wires may be joined at any terminal of theirs; the table starts each at its source"
    yield "- before the battery is plugged in, with the switch on: no contact between the plug's poles"
    yield f"  (multimeter{beep})"


def wiring_svg(robot: Robot) -> str:
    """Return a drawing of the net list: parts as boxes with their terminals, every net in a lane of its own (mm)."""
    chosen = chosen_parts(robot.workshop)
    wiring = wiring_of(chosen, robot.workshop.bought.pins)
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
