"""soldering.svg: the controller from above with the small parts that are soldered to its pins by their own legs."""

from typing import Any

from jumpcad.electronics.nets import AT, Terminal, Wiring
from jumpcad.files.rendering import fill
from jumpcad.parts.leads import OWN_LEGS
from jumpcad.robot import Robot, carried

PITCH_MM, WIDE_MM, AROUND_MM, TOP_MM = 7.0, 46.0, 48.0, 18.0
ROW_MM, TRACK_MM, BODY_MM = 9.0, 3.0, (22.0, 4.0)
"""Of the drawing, which is not to scale: between pins, the board, room beside and above it, between bodies and legs."""
MIDDLE_MM = AROUND_MM + WIDE_MM / 2.0
CONTROLLER = "controller"
Point = tuple[float, float]


@carried
def soldering_svg(robot: Robot) -> str:
    """Return the drawing; empty where nothing is soldered so, or where the board's sides are not known."""
    board, wiring = robot.electrical_parts.controller, robot.wiring
    legs = {name: legs for name in OWN_LEGS if (legs := _legs(wiring, name))}
    if not legs or not (board.left or board.right):
        return ""
    used = {end.pin for pair in legs.values() for _, end in pair if end.part == CONTROLLER}
    below = tuple(sorted(used - {*board.left, *board.right}))
    pins = _pins(board.left, board.right, below)
    height = PITCH_MM * (max(len(board.left), len(board.right) + len(below)) + 1)
    values = {
        "board": board.name,
        "x": AROUND_MM,
        "y": TOP_MM,
        "wide": WIDE_MM,
        "high": height,
        "width": WIDE_MM + 2.0 * AROUND_MM,
        "height": TOP_MM + height + ROW_MM * (len(legs) + 1),
        "middle": MIDDLE_MM,
        "body": BODY_MM,
        "parts": [
            _part(name, legs[name], wiring, pins, row, TOP_MM + height + ROW_MM * (row + 1))
            for row, name in enumerate(legs)
        ],
        "pins": [
            {"at": at, "used": pin in used, "words": f"{pin} (underneath)" if pin in below else pin}
            for pin, at in pins.items()
        ],
    }
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


def _pins(left: tuple[str, ...], right: tuple[str, ...], below: tuple[str, ...]) -> dict[str, Point]:
    """Return where the pins are drawn; those underneath after the right ones."""
    sides = ((AROUND_MM, left), (AROUND_MM + WIDE_MM, (*right, *below)))
    return {pin: (x, TOP_MM + PITCH_MM * (row + 1)) for x, names in sides for row, pin in enumerate(names)}


def _part(
    name: str, legs: list[tuple[str, Terminal]], wiring: Wiring, pins: dict[str, Point], row: int, y: float
) -> dict[str, Any]:
    """Return a part's name and the height of its body below the board, and its legs with what is written at them."""
    drawn = []
    for side, (own, end) in zip((-1.0, 1.0), _left_first(legs, pins), strict=False):
        body = (MIDDLE_MM + side * BODY_MM[0] / 2.0, y)
        if end.part == CONTROLLER:
            pin = pins[end.pin]
            outwards = -1.0 if pin[0] < MIDDLE_MM else 1.0
            beside = 0.0 if outwards == side else TRACK_MM / 2.0  # apart from the other leg, which is on this side too
            out = pin[0] + outwards * (TRACK_MM * (row + 1.5) + beside)
            turns = [(out, y)] if outwards == side else [(out, y + 3.4), (body[0] + 3.0 * side, y + 3.4),
                                                         (body[0] + 3.0 * side, y)]  # fmt: skip
            points = [pin, (out, pin[1]), *turns, body]
        else:
            points = [body, (body[0] + side * 4.0, y)]
        wire = "" if end.part == CONTROLLER else f"wire to {end}"
        drawn.append({"x": body[0], "side": side, "points": points, "wire": wire, "own": own})
    ohm = wiring.resistors.get(name)
    words = name.removesuffix(" resistor") + (f" {ohm / 1000:g} kΩ" if ohm else "")
    return {"y": y, "words": words, "legs": drawn}


def _left_first(legs: list[tuple[str, Terminal]], pins: dict[str, Point]) -> list[tuple[str, Terminal]]:
    """Return a part's legs, that to the leftmost pin first; a wire goes to the side that the other leg leaves free."""
    at = [pins[end.pin][0] if end.part == CONTROLLER else None for _, end in legs]
    x = [2.0 * MIDDLE_MM - (other or 0.0) if own is None else own for own, other in zip(at, at[::-1], strict=True)]
    return [legs[index] for index in sorted(range(len(legs)), key=lambda index: x[index])]
