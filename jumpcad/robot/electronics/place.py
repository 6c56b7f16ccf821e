"""Battery and boards on their trays: their size, and their seats (mm).

In-plane places are in the body frame's x-z plane.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from jumpcad.catalogue import Component
from jumpcad.dimensions import STRAP_EDGE_MM, STRAP_SLOT_MM, TIE_SLOT_MM, TRAY_LENGTH_MIN_MM, TRAY_MM
from jumpcad.electronics.supply import Chosen
from jumpcad.solids.slab import Interval
from jumpcad.transforms import Array

Side = Literal["left", "right"]

ABOVE_BATTERY_MM = 3.8
"""Gap above the battery: its strap, 2.5 mm where hook lies on loop, and under the upper tray ties of 1.1 mm, which
cross the strap; judgement: 0.2 mm more."""
TAPE_MM = 1.0
"""Foam tape under boards: solder joints sink into it."""
SEAT_PLAY_MM, RIM_MM, RIM_HEIGHT_MM = 0.2, 1.2, 1.6
"""Play of a board in its seat, and the rims at its ends: three lines wide, up to the middle of the board."""
TIE_END_MM = 1.6
"""From a tie's slot to the end of a tray; judgement: four lines of a 0.4 mm nozzle."""
SMALL_MM = (2.3, 6.3, 2.3)
"""Room for the body of a resistor of 0.25 W or of a diode of 1 A: along the robot, across it, and up; usual sizes."""
BATTERY_PLAY_MM, STOP_HEIGHT_MM = 0.5, 2.0
"""Play of a battery between the stops at its ends, and their height; judgement: packs differ, leads pass over, and with
its strap open a battery can be lifted over them below the upper tray's ties."""
BALANCE_MM = 10.0
"""Room across for a balance lead under its tie, ahead of the battery; judgement: three wires beside their plug."""
USB_BESIDE_MM, BESIDE_PLATE_MM = 0.9, 0.6
"""From a board's end to the plate, which keeps it there: of the controller, whose USB socket stands into the plate's
opening, and of the others; judgement."""
WALL_MM, PLAY_MM = 0.8, 0.2
"""Least wall beside a tie's slot, of two lines, and play of a tray between the plates; where a workshop needs more,
what it needs; judgement."""


@dataclass(frozen=True)
class Seat:
    """Where something lies on a tray: its middle along the robot from that of the trays, and across it in the body.

    `bottom_mm` is above the lower tray's underside; `size_mm` is along the robot, across it, and up.
    """

    x_mm: float
    y_mm: float
    bottom_mm: float
    size_mm: tuple[float, float, float]


@dataclass(frozen=True)
class Electronics(Chosen):
    """Battery, boards, plug and capacitor as the trays carry them.

    The battery is strapped to the lower tray. On the upper one the boards lie in a row across it, from the back: the
    controller with its USB socket at one plate, `usb_side`, the others at the other. The capacitor lies beside the
    controller, the plug beside the foremost board and opens to the front. The battery lies as near to the leg as strap
    and plates let it, or to the plate of `battery_side`: near the leg the robot tips less sideways.

    `wall_mm` is the thinnest wall that can be printed, `play_mm` that of a tray between the plates on either side.
    """

    wall_mm: float = WALL_MM
    play_mm: float = PLAY_MM
    battery_side: Side | None = None
    usb_side: Side = "right"

    @property
    def side_mm(self) -> float:
        """From a tie's slot to the plate: a wall and the tray's play."""
        return max(WALL_MM, self.wall_mm) + max(PLAY_MM, self.play_mm)

    @property
    def rim_mm(self) -> float:
        """Thickness of the rims at the boards' ends, and of the battery's stops."""
        return max(RIM_MM, self.wall_mm)

    @property
    def ties_apart_mm(self) -> float:
        """From one board to the next: the ties of both, and a wall between them."""
        return 2.0 * (SEAT_PLAY_MM + TIE_SLOT_MM[0]) + max(WALL_MM, self.wall_mm)

    @property
    def names(self) -> str:
        """Their names, for messages."""
        *others, last = (self.battery.name, *(board.name for board in self.boards.values()))
        return f"{', '.join(others)} and {last}"

    @property
    def length_mm(self) -> float:
        """Along x: the battery, or all boards one behind the other with the slots of their ties."""
        boards = self.boards_mm + 2.0 * (SEAT_PLAY_MM + TIE_SLOT_MM[0] + TIE_END_MM)
        return max(2.0 * self._stopped_mm + self._balance_room_mm, boards, TRAY_LENGTH_MIN_MM)

    @property
    def battery_mm(self) -> float:
        """The battery's middle from that of the trays: behind it where its balance lead needs the room in front."""
        return min(0.0, self.length_mm / 2.0 - self._stopped_mm - self._balance_room_mm)

    @property
    def _stopped_mm(self) -> float:
        """Half of the battery's length with its stop, which keeps away from the strap."""
        return max(self.battery.length_mm / 2.0 + BATTERY_PLAY_MM, STRAP_SLOT_MM[1] / 2.0 + TIE_END_MM) + self.rim_mm

    @property
    def _balance_room_mm(self) -> float:
        return TIE_SLOT_MM[1] + 2.0 * TIE_END_MM if self.balanced else 0.0

    @property
    def balanced(self) -> bool:
        """Tell whether the battery has several cells, and so a balance lead."""
        return self.battery.cells > 1

    @property
    def stop_mm(self) -> float:
        """From the battery's middle to that of the stops at its ends."""
        return self._stopped_mm - self.rim_mm / 2.0

    @property
    def balance_mm(self) -> float:
        """From the battery's middle to that of the tie over its balance lead, forwards."""
        return self._stopped_mm + TIE_END_MM + TIE_SLOT_MM[1] / 2.0

    @property
    def boards_mm(self) -> float:
        """Length of all boards one behind the other, across which each has its length."""
        widths = [board.width_mm for board in self.boards.values()]
        return sum(widths) + self.ties_apart_mm * (len(widths) - 1)

    @property
    def width_mm(self) -> float:
        """Across the robot (y): the battery with its strap, or a board with what lies beside it."""
        strap = 2.0 * (1.5 * STRAP_SLOT_MM[0] + STRAP_EDGE_MM)
        boards = (board.length_mm + self._beside_mm(role) for role, board in self.boards.items())
        return max(self.battery.width_mm + strap, *boards)

    @property
    def upper_tray_mm(self) -> float:
        """From the bottom of the lower tray to that of the upper one."""
        return TRAY_MM + self.battery.height_mm + ABOVE_BATTERY_MM

    @property
    def height_mm(self) -> float:
        """From the bottom of the lower tray to the top of the boards and of what lies beside them."""
        highest = TAPE_MM + max(board.height_mm for board in self.boards.values())
        beside = (part.height_mm or 0.0 for part in self.tied.values())
        return self.upper_tray_mm + TRAY_MM + max(highest, *beside, 0.0)

    @property
    def half_mm(self) -> tuple[float, float]:
        """Half of length and height, trays and boards together."""
        return self.length_mm / 2.0, self.height_mm / 2.0

    @property
    def tied(self) -> dict[str, Component]:
        """Capacitor and plug, as far as their sizes are known."""
        parts = ((role, self.components.get(role)) for role in ("capacitor", "plug"))
        return {role: part for role, part in parts if part is not None and part.length_mm}

    def _neighbour(self, role: str) -> str:
        """Return what lies beside a board: the capacitor, the plug, or nothing."""
        beside = {"controller": "capacitor", list(self.boards)[-1]: "plug"}.get(role, "")
        return beside if beside in self.tied else ""

    def _beside_mm(self, role: str) -> float:
        """Return the room across the robot that a board needs besides its own length."""
        part = self.tied.get(self._neighbour(role))
        tied = 0.0 if part is None else (part.width_mm or 0.0) + 2.0 * TIE_SLOT_MM[0]
        return _from_plate_mm(role) + SEAT_PLAY_MM + self.rim_mm + tied + self.side_mm

    def seats(self, inside: Interval) -> dict[str, Seat]:
        """Return where everything lies on the trays between the plates."""
        low, high = inside
        battery, board_bottom = self.battery, self.upper_tray_mm + TRAY_MM + TAPE_MM
        size = (battery.length_mm, battery.width_mm, battery.height_mm)
        wanted = 0.0 if self.battery_side is None else low if self.battery_side == "right" else high
        strap = battery.width_mm / 2.0 + 1.5 * STRAP_SLOT_MM[0] + STRAP_EDGE_MM
        y = min(max(wanted, low + strap), high - strap)
        seats = {"battery": Seat(self.battery_mm, y, TRAY_MM, size)}
        start = -self.boards_mm / 2.0
        for role, board in self.boards.items():
            x, reach = start + board.width_mm / 2.0, _from_plate_mm(role) + board.length_mm / 2.0
            side = self.inwards(role)
            y = low + reach if side > 0.0 else high - reach
            seats[role] = Seat(x, y, board_bottom, (board.width_mm, board.length_mm, board.height_mm))
            beside = self._neighbour(role)
            if beside:
                part = self.tied[beside]
                size = (part.length_mm or 0.0, part.width_mm or 0.0, part.height_mm or 0.0)
                end = board.length_mm / 2.0 + SEAT_PLAY_MM + self.rim_mm + TIE_SLOT_MM[0]
                at = self.length_mm / 2.0 - size[0] / 2.0 if beside == "plug" else x
                seats[beside] = Seat(at, y + side * (end + size[1] / 2.0), board_bottom - TAPE_MM, size)
            start += board.width_mm + self.ties_apart_mm
        return seats

    def inwards(self, role: str) -> float:
        """Return 1 for a board that lies at the right plate, -1 for one at the left."""
        return 1.0 if (role == "controller") == (self.usb_side == "right") else -1.0

    def tie_slots(self, inside: Interval) -> dict[str, list[tuple[float, float, tuple[float, float]]]]:
        """Return the slots of every tie on the upper tray: middles along and across the robot, and sizes (x, y).

        A board's tie runs along the robot, beside the socket's end; those of capacitor and plug run across it.
        """
        slots = {}
        for role, seat in self.seats(inside).items():
            along, across = seat.size_mm[0] / 2.0, seat.size_mm[1] / 2.0
            if role in self.boards:
                reach = along + SEAT_PLAY_MM + TIE_SLOT_MM[0] / 2.0
                slots[role] = [(seat.x_mm + side * reach, seat.y_mm, TIE_SLOT_MM) for side in (-1.0, 1.0)]
            elif role in self.tied:
                reach, size = across + TIE_SLOT_MM[0] / 2.0, TIE_SLOT_MM[::-1]
                slots[role] = [(seat.x_mm, seat.y_mm + side * reach, size) for side in (-1.0, 1.0)]
        return slots

    def small_seats(self, inside: Interval) -> list[Seat]:
        """Return places for resistors and diode, nearest to the controller first: between it and the next board.

        Two lie side by side; they keep away from the ties of both boards and from what lies beside them.
        """
        seats = self.seats(inside)
        controller = seats["controller"]
        x = controller.x_mm + (controller.size_mm[0] + self.ties_apart_mm) / 2.0
        ties = [y for role in list(self.boards)[:2] for _, y, _ in self.tie_slots(inside)[role]]
        low, high = inside[0] + self.side_mm, inside[1] - self.side_mm
        free: list[float] = []
        length = SMALL_MM[1] + 2.0 * SEAT_PLAY_MM
        for start in np.arange(low, high - length, 0.5):
            apart = all(abs(start + length / 2.0 - y) >= (length + TIE_SLOT_MM[1]) / 2.0 for y in ties)
            if apart and (not free or start >= free[-1] + length):
                free.append(float(start))
        free.sort(key=lambda y: abs(y + length / 2.0 - controller.y_mm))
        beside = [seat for role, seat in seats.items() if role in self.tied]
        free = [y for y in free if all(_apart(seat, x, y, length) for seat in beside)]
        bottom = self.upper_tray_mm + TRAY_MM
        lanes = (-SMALL_MM[0] / 2.0, SMALL_MM[0] / 2.0)
        return [Seat(x + lane, y + length / 2.0, bottom, SMALL_MM) for y in free for lane in lanes]

    def middle_mm(self, tray_mm: Array) -> Array:
        """Return the middle (2,) of trays and boards, given that of the lower tray's underside."""
        return np.asarray(tray_mm + np.array([0.0, self.half_mm[1]]))


def _apart(seat: Seat, x_mm: float, start_mm: float, length_mm: float) -> bool:
    """Tell whether a seat is clear of two bodies side by side that begin at a place across the robot."""
    along = abs(seat.x_mm - x_mm) >= seat.size_mm[0] / 2.0 + SMALL_MM[0]
    return along or abs(seat.y_mm - start_mm - length_mm / 2.0) >= (seat.size_mm[1] + length_mm) / 2.0


def _from_plate_mm(role: str) -> float:
    return USB_BESIDE_MM if role == "controller" else BESIDE_PLATE_MM
