"""Bought parts as bodies: a shape for the assembly, and the catalogue's mass spread evenly over it; boxes, screws."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from jumpcad.catalogue import Bearing, Catalogue, Screw
from jumpcad.mechanism.mass import MassProperties
from jumpcad.mechanism.model import BODY, MAIN_LEG
from jumpcad.parts.part import Shaped, lying_on_left, lying_stack
from jumpcad.solids.outline import Region, disc, hexagon, hole, rectangle, ring
from jumpcad.solids.slab import Interval, Slab
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire, tube
from jumpcad.transforms import Array, ByValue, Trimesh, chained, in_metres, pose_about_z

TIE, TIE_MM, TIE_G = "cable tie 2.5 x 100 mm, polyamide", (2.5, 1.1), 0.3
"""Order text, width and thickness, mass; from memory."""


@dataclass(frozen=True, repr=False, eq=False)
class BoughtPart(Shaped, ByValue):
    """One bought part on the robot.

    `article` is what to order and `units` how many of it this piece counts for: 0 for a piece of one that is counted
    elsewhere (a motor's shaft, a spring's second arm). `shape` lies in its own frame, placed by `T_body_part` (4, 4) in
    mm in the frame of `body`; `mass` is given in that body's frame (kg, m). What is bent of wire is seen as its `wire`
    in the body's frame, and `shape` is the room that it takes.
    """

    name: str
    article: str
    body: str
    shape: Stack
    T_body_part: Array
    mass: MassProperties
    units: int = 1
    wire: DrawnWire | None = None

    def __repr__(self) -> str:
        return f"<BoughtPart {self.name!r}: {self.article[:80]}, {1000.0 * self.mass_kg:.2f} g>"

    @property
    def mass_kg(self) -> float:
        """Mass (kg)."""
        return self.mass.mass_kg

    def moved(self, T_body_frame: Array) -> "BoughtPart":
        """Return the part moved from its body's frame into a frame with a pose (4, 4; mm) in that body."""
        T_body_part = chained(T_body_frame, self.T_body_part)
        return replace(self, T_body_part=T_body_part, mass=self.mass.placed(in_metres(T_body_frame)))

    def seen_as(self, wire: DrawnWire) -> "BoughtPart":
        """Return the part with a wire to be seen in its place."""
        return replace(self, wire=wire)

    @cached_property
    def shown_mesh(self) -> Trimesh:
        """The mesh that is seen, in its own frame, without detail that eyes miss (mm)."""
        if self.wire is None:
            return super().shown_mesh
        rotation, origin = self.T_body_part[:3, :3], self.T_body_part[:3, 3]
        return tube(np.einsum("ji,nj->ni", rotation, self.wire.points_mm - origin), self.wire.diameter_mm)


def bought(
    name: str, article: str, body: str, mass_g: float, slabs: Iterable[tuple[float, float, Region]],
    at_mm: Sequence[float] = (0.0, 0.0, 0.0), turn_rad: float = 0.0, units: int = 1,
) -> BoughtPart:  # fmt: skip
    """Return a bought part drawn as slabs (y0, y1, region in x-z), turned counter-clockwise in x-z and moved (mm).

    Copies drawn about their own origin are equal: one shape for all of them, measured once.
    """
    shape, top, turn, mass = _turned(tuple(Slab(*slab) for slab in slabs), turn_rad, mass_g)
    pose, (x, y, z) = turn.copy(), at_mm
    pose[:3, 3] = x, top + y, z
    moved = MassProperties(mass.mass_kg, mass.com_m + pose[:3, 3] / 1000.0, mass.inertia_kg_m2)
    return BoughtPart(name, article, body, shape, pose, moved, units)


@lru_cache(maxsize=256)
def _turned(slabs: tuple[Slab, ...], turn_rad: float, mass_g: float) -> tuple[Stack, float, Array, MassProperties]:
    """Return slabs as `_drawn` does, their turn (4, 4) to the body's axes, and their mass seen along these."""
    shape, top, uniform = _drawn(slabs)
    turn = lying_on_left(0.0) @ pose_about_z(turn_rad)
    return shape, top, turn, uniform.scaled_to(mass_g / 1000.0).placed(turn)


@lru_cache(maxsize=256)
def _drawn(slabs: tuple[Slab, ...]) -> tuple[Stack, float, MassProperties]:
    """Return slabs along y laid on their left face, the y of that face, and the mass properties at unit density."""
    stack, _ = lying_stack((slab.z0_mm, slab.z1_mm, slab.outline) for slab in slabs)
    return stack, max(slab.z1_mm for slab in slabs), stack.mass_properties(1.0)


@lru_cache(maxsize=64)
def round_outline(outer_mm: float, bore_mm: float = 0.0) -> Region:
    """Return a disc, or a ring, about the origin."""
    return ring(outer_mm, bore_mm) if bore_mm else disc(outer_mm)


@lru_cache(maxsize=64)
def box_outline(width_mm: float, height_mm: float) -> Region:
    """Return a rectangle about the origin."""
    return rectangle((width_mm, height_mm))


def placed_box(
    name: str, article: str, x: float, y: float, z: float, size_x: float, size_y: float, size_z: float, mass_g: float
) -> BoughtPart:
    """Return a box of the body, at the middle of its underside, by its sizes along the axes (mm)."""
    slabs = [(-size_y / 2.0, size_y / 2.0, box_outline(size_x, size_z))]
    return bought(name, article, BODY, mass_g, slabs, (x, y, z + size_z / 2.0))


def placed_screw(
    name: str, body: str, centre: Array, shank: Interval, side: float, screw: Screw, catalogue: Catalogue
) -> BoughtPart:
    """Return a screw whose shank fills an interval of y; its head sits at the left end (side +1) or the right (-1)."""
    height, width = screw.button_head_height_mm, screw.button_head_mm
    length = round(shank[1] - shank[0], 6)
    seat = length if side > 0 else -height
    volume_mass = catalogue.rod_mass_g(screw.diameter_mm, length) + catalogue.rod_mass_g(width, 0.7 * height)
    slabs = [(0.0, length, round_outline(screw.diameter_mm)), (seat, seat + height, round_outline(width))]
    at = (centre[0], shank[0], centre[1])
    return bought(name, f"screw {screw.name} x {length:g} {screw.norm}", body, volume_mass, slabs, at)


@lru_cache(maxsize=64)
def hexagon_outline(across_flats_mm: float, bore_mm: float) -> Region:
    """Return a hexagon with a bore, about the origin."""
    return hexagon(across_flats_mm) - hole(bore_mm)


def interval(a: float, b: float) -> Interval:
    """Return both ends of an interval, the lower one first."""
    return (a, b) if a < b else (b, a)


def bearing_part(name: str, centre: Array, right_mm: float, bearing: Bearing) -> BoughtPart:
    """Return a bearing whose right side is at `right_mm` along y."""
    slabs = [(0.0, bearing.width_mm, round_outline(bearing.outer_mm, bearing.bore_mm))]
    at = (centre[0], right_mm, centre[1])
    size = f"{bearing.bore_mm:g} x {bearing.outer_mm:g} x {bearing.width_mm:g} mm"
    return bought(name, f"ball bearing {bearing.name} ZZ, {size}", MAIN_LEG, bearing.mass_g, slabs, at)
