"""Flat regions that parts are extruded from, and letters as regions, in mm.

Every function returns a `manifold3d.CrossSection`, here called a `Region`: a set of polygons without overlaps. To
Python two of them are never equal, so regions are compared and cached by their `corners_key`.
Circles are polygons of at least 64 sides. The corners of a disc lie on its circle, so it is never wider than its
diameter; the sides of a hole touch its circle, so it is never narrower. No clearance is smaller than drawn.
"""

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, FillRule, JoinType, OpType

from jumpcad.errors import JumpcadError
from jumpcad.transforms import Array

Region: TypeAlias = CrossSection
Point: TypeAlias = Sequence[float] | Array

MIN_FACETS = 64
SAGITTA_MM = 0.005  # a polygon may leave its circle by this much: a tenth of what a printer resolves
SLIVER_MM = 0.01
ORIGIN = (0.0, 0.0)


@lru_cache(maxsize=512)
def facets(diameter_mm: float) -> int:
    """Return how many sides a circle gets: at least 64, a multiple of 8, and within `SAGITTA_MM` of the circle."""
    return max(MIN_FACETS, 8 * math.ceil(math.pi / 8.0 / _half_step(diameter_mm)))


def _half_step(diameter_mm: float) -> float:
    """Return half the angle of a circle's longest side that stays within `SAGITTA_MM` of it (rad)."""
    return math.acos(max(1.0 - 2.0 * SAGITTA_MM / diameter_mm, 0.0))


def circle_points(diameter_mm: float, centre_mm: Point = ORIGIN, around: bool = False) -> Array:
    """Return the corners (n, 2) of a circle's polygon, counter-clockwise; `around` puts its sides on the circle."""
    if not diameter_mm > 0:
        raise JumpcadError(f"a circle's diameter of {diameter_mm:g} mm must be more than 0")
    count = facets(diameter_mm)
    radius = diameter_mm / 2.0 / (math.cos(math.pi / count) if around else 1.0)
    return np.asarray(np.asarray(centre_mm, dtype=float) + radius * _unit_circle(count))


@lru_cache(maxsize=64)
def _unit_circle(count: int) -> Array:
    """Return the corners (count, 2) of a polygon in the unit circle, the first on +x, counter-clockwise."""
    angles = np.arange(count) * (2.0 * math.pi / count)
    corners = np.column_stack([np.cos(angles), np.sin(angles)])
    corners.setflags(write=False)
    return corners


def contained(region: Region, points_mm: Array) -> npt.NDArray[np.bool_]:
    """Tell which points (n, 2) are inside a region: a ray from them crosses its sides an odd number of times."""
    corners = region.to_polygons()
    x0, z0 = np.concatenate(corners).T
    x1, z1 = np.concatenate([np.roll(contour, -1, axis=0) for contour in corners]).T
    inside = np.zeros(len(points_mm), dtype=bool)
    for z in np.unique(points_mm[:, 1]):
        row, spans = points_mm[:, 1] == z, (z0 <= z) != (z1 <= z)
        share = (z - z0[spans]) / (z1[spans] - z0[spans])
        crossed = np.sort(x0[spans] + share * (x1[spans] - x0[spans]))
        inside[row] = (len(crossed) - np.searchsorted(crossed, points_mm[row, 0], side="right")) % 2 == 1
    return inside


def corners_key(region: Region) -> tuple[bytes, ...]:
    """Return the corners of a region's contours as bytes: the same for two regions that are made in the same way."""
    return tuple(contour.tobytes() for contour in region.to_polygons())


def disc(diameter_mm: float, centre_mm: Point = ORIGIN) -> Region:
    """Return a disc that is nowhere wider than its diameter."""
    return CrossSection([circle_points(diameter_mm, centre_mm)])


def hole(diameter_mm: float, centre_mm: Point = ORIGIN) -> Region:
    """Return a round hole, to be subtracted, whose smallest width is its diameter."""
    return CrossSection([circle_points(diameter_mm, centre_mm, around=True)])


def ring(outer_mm: float, inner_mm: float, centre_mm: Point = ORIGIN) -> Region:
    """Return a disc with a hole, given both diameters."""
    return disc(outer_mm, centre_mm) - hole(inner_mm, centre_mm)


def hexagon(across_flats_mm: float) -> Region:
    """Return a hexagon about the origin, a corner on +x."""
    angles = np.arange(6) * math.pi / 3.0
    return polygon(across_flats_mm / math.sqrt(3.0) * np.stack([np.cos(angles), np.sin(angles)], axis=-1))


def d_bore(diameter_mm: float, across_flat_mm: float, centre_mm: Point = ORIGIN) -> Region:
    """Return the hole for a D-shaft, to be subtracted; the flat faces +x, `across_flat_mm` from the far side."""
    depth = diameter_mm - across_flat_mm
    if not 0 < depth < diameter_mm / 2:
        raise JumpcadError(f"a D-bore of {diameter_mm:g} mm cannot be {across_flat_mm:g} mm across its flat")
    cut = rectangle((diameter_mm, 2.0 * diameter_mm)).translate((across_flat_mm, 0.0))
    return (hole(diameter_mm) - cut).translate(tuple(centre_mm))


def polygon(*contours_mm: npt.ArrayLike) -> Region:
    """Return the region of one or more closed contours (n, 2) in any direction; contours inside others are holes."""
    return CrossSection([np.asarray(contour, dtype=float) for contour in contours_mm], FillRule.EvenOdd)


def rectangle(size_mm: Sequence[float], centre_mm: Point = ORIGIN, corner_radius_mm: float = 0.0) -> Region:
    """Return a rectangle along the axes about its centre, with rounded corners if asked for."""
    width, height = size_mm
    if corner_radius_mm <= 0:
        return CrossSection.square((width, height), center=True).translate(tuple(centre_mm))
    across, along = width / 2.0 - corner_radius_mm, height / 2.0 - corner_radius_mm
    if across < 0.0 or along < 0.0:
        raise JumpcadError(f"corners of {corner_radius_mm:g} mm radius do not fit {width:g} x {height:g} mm")
    circle = circle_points(2.0 * corner_radius_mm)
    quarter = len(circle) // 4
    signs = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
    corners = np.asarray(centre_mm, dtype=float) + signs * (across, along)
    arcs = np.add.outer(quarter * np.arange(4), np.arange(quarter + 1)) % len(circle)
    return CrossSection([(corners[:, None] + circle[arcs]).reshape(-1, 2)])


def tapered_bar(start_mm: Point, end_mm: Point, start_width_mm: float, end_width_mm: float) -> Region:
    """Return the hull of two discs: a bar with round ends that may differ in width."""
    return hull([disc(start_width_mm, start_mm), disc(end_width_mm, end_mm)])


def stadium(start_mm: Point, end_mm: Point, width_mm: float) -> Region:
    """Return a bar with round ends of one width between two centres."""
    return tapered_bar(start_mm, end_mm, width_mm, width_mm)


def strips(starts_mm: npt.ArrayLike, ends_mm: npt.ArrayLike, width_mm: float) -> Region:
    """Return bars with square ends between points (2,) or (n, 2), all of one width, as one region."""
    start, end = (np.atleast_2d(np.asarray(points, dtype=float)) for points in (starts_mm, ends_mm))
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    across = width_mm / 2.0 * np.stack([-along[:, 1], along[:, 0]], axis=-1)
    corners = np.stack([start - across, end - across, end + across, start + across], axis=1)
    return CrossSection(list(corners), FillRule.NonZero)


def hull(regions: Iterable[Region]) -> Region:
    """Return the convex hull of several regions."""
    return CrossSection.batch_hull(list(regions))


def union(regions: Iterable[Region]) -> Region:
    """Return everything that lies in at least one of the regions."""
    return CrossSection.batch_boolean(list(regions), OpType.Add)


def grown(region: Region, distance_mm: float) -> Region:
    """Return the region with every edge moved outwards (inwards if negative); outer corners become round.

    Edges and round corners may be off by `SAGITTA_MM`: circles that others must fit are drawn after this.
    """
    if distance_mm == 0.0:
        return region
    segments = 4 * math.ceil(math.pi / 4.0 / _half_step(2.0 * abs(distance_mm)))
    return region.simplify(SAGITTA_MM).offset(distance_mm, JoinType.Round, 2.0, segments).simplify(1e-4)


def rounded(region: Region, radius_mm: float) -> Region:
    """Return the region with its convex corners rounded; what is narrower than two radii disappears."""
    return grown(grown(region, -radius_mm), radius_mm)


def filleted(region: Region, radius_mm: float) -> Region:
    """Return the region with its inner corners filled to a radius; holes narrower than two radii close."""
    return grown(grown(region, radius_mm), -radius_mm)


def without_slivers(region: Region) -> Region:
    """Return the region with gaps and walls narrower than two `SLIVER_MM` closed and removed.

    They come from outlines that nearly coincide; in a file their sides would touch along a line.
    """
    closed = region.offset(SLIVER_MM, JoinType.Miter).offset(-2.0 * SLIVER_MM, JoinType.Miter)
    return closed.offset(SLIVER_MM, JoinType.Miter)


def boxes_apart(a: Region, b: Region) -> bool:
    """Tell whether the bounding boxes of two regions do not meet."""
    ax0, ay0, ax1, ay1 = a.bounds()
    bx0, by0, bx1, by1 = b.bounds()
    return bool(ax1 <= bx0 or bx1 <= ax0 or ay1 <= by0 or by1 <= ay0)


def box_around(region: Region, margin_mm: float) -> Region:
    """Return a rectangle that is larger than a region by a margin on all sides."""
    x0, y0, x1, y1 = region.bounds()
    size = x1 - x0 + 2.0 * margin_mm, y1 - y0 + 2.0 * margin_mm
    return rectangle(size, ((x0 + x1) / 2.0, (y0 + y1) / 2.0))


def middle_of(region: Region) -> Array:
    """Return the middle (2,) of a region's bounding box."""
    low_x, low_z, high_x, high_z = region.bounds()
    return np.array([(low_x + high_x) / 2.0, (low_z + high_z) / 2.0])


if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

FONT = "DejaVuSans-Bold.ttf"  # shipped with the plotting library, so the same letters everywhere
_tracing = Lock()  # a font's file is read by Python, which lets another thread in while a letter is half loaded
TRACED_AT = 100.0  # size at which letters are traced: large enough for smooth curves, small enough for few corners


@lru_cache(maxsize=256)
def text(label: str, height_mm: float) -> Region:
    """Return a line of text with capitals of a given height, from the origin along +x, standing on y = 0.

    Letters that the font lacks are left out: see `engravable`.
    """
    label = engravable(label)
    contours, x = [], 0.0
    for letter in label:
        advance, polygons = _letter(letter)
        contours += [polygon + np.array([x, 0.0]) for polygon in polygons]
        x += advance
    if not contours or not height_mm > 0:
        raise JumpcadError(f"text {label!r} of height {height_mm:g} mm cannot be engraved: give letters and a height")
    capital = max(float(polygon[:, 1].max()) for polygon in _letter("H")[1])
    letters = CrossSection(contours, FillRule.NonZero).scale((height_mm / capital, height_mm / capital))
    return letters.simplify(SAGITTA_MM)


def engravable(label: str) -> str:
    """Return the letters of a label that the font has: Latin, Greek, Cyrillic and some others."""
    with _tracing:
        known = _font().get_charmap()
    return "".join(letter for letter in label if ord(letter) in known)


@lru_cache(maxsize=1)
def _font() -> "FT2Font":
    import matplotlib  # takes a tenth of a second, and most robots that are built have no name
    from matplotlib.ft2font import FT2Font

    font = FT2Font(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / FONT))
    font.set_size(TRACED_AT, 72)
    return font


@lru_cache(maxsize=256)
def _letter(letter: str) -> tuple[float, list[Array]]:
    """Return the advance width of a letter, and its closed contours (n, 2)."""
    from matplotlib.ft2font import LoadFlags
    from matplotlib.path import Path as Curve

    with _tracing:
        font = _font()
        glyph = font.load_char(ord(letter), flags=LoadFlags.NO_HINTING)
        vertices, codes = font.get_path()
    polygons = [np.asarray(polygon) for polygon in Curve(vertices, codes).to_polygons()] if len(vertices) else []
    return glyph.linearHoriAdvance / 65536.0, polygons
