"""The shipped catalogue, read from the templates, and the catalogue with a user's own parts (mm, g, N·m)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Generic, NoReturn, TypeVar

from pydantic import PositiveFloat

from jumpcad.catalogue.articles import AnyArticle, Article
from jumpcad.catalogue.bars import CageRod, ClevisPin, Clip, LegBar, Rod
from jumpcad.catalogue.boards import Board
from jumpcad.catalogue.electrical import Battery, Component, Kit, Motor
from jumpcad.catalogue.mechanical import Bearing, ORing, Pad, StockSpring
from jumpcad.errors import JumpcadError
from jumpcad.files import Record, TomlTable, did_you_mean, read_toml, templates_folder


class Screw(Record):
    """A metric screw size with its heads and the lengths in stock; `norm` is that of its low head, the button."""

    name: str
    norm: str = "ISO 7380-1"
    diameter_mm: PositiveFloat
    cylinder_head_mm: PositiveFloat
    cylinder_head_height_mm: PositiveFloat
    button_head_mm: PositiveFloat
    button_head_height_mm: PositiveFloat
    lengths_mm: list[PositiveFloat]

    def length_for(self, needed_mm: float, remedy: str = "choose thinner parts") -> float:
        """Return the shortest stock length of at least what is needed (mm); `remedy` is what a user may change."""
        for length in self.lengths_mm:
            if length >= needed_mm - 1e-9:
                return length
        raise JumpcadError(
            f"no {self.name} screw of {needed_mm:.1f} mm; the longest in stock is {self.lengths_mm[-1]:g} mm: {remedy}"
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
    article: str
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

    def tensile_mpa(self, diameter_mm: float) -> float:
        """Return the least tensile strength at a diameter (MPa): linear between the listed ones, and beyond them."""
        known = list(zip(self.diameters_mm, self.tensile_strength_mpa, strict=True))
        above = next((index for index, (d, _) in enumerate(known) if d >= diameter_mm), len(known) - 1)
        (d0, s0), (d1, s1) = known[max(above, 1) - 1], known[max(above, 1)]
        return s0 + (s1 - s0) * (diameter_mm - d0) / (d1 - d0)


Entry = TypeVar("Entry", bound=TomlTable)


class PartsByName(dict[str, Entry], Generic[Entry]):
    """Bought parts of one kind by name; an unknown name is an error with a hint."""

    def __init__(self, kind: str, items: Mapping[str, Entry]) -> None:
        super().__init__(items)
        self._kind = kind

    def __missing__(self, name: str) -> NoReturn:
        known = ", ".join(self)
        raise JumpcadError(f"no {self._kind} {name!r} in the catalogue ({known}){did_you_mean(name, self)}")

    def with_own(self, items: Mapping[str, Entry]) -> "PartsByName[Entry]":
        """Return these parts with a user's own after them."""
        return PartsByName(self._kind, {**self, **items})


@dataclass(frozen=True)
class Catalogue:
    """All bought parts that a robot can be made of."""

    motors: PartsByName[Motor]
    small_motors: PartsByName[Motor]
    o_rings: PartsByName[ORing]
    bearings: PartsByName[Bearing]
    batteries: PartsByName[Battery]
    boards: PartsByName[Board]
    components: PartsByName[Component]
    kits: PartsByName[Kit]
    springs: PartsByName[StockSpring]
    pads: PartsByName[Pad]
    screws: PartsByName[Screw]
    nuts: PartsByName[Nut]
    washers: PartsByName[Washer]
    standoffs: PartsByName[Standoff]
    rods: PartsByName[Rod]
    clips: PartsByName[Clip]
    clevis_pins: PartsByName[ClevisPin]
    bars: PartsByName[LegBar]
    cage_rods: PartsByName[CageRod]
    wire: Wire
    rod_density_g_cm3: float

    def with_own(self, own: Mapping[str, Mapping[str, Article]]) -> "Catalogue":
        """Return the catalogue with a user's own parts, by kind and name, beside the shipped ones."""
        both = {kind: getattr(self, kind).with_own(parts) for kind, parts in own.items() if parts}
        return replace(self, **both) if both else self

    @property
    def steering_motors(self) -> PartsByName[Motor]:
        """The motors that may turn the steering wheel: small ones, and those that wind."""
        return PartsByName("motor", {**self.small_motors, **self.motors})

    def rod_mass_g(self, diameter_mm: float, length_mm: float) -> float:
        return self.rod_density_g_cm3 * math.pi / 4.0 * diameter_mm**2 * length_mm / 1000.0

    def clip_for(self, shaft_mm: float) -> Clip:
        return _of_size("clip", {clip.shaft_mm: clip for clip in self.clips.values()}, shaft_mm)

    def clevis_pin_for(self, diameter_mm: float) -> ClevisPin:
        return _of_size("clevis pin", {p.diameter_mm: p for p in self.clevis_pins.values()}, diameter_mm)


@lru_cache(maxsize=1)
def load_catalogue() -> Catalogue:
    """Return the shipped catalogue."""
    electronics, fasteners, axles = (_tables(name) for name in ("electronics", "fasteners", "axles"))
    return Catalogue(
        motors=_articles("motor", Motor, _tables("motors")),
        small_motors=_articles("motor", Motor, _tables("small_motors")),
        bearings=_articles("bearing", Bearing, _tables("bearings")),
        o_rings=_articles("O-ring", ORing, _tables("o_rings")),
        batteries=_articles("battery", Battery, electronics["batteries"]),
        boards=_articles("board", Board, electronics["boards"]),
        components=_articles("component", Component, electronics["components"]),
        kits=_by_name("kit", Kit, _tables("kits")), springs=_articles("spring", StockSpring, _tables("springs")),
        pads=_articles("pad", Pad, _tables("pads")), screws=_by_name("screw", Screw, fasteners["screws"]),
        nuts=_by_name("nut", Nut, fasteners["nuts"]), washers=_by_name("washer", Washer, fasteners["washers"]),
        standoffs=_by_name("standoff", Standoff, fasteners["standoffs"]), rods=_by_name("rod", Rod, axles["rods"]),
        clips=_by_name("clip", Clip, axles["clips"]), bars=_articles("leg bar", LegBar, _tables("bars")),
        clevis_pins=_by_name("clevis pin", ClevisPin, axles["clevis_pins"]),
        cage_rods=_articles("cage rod", CageRod, _tables("cage_rods")), wire=Wire(**_tables("wire")),
        rod_density_g_cm3=fasteners["rods"]["density_g_cm3"],
    )  # fmt: skip


def _tables(name: str) -> dict[str, Any]:
    return read_toml(templates_folder() / "hardware" / f"{name}.toml")[0]


def _articles(kind: str, model: type[AnyArticle], tables: dict[str, Any]) -> PartsByName[AnyArticle]:
    """Return the articles of a file whose `source` and `defaults` are those of all of them."""
    common = {"source": tables.pop("source", "")} | tables.pop("defaults", {})
    return _by_name(kind, model, {name: common | table for name, table in tables.items()})


def _by_name(kind: str, model: type[Entry], tables: Mapping[str, Mapping[str, Any]]) -> PartsByName[Entry]:
    return PartsByName(kind, {name: model.model_validate({"name": name, **table}) for name, table in tables.items()})


def _of_size(kind: str, by_size: Mapping[float, Entry], size_mm: float) -> Entry:
    """Return the part of a size; an unknown size is an error that names the known ones."""
    if size_mm not in by_size:
        sizes = ", ".join(f"{size:g}" for size in by_size)
        raise JumpcadError(f"bought.axle_mm = {size_mm:g}: no {kind} of that size ({sizes} mm): use one of these")
    return by_size[size_mm]
