"""`Workshop`: printer, process, materials, fits, bought parts, ground, safety and masses, checked against each other.

A workshop file gives any subset; what it leaves out comes from its `base` (the shipped `default` unless named).
`printer = "mini"` takes a shipped printer whole; the names under `[roles]` choose materials, shipped or the file's own.
`[motors.NAME]` and the like are parts of the user's own beside those of the catalogue; `like = "n20-298"` in such a
table takes over every figure of a shipped part that the table does not give, but not its source.
"""

import itertools
from collections.abc import Iterator, Mapping
from typing import Literal

from pydantic import Field

from jumpcad import catalogue as parts
from jumpcad.dimensions import DOG_PLAY_MIN_DEG
from jumpcad.files import Contradiction, Record, to_toml
from jumpcad.files.records import Name
from jumpcad.workshop import tables
from jumpcad.workshop.slots import SLOTS

Role = Literal["links", "body", "gears"]
MAX_LAYER_PER_NOZZLE = 0.8  # a thicker layer is no longer pressed onto the one below (common rule of slicers)
STOP_PAD_MIN_MM = 1.5
"""Least thickness of the rest stop's pad; judgement: it gives way by 0.3 to 0.8 mm on the templates."""
CAGE_LEAST = {"arc_deg": 200.0, "rear_radius_mm": 40.0, "front_radius_mm": 40.0}
"""Of hoops that are given; judgement: less bulges nowhere, and no rod of the catalogue bends tighter."""
OWN_PARTS = ("motors", "bearings", "batteries", "boards", "springs", "pads")
"""Tables of the user's own parts."""


class Workshop(Record):
    """Everything that a robot depends on besides its eight numbers.

    `prices_eur` holds prices of one piece by the beginning of the article's name in the bill of materials; 0 is what is
    there already, which is not ordered. `motors`,
    `bearings`, `batteries`, `boards`, `springs` and `pads` are the user's own parts alone.
    """

    printer: tables.Printer
    process: tables.Process
    roles: tables.Roles
    materials: dict[Name, tables.Material]
    fits: tables.Fits
    bought: tables.BoughtParts
    body: tables.BodyPlates
    cage: tables.CageTable
    steering: tables.SteeringTable
    seats: tables.Seats
    ground: tables.Ground
    pins: tables.Pins
    spring: tables.SpringTable
    release: tables.ReleaseTable
    safety: tables.Safety
    strength: tables.StrengthTable
    mass: tables.Masses
    prices_eur: dict[Name, tables.Price]
    motors: parts.OwnParts[parts.Motor] = Field(default_factory=dict)
    bearings: parts.OwnParts[parts.Bearing] = Field(default_factory=dict)
    batteries: parts.OwnParts[parts.Battery] = Field(default_factory=dict)
    boards: parts.OwnParts[parts.Board] = Field(default_factory=dict)
    springs: parts.OwnParts[parts.StockSpring] = Field(default_factory=dict)
    pads: parts.OwnParts[parts.Pad] = Field(default_factory=dict)

    @property
    def catalogue(self) -> parts.Catalogue:
        """The shipped catalogue with the user's own parts."""
        return parts.load_catalogue().with_own({kind: getattr(self, kind) for kind in OWN_PARTS})

    @property
    def stock_spring(self) -> parts.StockSpring | None:
        """The springs from stock, or None where they are made to order."""
        return self.catalogue.springs[self.bought.spring] if self.bought.spring else None

    @property
    def leg_bar(self) -> parts.LegBar | None:
        """The bar of main leg and front link, or None where they are printed whole."""
        return self.catalogue.bars[self.bought.leg] if self.bought.leg else None

    @property
    def cage_rod(self) -> parts.CageRod | None:
        """The rod of the cage, or None without one."""
        return self.catalogue.cage_rods[self.cage.rod] if self.cage.rod else None

    @property
    def foot_pad(self) -> parts.Pad | None:
        """The pad under nose and toes, or None where the feet are bare."""
        return self.catalogue.pads[self.ground.pad] if self.ground.pad else None

    @property
    def stop_pad(self) -> parts.Pad:
        return self.catalogue.pads[self.body.stop_pad]

    def __hash__(self) -> int:
        return hash(self.printer)  # tables by name have none

    def __repr__(self) -> str:
        materials = ", ".join(f"{role} {name[:20]}" for role, name in self.roles.model_dump().items())
        return f"<Workshop: {self.printer.name[:60]}, layers of {self.process.layer_height_mm:g} mm, {materials}>"

    def material_name(self, role: Role) -> str:
        """Return the name of the material that a kind of part is printed in."""
        return str(getattr(self.roles, role))

    def material(self, role: Role) -> tables.Material:
        return self.materials[self.material_name(role)]

    def to_toml(self) -> str:
        """Return the workshop as a complete TOML document that reads back the same."""
        unsaid = {} if self.steering.gyroscope else {"steering": {"gyroscope"}}
        data = self.model_dump(exclude_none=True, exclude=unsaid)
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
        yield from _release_contradictions(self.release)
        for key, least in CAGE_LEAST.items():
            if 0.0 < getattr(self.cage, key) < least:  # 0: it is found
                reason = f"must be at least {least:g}, or 0: found from the robot's height"
                yield ("cage", key), getattr(self.cage, key), reason
        if self.steering.gyroscope and self.steering.wheel == "none":
            reason = 'measures the turns of a wheel, and there is none: set wheel = "o-ring", or leave it out'
            yield ("steering", "gyroscope"), self.steering.gyroscope, reason
        if not self.body.stop_pad:
            known = ", ".join(name for name, pad in self.catalogue.pads.items() if pad.thickness_mm >= STOP_PAD_MIN_MM)
            reason = f"the rest stop needs a pad of at least {STOP_PAD_MIN_MM:g} mm: name one of {known}"
            yield ("body", "stop_pad"), self.body.stop_pad, reason
        for role, name in self.roles.model_dump().items():
            if name not in self.materials:
                yield ("roles", role), name, f"is none of the materials {', '.join(self.materials)}"
            twins = (other for other in self.materials if other < name and other.casefold() == name.casefold())
            if twin := next(twins, ""):
                reason = f"is {twin!r} but for capital letters, and their plates would be one file on many computers"
                yield ("roles", role), name, f"{reason}: write both alike, or choose another name"
        for name, material in self.materials.items():
            yield from _material_contradictions(name, material)
        yield from self._misfits()
        for kind in OWN_PARTS:
            yield from _own_contradictions(kind, getattr(self, kind))

    def _misfits(self) -> Iterator[Contradiction]:
        """Yield names of parts that are not in the catalogue, or of another kind than their key asks for."""
        catalogue = self.catalogue
        for key, slot in SLOTS.items():
            table, name = key.split(".")
            value = getattr(getattr(self, table), name)
            for one in value if isinstance(value, tuple) else (value,):
                if reason := slot.misfit(catalogue, one):
                    yield (table, name), one, reason


def _own_contradictions(kind: str, own: Mapping[str, parts.Article]) -> Iterator[Contradiction]:
    shipped: Mapping[str, parts.Article] = getattr(parts.load_catalogue(), kind, {})
    for key, part in own.items():
        if key in shipped:
            reason = f'is the name of a shipped part: choose another one, and like = "{key}" takes its figures over'
            yield (kind, key), key, reason
        if part.name != key:
            yield (kind, key, "name"), part.name, "a part has its table's name: leave it out"
        for where, value, reason in part.contradictions():
            yield (kind, key, *where), value, reason


def _material_contradictions(name: str, material: tables.Material) -> Iterator[Contradiction]:
    """Yield layers that hold each other better than they hold themselves, and a modulus that is not in MPa."""
    strength, between = material.strength_in_plane_mpa, material.strength_interlayer_mpa
    if between > strength:
        reason = f"must be at most strength_in_plane_mpa = {strength:g}: no print is stronger between its layers"
        yield ("materials", name, "strength_interlayer_mpa"), between, reason
    if material.modulus_mpa < strength:
        reason = f"must be at least strength_in_plane_mpa = {strength:g}, or it is rubber: is it in MPa?"
        yield ("materials", name, "modulus_mpa"), material.modulus_mpa, reason


def _release_contradictions(release: tables.ReleaseTable) -> Iterator[Contradiction]:
    """Yield a play that is worse than none, and ranges whose limits are exchanged."""
    play, least = release.play_deg, DOG_PLAY_MIN_DEG
    if play != "auto" and 0.0 < play < least:
        reason = f'ends while the roller is on the cam\'s corner: use at least {least:g}, 0 (rigid), or "auto"'
        yield ("release", "play_deg"), play, reason
    for key in ("rotor_kg_m2", "backlash_deg"):
        low, high = getattr(release, key)
        if low > high:
            yield ("release", key), low, f"must be at most {high:g}, the end of its range"


def _not_ascending(fits: tables.Fits, keys: tuple[str, ...]) -> Iterator[Contradiction]:
    """Yield the fits that are tighter than the one before them."""
    for tight, wide in itertools.pairwise(keys):
        if getattr(fits, wide) < getattr(fits, tight):
            limit = f"must be at least fits.{tight} = {getattr(fits, tight):g}, the tighter fit"
            yield ("fits", wide), getattr(fits, wide), limit
