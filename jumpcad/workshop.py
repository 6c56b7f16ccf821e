"""`Workshop`: where and of what a robot is made. Printer, process, materials, fits, bought parts, safety, masses.

A workshop file gives any subset; what it leaves out comes from its `base` (the shipped `default` unless named).
`printer = "mini"` takes a shipped printer whole; the names under `[roles]` choose materials, shipped or the file's own.
`[motors.NAME]` and the like are parts of the user's own beside those of the catalogue; `like = "n20-298"` in such a
table takes over every figure of a shipped part that the table does not give, but not its source.
"""

import itertools
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from jumpcad.arguments import typed
from jumpcad.catalogue import (
    Article,
    Battery,
    Bearing,
    Board,
    Catalogue,
    Motor,
    OwnParts,
    StockSpring,
    load_catalogue,
)
from jumpcad.errors import JumpcadError
from jumpcad.files import (
    Contradiction,
    Record,
    TomlTable,
    did_you_mean,
    find_template,
    read_toml,
    template_names,
    to_toml,
)
from jumpcad.files.complaints import place, shown
from jumpcad.files.names import NAME, NAME_RULE, Name, OptionalName, Text

Positive = Annotated[float, Field(gt=0, le=1e4)]
Share = Annotated[float, Field(gt=0, le=1)]
Role = Literal["links", "body", "gears"]

MAX_LAYER_PER_NOZZLE = 0.8  # a thicker layer is no longer pressed onto the one below (common rule of slicers)
DEFAULT = "default"
OWN_PARTS = ("motors", "bearings", "batteries", "boards", "springs")
"""Tables of the user's own parts; `springs` are kept for reference, since the generator winds its own."""
MOST_BASES = 20
"""Files of a workshop that may build on each other."""


class Printer(TomlTable):
    """A machine: usable bed (x, y, z) and nozzle."""

    name: Text
    bed_mm: Annotated[tuple[Positive, Positive, Positive], Field(strict=False)]
    nozzle_mm: Annotated[float, Field(ge=0.1, le=2)]
    source: Text = ""


class Process(TomlTable):
    """How the printer is told to print; the printed mass follows from these."""

    layer_height_mm: Annotated[float, Field(ge=0.03, le=1.5)]
    first_layer_mm: Annotated[float, Field(ge=0.03, le=1.5)]
    line_width_mm: Annotated[float, Field(ge=0.1, le=4)]
    perimeters: Annotated[int, Field(ge=1, le=20)]
    top_layers: Annotated[int, Field(ge=0, le=50)]
    bottom_layers: Annotated[int, Field(ge=0, le=50)]
    infill: Annotated[float, Field(ge=0, le=1)]
    infill_pattern: Literal["grid", "rectilinear", "gyroid", "triangles", "cubic", "honeycomb"]
    solid_below_area_mm2: Annotated[float, Field(ge=0)]
    part_spacing_mm: Annotated[float, Field(ge=0, le=50)]


class Material(TomlTable):
    """What is printed; strengths along the layers and between them, and its price where one is entered."""

    density_g_cm3: Annotated[float, Field(ge=0.3, le=10)]
    strength_in_plane_mpa: Positive
    strength_interlayer_mpa: Positive
    modulus_mpa: Annotated[float, Field(gt=0, le=1e6)]
    price_eur_per_kg: Positive | None = None
    source: Text = ""


class Roles(TomlTable):
    """Which material a kind of part is printed in."""

    links: Name
    body: Name
    gears: Name


class Fits(TomlTable):
    """Every tolerance offset, as modelled. Fits are added per side; diameters of screw holes are complete.

    The limits leave room for any printer that can be used: holes come out up to 1 mm too small in diameter, hardly ever
    too large. What a shaft turns in or passes is never drawn smaller than the shaft; a screw cuts its thread in a hole
    between its core and its own diameter, and passes one that is wider than itself.
    """

    press_mm: Annotated[float, Field(ge=-0.2, le=0.5)]
    sliding_mm: Annotated[float, Field(ge=0, le=0.8)]
    loose_mm: Annotated[float, Field(ge=0, le=1)]
    hole_allowance_diameter_mm: Annotated[float, Field(ge=-0.4, le=1)]
    backlash_circumferential_mm: Annotated[float, Field(ge=0, le=1)]
    m2_tap_mm: Annotated[float, Field(ge=1.4, le=2.2)]
    m2_clearance_mm: Annotated[float, Field(ge=2, le=3.5)]
    m3_tap_mm: Annotated[float, Field(ge=2.2, le=3.2)]
    m3_insert_mm: Annotated[float, Field(ge=3, le=6)]
    m3_clearance_mm: Annotated[float, Field(ge=3, le=5)]
    wall_min_mm: Annotated[float, Field(ge=0.1, le=10)]
    wall_mm: Annotated[float, Field(ge=0.1, le=10)]
    pin_min_mm: Annotated[float, Field(gt=0, le=20)]
    hole_min_mm: Annotated[float, Field(gt=0, le=20)]
    first_layer_chamfer_mm: Annotated[float, Field(ge=0, le=2)]
    overhang_deg: Annotated[float, Field(ge=0, le=80)]
    bridge_mm: Annotated[float, Field(gt=0, le=200)]


class BoughtParts(TomlTable):
    """Names in the catalogue, shipped or the user's own; an empty list of motors allows every one.

    `leg_bearing` may be "any", the lightest that bears its load, or empty, which means none.
    """

    motors: Annotated[tuple[Name, ...], Field(strict=False)]
    leg_bearing: OptionalName
    roller: Name
    battery: Name
    controller: Name
    driver: Name
    axle_mm: Positive


class BodyPlates(TomlTable):
    """The two plates of the body."""

    plate_mm: Annotated[float, Field(ge=1, le=10)]


class Safety(TomlTable):
    """How far the parts are kept from what they could just bear."""

    strength_factor: Annotated[float, Field(ge=1, le=20)]
    motor_stall_share: Share
    motor_torque_max_nm: Positive
    gear_efficiency: Share
    spring_stress_share: Share
    jumps: Annotated[float, Field(ge=1, le=1e9)]
    landing_stop_mm: Positive
    leg_flex_share: Share
    steel_yield_mpa: Positive
    steel_factor: Annotated[float, Field(ge=1, le=20)]
    bearing_factor: Annotated[float, Field(ge=0.4, le=20)]


class Masses(TomlTable):
    """Where printed masses come from; a weighed mass (g, by part) overrides the model."""

    model: Literal["printed", "solid"]
    weighed_g: dict[Name, Positive]


class Workshop(Record):
    """Everything that a robot depends on beside its eight numbers.

    `prices_eur` holds prices of one piece by the beginning of the article's name in the bill of materials. `motors`,
    `bearings`, `batteries`, `boards` and `springs` are the user's own parts alone.
    """

    printer: Printer
    process: Process
    roles: Roles
    materials: dict[Name, Material]
    fits: Fits
    bought: BoughtParts
    body: BodyPlates
    safety: Safety
    mass: Masses
    prices_eur: dict[Name, Positive]
    motors: OwnParts[Motor] = Field(default_factory=dict)
    bearings: OwnParts[Bearing] = Field(default_factory=dict)
    batteries: OwnParts[Battery] = Field(default_factory=dict)
    boards: OwnParts[Board] = Field(default_factory=dict)
    springs: OwnParts[StockSpring] = Field(default_factory=dict)

    @property
    def catalogue(self) -> Catalogue:
        """The shipped catalogue with the user's own parts."""
        return load_catalogue().with_own(self.motors, self.bearings, self.batteries, self.boards)

    def __repr__(self) -> str:
        materials = ", ".join(f"{role} {name[:20]}" for role, name in self.roles.model_dump().items())
        return f"<Workshop: {self.printer.name[:60]}, layers of {self.process.layer_height_mm:g} mm, {materials}>"

    def material_name(self, role: Role) -> str:
        """Return the name of the material that a kind of part is printed in."""
        return str(getattr(self.roles, role))

    def material(self, role: Role) -> Material:
        """Return the material that a kind of part is printed in."""
        return self.materials[self.material_name(role)]

    def to_toml(self) -> str:
        """Return the workshop as a complete TOML document that reads back the same."""
        data = self.model_dump(exclude_none=True)
        return to_toml({key: value for key, value in data.items() if value or key not in OWN_PARTS})

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield the values that do not go together."""
        printer, process, fits = self.printer, self.process, self.fits
        thickest = round(MAX_LAYER_PER_NOZZLE * printer.nozzle_mm, 6)
        for key in ("layer_height_mm", "first_layer_mm"):
            height = getattr(process, key)
            if height > thickest:
                yield ("process", key), height, f"must be at most {thickest:g}, 0.8 of the nozzle: lower it"
        widths = (round(0.8 * printer.nozzle_mm, 6), round(2.0 * printer.nozzle_mm, 6))
        if not widths[0] <= process.line_width_mm <= widths[1]:
            reason = f"a nozzle of {printer.nozzle_mm:g} mm lays lines of {widths[0]:g}…{widths[1]:g} mm"
            yield ("process", "line_width_mm"), process.line_width_mm, reason
        elif process.line_width_mm <= max(process.layer_height_mm, process.first_layer_mm):
            yield ("process", "line_width_mm"), process.line_width_mm, "must be more than the layer height"
        lines = round(2.0 * process.line_width_mm, 6)
        if fits.wall_mm < lines:
            reason = f"must be at least {lines:g}, two lines of process.line_width_mm: raise it"
            yield ("fits", "wall_mm"), fits.wall_mm, reason
        if fits.wall_min_mm > fits.wall_mm:
            yield ("fits", "wall_min_mm"), fits.wall_min_mm, f"must be at most fits.wall_mm = {fits.wall_mm:g}"
        if 2.0 * fits.first_layer_chamfer_mm >= fits.wall_mm:
            reason = f"leaves nothing of a wall of {fits.wall_mm:g}: must be less than {fits.wall_mm / 2.0:g}"
            yield ("fits", "first_layer_chamfer_mm"), fits.first_layer_chamfer_mm, reason
        yield from _not_ascending(fits, ("press_mm", "sliding_mm", "loose_mm"))
        yield from _not_ascending(fits, ("m2_tap_mm", "m2_clearance_mm"))
        yield from _not_ascending(fits, ("m3_tap_mm", "m3_clearance_mm"))
        for role, name in self.roles.model_dump().items():
            if name not in self.materials:
                yield ("roles", role), name, f"is none of the materials {', '.join(self.materials)}"
        for kind in OWN_PARTS:
            yield from _own_contradictions(kind, getattr(self, kind))


@typed
def load_workshop(name_or_path: str | Path = DEFAULT) -> Workshop:
    """Return the workshop of a template (`default`) or of a TOML file, with everything that it builds on.

    Raises
    ------
    JumpcadError
        If a file is missing, or a key is unknown, out of range, or contradicts another.
    """
    path = find_template("workshops", name_or_path)
    data, text = _assembled(path, ())
    return Workshop.from_data(data, source=str(path), text=text)


def _assembled(path: Path, above: tuple[str, ...]) -> tuple[dict[str, Any], str]:
    """Return the data of a workshop file on top of its base, and the text of the file itself."""
    if len(above) > MOST_BASES:
        raise JumpcadError(f"{above[0]}: more than {MOST_BASES} workshops build on each other; join some of them")
    data, text = read_toml(path)
    whole: dict[str, Any] = {}
    if "base" in data or path != find_template("workshops", DEFAULT):
        base = data.pop("base", DEFAULT)
        if not isinstance(base, str):
            raise JumpcadError(f"{path}: base = {shown(base)}: must be the name of a workshop or a path")
        beside = path.parent / base
        base_path = beside if base.endswith(".toml") and os.path.isfile(beside) else find_template("workshops", base)
        real = os.path.realpath(path)  # unlike Path.resolve, also of links that lead round in a circle
        if os.path.realpath(base_path) in (real, *above):
            raise JumpcadError(f"{path}: base = {shown(base)}: leads back to a file that builds on it")
        whole, _ = _assembled(base_path, (*above, real))
    if isinstance(data.get("printer"), str):
        whole["printer"] = read_toml(find_template("printers", data.pop("printer")))[0]
    data |= {
        kind: _completed(kind, data[kind], str(path), text) for kind in OWN_PARTS if isinstance(data.get(kind), dict)
    }
    own = set(data["materials"]) if isinstance(data.get("materials"), dict) else set()
    whole = _merged(whole, data)
    if isinstance(whole.get("roles"), dict) and isinstance(whole.setdefault("materials", {}), dict):
        used = [name for name in whole["roles"].values() if isinstance(name, str)]
        if wrong := [name for name in sorted({*own, *used}) if not NAME.fullmatch(name)]:
            raise JumpcadError(f"{path}: {shown(wrong[0])} cannot be the name of a material: {NAME_RULE}")
        if unused := sorted(own - set(used)):
            raise JumpcadError(
                f"{path}: materials.{unused[0]}: no role uses it; the roles use {', '.join(sorted(set(used)))}"
                f"{did_you_mean(unused[0], used)}"
            )
        whole["materials"] = {name: _material(path, name, whole["materials"].get(name)) for name in sorted(set(used))}
    return whole, text


def _material(path: Path, name: str, own: Any) -> Any:
    """Return the data of a material: the shipped one, if there is one of that name, under the file's own figures."""
    known = template_names("materials")
    if name.lower() in known:
        shipped = read_toml(find_template("materials", name.lower()))[0]
        return _merged(shipped, own) if isinstance(own, dict) else shipped if own is None else own
    if own is None:
        raise JumpcadError(
            f"{path}: roles: {name!r} is neither a table under [materials] nor one of {', '.join(known)}"
            f"{did_you_mean(name.lower(), known)}"
        )
    return own


def _completed(kind: str, tables: dict[str, Any], source: str, text: str) -> dict[str, Any]:
    """Return own parts in which `like` has been replaced by the figures of the shipped part that it names."""
    shipped: Mapping[str, Article] = getattr(load_catalogue(), kind, {})
    completed = {}
    for name, table in tables.items():
        if isinstance(table, dict) and "like" in table and NAME.fullmatch(name):
            like, key = table["like"], f"{kind}.{name}.like"
            if not isinstance(like, str) or like not in shipped:
                known = ", ".join(shipped) or "there are none"
                hint = did_you_mean(like, shipped) if isinstance(like, str) else ""
                where = place(source, text, key)
                raise JumpcadError(f"{where}: {key} = {shown(like)}: is no shipped part of this kind ({known}){hint}")
            figures = shipped[like].model_dump(exclude={"source"})
            table = figures | {key: value for key, value in table.items() if key != "like"}
        completed[name] = table
    return completed


def _merged(base: dict[str, Any], over: dict[str, Any]) -> dict[str, Any]:
    """Return nested data with the values of `over` in place of those of `base`."""
    merged = dict(base)
    for key, value in over.items():
        both = isinstance(value, dict) and isinstance(merged.get(key), dict)
        merged[key] = _merged(merged[key], value) if both else value
    return merged


def _own_contradictions(kind: str, parts: Mapping[str, Article]) -> Iterator[Contradiction]:
    """Yield what is wrong with the user's own parts of a kind."""
    shipped: Mapping[str, Article] = getattr(load_catalogue(), kind, {})
    for key, part in parts.items():
        if key in shipped:
            reason = f'is the name of a shipped part: choose another one, and like = "{key}" takes its figures over'
            yield (kind, key), key, reason
        if part.name != key:
            yield (kind, key, "name"), part.name, "a part has its table's name: leave it out"
        for where, value, reason in part.contradictions():
            yield (kind, key, *where), value, reason


def _not_ascending(fits: Fits, keys: tuple[str, ...]) -> Iterator[Contradiction]:
    """Yield the fits that are tighter than the one before them."""
    for tight, wide in itertools.pairwise(keys):
        if getattr(fits, wide) < getattr(fits, tight):
            limit = f"must be at least fits.{tight} = {getattr(fits, tight):g}, the tighter fit"
            yield ("fits", wide), getattr(fits, wide), limit
