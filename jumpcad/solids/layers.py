"""What a print weighs and how it turns: shells, solid layers and infill, layer by layer.

A line of width w and height h has the cross-section h·s with s = w - h·(1 - π/4), and lines lie s apart. n perimeters
therefore fill the part between (w - s)/2 and n·s + (w - s)/2 from its outline; what is inside that is solid where one
of the layers that count as top or bottom ends there, and infill elsewhere. The first solid layer over infill is laid
as bridges, with round threads of the nozzle's diameter d, d + 0.05 mm apart.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, Protocol, TypeVar

import numpy as np
import numpy.typing as npt
from manifold3d import CrossSection, JoinType, OpType

from jumpcad.mass import MassProperties
from jumpcad.solids.moments import areas_moments, borders_moments, mass_of, prism_moments
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import NOTHING, SMALLEST_AREA_MM2
from jumpcad.workshop import Process

Array = npt.NDArray[np.float64]
T = TypeVar("T")
MassModel = Literal["printed", "solid"]

SOLID_TURNS = 0.5
"""Share of a solid region's border along which the turns of its zigzag lie, one spacing wide."""
SPARSE_TURNS = 0.25
"""The same for sparse infill: its lines end on the border, overlapping the perimeters by a quarter of a spacing."""
OUTLINE_TOLERANCE_MM = 0.01
"""Corners nearer than this to a straight line are left out where shells and infill are concerned, for speed."""
BRIDGE_GAP_MM = 0.05
"""Distance between the threads of a bridge (fixed in PrusaSlicer's Flow.hpp, BRIDGE_EXTRA_SPACING)."""


class Shape(Protocol):
    """What can be sliced and weighed, z up from the bed (mm)."""

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""

    @property
    def moments(self) -> Array:
        """Volume moments (10,)."""

    def regions_at(self, heights_mm: Array) -> list[Region]:
        """Return the cross-sections at heights (n,) ascending; neighbours that do not differ are one object."""


@dataclass(frozen=True)
class Layer:
    """One printed layer, or several alike; neighbours of the same cross-section share one object."""

    z0_mm: float
    z1_mm: float
    section: Region


@lru_cache(maxsize=128)
def mass_properties(
    shape: Shape, density_g_cm3: float, process: Process, nozzle_mm: float, model: MassModel = "printed"
) -> MassProperties:
    """Return mass, centre and inertia of one part in its printing frame (kg, m); of the last shapes it is remembered.

    Parameters
    ----------
    shape
        The part in printing orientation (mm).
    density_g_cm3
        Density of its material.
    process, nozzle_mm
        How it is printed.
    model
        `solid` for volume times density, `printed` for the layer model.
    """
    moments = printed_moments(shape, process, nozzle_mm) if model == "printed" else shape.moments
    return mass_of(moments, density_g_cm3)


def line_spacing_mm(width_mm: float, height_mm: float) -> float:
    """Return the distance between neighbouring lines, s = w - h·(1 - π/4) (mm)."""
    return width_mm - height_mm * (1.0 - math.pi / 4.0)


def sliced(shape: Shape, process: Process) -> list[Layer]:
    """Return the layers of a shape, from the bed up, each with the cross-section at its middle as slicers take it."""
    bottom, top = (float(z) for z in shape.bounds_mm[:, 2])
    first, height = process.first_layer_mm, process.layer_height_mm
    above = max(0, math.ceil((top - bottom - first) / height - 0.5 - 1e-6))
    levels = bottom + np.array([0.0, *(first + height * np.arange(above + 1))])
    sections = shape.regions_at(np.round((levels[:-1] + levels[1:]) / 2.0, 6))
    return [Layer(*layer) for layer in zip(levels[:-1].tolist(), levels[1:].tolist(), sections, strict=True)]


def printed_moments(shape: Shape, process: Process, nozzle_mm: float) -> Array:
    """Return the volume moments (10,) of the extruded plastic, see `jumpcad.solids.moments`.

    In each layer, as if it were laid at full height everywhere: the area of its cross-section, less the rounding of
    the lines along its border, plus the turns of the solid filling and of the infill, less what the infill leaves
    open, plus what bridges over infill hold more than flat lines do.
    """
    thread_layers = max(1, math.floor(nozzle_mm / process.layer_height_mm + 1e-9))
    layers = _joined(sliced(shape, process), max(process.bottom_layers + thread_layers, process.top_layers))
    sections = [layer.section for layer in layers]
    spacing = line_spacing_mm(process.line_width_mm, process.layer_height_mm)
    void = (process.line_width_mm - spacing) / 2.0
    outlines = _each(lambda section: section.simplify(OUTLINE_TOLERANCE_MM), sections)
    cores = _each(lambda outline: _core(outline, process.perimeters * spacing + void, spacing), outlines)
    sparse, solid = _filling(outlines, cores, process)
    hollow = 1.0 - process.infill
    bridged = _bridged(solid, sparse, thread_layers)
    thread = math.pi * nozzle_mm**2 / 4.0 / (nozzle_mm + BRIDGE_GAP_MM)
    excess = max(0.0, thread / process.layer_height_mm - 1.0) if hollow > 0.0 else 0.0

    area = _table(areas_moments, sections, sparse, bridged)
    border = _table(borders_moments, outlines, solid, sparse)
    plastic = area[0] - void * border[0] + spacing * SOLID_TURNS * border[1]
    plastic += hollow * (spacing * SPARSE_TURNS * border[2] - area[1]) + excess * area[2]
    return prism_moments(plastic, [layer.z0_mm for layer in layers], [layer.z1_mm for layer in layers])


def _joined(layers: Sequence[Layer], reach: int) -> list[Layer]:
    """Return the layers with those taken together that are farther than `reach` layers from another cross-section."""
    joined: list[Layer] = []
    for section, same in itertools.groupby(layers, key=lambda layer: layer.section):
        run = list(same)
        if len(run) > 2 * reach + 1:
            middle = Layer(run[reach].z0_mm, run[-reach - 1].z1_mm, section)
            run = [*run[:reach], middle, *run[len(run) - reach :]]
        joined += run
    return joined


def _each(change: Callable[..., T], *regions: Sequence[Region]) -> list[T]:
    """Return what becomes of every layer's regions; every distinct case is computed once."""
    cases = list(zip(*regions, strict=True))
    known = {case: change(*case) for case in dict.fromkeys(cases)}
    return [known[case] for case in cases]


def _core(outline: Region, walls_mm: float, spacing_mm: float) -> Region:
    """Return what is inside the perimeters; nothing where that is all narrower than a line, as they widen to fill it.

    So does PrusaSlicer (PerimeterGenerator.cpp, process_arachne). A strip of width w has an area of w·border/2.
    """
    core = outline.offset(-walls_mm, JoinType.Miter)
    if core.is_empty():
        return NOTHING
    border = sum(float(np.hypot(*(ring - np.roll(ring, 1, axis=0)).T).sum()) for ring in core.to_polygons())
    narrow = 2.0 * core.area() < spacing_mm * border and core.offset(-spacing_mm / 2.0, JoinType.Miter).is_empty()
    return NOTHING if narrow else core


def _table(measure: Callable[[Sequence[Region]], Array], *regions: Sequence[Region]) -> Array:
    """Return the moments (k, n, 6) of k regions in each of n layers; every distinct one is computed once."""
    everything = [region for column in regions for region in column]
    number = {region: index for index, region in enumerate(dict.fromkeys(everything))}
    moments = measure(list(number))
    return np.asarray(moments[[number[region] for region in everything]].reshape(len(regions), -1, 6))


def _filling(
    outlines: Sequence[Region], cores: Sequence[Region], process: Process
) -> tuple[list[Region], list[Region]]:
    """Return the sparsely and the solidly filled region of every layer.

    The sparse one lies inside the perimeters, and inside the outlines of all layers that would otherwise make it a top
    or a bottom. Pieces so small as to be filled are not part of it.
    """
    below, above = process.bottom_layers, process.top_layers
    if len(outlines) < below + 1 + above:
        return [NOTHING] * len(outlines), list(cores)

    def filling(outline: Region, core: Region, common: Region) -> tuple[Region, Region]:
        sparse = core if common is outline else core ^ common
        if process.solid_below_area_mm2 > 0.0 and (large := _large(sparse, process.solid_below_area_mm2)) is not sparse:
            return large, core - large
        if core.area() - sparse.area() < SMALLEST_AREA_MM2:
            return core, NOTHING
        if sparse.area() < SMALLEST_AREA_MM2:
            return NOTHING, core
        return sparse, core - common  # not `core - sparse`: along the border that they share, slivers would remain

    inside = slice(below, len(outlines) - above)
    filled = _each(filling, outlines[inside], cores[inside], _common(outlines, below + 1 + above))
    sparse = [NOTHING] * below + [sparse for sparse, _ in filled] + [NOTHING] * above
    solid = [*cores[:below], *(solid for _, solid in filled), *cores[len(cores) - above :]]
    return sparse, solid


def _large(region: Region, area_mm2: float) -> Region:
    """Return the pieces of a region that have at least an area; the region itself if all have."""
    pieces = region.decompose()
    large = [piece for piece in pieces if piece.area() >= area_mm2]
    return region if len(large) == len(pieces) else CrossSection.compose(large)


def _common(regions: Sequence[Region], count: int) -> list[Region]:
    """Return what each `count` regions in a row have in common, by doubling the length of shorter rows."""
    known: dict[frozenset[Region], Region] = {frozenset([region]): region for region in regions}
    rows, span = [frozenset([region]) for region in regions], 1
    while span < count:
        step = min(span, count - span)
        longer = [a | b for a, b in zip(rows[:-step], rows[step:], strict=True)]
        for a, b, both in zip(rows[:-step], rows[step:], longer, strict=True):
            if both not in known:
                known[both] = known[a] ^ known[b]
        rows, span = longer, span + step
    return [known[row] for row in rows]


def _bridged(solid: Sequence[Region], sparse: Sequence[Region], depth: int) -> list[Region]:
    """Return the region of every layer that is solid over sparse ones, which a thread laid as a bridge is deep."""

    def over(*regions: Region) -> Region:
        if NOTHING in regions:
            return NOTHING
        return CrossSection.batch_boolean(list(dict.fromkeys(regions)), OpType.Intersect)

    count = min(depth, len(solid))
    below = [[NOTHING] * step + list(sparse[: len(sparse) - step]) for step in range(1, count + 1)]
    return _each(over, solid, *below)
