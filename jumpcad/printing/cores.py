"""What is inside a part's perimeters, and what of it other layers leave open.

A cross-section that is an outline less a pocket inside it is treated as the outline, once for all its pockets, and
the pocket.
"""

from collections.abc import Sequence

from manifold3d import CrossSection, JoinType, OpType

from jumpcad.solids.moments import areas_and_borders, borders_mm
from jumpcad.solids.outline import Region, box_around, union
from jumpcad.solids.slab import NOTHING, CrossSections
from jumpcad.transforms import Array

OUTLINE_TOLERANCE_MM = 0.01
"""Corners nearer than this to a straight line are left out where shells and infill are concerned, for speed."""


def section_moments(sections: CrossSections) -> tuple[Array, Array]:
    """Return the area moments (n, 6) of the n different cross-sections, and those along their borders."""
    count = len(sections.outlines)
    areas, borders = areas_and_borders([*sections.outlines, *(pocket for _, pocket in sections.pockets)])
    around = [number for number, _ in sections.pockets]
    areas[count:] = areas[around] - areas[count:]
    borders[count:] = borders[around] + borders[count:]
    return areas, borders


def cores(sections: CrossSections, numbers: Sequence[int], shell_mm: float, spacing_mm: float) -> dict[int, Region]:
    """Return what is inside the perimeters of cross-sections, each under its number.

    It is empty where all of it is narrower than a line, as perimeters then widen to fill it; the same in PrusaSlicer
    (PerimeterGenerator.cpp, process_arachne). A strip of width w has an area of w·border/2.
    """
    inside: dict[int, Region] = {}
    for number in numbers:
        around, pocket = _parted(sections, number)
        if around not in inside:
            inside[around] = _set_back(sections.outlines[around], shell_mm)
        if number != around:
            outline = sections.outlines[around]  # less what is nearer to the pocket than the perimeters are thick
            inside[number] = inside[around] ^ _set_back(box_around(outline, 2.0 * shell_mm) - pocket, shell_mm)
    borders = borders_mm([inside[number] for number in numbers]).tolist()
    found = {}
    for number, border in zip(numbers, borders, strict=True):
        core = inside[number]
        slim = 2.0 * core.area() < spacing_mm * border
        narrow = slim and core.offset(-spacing_mm / 2.0, JoinType.Miter).is_empty()
        found[number] = NOTHING if narrow else core
    return found


def shared(core: Region, number: int, others: Sequence[int], sections: CrossSections) -> Region:
    """Return a region that has the same of the core of a cross-section as all of some others have."""
    around, pocket = _parted(sections, number)
    regions, beyond = [], []
    for outline, other in (_parted(sections, other) for other in others):
        if outline == around:
            beyond.append(other - pocket)
        else:
            regions.append(sections.outlines[outline] - other if not other.is_empty() else sections.outlines[outline])
    if beyond:
        regions.append(box_around(core, 1.0) - union(beyond))
    return CrossSection.batch_boolean(regions, OpType.Intersect)


def _parted(sections: CrossSections, number: int) -> tuple[int, Region]:
    """Return the number of a cross-section's outline, and the pocket in it."""
    count = len(sections.outlines)
    return sections.pockets[number - count] if number >= count else (number, NOTHING)


def _set_back(outline: Region, distance_mm: float) -> Region:
    """Return what is at least a distance inside an outline."""
    return outline.simplify(OUTLINE_TOLERANCE_MM).offset(-distance_mm, JoinType.Miter)
