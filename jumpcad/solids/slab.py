"""Slabs, of which stacks are made, and cross-sections of what has them."""

import functools
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, JoinType

from jumpcad.solids.outline import Region, corners_key
from jumpcad.transforms import Array

Numbers = npt.NDArray[np.int64]
Interval = tuple[float, float]
"""Lower and upper end (mm)."""

Z_DIGITS = 4  # heights are rounded to this many decimals of a mm: faces meant to meet do, in 32-bit floats too
SMALLEST_AREA_MM2 = 1e-6  # what clipping leaves where two regions only touch
NOTHING: Region = CrossSection()


class CrossSections(NamedTuple):
    """Cross-sections at heights (n,): the different outlines, the number of each section, and the inset of its chamfer.

    `which` (n,) numbers outline and pocket: two heights have the same cross-section where it and the inset are the
    same. `pockets` are outlines that are another one less a pocket inside it, which are not among `outlines`: they are
    numbered after these. Each is the number of the other outline and the pocket.
    """

    outlines: Sequence[Region]
    which: Numbers
    inset_mm: Array
    pockets: Sequence[tuple[int, Region]] = ()

    def contours(self) -> list[list[Array]]:
        """Return the contours (k, 2) of each outline, then of each pocket."""
        return [region.to_polygons() for region in (*self.outlines, *(pocket for _, pocket in self.pockets))]


@dataclass(frozen=True, eq=False)
class Slab:
    """An outline, with its border set back by `inset_mm`, extruded from `z0_mm` to `z1_mm`, less a pocket inside it.

    `number` is the outline's number within a stack: slabs of one number have one outline. `pocket_number` is likewise
    that of the pocket, 0 without. Slabs are equal if their numbers and the corners of their outlines and pockets are.
    """

    z0_mm: float
    z1_mm: float
    outline: Region
    inset_mm: float = 0.0
    number: int = 0
    pocket: Region = NOTHING
    pocket_number: int = 0

    @functools.cached_property
    def region(self) -> Region:
        """The region that is extruded."""
        outline = self.outline - self.pocket if self.pocket_number else self.outline
        return outline.offset(-self.inset_mm, JoinType.Miter) if self.inset_mm else outline

    @property
    def height_mm(self) -> float:
        """Thickness of the slab (mm)."""
        return self.z1_mm - self.z0_mm

    @property
    def _numbers(self) -> tuple[float, float, float, int, int]:
        return self.z0_mm, self.z1_mm, self.inset_mm, self.number, self.pocket_number

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Slab) or self._numbers != other._numbers:
            return False
        return _same(self.outline, other.outline) and _same(self.pocket, other.pocket)

    def __hash__(self) -> int:
        return hash((self._numbers, self.outline.bounds()))  # quicker than the corners, which few slabs need


SlabLike = Slab | tuple[float, float, Region]


def pocketed(sections: CrossSections) -> CrossSections:
    """Return the same cross-sections, outlines that differ in some holes as one outline and pockets.

    The numbers of the sections are other ones.
    """
    contours = [{contour.tobytes(): contour for contour in outline.to_polygons()} for outline in sections.outlines]
    alike = defaultdict[bytes, list[int]](list)
    for number, found in enumerate(contours):
        alike[next(iter(found), b"")].append(number)
    if len(alike) == len(contours):
        return sections
    outlines: list[Region] = []
    cases: dict[int, tuple[int, Region]] = {}
    for numbers in alike.values():
        common = set.intersection(*(set(contours[number]) for number in numbers))
        more = {number: [c for key, c in contours[number].items() if key not in common] for number in numbers}
        if len(numbers) > 1 and all(_is_hole(contour) for extra in more.values() for contour in extra):
            plain = next((number for number, extra in more.items() if not extra), None)
            shared = [contour for key, contour in contours[numbers[0]].items() if key in common]
            cases |= {
                number: (len(outlines), CrossSection([hole[::-1] for hole in extra]) if extra else NOTHING)
                for number, extra in more.items()
            }
            outlines.append(CrossSection(shared) if plain is None else sections.outlines[plain])
        else:
            cases |= {number: (len(outlines) + place, NOTHING) for place, number in enumerate(numbers)}
            outlines += [sections.outlines[number] for number in numbers]
    for number, (outline, pocket) in enumerate(sections.pockets, start=len(sections.outlines)):
        around, hole = cases[outline]
        cases[number] = around, pocket if hole.is_empty() else hole + pocket
    pockets = [cases[number] for number in sorted(cases) if not cases[number][1].is_empty()]
    later = iter(range(len(outlines), len(outlines) + len(pockets)))
    numbers = [around if pocket.is_empty() else next(later) for _, (around, pocket) in sorted(cases.items())]
    return CrossSections(outlines, np.array(numbers)[sections.which], sections.inset_mm, pockets)


def rounded_z(height_mm: float) -> float:
    """Return a height as it is kept."""
    return round(float(height_mm), Z_DIGITS)


def _same(a: Region, b: Region) -> bool:
    """Tell whether two regions have the same corners."""
    return a is b or corners_key(a) == corners_key(b)


def _is_hole(contour: Array) -> bool:
    """Tell whether a contour (n, 2) is clockwise."""
    x, y = contour.T
    return float(np.dot(np.roll(x, 1), y) - np.dot(x, np.roll(y, 1))) < 0.0
