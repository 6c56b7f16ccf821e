"""What a print weighs and how it turns: shells, solid layers and infill, layer by layer.

A line of width w and height h has the cross-section h·s with s = w - h·(1 - π/4), and lines lie s apart. n perimeters
therefore fill the part between (w - s)/2 and n·s + (w - s)/2 from its outline; what is inside that is solid where one
of the layers that count as top or bottom ends there, and infill elsewhere. The first solid layer over infill is laid
as bridges, with round threads of the nozzle's diameter d, d + 0.05 mm apart.
"""

import math
from collections.abc import Callable, Hashable, Sequence
from typing import Literal, NamedTuple, Protocol, TypeVar
from weakref import WeakKeyDictionary

import numpy as np
from manifold3d import CrossSection, JoinType, OpType

from jumpcad.mechanism.mass import MassProperties
from jumpcad.printing.runs import LayerRun, jumps_of, runs_of
from jumpcad.solids.moments import areas_and_borders, border_mm, mass_of, prism_moments
from jumpcad.solids.outline import Region
from jumpcad.solids.stack import NOTHING, SMALLEST_AREA_MM2, SlabSection
from jumpcad.transforms import Array
from jumpcad.workshop import Process

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


class Weighable(Protocol):
    """What can be sliced and weighed, z up from the bed (mm)."""

    @property
    def bounds_mm(self) -> Array:
        """Lower and upper corner of the bounding box, (2, 3)."""

    @property
    def moments(self) -> Array:
        """Volume moments (10,)."""

    def sections_at(self, heights_mm: Array) -> list[SlabSection]:
        """Return the cross-sections at heights (n,) ascending; outlines that do not differ are one object."""


class Layer(NamedTuple):
    """One printed layer; neighbours of the same cross-section share one outline."""

    z0_mm: float
    z1_mm: float
    section: SlabSection


_KNOWN: WeakKeyDictionary[Weighable, dict[tuple[object, ...], MassProperties]] = WeakKeyDictionary()
"""What is known of shapes, for as long as someone keeps them: gears and small parts serve many designs."""


def mass_properties(
    shape: Weighable, density_g_cm3: float, process: Process, nozzle_mm: float, model: MassModel = "printed"
) -> MassProperties:
    """Return mass, centre and inertia of one part in its printing frame (kg, m); found once for every shape.

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
    known, case = _KNOWN.setdefault(shape, {}), (density_g_cm3, process, nozzle_mm, model)
    if case not in known:
        moments = printed_moments(shape, process, nozzle_mm) if model == "printed" else shape.moments
        known[case] = mass_of(moments, density_g_cm3)
    return known[case]


def line_spacing_mm(width_mm: float, height_mm: float) -> float:
    """Return the distance between neighbouring lines, s = w - h·(1 - π/4) (mm)."""
    return width_mm - height_mm * (1.0 - math.pi / 4.0)


def sliced(shape: Weighable, process: Process) -> list[Layer]:
    """Return the layers of a shape, from the bed up, each with the cross-section at its middle as slicers take it."""
    bottom, top = (float(z) for z in shape.bounds_mm[:, 2])
    first, height = process.first_layer_mm, process.layer_height_mm
    above = max(0, math.ceil((top - bottom - first) / height - 0.5 - 1e-6))
    levels = bottom + np.array([0.0, *(first + height * np.arange(above + 1))])
    sections = shape.sections_at(np.round((levels[:-1] + levels[1:]) / 2.0, 6))
    return [Layer(*layer) for layer in zip(levels[:-1].tolist(), levels[1:].tolist(), sections, strict=True)]


def printed_moments(shape: Weighable, process: Process, nozzle_mm: float) -> Array:
    """Return the volume moments (10,) of the extruded plastic, see `jumpcad.solids.moments`.

    In each layer, as if it were laid at full height everywhere: the area of its cross-section, less the rounding of
    the lines along its border, plus the turns of the solid filling and of the infill, less what the infill leaves
    open, plus what bridges over infill hold more than flat lines do. All but the area are those of the middle layer of
    a run of layers that are alike. A chamfer takes from a layer's area, not from what is inside its perimeters.
    """
    layers = sliced(shape, process)
    outlines = [layer.section.outline for layer in layers]
    number = {outline: index for index, outline in enumerate(dict.fromkeys(outlines))}
    which = np.array([number[outline] for outline in outlines])
    areas, borders = areas_and_borders(list(number))
    jumps = jumps_of(which, areas[which, 0])
    runs = runs_of(areas[which], jumps, process)
    middles = [run.middle for run in runs]

    spacing = line_spacing_mm(process.line_width_mm, process.layer_height_mm)
    void = (process.line_width_mm - spacing) / 2.0
    shell = process.perimeters * spacing + void
    cores = _each(lambda outline: _core(outline, shell, spacing), [outlines[middle] for middle in middles])
    windows = [_window(middle, outlines, jumps, process) for middle in middles]
    filled = _each(lambda core, window: _filled(core, window, process.solid_below_area_mm2), cores, windows)
    solid, sparse = [pair[0] for pair in filled], [pair[1] for pair in filled]
    bridged = _bridged(runs, cores, solid, sparse, max(1, math.floor(nozzle_mm / process.layer_height_mm + 1e-9)))
    hollow = 1.0 - process.infill
    thread = math.pi * nozzle_mm**2 / 4.0 / (nozzle_mm + BRIDGE_GAP_MM)
    excess = max(0.0, thread / process.layer_height_mm - 1.0) if hollow > 0.0 else 0.0

    area, border = _table(solid, sparse, bridged)
    inside = spacing * SOLID_TURNS * border[0] + hollow * (spacing * SPARSE_TURNS * border[1] - area[1])
    inside -= void * borders[which[middles]]
    insets = np.array([[layer.section.inset_mm] for layer in layers])
    z0, z1 = np.array([layer.z0_mm for layer in layers]), np.array([layer.z1_mm for layer in layers])
    first, last = [run.first for run in runs], [run.end - 1 for run in runs]
    plastic = [areas[which] - insets * borders[which], inside, excess * area[2]]
    bottoms, tops = [z0, z0[first], z0[first]], [z1, z1[last], z1[first]]
    return prism_moments(*(np.concatenate(parts) for parts in (plastic, bottoms, tops)))


def _window(middle: int, outlines: Sequence[Region], jumps: Sequence[int], process: Process) -> tuple[Region, ...]:
    """Return the outlines that a layer's infill must lie within beside its own; `NOTHING` at the ends of the part.

    Of layers that change little by little, those at either end of the window and beside jumps speak for all.
    """
    low, high = middle - process.bottom_layers, middle + process.top_layers
    if low < 0 or high >= len(outlines):
        return (NOTHING,)
    layers = {low, high, *(layer for jump in jumps if low < jump <= high for layer in (jump - 1, jump))}
    return tuple(dict.fromkeys(outlines[layer] for layer in sorted(layers) if outlines[layer] is not outlines[middle]))


def _core(outline: Region, shell_mm: float, spacing_mm: float) -> Region:
    """Return what is inside the perimeters; nothing where that is all narrower than a line, as they widen to fill it.

    So does PrusaSlicer (PerimeterGenerator.cpp, process_arachne). A strip of width w has an area of w·border/2.
    """
    core = outline.simplify(OUTLINE_TOLERANCE_MM).offset(-shell_mm, JoinType.Miter)
    if core.is_empty():
        return NOTHING
    narrow = (
        2.0 * core.area() < spacing_mm * border_mm(core) and core.offset(-spacing_mm / 2.0, JoinType.Miter).is_empty()
    )
    return NOTHING if narrow else core


def _filled(core: Region, window: Sequence[Region], solid_below_mm2: float) -> tuple[Region, Region]:
    """Return the solidly and the sparsely filled region of a core, the latter inside all outlines of a window.

    Pieces so small as to be filled are not part of the sparse region.
    """
    if NOTHING in window:
        return core, NOTHING
    common = CrossSection.batch_boolean(list(window), OpType.Intersect) if window else core
    sparse = core ^ common if window else core
    if solid_below_mm2 > 0.0 and (large := _large(sparse, solid_below_mm2)) is not sparse:
        return core - large, large
    if core.area() - sparse.area() < SMALLEST_AREA_MM2:
        return NOTHING, core
    if sparse.area() < SMALLEST_AREA_MM2:
        return core, NOTHING
    return core - common, sparse  # not `core - sparse`: along the border that they share, slivers would remain


def _large(region: Region, area_mm2: float) -> Region:
    """Return the pieces of a region that have at least an area; the region itself if all have."""
    pieces = region.decompose()
    large = [piece for piece in pieces if piece.area() >= area_mm2]
    return region if len(large) == len(pieces) else CrossSection.compose(large)


def _bridged(
    runs: Sequence[LayerRun], cores: Sequence[Region], solid: Sequence[Region], sparse: Sequence[Region], depth: int
) -> list[Region]:
    """Return what threads bridge in the first layer of every run: where it is solid over `depth` sparse layers."""
    below = [sparse[index] for index, run in enumerate(runs) for _ in range(run.first, run.end)]

    def over(index: int) -> Region:
        first = runs[index].first
        beneath = dict.fromkeys(below[max(first - depth, 0) : first])
        if first < depth or solid[index] is NOTHING or NOTHING in beneath:
            return NOTHING
        beneath.pop(cores[index], None)  # all that is solid lies within its own core
        return CrossSection.batch_boolean([solid[index], *beneath], OpType.Intersect) if beneath else solid[index]

    return [over(index) for index in range(len(runs))]


def _each(change: Callable[..., T], *columns: Sequence[Hashable]) -> list[T]:
    """Return what becomes of every run's regions; every distinct case is computed once."""
    cases = list(zip(*columns, strict=True))
    known = {case: change(*case) for case in dict.fromkeys(cases)}
    return [known[case] for case in cases]


def _table(*regions: Sequence[Region]) -> tuple[Array, Array]:
    """Return the moments (k, n, 6) of k regions in each of n runs, and those of their borders."""
    everything = [region for column in regions for region in column]
    number = {region: index for index, region in enumerate(dict.fromkeys(everything))}
    which = [number[region] for region in everything]
    areas, borders = (moments[which].reshape(len(regions), -1, 6) for moments in areas_and_borders(list(number)))
    return areas, borders
