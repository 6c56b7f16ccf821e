"""A printed part: a shape in printing orientation, and the places where it sits on the robot.

Parts are drawn where they belong, in the x-z plane of their body's frame and over intervals of y (all mm), and then
laid on the bed on their left or right face. What a bundle says of a part's mass is here too.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Annotated, Literal, TypeAlias

import numpy as np
from manifold3d import Manifold
from pydantic import Field, StrictFloat, StrictInt

from jumpcad.files.records import Text
from jumpcad.mechanism.mass import MassProperties
from jumpcad.printing.bed import BedFit, fit_to_bed, require_bed
from jumpcad.solids.blocks import Blocks
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import Stack
from jumpcad.transforms import Array, ByValue, Trimesh

Shape: TypeAlias = Stack | Blocks
Face = Literal["left", "right"]

UNSEEN_MM = 0.05
"""Size of detail that is left out of meshes for pictures; judgement: less than a pixel."""
SHAPES_KEPT = 400
"""Shapes of which solids and meshes are kept, those of some 15 robots: most parts are those of the robot before."""


@dataclass(frozen=True, eq=False)
class Placement(ByValue):
    """One copy of a part: its body, and the pose (4, 4) of the printing frame in the body's frame, lengths in mm."""

    body: str
    T_body_part: Array


class Shaped:
    """Something of a `shape`, in printing orientation or in its own frame: its solid and meshes (mm)."""

    shape: Shape

    @cached_property
    def solid(self) -> Manifold:
        """It as one closed solid."""
        return solid_of(self.shape)

    @cached_property
    def mesh(self) -> Trimesh:
        """Its mesh."""
        return _mesh_of(self.shape, 0.0)

    @cached_property
    def shown_mesh(self) -> Trimesh:
        """The mesh without fine detail, for pictures."""
        return _mesh_of(self.shape, UNSEEN_MM)


@dataclass(frozen=True)
class Piece(Shaped):
    """A printed piece, in printing orientation, and how many of it are needed."""

    name: str
    material: str
    shape: Shape
    quantity: int = 1


@dataclass(frozen=True)
class Drawing(Shaped):
    """A part before it is printed: its name, its role, its shape in printing orientation (z up) and its places.

    `role` chooses the material in the workshop: `links`, `body` or `gears`.
    """

    name: str
    role: Literal["links", "body", "gears"]
    shape: Shape
    placements: tuple[Placement, ...]

    def fit_to_bed(self, bed_mm: Sequence[float]) -> BedFit:
        """Return how the part fits a bed (x, y, z)."""
        return fit_to_bed(self.shape.bounds_mm, self._outline_mm, bed_mm)

    def require_bed(self, bed_mm: Sequence[float], caged: bool = False) -> None:
        """Reject a part that fits the bed at no angle; `caged`: body plates have horns."""
        require_bed(self.name, self.shape.bounds_mm, self._outline_mm, bed_mm, caged)

    def _outline_mm(self) -> Array:
        return self.shape.outline_mm


@lru_cache(SHAPES_KEPT)
def solid_of(shape: Shape) -> Manifold:
    """Return a shape's solid (mm)."""
    return shape.solid()


@lru_cache(2 * SHAPES_KEPT)
def _mesh_of(shape: Shape, unseen_mm: float) -> Trimesh:
    """Return a shape's mesh without smaller detail (mm); whoever asks gets the same one."""
    from jumpcad.solids.stl import to_trimesh

    return to_trimesh(solid_of(shape).simplify(unseen_mm) if unseen_mm else solid_of(shape))


def lying_stack(slabs: Iterable[tuple[float, float, Region]], face: Face = "left") -> tuple[Stack, Array]:
    """Lay slabs (y0, y1, region in x-z) on their left or right face; return stack and pose in the slabs' frame."""
    slabs = list(slabs)
    if face == "left":
        top = max(y1 for _, y1, _ in slabs)
        return Stack.of([(top - y1, top - y0, region) for y0, y1, region in slabs]), lying_on_left(top)
    bottom = min(y0 for y0, _, _ in slabs)
    flipped = [(y0 - bottom, y1 - bottom, region.mirror((1.0, 0.0))) for y0, y1, region in slabs]
    return Stack.of(flipped), lying_on_right(bottom)


def lying_on_left(y_mm: float, x_mm: float = 0.0, z_mm: float = 0.0) -> Array:
    """Return the pose (4, 4) of a part whose bed face is its left one, at y."""
    return np.array([[1.0, 0, 0, x_mm], [0, 0, -1, y_mm], [0, 1, 0, z_mm], [0, 0, 0, 1]])


def lying_on_right(y_mm: float, x_mm: float = 0.0, z_mm: float = 0.0) -> Array:
    """Return the pose (4, 4) of a part whose bed face is its right one, at y."""
    return np.array([[-1.0, 0, 0, x_mm], [0, 0, 1, y_mm], [0, 1, 0, z_mm], [0, 0, 0, 1]])


def upright(z_mm: float, x_mm: float = 0.0, y_mm: float = 0.0) -> Array:
    """Return the pose (4, 4) of a part that stands on the robot as it does on the bed."""
    pose = np.eye(4)
    pose[:3, 3] = x_mm, y_mm, z_mm
    return pose


@dataclass(frozen=True, repr=False)
class Part(Shaped):
    """A printed part: a drawing with its material, and the mass of one copy in its printing frame (kg, m).

    `mass_source` says where the mass came from: `printed` (layer model), `solid` (volume times density), `weighed`.
    """

    drawing: Drawing
    material: str
    mass: MassProperties
    mass_source: Literal["printed", "solid", "weighed"]

    @property
    def name(self) -> str:
        """The part's name, also that of its files."""
        return self.drawing.name

    @property
    def placements(self) -> tuple[Placement, ...]:
        """Where its copies sit."""
        return self.drawing.placements

    @property
    def quantity(self) -> int:
        """How many copies the robot needs."""
        return len(self.drawing.placements)

    @cached_property
    def shape(self) -> Shape:  # type: ignore[override]
        """Its shape in printing orientation."""
        return self.drawing.shape

    @property
    def mass_kg(self) -> float:
        """Mass of one copy (kg)."""
        return self.mass.mass_kg

    def __repr__(self) -> str:
        times = f"{self.quantity} x " if self.quantity > 1 else ""
        return f"<Part {self.name!r}: {times}{1000.0 * self.mass_kg:.2f} g of {self.material[:40]}, {self.mass_source}>"


@dataclass(frozen=True)
class MassLine:
    """Mass of one piece, how many of it the robot has, and where the mass comes from.

    `kind` is `printed`, `pad` (printed of a soft material) or `bought`.
    """

    kind: Literal["printed", "pad", "bought"]
    name: Text
    quantity: Annotated[StrictInt, Field(ge=1)]
    material: Text
    mass_kg: Annotated[StrictFloat, Field(ge=0.0)]
    source: Text
