"""`Stack`: a part as slabs over flat regions, in printing orientation, z up from the bed, in mm.

Nearly every printed part is of this kind. A stack is an exact description: its solid, its mass properties, its layers
and what it shares with another stack all follow from the polygons, without a mesh.
"""

import functools
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, Manifold, Mesh64, OpType

from jumpcad.errors import JumpcadError
from jumpcad.mechanism.mass import MassProperties
from jumpcad.solids.moments import areas_moments, mass_of, prism_moments
from jumpcad.solids.outline import Region, without_slivers
from jumpcad.solids.skin import skin
from jumpcad.solids.slab import NOTHING, SMALLEST_AREA_MM2, CrossSections, Numbers, Slab, SlabLike, pocketed, rounded_z
from jumpcad.transforms import Array


@dataclass(frozen=True)
class Stack:
    """Slabs in ascending order whose z intervals do not overlap; make one with `Stack.of`."""

    slabs: tuple[Slab, ...]

    @classmethod
    def of(cls, slabs: Iterable[SlabLike]) -> "Stack":
        """Return the union of slabs (z0, z1, region) that may overlap in every way."""
        return _arranged(slabs, ())

    def minus(self, slabs: Iterable[SlabLike]) -> "Stack":
        """Return this stack without slabs (z0, z1, region), such as bores, pockets and engravings."""
        return _arranged(self.slabs, slabs)

    def pocketed(self, pockets: Iterable[tuple[float, float, Region]]) -> "Stack":
        """Return this stack without pockets (z0, z1, region) on top of each other, with a wall around each.

        This is `minus`, but the outlines are left as they are: a part's layers that differ only in a pocket inside it
        are made and weighed for little more than one.
        """
        cuts = [(rounded_z(z0), rounded_z(z1), region) for z0, z1, region in pockets]
        levels = {z for z0, z1, _ in cuts for z in (z0, z1)}
        slabs = []
        for slab in self.slabs:
            inside = {z for z in levels if slab.z0_mm < z < slab.z1_mm}
            for z0, z1 in itertools.pairwise(sorted({slab.z0_mm, *inside, slab.z1_mm})):
                cut = next((index for index, (low, high, _) in enumerate(cuts) if low <= z0 and z1 <= high), None)
                pocket, number = (NOTHING, 0) if cut is None else (cuts[cut][2], cut + 1)
                slabs.append(replace(slab, z0_mm=z0, z1_mm=z1, pocket=pocket, pocket_number=number))
        return Stack(tuple(slabs))

    def through(self, *holes: Region) -> "Stack":
        """Return this stack with holes from bottom to top."""
        return self.minus([(self.z0_mm, self.z1_mm, hole) for hole in holes])

    def chamfered(self, depth_mm: float, layer_mm: float, first_layer_mm: float | None = None) -> "Stack":
        """Return the stack with the edges of its bottom face chamfered at 45° against a spreading first layer.

        The chamfer is as wide on the bed as high, and built as the printer makes it: one step a layer, each as wide as
        the slope is in the middle of that layer. The first layer is like the others unless its height is given. The
        slab at the bottom must be thicker than the chamfer is deep.
        """
        bottom = self.slabs[0]
        if bottom.height_mm < depth_mm:
            raise JumpcadError(f"a bottom slab of {bottom.height_mm:g} mm is too thin for a chamfer of {depth_mm:g} mm")
        steps, z, height = [], 0.0, first_layer_mm or layer_mm
        while (inset := depth_mm - z - height / 2.0) > 1e-9:
            top, whole = min(z + height, bottom.height_mm), bottom.inset_mm
            low, high = rounded_z(bottom.z0_mm + z), rounded_z(bottom.z0_mm + top)
            steps.append(replace(bottom, z0_mm=low, z1_mm=high, inset_mm=whole + inset))
            z, height = top, layer_mm
        rest = replace(bottom, z0_mm=rounded_z(bottom.z0_mm + z))
        upper = (rest, *self.slabs[1:]) if rest.height_mm > 1e-9 else self.slabs[1:]
        return Stack((*steps, *upper))

    @property
    def z0_mm(self) -> float:
        """Height of the bottom (mm)."""
        return self.slabs[0].z0_mm

    @property
    def z1_mm(self) -> float:
        """Height of the top (mm)."""
        return self.slabs[-1].z1_mm

    @functools.cached_property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3) in mm."""
        flat = np.array([region.bounds() for region in self._widest()])
        low, high = flat[:, :2].min(axis=0), flat[:, 2:].max(axis=0)
        return np.array([[*low, self.z0_mm], [*high, self.z1_mm]])

    @property
    def outline_mm(self) -> Array:
        """Points (n, 2) that span its convex hull seen from above."""
        return np.concatenate([contour for region in self._widest() for contour in region.to_polygons()])

    @functools.cached_property
    def moments(self) -> Array:
        """Volume moments (10,), see `jumpcad.solids.moments`; exact."""
        areas = areas_moments([slab.region for slab in self.slabs])
        return prism_moments(areas, [slab.z0_mm for slab in self.slabs], [slab.z1_mm for slab in self.slabs])

    def mass_properties(self, density_g_cm3: float) -> MassProperties:
        """Return the mass properties of the stack printed solid, in its own frame (kg, m)."""
        return mass_of(self.moments, density_g_cm3)

    def regions_at(self, heights_mm: npt.ArrayLike) -> list[Region]:
        """Return the cross-sections at heights (n,), at the edge of two slabs the upper one's; `NOTHING` outside."""
        regions = [*(slab.region for slab in self.slabs), NOTHING]
        return [regions[number] for number in self._slabs_at(heights_mm)]

    def sections_at(self, heights_mm: npt.ArrayLike) -> CrossSections:
        """Return the cross-sections at heights (n,) as outlines and the insets of chamfers."""
        outlines = [*self._outlines.values(), NOTHING]
        place = {(number, 0): index for index, number in enumerate(self._outlines)}
        pockets: list[tuple[int, Region]] = []
        for slab in self.slabs:
            if (slab.number, slab.pocket_number) not in place:
                place[slab.number, slab.pocket_number] = len(outlines) + len(pockets)
                pockets.append((place[slab.number, 0], slab.pocket))
        which = np.array([*(place[slab.number, slab.pocket_number] for slab in self.slabs), len(outlines) - 1])
        insets = np.array([*(slab.inset_mm for slab in self.slabs), 0.0])
        slabs = self._slabs_at(heights_mm)
        return pocketed(CrossSections(outlines, which[slabs], insets[slabs], pockets))

    def solid(self) -> Manifold:
        """Return the stack as one closed solid whose corners 32-bit floats hold exactly (on a grid of 1 µm).

        It is empty where all regions are slivers.
        """
        heights = [(slab.z0_mm, slab.z1_mm) for slab in self.slabs]
        cases = [(slab.number, slab.pocket_number, slab.inset_mm) for slab in self.slabs]
        regions = {case: slab.region for case, slab in zip(cases, self.slabs, strict=True)}
        clean = {case: without_slivers(region).to_polygons() for case, region in regions.items()}
        if not any(clean.values()):
            return Manifold()
        vertices, faces = skin(heights, [clean[case] for case in cases])
        return Manifold(Mesh64(vertices, faces.astype(np.uint64)))

    @functools.cached_property
    def _outlines(self) -> dict[int, Region]:
        """The outlines by their numbers."""
        return {slab.number: slab.outline for slab in self.slabs}

    def _slabs_at(self, heights_mm: npt.ArrayLike) -> Numbers:
        """Return the numbers of the slabs at heights (n,), at the edge of two the upper one's; -1 outside."""
        heights = np.asarray(heights_mm, dtype=float)
        numbers = np.searchsorted([slab.z0_mm for slab in self.slabs], heights, side="right") - 1
        inside = (numbers >= 0) & (heights < np.array([slab.z1_mm for slab in self.slabs])[numbers])
        return np.where(inside, numbers, -1)

    def _widest(self) -> list[Region]:
        """Return the regions that matter for how far the stack reaches: without those that others contain."""
        whole = {slab.number: slab.outline for slab in self.slabs if not slab.inset_mm}
        return [*whole.values(), *(slab.region for slab in self.slabs if slab.number not in whole)]


def _clean(slabs: Iterable[SlabLike]) -> list[Slab]:
    """Return slabs with rounded heights; empty ones are dropped."""
    tuples = [(s.z0_mm, s.z1_mm, s.region) if isinstance(s, Slab) else s for s in slabs]
    levels = [(rounded_z(z0), rounded_z(z1), region) for z0, z1, region in tuples]
    return [Slab(z0, z1, region) for z0, z1, region in levels if z0 < z1 and not region.is_empty()]


def _arranged(added: Iterable[SlabLike], removed: Iterable[SlabLike]) -> Stack:
    """Return disjoint slabs that cover what is added but not removed."""
    plus, minus = _clean(added), _clean(removed)
    levels = sorted({z for slab in (*plus, *minus) for z in (slab.z0_mm, slab.z1_mm)})
    numbers: dict[tuple[tuple[int, ...], tuple[int, ...]], int] = {}
    regions: list[Region] = []
    slabs: list[Slab] = []
    for z0, z1 in itertools.pairwise(levels):
        solid, void = _present(plus, z0, z1), _present(minus, z0, z1)
        if not solid:
            continue
        number = numbers.setdefault((solid, void), len(regions))
        if number == len(regions):
            regions.append(_difference([plus[n].outline for n in solid], [minus[n].outline for n in void]))
        if regions[number].area() <= SMALLEST_AREA_MM2:
            continue
        slabs.append(Slab(z0, z1, regions[number], number=number))
    if not slabs:
        raise JumpcadError("nothing is left of a part: its slabs are empty or cut away completely")
    return Stack(tuple(slabs))


def _present(slabs: Sequence[Slab], z0_mm: float, z1_mm: float) -> tuple[int, ...]:
    """Return the numbers of the slabs that reach from one height to another."""
    return tuple(number for number, slab in enumerate(slabs) if slab.z0_mm <= z0_mm and slab.z1_mm >= z1_mm)


def _difference(added: Sequence[Region], removed: Sequence[Region]) -> Region:
    """Return what lies in an added region but in no removed one."""
    region = added[0] if len(added) == 1 else CrossSection.batch_boolean(list(added), OpType.Add)
    return CrossSection.batch_boolean([region, *removed], OpType.Subtract) if removed else region
