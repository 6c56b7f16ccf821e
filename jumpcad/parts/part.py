"""A printed part: a shape in printing orientation, and the places where it sits on the robot.

Parts are drawn where they belong, in the x-z plane of their body's frame and over intervals of y (all mm), and then
laid on the bed on their left or right face: along its sides, or at an angle where they are too long for that. What a
bundle says of a part's mass is here too.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Annotated, Literal, TypeAlias

import numpy as np
from manifold3d import Manifold
from pydantic import Field, StrictFloat, StrictInt

from jumpcad.errors import CannotBuildError
from jumpcad.files.records import Text
from jumpcad.findings import lower
from jumpcad.mechanism.linkage import SHORTER_BODY, SMALLER_LINKS
from jumpcad.mechanism.mass import MassProperties
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
ROUND_OFF_MM = 1e-6

SMALLER = SMALLER_LINKS | {"cage_bar": lower("cage.rear_radius_mm", "cage.front_radius_mm")}
SMALLER_BODY = (*SHORTER_BODY, "choose a smaller battery or boards")
"""What to change where a part is too large, by the beginning of its name; other parts are the body's."""
CAGED = (*lower("cage.front_ahead_mm", "cage.rear_behind_mm", note="shorter horns"), 'no cage (cage.rod = "")')


@dataclass(frozen=True)
class BedFit:
    """A turn about z in whole degrees, and what is left of the bed at the tightest of its three sides (mm)."""

    angle_deg: float
    margin_mm: float


def fit_to_bed(bounds_mm: Array, outline: Callable[[], Array], bed_mm: Sequence[float]) -> BedFit:
    """Return how a part fits the bed: along its sides if it can, else at an angle; the best if it does not fit.

    Given are lower and upper corner of its bounding box, (2, 3), and the usable bed (x, y, z). `outline` gives points
    (n, 2) that span its convex hull seen from above; it is asked only where the box does not fit.
    """
    x, y, z = (bounds_mm[1] - bounds_mm[0]).tolist()
    bed_x, bed_y, bed_z = bed_mm
    along = BedFit(0.0, min(bed_x - x, bed_y - y, bed_z - z)), BedFit(90.0, min(bed_x - y, bed_y - x, bed_z - z))
    best = max(along, key=lambda fit: fit.margin_mm)
    if best.margin_mm >= -ROUND_OFF_MM:
        return best
    for found in _at_angles(outline(), z, np.asarray(bed_mm)):
        if found.margin_mm >= -ROUND_OFF_MM:
            return found
        best = max(best, found, key=lambda fit: fit.margin_mm)
    return best


def require_bed(
    name: str, bounds_mm: Array, outline: Callable[[], Array], bed_mm: Sequence[float], caged: bool = False
) -> BedFit:
    """Return how a part lies on the bed; `caged` says whether body plates have horns for a cage."""
    found = fit_to_bed(bounds_mm, outline, bed_mm)
    if found.margin_mm < -ROUND_OFF_MM:
        size, bed = ("×".join(f"{side:.1f}" for side in sides) for sides in (bounds_mm[1] - bounds_mm[0], bed_mm))
        horns = CAGED if caged and name.startswith("body_plate") else ()
        smaller = next((words for part, words in SMALLER.items() if name.startswith(part)), SMALLER_BODY)
        raise CannotBuildError(
            f"part {name} of {size} mm does not fit the bed of {bed} mm at any angle, by {-found.margin_mm:.1f} mm",
            "bed", found.margin_mm, ways=("choose a larger printer in the workshop", *horns, *smaller),
        )  # fmt: skip
    return found


def _at_angles(outline_mm: Array, height_mm: float, bed_mm: Array) -> Iterator[BedFit]:
    """Yield the fit at each whole degree between 0° and 90°."""
    angles = np.arange(1.0, 90.0)
    cos, sin = np.cos(np.radians(angles))[:, None], np.sin(np.radians(angles))[:, None]
    x, y = outline_mm.T
    sides = np.stack([np.ptp(cos * x - sin * y, axis=1), np.ptp(sin * x + cos * y, axis=1)], axis=-1)
    margins = np.minimum((bed_mm[:2] - sides).min(axis=1), bed_mm[2] - height_mm)
    yield from map(BedFit, angles.tolist(), margins.tolist())


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
        return fit_to_bed(self.shape.bounds_mm, lambda: self.shape.outline_mm, bed_mm)

    def require_bed(self, bed_mm: Sequence[float], caged: bool = False) -> None:
        """Reject a part that fits the bed at no angle; `caged`: body plates have horns."""
        require_bed(self.name, self.shape.bounds_mm, lambda: self.shape.outline_mm, bed_mm, caged)


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
class Part(Drawing):
    """A printed part: a drawing with its material, and the mass of one copy in its printing frame (kg, m).

    `mass_source` says where the mass came from: `printed` (layer model), `solid` (volume times density), `weighed`.
    """

    material: str
    mass: MassProperties
    mass_source: Literal["printed", "solid", "weighed"]

    @property
    def quantity(self) -> int:
        """How many copies the robot needs."""
        return len(self.placements)

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
