"""Bought parts: a catalogue of motors, bearings, fasteners, electronics and spring wire, read from the templates.

Every table names the source of its figures. Lengths in mm, masses in g, torques in N·m.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Generic, TypeVar

from pydantic import PositiveFloat

from jumpcad.errors import JumpcadError
from jumpcad.files import Record, did_you_mean, read_toml, templates_folder


class Motor(Record):
    """A brushed gear motor. Its axis lies along its body; width and height are across it, the shaft is D-shaped."""

    name: str
    ratio: PositiveFloat
    voltage_v: PositiveFloat
    no_load_rpm: PositiveFloat
    no_load_current_a: PositiveFloat
    stall_torque_nm: PositiveFloat
    stall_current_a: PositiveFloat
    mass_g: PositiveFloat
    width_mm: PositiveFloat
    height_mm: PositiveFloat
    body_length_mm: PositiveFloat
    shaft_mm: PositiveFloat
    shaft_flat_mm: PositiveFloat
    shaft_length_mm: PositiveFloat


class Bearing(Record):
    """A ball bearing."""

    name: str
    bore_mm: PositiveFloat
    outer_mm: PositiveFloat
    width_mm: PositiveFloat
    mass_g: PositiveFloat
    static_load_n: PositiveFloat


class Battery(Record):
    """A battery pack: length along the robot, width across it."""

    name: str
    description: str
    length_mm: PositiveFloat
    width_mm: PositiveFloat
    height_mm: PositiveFloat
    mass_g: PositiveFloat
    voltage_v: PositiveFloat
    capacity_mah: PositiveFloat


class Board(Record):
    """A circuit board with what stands on it."""

    name: str
    description: str
    length_mm: PositiveFloat
    width_mm: PositiveFloat
    height_mm: PositiveFloat
    mass_g: PositiveFloat


class Screw(Record):
    """A metric screw size with its heads and the lengths that shops keep."""

    name: str
    diameter_mm: PositiveFloat
    cylinder_head_mm: PositiveFloat
    cylinder_head_height_mm: PositiveFloat
    button_head_mm: PositiveFloat
    button_head_height_mm: PositiveFloat
    lengths_mm: list[PositiveFloat]

    def length_for(self, needed_mm: float) -> float:
        """Return the shortest length kept that is at least what is needed (mm)."""
        for length in self.lengths_mm:
            if length >= needed_mm - 1e-9:
                return length
        raise JumpcadError(
            f"no {self.name} screw of {needed_mm:.1f} mm; the longest kept is {self.lengths_mm[-1]:g} mm"
        )


class Nut(Record):
    """A hexagon nut."""

    name: str
    across_flats_mm: PositiveFloat
    height_mm: PositiveFloat
    mass_g: PositiveFloat


class Washer(Record):
    """A flat washer."""

    name: str
    outer_mm: PositiveFloat
    bore_mm: PositiveFloat
    height_mm: PositiveFloat
    mass_g: PositiveFloat


class Standoff(Record):
    """A hexagon standoff with threads at both ends, cut to any length."""

    name: str
    across_flats_mm: PositiveFloat
    density_g_cm3: PositiveFloat
    bore_mm: PositiveFloat


class Wire(Record):
    """Spring steel wire: preferred diameters and the minimum tensile strength at each."""

    source: str
    modulus_mpa: PositiveFloat
    density_g_cm3: PositiveFloat
    diameters_mm: list[PositiveFloat]
    tensile_strength_mpa: list[PositiveFloat]


Article = TypeVar("Article", bound=Record)


class Shelf(Mapping[str, Article], Generic[Article]):
    """Articles of one kind by name; an unknown name is an error with a hint."""

    def __init__(self, kind: str, items: dict[str, Article]) -> None:
        self._kind, self._items = kind, items

    def __getitem__(self, name: str) -> Article:
        if name not in self._items:
            known = ", ".join(self._items)
            raise JumpcadError(f"no {self._kind} {name!r} in the catalogue ({known}){did_you_mean(name, self._items)}")
        return self._items[name]

    def __iter__(self) -> Any:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)


@dataclass(frozen=True)
class Catalogue:
    """All bought parts that a robot can be made of."""

    motors: Shelf[Motor]
    bearings: Shelf[Bearing]
    batteries: Shelf[Battery]
    boards: Shelf[Board]
    screws: Shelf[Screw]
    nuts: Shelf[Nut]
    washers: Shelf[Washer]
    standoffs: Shelf[Standoff]
    wire: Wire
    rod_density_g_cm3: float

    def rod_mass_g(self, diameter_mm: float, length_mm: float) -> float:
        """Return the mass of a steel rod (g)."""
        return self.rod_density_g_cm3 * math.pi / 4.0 * diameter_mm**2 * length_mm / 1000.0


@lru_cache(maxsize=1)
def load_catalogue() -> Catalogue:
    """Return the shipped catalogue."""
    folder = templates_folder() / "hardware"
    motors = _read(folder / "motors.toml")
    defaults = motors.pop("defaults")
    electronics, fasteners = _read(folder / "electronics.toml"), _read(folder / "fasteners.toml")
    return Catalogue(
        motors=_shelf("motor", Motor, {name: defaults | values for name, values in motors.items()}),
        bearings=_shelf("bearing", Bearing, _read(folder / "bearings.toml")),
        batteries=_shelf("battery", Battery, electronics["batteries"]),
        boards=_shelf("board", Board, electronics["boards"]),
        screws=_shelf("screw", Screw, fasteners["screws"]),
        nuts=_shelf("nut", Nut, fasteners["nuts"]),
        washers=_shelf("washer", Washer, fasteners["washers"]),
        standoffs=_shelf("standoff", Standoff, fasteners["standoffs"]),
        wire=Wire.from_toml(folder / "wire.toml"),
        rod_density_g_cm3=fasteners["rods"]["density_g_cm3"],
    )


def _read(path: Path) -> dict[str, Any]:
    data, _ = read_toml(path)
    data.pop("source")
    return data


def _shelf(kind: str, model: type[Article], tables: dict[str, Any]) -> Shelf[Article]:
    return Shelf(kind, {name: model(name=name, **values) for name, values in tables.items()})
