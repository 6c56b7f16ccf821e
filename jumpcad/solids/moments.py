"""Integrals of 1, x, y, z and their products over regions and volumes: what mass properties are made of.

Area moments are arrays (6,): ∫1, ∫x, ∫y, ∫x², ∫y², ∫xy in mm², mm³ and mm⁴.
Volume moments are arrays (10,): ∫1, ∫x, ∫y, ∫z, ∫x², ∫y², ∫z², ∫xy, ∫yz, ∫zx in mm³, mm⁴ and mm⁵.
Both add up, also with weights and signs.
"""

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, Manifold

from jumpcad.mechanism.mass import MassProperties
from jumpcad.transforms import Array

MM = 1e-3
"""One millimetre in metres."""
BATCH_SIDES = 4096
"""Sides of polygons measured at once: a row of numbers takes 32 KB."""
G_PER_CM3 = 1e-6
"""One gram per cubic centimetre in kilograms per cubic millimetre."""


def areas_moments(regions: Sequence[CrossSection]) -> Array:
    """Return the area moments (n, 6) of regions by the polygon formulas (Green's theorem)."""
    return areas_and_borders(regions)[0]


def areas_and_borders(regions: Sequence[CrossSection]) -> tuple[Array, Array]:
    """Return the moments (n, 6) of regions and those along their borders, which are those of a strip per its width."""
    return contours_moments([region.to_polygons() for region in regions])


def contours_moments(regions: Sequence[Sequence[Array]]) -> tuple[Array, Array]:
    """Return the moments (n, 6) of regions, given their contours (k, 2), and those along their borders.

    Borders are integrated by Simpson's rule, which is exact along straight sides.
    """
    found = np.concatenate([_moments(*sides) for sides in _batches(regions)])
    return found[:, :6], found[:, 6:]


class Measured:
    """Moments of regions that recur, each of them measured once."""

    def __init__(self, empty: CrossSection) -> None:
        self._regions, self._rows = {id(empty): empty}, np.zeros((1, 12))
        self._number = {id(empty): 0}

    def of(self, regions: Sequence[CrossSection]) -> tuple[Array, Array]:
        """Return the moments (n, 6) of regions, and those along their borders."""
        new = {id(region): region for region in regions if id(region) not in self._number}
        if new:
            self._regions |= new  # alive, so that no other one gets its identity
            self._number |= zip(new, range(len(self._rows), len(self._rows) + len(new)), strict=True)
            self._rows = np.concatenate([self._rows, np.hstack(areas_and_borders(list(new.values())))])
        rows = self._rows[[self._number[id(region)] for region in regions]]
        return rows[:, :6], rows[:, 6:]


def _batches(regions: Sequence[Sequence[Array]]) -> Iterator[tuple[Array, Array, npt.NDArray[np.int64]]]:
    """Yield the sides of regions, few enough at once to stay in the processor's cache."""
    first = count = 0
    for index, region in enumerate(regions):
        corners = sum(map(len, region))
        if index > first and count + corners > BATCH_SIDES:
            yield _sides(regions[first:index])
            first, count = index, 0
        count += corners
    yield _sides(regions[first:])


def _moments(start: Array, end: Array, ends: npt.NDArray[np.int64]) -> Array:
    """Return the moments (n, 12) of n regions and of their borders, from the sides (2, m) of all."""
    (x0, y0), (x1, y1) = start, end
    both = start + end
    squares, mixed = start * start + end * end + both * both, x0 * y0 + x1 * y1 + both[0] * both[1]
    cross, part = (x0 * y1 - x1 * y0) / 24.0, np.hypot(*(end - start)) / 6.0
    products = np.empty((12, len(x0)))
    for row, weight in ((0, cross), (6, part)):
        np.multiply(both, weight, out=products[row + 1 : row + 3])
        np.multiply(squares, weight, out=products[row + 3 : row + 5])
        np.multiply(mixed, weight, out=products[row + 5])
    products[0], products[6] = 12.0 * cross, 6.0 * part
    products[1:3] *= 4.0
    products[7:9] *= 3.0
    return _sums(products, ends)


def _sides(regions: Sequence[Sequence[Array]]) -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Return where the sides of all regions' contours start and end, (2, m) each, and where each region's end (n,)."""
    ends = np.cumsum([sum(map(len, region)) for region in regions], dtype=np.int64)
    contours = list(itertools.chain(*regions))
    if not contours:
        return np.zeros((2, 0)), np.zeros((2, 0)), ends
    start = np.concatenate(contours).T
    last = np.cumsum([len(contour) for contour in contours]) - 1
    end = np.empty_like(start)
    end[:, :-1] = start[:, 1:]
    end[:, last] = start[:, np.concatenate([[0], last[:-1] + 1])]
    return start, end, ends


def _sums(products: Array, ends: npt.NDArray[np.int64]) -> Array:
    """Return the sums (n, k) of products (k, m) over the sides of n regions, which end at `ends` (n,)."""
    starts = np.concatenate([[0], ends[:-1]])
    some = starts < ends
    sums = np.zeros((len(ends), len(products)))
    if some.any():
        sums[some] = np.add.reduceat(products, starts[some], axis=1).T
    return sums


def prism_moments(area: Array, z0_mm: npt.ArrayLike, z1_mm: npt.ArrayLike) -> Array:
    """Return the volume moments (10,) of prisms over regions with area moments (6,) or (n, 6), all together.

    Their bottoms and tops are one number or (n,).
    """
    a, sx, sy, sxx, syy, sxy = np.atleast_2d(area).T
    z0, z1 = np.asarray(z0_mm, dtype=float), np.asarray(z1_mm, dtype=float)
    height, lever, square = z1 - z0, (z1**2 - z0**2) / 2.0, (z1**3 - z0**3) / 3.0
    columns = [
        *(a * height, sx * height, sy * height, a * lever),
        *(sxx * height, syy * height, a * square, sxy * height, sy * lever, sx * lever),
    ]
    return np.asarray(np.sum(columns, axis=1))


def mesh_moments(solid: Manifold) -> Array:
    """Return the volume moments (10,) of a closed mesh: signed tetrahedra from the origin to each triangle."""
    mesh = solid.to_mesh64()
    corners = mesh.vert_properties[:, :3][mesh.tri_verts]
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    total = corners.sum(axis=1)
    first = (volume[:, None] * total).sum(axis=0) / 4.0
    # ∫ x_i x_j over a tetrahedron with one corner at the origin: V/20·(Σ_k p_ki·p_kj + Σ_k p_ki · Σ_k p_kj)
    second = np.einsum("t,tki,tkj->ij", volume, corners, corners) + np.einsum("t,ti,tj->ij", volume, total, total)
    xx, yy, zz = np.diag(second) / 20.0
    return np.array([volume.sum(), *first, xx, yy, zz, second[0, 1] / 20.0, second[1, 2] / 20.0, second[2, 0] / 20.0])


def mass_of(moments: Array, density_g_cm3: float) -> MassProperties:
    """Return the mass properties (kg, m, about the centre of mass) of a volume with the given moments (10,)."""
    volume, first = moments[0], moments[1:4]
    xx, yy, zz, xy, yz, zx = moments[4:]
    com = first / volume
    second = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]) - np.outer(com, first)
    inertia = np.trace(second) * np.eye(3) - second
    density = density_g_cm3 * G_PER_CM3
    return MassProperties(float(density * volume), com * MM, density * inertia * MM**2)
