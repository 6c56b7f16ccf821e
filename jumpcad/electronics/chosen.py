"""The electrical parts of a workshop, found in its catalogue."""

from dataclasses import dataclass

from jumpcad.catalogue import Battery, Board, Catalogue, Component
from jumpcad.workshop import BoughtParts, Workshop

COMPONENTS = ("sensor", "switch", "plug", "capacitor", "diode", "wire")
"""Roles of small parts; a workshop may leave each out."""


@dataclass(frozen=True)
class Chosen:
    """Battery, boards and small parts; `components` holds those that are not left out, by role."""

    battery: Battery
    controller: Board
    driver: Board
    regulator: Board | None
    components: dict[str, Component]

    @property
    def boards(self) -> dict[str, Board]:
        """Every board by its role."""
        boards = {"controller": self.controller, "driver": self.driver}
        return boards | ({"regulator": self.regulator} if self.regulator else {})

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
    return chosen_of(workshop.catalogue, workshop.bought)


def chosen_of(catalogue: Catalogue, names: BoughtParts) -> Chosen:
    """Return the electrical parts of those names in a catalogue."""
    roles = [role for role in COMPONENTS if getattr(names, role)]
    return Chosen(
        battery=catalogue.batteries[names.battery],
        controller=catalogue.boards[names.controller],
        driver=catalogue.boards[names.driver],
        regulator=catalogue.boards[names.regulator] if names.regulator else None,
        components={role: catalogue.components[getattr(names, role)] for role in roles},
    )
