"""`Blocks`: a part of bars that lie across the bed and of tapering fingers, in printing orientation, in mm.

Unlike a `Stack` its cross-section changes from layer to layer. The section at a height follows in closed form from the
same numbers as the solid: a bar's is a set of rectangles, a finger's the hull of two discs.
"""

import math
from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, Manifold, OpType

from jumpcad.solids.moments import mesh_moments
from jumpcad.solids.outline import Region, circle_points, corners_key
from jumpcad.solids.slab import NOTHING, CrossSections
from jumpcad.solids.stl import finished
from jumpcad.transforms import Array

Contours = list[Array]


Block: TypeAlias = "Bar | Finger | Turned"
"""One simple piece, z up from the bed."""


@dataclass(frozen=True, eq=False)
class Bar:
    """A region of the x-z plane extruded along y, over one or several intervals (y0, y1)."""

    region: Region
    y_mm: tuple[tuple[float, float], ...]

    @property
    def key(self) -> Hashable:
        """The corners of the region and the intervals."""
        return corners_key(self.region), self.y_mm

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""
        x0, z0, x1, z1 = self.region.bounds()
        return np.array([[x0, min(y0 for y0, _ in self.y_mm), z0], [x1, max(y1 for _, y1 in self.y_mm), z1]])

    @property
    def outline_mm(self) -> Array:
        """Points (4, 2) that span its convex hull seen from above."""
        (x0, y0, _), (x1, y1, _) = self.bounds_mm
        return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])

    def solid(self) -> Manifold:
        """Return the bar, or bars, as a solid."""
        lying = [
            self.region.extrude(y1 - y0).rotate((90.0, 0.0, 0.0)).translate((0.0, y1, 0.0)) for y0, y1 in self.y_mm
        ]
        return Manifold.batch_boolean(lying, OpType.Add)

    def contours_at(self, heights_mm: Array) -> list[Contours]:
        """Return the rectangles of the sections at heights (n,): where the region lies at a height, over each y."""
        polygons = self.region.to_polygons()
        start = np.concatenate(polygons)
        end = np.concatenate([np.roll(polygon, -1, axis=0) for polygon in polygons])
        z = heights_mm[:, None]
        crosses = (start[:, 1] <= z) != (end[:, 1] <= z)
        rise = np.where(start[:, 1] == end[:, 1], 1.0, end[:, 1] - start[:, 1])
        x = start[:, 0] + (z - start[:, 1]) / rise * (end[:, 0] - start[:, 0])
        ends = np.sort(np.where(crosses, x, np.inf), axis=1)[:, : int(crosses.sum(axis=1).max(initial=0))]
        rows, pairs = np.nonzero(np.isfinite(ends[:, ::2]))
        x0, x1 = ends[rows, 2 * pairs], ends[rows, 2 * pairs + 1]
        corners = np.empty((len(rows), len(self.y_mm), 4, 2))
        corners[..., 0] = np.stack([x0, x1, x1, x0], axis=-1)[:, None]
        corners[..., 1] = [(y0, y0, y1, y1) for y0, y1 in self.y_mm]
        rectangles: list[Contours] = [[] for _ in heights_mm]
        for row, over_y in zip(rows.tolist(), corners, strict=True):
            rectangles[row].extend(over_y)
        return rectangles


@dataclass(frozen=True, eq=False)
class Finger:
    """The hull of two upright cylinders on the bed: centres (2,), diameters and heights of root and tip.

    The root is the higher one.
    """

    root_mm: Array
    root_diameter_mm: float
    root_height_mm: float
    tip_mm: Array
    tip_diameter_mm: float
    tip_height_mm: float

    @property
    def key(self) -> Hashable:
        """Centres, diameters and heights."""
        root = (*self.root_mm.tolist(), self.root_diameter_mm, self.root_height_mm)
        return root, (*self.tip_mm.tolist(), self.tip_diameter_mm, self.tip_height_mm)

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""
        flat = self.outline_mm
        return np.array([[*flat.min(axis=0), 0.0], [*flat.max(axis=0), self.root_height_mm]])

    @property
    def outline_mm(self) -> Array:
        """Points (n, 2) that span its convex hull seen from above."""
        return np.concatenate([self._disc(1.0), self._disc(0.0)])

    def solid(self) -> Manifold:
        """Return the finger as a solid."""
        ends = ((1.0, self.root_height_mm), (0.0, self.tip_height_mm))
        return Manifold.batch_hull([CrossSection([self._disc(share)]).extrude(height) for share, height in ends])

    def contours_at(self, heights_mm: Array) -> list[Contours]:
        """Return the sections at heights (n,): above the tip's top, its disc runs back to the root along the slope."""
        slope = self.root_height_mm - self.tip_height_mm
        shares = np.clip((heights_mm - self.tip_height_mm) / slope, 0.0, 1.0) if slope > 0.0 else 0.0 * heights_mm
        root = self._disc(1.0)
        known = {share: [_hull(root, self._disc(share))] for share in dict.fromkeys(shares.tolist())}
        inside = (heights_mm >= 0.0) & (heights_mm < self.root_height_mm)
        return [known[share] if within else [] for share, within in zip(shares.tolist(), inside, strict=True)]

    def _disc(self, share: float) -> Array:
        """Return the corners (n, 2) of a disc between tip (0) and root (1)."""
        unit = circle_points(max(self.root_diameter_mm, self.tip_diameter_mm))
        unit /= max(self.root_diameter_mm, self.tip_diameter_mm)
        centre = self.tip_mm + share * (self.root_mm - self.tip_mm)
        diameter = self.tip_diameter_mm + share * (self.root_diameter_mm - self.tip_diameter_mm)
        return np.asarray(centre + diameter * unit)


@dataclass(frozen=True, eq=False)
class Turned:
    """A block turned counter-clockwise about z by an angle, then moved to a place (2,)."""

    block: Block
    angle_rad: float
    place_mm: Array

    @property
    def key(self) -> Hashable:
        """The block's key, the angle and the place."""
        return self.block.key, self.angle_rad, *self.place_mm.tolist()

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""
        low, high = self.block.bounds_mm
        flat = self.outline_mm
        return np.array([[*flat.min(axis=0), low[2]], [*flat.max(axis=0), high[2]]])

    @property
    def outline_mm(self) -> Array:
        """Points (n, 2) that span its convex hull seen from above."""
        return self._moved(self.block.outline_mm)

    def solid(self) -> Manifold:
        """Return the turned block as a solid."""
        x, y = self.place_mm.tolist()
        return self.block.solid().rotate((0.0, 0.0, math.degrees(self.angle_rad))).translate((x, y, 0.0))

    def contours_at(self, heights_mm: Array) -> list[Contours]:
        """Return the block's outlines at heights (n,), turned and moved."""
        sections = self.block.contours_at(heights_mm)
        known = {id(contour): contour for contours in sections for contour in contours}
        if not known:
            return sections
        ends = np.cumsum([len(contour) for contour in known.values()])[:-1]
        moved = dict(zip(known, np.split(self._moved(np.concatenate(list(known.values()))), ends), strict=True))
        return [[moved[id(contour)] for contour in contours] for contours in sections]

    def _moved(self, points_mm: Array) -> Array:
        cos, sin = math.cos(self.angle_rad), math.sin(self.angle_rad)
        x, y = points_mm.T
        return np.column_stack([cos * x - sin * y, sin * x + cos * y]) + self.place_mm


@dataclass(frozen=True, eq=False)
class Blocks:
    """The union of blocks minus the union of others, which must not make the bounding box smaller."""

    added: tuple[Block, ...]
    removed: tuple[Block, ...] = ()

    @cached_property
    def _key(self) -> Hashable:
        return tuple(block.key for block in self.added), tuple(block.key for block in self.removed)

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Blocks) and self._key == other._key)

    def __hash__(self) -> int:
        return hash(self._key)

    @cached_property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""
        boxes = np.array([block.bounds_mm for block in self.added])
        return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    @property
    def outline_mm(self) -> Array:
        """Points (n, 2) that span its convex hull seen from above."""
        return np.concatenate([block.outline_mm for block in self.added])

    @cached_property
    def moments(self) -> Array:
        """Volume moments (10,), see `jumpcad.solids.moments`."""
        return mesh_moments(self.solid())

    def solid(self) -> Manifold:
        """Return the part as one closed solid."""
        whole = Manifold.batch_boolean([block.solid() for block in self.added], OpType.Add)
        if self.removed:
            whole -= Manifold.batch_boolean([block.solid() for block in self.removed], OpType.Add)
        return finished(whole)

    def regions_at(self, heights_mm: npt.ArrayLike) -> list[Region]:
        """Return the cross-sections at heights (n,)."""
        sections = self.sections_at(heights_mm)
        return [sections.outlines[number] for number in sections.which]

    def sections_at(self, heights_mm: npt.ArrayLike) -> CrossSections:
        """Return the cross-sections at heights (n,), each different outline once; blocks have no chamfers."""
        heights = np.asarray(heights_mm, dtype=float)
        numbers: dict[tuple[int, tuple[bytes, ...]], int] = {}
        regions: list[Region] = []
        which = []
        for added, removed in zip(_gathered(self.added, heights), _gathered(self.removed, heights), strict=True):
            case = len(added), tuple([contour.tobytes() for contour in (*added, *removed)])
            number = numbers.setdefault(case, len(regions))
            if number == len(regions):
                region = CrossSection(added) if added else NOTHING
                regions.append(region - CrossSection(removed) if removed else region)
            which.append(number)
        return CrossSections(regions, np.array(which, dtype=np.int64), np.zeros(len(heights)))


def _gathered(blocks: tuple[Block, ...], heights_mm: Array) -> Iterator[Contours]:
    """Yield the outlines of all blocks at each height."""
    for at_height in zip(*(block.contours_at(heights_mm) for block in blocks), strict=True) if blocks else ():
        yield [contour for contours in at_height for contour in contours]
    if not blocks:
        yield from ([] for _ in heights_mm)


def _hull(*points_mm: Array) -> Array:
    """Return the convex hull (k, 2) of points, counter-clockwise."""
    return np.asarray(CrossSection.hull_points(np.concatenate(points_mm)).to_polygons()[0])
