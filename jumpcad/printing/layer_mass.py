"""Mass and inertia of a print: shells, solid layers and infill, layer by layer.

A line of width w and height h has the cross-section h·s with s = w - h·(1 - π/4), and lines lie s apart. n perimeters
therefore fill the part between (w - s)/2 and n·s + (w - s)/2 from its outline; what is inside that is solid where one
of the layers that count as top or bottom ends there, and infill elsewhere. The first solid layer over infill is laid
as bridges, with round threads of the nozzle's diameter d, d + 0.05 mm apart.
"""

import itertools
import math
from collections.abc import Hashable, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Literal, NamedTuple, Protocol

import numpy as np
from manifold3d import CrossSection, OpType

from jumpcad.mechanism.mass import MassProperties
from jumpcad.printing.layers import Cores, LayerRun, Numbers, jumps_of, runs_of, section_moments
from jumpcad.solids.moments import Measured, mass_of, prism_moments
from jumpcad.solids.outline import Region
from jumpcad.solids.slab import NOTHING, SMALLEST_AREA_MM2, CrossSections
from jumpcad.transforms import Array
from jumpcad.workshop import Process

MassModel = Literal["printed", "solid"]

SOLID_TURNS = 0.5
"""Share of a solid region's border along which the turns of its zigzag lie, one spacing wide."""
SPARSE_TURNS = 0.25
"""The same for sparse infill: its lines end on the border, overlapping the perimeters by a quarter of a spacing."""
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

    def sections_at(self, heights_mm: Array) -> CrossSections:
        """Return the cross-sections at heights (n,) ascending."""


class Filling(NamedTuple):
    """The solidly and the sparsely filled region inside the perimeters, and whether all of it is sparse."""

    solid: Region
    sparse: Region
    all_sparse: bool = False


Window = tuple[int, ...] | None
"""Numbers of the outlines, beside its own, that a layer's infill must lie within; None near the ends of the part."""
Case = tuple[int, Window]
"""What a filling depends on: the number of a layer's outline, and its window."""


KEPT, FEW = 64, 4
"""Sliced parts of which moments are kept, each of few outlines: spacers, mounts and trays recur in many designs."""


def mass_properties(
    shape: Weighable, density_g_cm3: float, process: Process, nozzle_mm: float, model: MassModel = "printed"
) -> MassProperties:
    """Return mass, centre and inertia of one part in its printing frame (kg, m); `solid` is volume times density."""
    moments = printed_moments(shape, process, nozzle_mm) if model == "printed" else shape.moments
    return mass_of(moments, density_g_cm3)


def line_spacing_mm(width_mm: float, height_mm: float) -> float:
    """Return the distance between neighbouring lines, s = w - h·(1 - π/4) (mm)."""
    return width_mm - height_mm * (1.0 - math.pi / 4.0)


def sliced(shape: Weighable, process: Process) -> tuple[Array, CrossSections]:
    """Return where a shape's n layers begin and end (n + 1,), from the bed up, and the sections at their middles."""
    bottom, top = (float(z) for z in shape.bounds_mm[:, 2])
    first, height = process.first_layer_mm, process.layer_height_mm
    above = max(0, math.ceil((top - bottom - first) / height - 0.5 - 1e-6))
    levels = bottom + np.array([0.0, *(first + height * np.arange(above + 1))])
    return levels, shape.sections_at(np.round((levels[:-1] + levels[1:]) / 2.0, 6))


def printed_moments(shape: Weighable, process: Process, nozzle_mm: float) -> Array:
    """Return the volume moments (10,) of the extruded plastic, see `jumpcad.solids.moments`.

    In each layer, as if it were laid at full height everywhere: the area of its cross-section, less the rounding of
    the lines along its border, plus the turns of the solid filling and of the infill, less what the infill leaves
    open, plus what bridges over infill hold more than flat lines do, or in thick layers less. All but the area are
    those of the middle layer of a run of layers that are alike. A chamfer takes from a layer's area, not from what is
    inside its perimeters.
    """
    layers = _Layers(*sliced(shape, process))
    weigh = _printed if len(layers.contours) <= FEW else _printed.__wrapped__
    return weigh(layers, process, nozzle_mm)


class _Layers:
    """What `sliced` returns, equal where levels, contours and insets are: also of parts that end in one layer."""

    def __init__(self, levels_mm: Array, sections: CrossSections) -> None:
        self.levels, self.sections, self.contours = levels_mm, sections, sections.contours()

    @cached_property
    def _key(self) -> Hashable:
        around, counts = tuple(number for number, _ in self.sections.pockets), tuple(map(len, self.contours))
        arrays = (self.levels, self.sections.which, self.sections.inset_mm, *itertools.chain(*self.contours))
        return around, counts, tuple([array.tobytes() for array in arrays])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Layers) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@lru_cache(KEPT)
def _printed(layers: _Layers, process: Process, nozzle_mm: float) -> Array:
    """Return the volume moments (10,) of the extruded plastic of layers."""
    levels, sections = layers.levels, layers.sections
    which, inset = sections.which, sections.inset_mm
    areas, borders = section_moments(sections, layers.contours)
    jumps = jumps_of(which, areas[which, 0])
    runs = runs_of(areas[which], jumps, process)
    middles = [run.middle for run in runs]

    spacing = line_spacing_mm(process.line_width_mm, process.layer_height_mm)
    void = (process.line_width_mm - spacing) / 2.0
    shell = process.perimeters * spacing + void
    cases = [(int(which[middle]), _window(middle, which, jumps, process)) for middle in middles]
    cores = Cores(sections, dict.fromkeys(number for number, _ in cases), shell, spacing)
    fillings = {case: _filled(cores, *case, process.solid_below_area_mm2) for case in dict.fromkeys(cases)}
    bridged = _bridged(runs, cases, fillings, math.floor(nozzle_mm / process.layer_height_mm + 1e-9))
    hollow = 1.0 - process.infill
    thread = math.pi * nozzle_mm**2 / 4.0 / (nozzle_mm + BRIDGE_GAP_MM)
    excess = thread / process.layer_height_mm - 1.0 if hollow > 0.0 else 0.0

    area, border = _table(cases, fillings, bridged, cores.measured)
    inside = spacing * SOLID_TURNS * border[0] + hollow * (spacing * SPARSE_TURNS * border[1] - area[1])
    inside -= void * borders[which[middles]]
    z0, z1 = levels[:-1], levels[1:]
    first, last = [run.first for run in runs], [run.end - 1 for run in runs]
    plastic = [areas[which] - inset[:, None] * borders[which], inside, excess * area[2]]
    bottoms, tops = [z0, z0[first], z0[first]], [z1, z1[last], z1[first]]
    return prism_moments(*(np.concatenate(parts) for parts in (plastic, bottoms, tops)))


def _window(middle: int, which: Numbers, jumps: Sequence[int], process: Process) -> Window:
    """Return the window of a layer, given the numbers of all layers' outlines (n,).

    Where layers change gradually, those at either end of the window and beside jumps stand for all.
    """
    low, high = middle - process.bottom_layers, middle + process.top_layers
    if low < 0 or high >= len(which):
        return None
    layers = {low, high, *(layer for jump in jumps if low < jump <= high for layer in (jump - 1, jump))}
    numbers = dict.fromkeys(which[sorted(layers)].tolist())
    return tuple(number for number in numbers if number != which[middle])


def _filled(cores: Cores, number: int, window: Window, solid_below_mm2: float) -> Filling:
    """Return how the core of a cross-section is filled: sparsely where it lies in all those of a window, else solidly.

    Pieces of the sparse region that are smaller than `solid_below_mm2` become solid.
    """
    core = cores.inside[number]
    if window is None or core.is_empty():
        return Filling(core, NOTHING)
    solid, sparse = cores.divided(number, window)
    if solid_below_mm2 > 0.0:
        pieces = sparse.decompose()
        large = [piece for piece in pieces if piece.area() >= solid_below_mm2]
        if len(large) < len(pieces):
            kept = CrossSection.compose(large)
            return Filling(core - kept, kept)
    if core.area() - sparse.area() < SMALLEST_AREA_MM2:
        return Filling(NOTHING, core, all_sparse=True)
    if sparse.area() < SMALLEST_AREA_MM2:
        return Filling(core, NOTHING)
    return Filling(solid, sparse)


def _bridged(
    runs: Sequence[LayerRun], cases: Sequence[Case], fillings: Mapping[Case, Filling], depth: int
) -> list[Region]:
    """Return what threads bridge in the first layer of every run: where it is solid over `depth` sparse layers."""
    below = [case for case, run in zip(cases, runs, strict=True) for _ in range(run.first, run.end)]

    def over(case: Case, first: int) -> Region:
        solid, beneath = fillings[case].solid, dict.fromkeys(below[max(first - depth, 0) : first])
        if first < depth or solid.is_empty() or any(fillings[other].sparse.is_empty() for other in beneath):
            return NOTHING
        # by the number of the outline where all of its core is sparse, which is then one region for all windows
        sparse = {(other[0] if fillings[other].all_sparse else other): fillings[other].sparse for other in beneath}
        sparse.pop(case[0], None)  # all that is solid lies within its own core
        return CrossSection.batch_boolean([solid, *sparse.values()], OpType.Intersect) if sparse else solid

    return [over(case, run.first) for case, run in zip(cases, runs, strict=True)]


def _table(
    cases: Sequence[Case], fillings: Mapping[Case, Filling], bridged: Sequence[Region], measured: Measured
) -> tuple[Array, Array]:
    """Return the area moments (3, n, 6) of what is solid, sparse and bridged in n runs, and those of the borders."""
    filled = [fillings[case] for case in cases]
    regions = [*(one.solid for one in filled), *(one.sparse for one in filled), *bridged]
    areas, borders = measured.of(regions)
    return areas.reshape(3, -1, 6), borders.reshape(3, -1, 6)
