"""Layers of a print: runs of them that are alike, what is inside their perimeters, and what of it others leave open.

A cross-section that is an outline less pockets inside it is treated as the outline, once for all its pockets, and the
pockets.
"""

import itertools
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, JoinType, OpType

from jumpcad.solids.moments import Measured, contours_moments
from jumpcad.solids.outline import Region, box_around, union
from jumpcad.solids.slab import NOTHING, SMALLEST_AREA_MM2, CrossSections
from jumpcad.transforms import Array
from jumpcad.workshop import Process

Numbers = npt.NDArray[np.int64]

ALIKE_LAYERS = 5
"""Largest number of layers that change gradually and are taken together."""
ALIKE = 0.1
"""Largest sum of second differences in such a run, over the largest cross-section."""
JUMP = 0.01
"""A change by more than this share of the largest cross-section plus twice the neighbouring changes is a jump."""


class LayerRun(NamedTuple):
    """Layers on top of each other, from `first` to the one before `end`."""

    first: int
    end: int

    @property
    def middle(self) -> int:
        """The layer that represents all."""
        return (self.first + self.end) // 2


def jumps_of(which: Numbers, area_mm2: Array) -> list[int]:
    """Return the layers whose cross-section differs from the one below by more than a step in a series of small ones.

    Given are the number of each layer's cross-section, and its area, (n,).
    """
    sizes, changes = area_mm2.tolist(), (np.flatnonzero(which[1:] != which[:-1]) + 1).tolist()
    change = [0.0, *(abs(upper - lower) for lower, upper in itertools.pairwise(sizes)), 0.0]
    ends, least = {0, *changes, len(sizes)}, JUMP * max(sizes)

    def is_jump(layer: int) -> bool:
        beside_steady = layer - 1 not in ends or layer + 1 not in ends
        return beside_steady or change[layer] > least + 2.0 * max(change[layer - 1], change[layer + 1])

    return list(filter(is_jump, changes))


def runs_of(area: Array, jumps: Sequence[int], process: Process) -> list[LayerRun]:
    """Return runs of layers that are alike and have the same jumps among the layers that make them bottom or top.

    Where area and polar moment about the centre change from layer to layer, they change steadily within a run, and so
    do the layers that make them bottom or top; its length is odd. Its middle layer is then the average of all.
    It has no more layers than a top: what a run bridges begins where the run below ends. Given are the area moments of
    all layers, (n, 6).
    """
    count, below, above = len(area), process.bottom_layers, process.top_layers
    cuts = {jump + step for jump in jumps for step in (-above, 0, below)} | {below, count - above}
    ends = sorted({0, count, *(cut for cut in cuts if 0 < cut < count)})
    changes = np.flatnonzero((area[1:] != area[:-1]).any(axis=1)) + 1
    if set(changes.tolist()) <= set(jumps):
        return list(itertools.starmap(LayerRun, itertools.pairwise(ends)))
    a, x, y, xx, yy, _ = area.T
    sizes = np.stack([a, xx + yy - (x * x + y * y) / np.maximum(a, SMALLEST_AREA_MM2)])
    steps = np.diff(sizes, prepend=sizes[:, :1], append=sizes[:, -1:])
    steps[:, list(jumps)] = 0.0
    bends = (np.abs(np.diff(steps)) / sizes.max(axis=1, keepdims=True)).max(axis=0)
    bends = np.pad(bends, (below, above))
    bent = np.cumsum(bends[:count] + bends[below : below + count] + bends[below + above :])
    longest = max(1, min(ALIKE_LAYERS, above - (above + 1) % 2))
    runs = []
    for first, end in itertools.pairwise(ends):
        while first < end:
            length = int(np.searchsorted(bent[first:end], bent[first] + ALIKE, side="right"))
            if bent[first] < bent[first + length - 1]:
                length = min(longest, length - (length + 1) % 2)
            runs.append(LayerRun(first, first + length))
            first += length
    return runs


OUTLINE_TOLERANCE_MM = 0.01
"""Corners nearer than this to a straight line are left out where shells and infill are concerned, for speed."""
MANY_HOLES, FEW_CORNERS = 10, 100
"""Least contours of an outline that may be twice as coarse, and most corners of each: plates, but not gears."""


def section_moments(sections: CrossSections, contours: Sequence[Sequence[Array]]) -> tuple[Array, Array]:
    """Return the area moments (n, 6) of the n different cross-sections with some contours, and of their borders."""
    count = len(sections.outlines)
    areas, borders = contours_moments(contours)
    around = [number for number, _ in sections.pockets]
    areas[count:] = areas[around] - areas[count:]
    borders[count:] = borders[around] + borders[count:]
    return areas, borders


class Cores:
    """What is inside the perimeters of a part's cross-sections, by their numbers.

    It is empty where all of it is narrower than a line, as perimeters then widen to fill it; the same in PrusaSlicer
    (PerimeterGenerator.cpp, process_arachne). A strip of width w has an area of w·border/2.
    """

    def __init__(self, sections: CrossSections, numbers: Iterable[int], shell_mm: float, spacing_mm: float) -> None:
        self._sections, self.measured = sections, Measured(NOTHING)
        self._cut: dict[tuple[int, int], Region | None] = {}
        self._divided: dict[tuple[int, frozenset[int], frozenset[int]], tuple[Region, Region]] = {}
        self.inside: dict[int, Region] = {}
        whole: dict[int, Region] = {}
        for number in numbers:
            around, pocket = self._parted(number)
            if around not in whole:
                whole[around] = _moved(sections.outlines[around], -shell_mm)
            # less what is nearer to the pocket than the perimeters are thick
            self.inside[number] = whole[around] if number == around else whole[around] - _moved(pocket, shell_mm)
        areas, borders = self.measured.of(list(self.inside.values()))
        slims = (2.0 * areas[:, 0] < spacing_mm * borders[:, 0]).tolist()
        for (number, core), slim in zip(self.inside.items(), slims, strict=True):
            if slim and core.offset(-spacing_mm / 2.0, JoinType.Miter).is_empty():
                self.inside[number] = NOTHING

    def divided(self, number: int, others: Sequence[int]) -> tuple[Region, Region]:
        """Return of the core of a cross-section what does not lie in all of some others, and what does.

        Where all of it does, the second one is the core itself.
        """
        own = self._parted(number)[1]
        parted = [self._parted(other) for other in others]
        pockets = [pocket for _, pocket in parted if pocket is not own and not pocket.is_empty()]
        outlines = dict.fromkeys(outline for outline, _ in parted)
        cuts = {outline: cut for outline in outlines if (cut := self._within(number, outline)) is not None}
        key = number, frozenset(cuts), frozenset(map(id, pockets))
        if key not in self._divided:
            self._divided[key] = self._split(self.inside[number], cuts, pockets)
        return self._divided[key]

    def _split(self, core: Region, cuts: dict[int, Region], pockets: Sequence[Region]) -> tuple[Region, Region]:
        """Return a core outside and inside some outlines, given what each leaves of it, and not in some pockets."""
        sparse, bounds = core, list[Region]()
        for outline, cut in sorted(cuts.items(), key=lambda case: case[1].area()):
            smaller = sparse ^ self._sections.outlines[outline] if bounds else cut
            if not _same_area(sparse, smaller):
                sparse = smaller
                bounds.append(self._sections.outlines[outline])
        if pockets and not sparse.is_empty():
            void = union(pockets) if len(pockets) > 1 else pockets[0]
            smaller = sparse - void
            if not bounds and not smaller.is_empty():
                return (NOTHING, core) if _same_area(core, smaller) else (core ^ void, smaller)
            if not _same_area(sparse, smaller):
                sparse = smaller
                bounds.append(box_around(core, 1.0) - void)
        if not bounds or sparse.is_empty():
            return (core, NOTHING) if bounds else (NOTHING, core)
        common = CrossSection.batch_boolean(bounds, OpType.Intersect) if len(bounds) > 1 else bounds[0]
        return core - common, sparse  # not `core - sparse`: slivers would remain along the border that they share

    def _within(self, number: int, outline: int) -> Region | None:
        """Return what of a core lies within an outline; None where that is all of it."""
        if (number, outline) not in self._cut:
            core = self.inside[number]
            cut = core if outline == self._parted(number)[0] else core ^ self._sections.outlines[outline]
            self._cut[number, outline] = None if _same_area(core, cut) else cut
        return self._cut[number, outline]

    def _parted(self, number: int) -> tuple[int, Region]:
        """Return the number of a cross-section's outline, and the pocket in it."""
        count = len(self._sections.outlines)
        return self._sections.pockets[number - count] if number >= count else (number, NOTHING)


def _moved(region: Region, distance_mm: float) -> Region:
    """Return a region whose border is moved outwards by a distance."""
    contours = region.num_contour()
    coarse = contours >= MANY_HOLES and region.num_vert() <= FEW_CORNERS * contours
    return region.simplify((2.0 if coarse else 1.0) * OUTLINE_TOLERANCE_MM).offset(distance_mm, JoinType.Miter)


def _same_area(whole: Region, part: Region) -> bool:
    """Tell whether a part of a region is all of it."""
    return part is whole or whole.area() - part.area() < SMALLEST_AREA_MM2
