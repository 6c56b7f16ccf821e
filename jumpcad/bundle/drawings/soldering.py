"""soldering.svg: the controller from above with the small parts that are soldered to its pins by their own legs."""

from collections.abc import Iterator
from html import escape

from jumpcad.electronics.nets import AT, Terminal, Wiring
from jumpcad.parts.leads import OWN_LEGS
from jumpcad.robot import Robot, carried

PITCH_MM, WIDE_MM, AROUND_MM, TOP_MM = 7.0, 46.0, 48.0, 18.0
ROW_MM, TRACK_MM, BODY_MM = 9.0, 3.0, (22.0, 4.0)
"""Of the drawing, which is not to scale: between pins, the board, room beside and above it, between bodies and legs."""
CONTROLLER = "controller"
Point = tuple[float, float]


@carried
def soldering_svg(robot: Robot) -> str:
    """Return the drawing; empty where nothing is soldered so, or where the board's sides are not known."""
    chosen = robot.electrical_parts
    board, wiring = chosen.controller, robot.wiring
    legs = {name: legs for name in OWN_LEGS if (legs := _legs(wiring, name))}
    if not legs or not (board.left or board.right):
        return ""
    used = {end.pin for pair in legs.values() for _, end in pair if end.part == CONTROLLER}
    below = tuple(sorted(used - {*board.left, *board.right}))
    pins = _pins(board.left, board.right, below)
    height = PITCH_MM * (max(len(board.left), len(board.right) + len(below)) + 1)
    width, total = WIDE_MM + 2.0 * AROUND_MM, TOP_MM + height + ROW_MM * (len(legs) + 1)
    middle, bottom = width / 2.0, TOP_MM + height
    drawn = [part for row, name in enumerate(legs)
             for part in _part(name, legs[name], wiring, pins, row, bottom + ROW_MM * (row + 1))]  # fmt: skip
    drawn += [part for pin, at in pins.items() for part in _pin(pin, at, at[0] < middle, pin in used, pin in below)]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.1f} {total:.1f}" width="{4 * width:.0f}" '
            'font-family="sans-serif">',
            f'<rect width="{width:.1f}" height="{total:.1f}" fill="#ffffff"/>',
            f'<rect x="{AROUND_MM:.1f}" y="{TOP_MM:.1f}" width="{WIDE_MM:.1f}" height="{height:.1f}" '
            'fill="#e9f3ea" stroke="#1f7a46" stroke-width="0.5"/>',
            _text((middle, TOP_MM - 10.0), f"{board.name} from above, not to scale", "middle"),
            _text((middle, TOP_MM - 4.0), "USB socket at this end", "middle"),
            *sorted(drawn, key=lambda part: part.startswith("<text")),
            "</svg>",
            "",
        ]
    )


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


def _pin(name: str, at: Point, is_left: bool, used: bool, below: bool) -> Iterator[str]:
    fill = "#c9a227" if used else "#ffffff"
    yield f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="1.2" fill="{fill}" stroke="#555555" stroke-width="0.3"/>'
    words = f"{name} (underneath)" if below else name
    yield _text((at[0] + (3.0 if is_left else -3.0), at[1] + 1.2), words, "start" if is_left else "end")


def _part(
    name: str, legs: list[tuple[str, Terminal]], wiring: Wiring, pins: dict[str, Point], row: int, y: float
) -> Iterator[str]:
    """Yield a part's body below the board, its legs, and what is written at them."""
    middle, (width, height) = AROUND_MM + WIDE_MM / 2.0, BODY_MM
    for side, (own, end) in zip((-1.0, 1.0), _left_first(legs, pins, middle), strict=False):
        body = (middle + side * width / 2.0, y)
        if end.part == CONTROLLER:
            pin = pins[end.pin]
            outwards = -1.0 if pin[0] < middle else 1.0
            beside = 0.0 if outwards == side else TRACK_MM / 2.0  # apart from the other leg, which is on this side too
            out = pin[0] + outwards * (TRACK_MM * (row + 1.5) + beside)
            turns = [(out, y)] if outwards == side else [(out, y + 3.4), (body[0] + 3.0 * side, y + 3.4),
                                                         (body[0] + 3.0 * side, y)]  # fmt: skip
            points = [pin, (out, pin[1]), *turns, body]
        else:
            points = [body, (body[0] + side * 4.0, y)]
            yield _text((body[0] + side * 5.0, y + 1.2), f"wire to {end}", "start" if side > 0.0 else "end")
        shown = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
        yield f'<polyline points="{shown}" fill="none" stroke="#555555" stroke-width="0.7"/>'
        if own == "K":
            x = body[0] - side * 2.4
            yield f'<line x1="{x:.1f}" y1="{y - 2.0:.1f}" x2="{x:.1f}" y2="{y + 2.0:.1f}" stroke="#222222"/>'
        if own.isalpha():
            yield _text((body[0] + side * 1.0, y - 1.2), own, "start" if side > 0.0 else "end")
    yield (
        f'<rect x="{middle - width / 2.0:.1f}" y="{y - height / 2.0:.1f}" width="{width:.1f}" height="{height:.1f}" '
        'rx="1" fill="#e8d9b5" fill-opacity="0.6" stroke="#444444" stroke-width="0.3"/>'
    )
    ohm = wiring.resistors.get(name)
    words = name.removesuffix(" resistor") + (f" {ohm / 1000:g} kΩ" if ohm else "")
    yield _text((middle, y + 1.1), words, "middle", 2.8)


def _left_first(legs: list[tuple[str, Terminal]], pins: dict[str, Point], middle: float) -> list[tuple[str, Terminal]]:
    """Return a part's legs, that to the leftmost pin first; a wire goes to the side that the other leg leaves free."""
    at = [pins[end.pin][0] if end.part == CONTROLLER else None for _, end in legs]
    x = [2.0 * middle - (other or 0.0) if own is None else own for own, other in zip(at, at[::-1], strict=True)]
    return [legs[index] for index in sorted(range(len(legs)), key=lambda index: x[index])]


def _text(at: Point, words: str, anchor: str, size: float = 3.4) -> str:
    return (
        f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" text-anchor="{anchor}" font-size="{size:g}" stroke="#ffffff" '
        f'stroke-width="0.8" paint-order="stroke">{escape(words)}</text>'
    )
