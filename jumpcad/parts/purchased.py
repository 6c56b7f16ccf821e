"""Bought parts as bodies: a shape for the assembly, and the catalogue's mass spread evenly over it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Manifold

from jumpcad.mechanism.mass import MassProperties
from jumpcad.parts.part import lying_on_left, lying_stack, shown_mesh_of, solid_of
from jumpcad.solids.outline import Region
from jumpcad.solids.slab import Slab
from jumpcad.solids.stack import Stack
from jumpcad.solids.tube import DrawnWire, tube
from jumpcad.transforms import Array, ByValue, chained, in_metres, pose_about_z

if TYPE_CHECKING:
    import trimesh


@dataclass(frozen=True, repr=False, eq=False)
class BoughtPart(ByValue):
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
    def solid(self) -> Manifold:
        """The part's envelope in its own frame (mm)."""
        return solid_of(self.shape)

    @cached_property
    def shown_mesh(self) -> "trimesh.Trimesh":
        """The mesh that is seen, in its own frame, without detail that eyes miss (mm)."""
        if self.wire is None:
            return shown_mesh_of(self.shape)
        rotation, origin = self.T_body_part[:3, :3], self.T_body_part[:3, 3]
        return tube(np.einsum("ji,nj->ni", rotation, self.wire.points_mm - origin), self.wire.diameter_mm)


def bought(
    name: str,
    article: str,
    body: str,
    mass_g: float,
    slabs: Iterable[tuple[float, float, Region]],
    at_mm: Sequence[float] = (0.0, 0.0, 0.0),
    turn_rad: float = 0.0,
    units: int = 1,
) -> BoughtPart:
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
