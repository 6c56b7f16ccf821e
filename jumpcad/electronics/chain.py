"""The chain of voltages from the battery to the motor's winding: the voltage at each link and its rated range (V)."""

from collections.abc import Iterator
from dataclasses import dataclass

from jumpcad.catalogue import Board, Motor
from jumpcad.electronics.chosen import Chosen
from jumpcad.electronics.supply import Supply

Range = tuple[float, float]


@dataclass(frozen=True)
class Link:
    """One part of the chain: `gets_v` is the voltage at its input `pin`, `bears_v` its rated range (None if unknown).

    `role` is `controller`, `driver`, `regulator`, `motor` or a small part's; `remedy` says what to change.
    """

    role: str
    name: str
    pin: str
    gets_v: Range
    bears_v: Range | None
    remedy: str


def supply_pin(board: Board, volts: Range) -> str:
    """Return the input rated for a range of volts, else the first; empty where none is known."""
    bears = (pin for pin, (low, high) in board.supply_v.items() if low <= volts[0] and volts[1] <= high)
    return next(bears, next(iter(board.supply_v), ""))


def chain(chosen: Chosen, motor: Motor, supply: Supply, peak_a: float, torque_max_nm: float) -> Iterator[Link]:
    """Yield every link; `peak_a` is the motor's largest current, which lowers an empty battery's voltage."""
    battery = chosen.battery
    empty, full = battery.range_v
    direct = (empty - peak_a * battery.ohm, full)
    logic = direct
    regulator = chosen.regulator
    if regulator is not None:
        yield _board_link("regulator", regulator, direct, "another bought.regulator or bought.battery")
        out = regulator.output_v or 0.0
        drop = chosen.diode.drop_v if chosen.diode else 0.0
        logic = (out - drop, out - drop)
    remedy = "choose a bought.kit, a bought.battery within this range, or a bought.regulator before the controller"
    yield _board_link("controller", chosen.controller, logic, remedy)
    yield _board_link("driver", chosen.driver, direct, "choose a bought.kit, another bought.driver or bought.battery")
    duty = supply.duty(motor, torque_max_nm)
    mean = (duty * empty, duty * full)
    yield Link("motor", motor.name, "winding", mean, motor.range_v,
               "choose a bought.kit, a motor for this battery in bought.motors, or another bought.battery")  # fmt: skip
    for role in ("switch", "plug", "capacitor"):
        part = chosen.components.get(role)
        if part is not None and part.rated_v is not None:
            yield Link(role, part.name, "", direct, (0.0, part.rated_v), f"another bought.{role}")


def _board_link(role: str, board: Board, volts: Range, remedy: str) -> Link:
    pin = supply_pin(board, volts)
    return Link(role, board.name, pin, volts, board.supply_v.get(pin), remedy)
