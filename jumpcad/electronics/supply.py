"""The electrical parts of a workshop; supply of the motor: battery, driver, PWM, power of boards (V, A, ohm, N·m, W).

A brushed motor is linear: with the resistance R = V/I_stall and the constants k of torque and voltage, a source of U
in series with a resistance r turns the unloaded shaft with (U - I_0·(R + r))/k and stalls it with U/(R + r).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from jumpcad.catalogue import Battery, Board, Catalogue, Component, Motor
from jumpcad.workshop import BoughtParts, Workshop

COMPONENTS = ("sensor", "switch", "plug", "capacitor", "diode", "wire")
"""Roles of small parts; a workshop may leave each out."""


@dataclass(frozen=True)
class Chosen:
    """Battery, boards and small parts; `components` holds those that are not left out, by role."""

    battery: Battery
    controller: Board
    driver: Board
    regulator: Board | None = None
    components: dict[str, Component] = field(default_factory=dict)
    gyroscope: Board | None = None

    @property
    def boards(self) -> dict[str, Board]:
        """The boards by their roles, in the order in which they lie on the upper tray, from the back."""
        boards = {"controller": self.controller, "driver": self.driver, "regulator": self.regulator,
                  "gyroscope": self.gyroscope}  # fmt: skip
        return {role: board for role, board in boards.items() if board}

    @property
    def diode(self) -> Component | None:
        """The diode after the regulator."""
        return self.components.get("diode") if self.regulator else None

    @property
    def charged_by_usb(self) -> bool:
        """Tell whether the controller charges the battery: one cell, without a regulator between, and a charger.

        A board that neither says `charge_ma` nor has pads for a cell has no charger.
        """
        charger = self.controller.charge_ma is not None or bool(self.controller.with_function("battery"))
        return charger and self.regulator is None and self.battery.cells == 1


def chosen_parts(workshop: Workshop) -> Chosen:
    """Return the electrical parts of a workshop."""
    catalogue, name = workshop.catalogue, workshop.steering.gyroscope
    return replace(chosen_of(catalogue, workshop.bought), gyroscope=catalogue.boards[name] if name else None)


def chosen_of(catalogue: Catalogue, names: BoughtParts) -> Chosen:
    """Return the electrical parts of those names in a catalogue."""
    roles = [role for role in COMPONENTS if getattr(names, role)]
    battery, boards = catalogue.batteries[names.battery], catalogue.boards
    regulator = boards[names.regulator] if names.regulator else None
    components = {role: catalogue.components[getattr(names, role)] for role in roles}
    return Chosen(battery, boards[names.controller], boards[names.driver], regulator, components)


@dataclass(frozen=True)
class Supply:
    """A battery with a driver.

    - `empty_v`, `nominal_v`, `full_v`: Of the battery without load.
    - `ohm`: Of battery and driver in series with the motor; the battery's is counted as if PWM did not lower its
      current.
    - `boards_w`: Power of all boards at the nominal voltage, whether the motor turns or not. The
      1 to 2 mA of the sensor's pull-up are not counted: they are within the scatter of the boards' currents.
    - `usable_j`: Energy of a full battery.
    """

    empty_v: float
    nominal_v: float
    full_v: float
    ohm: float
    boards_w: float
    usable_j: float

    def duty(self, motor: Motor, torque_max_nm: float) -> float:
        """Return the largest mean share of a full battery's voltage that overloads neither gearbox nor winding.

        At most 1. The series resistance, which is not known well, is neglected: this is on the safe side.
        """
        rise = (motor.stall_current_a - motor.no_load_current_a) / motor.stall_torque_nm
        stall_v = _ohm(motor) * (motor.no_load_current_a + rise * torque_max_nm)
        return min(1.0, stall_v / self.full_v, motor.range_v[1] / self.full_v)

    def pwm(self, motor: Motor, torque_max_nm: float) -> float:
        """Return the share of PWM that gives the motor `duty` of the battery's voltage.

        The driver's other input is at ground: in the pauses both its outputs are off, and the current flows on against
        the battery through the diodes ("fast decay", TI DRV8833, table of PWM control). The mean is 2·share - 1 while
        current flows all the time, as it does at 20 kHz where the winding's L/R is 0.1 ms or more: judgement.
        """
        return (1.0 + self.duty(motor, torque_max_nm)) / 2.0

    def driven(self, motor: Motor, volts: float, torque_max_nm: float) -> Motor:
        """Return the motor as it behaves with the battery at some volts, under PWM: speed, stall and voltage."""
        mean_v = self.duty(motor, torque_max_nm) * volts
        ohm, unloaded = _ohm(motor), motor.no_load_current_a
        stall_a = mean_v / (ohm + self.ohm)
        speed = (mean_v - unloaded * (ohm + self.ohm)) / (motor.voltage_v - unloaded * ohm)
        torque = (stall_a - unloaded) / (motor.stall_current_a - unloaded)
        now = {"voltage_v": mean_v, "no_load_rpm": speed * motor.no_load_rpm, "stall_current_a": stall_a}
        return motor.model_copy(update=now | {"stall_torque_nm": torque * motor.stall_torque_nm})


def _ohm(motor: Motor) -> float:
    return motor.voltage_v / motor.stall_current_a


def boards_beside_a(chosen: Chosen) -> float:
    """Return what driver and regulator draw from the battery while something else feeds the controller."""
    return chosen.driver.quiescent_a + (chosen.regulator.quiescent_a if chosen.regulator else 0.0)


def supply_of(chosen: Chosen) -> Supply:
    """Return what a workshop's parts supply a motor with."""
    battery, regulator = chosen.battery, chosen.regulator
    empty, full = battery.range_v
    behind_v = battery.voltage_v if regulator is None else (regulator.output_v or battery.voltage_v)
    share = 1.0 if regulator is None else regulator.efficiency
    behind_a = chosen.controller.quiescent_a + (chosen.gyroscope.quiescent_a if chosen.gyroscope else 0.0)
    boards_w = behind_a * behind_v / share + boards_beside_a(chosen) * battery.voltage_v
    return Supply(
        empty_v=empty, nominal_v=battery.voltage_v, full_v=full, ohm=battery.ohm + chosen.driver.resistance_ohm,
        boards_w=boards_w, usable_j=3.6 * battery.capacity_mah * battery.voltage_v,
    )  # fmt: skip


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
    if chosen.gyroscope is not None and (volts := chosen.controller.logic_v):
        yield _board_link("gyroscope", chosen.gyroscope, (volts, volts), "another steering.gyroscope")
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
