"""Can every part be printed in its orientation? Bed, walls, holes, pins, overhangs, bridges, one closed solid (mm).

A stack is checked by its flat regions, anything else by sections through its solid and by its mesh. Each finding is
for all parts, names the worst one, and has its margin.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np
from manifold3d import CrossSection, JoinType

from jumpcad.dimensions import OVERHANG_LINES
from jumpcad.findings import Basis, Finding, Remedy, at_least, at_most, higher, limit, lower
from jumpcad.parts.part import Drawing
from jumpcad.robot.robot import Robot
from jumpcad.solids.outline import Region, box_around, grown, hull, union
from jumpcad.solids.stack import Stack
from jumpcad.solids.stl import faults, write_stl
from jumpcad.transforms import Trimesh
from jumpcad.workshop import Fits, Process

HALVINGS = 7
"""Steps in the search for a width: to 1 % of the range."""
SECTION_SPACING_MM = 1.0
"""Distance between sections through solids that are not stacks."""
SMALLEST_PIECE_MM2 = 0.05
"""Facets of circles on top of each other leave less than this."""
TOUCH_MM = 0.05
ROUND_OFF_MM = 0.02
"""By how much polygons can reduce a width."""
WALL_LINES = 2.0
"""Printed lines of the thinnest wall."""
MINIMA = ("wall_min_mm", "hole_min_mm", "pin_min_mm")
"""Fits that say what a printer can just print."""
PRACTICE = "practice of desktop printing: templates/workshops/default.toml"
BASIS = {
    "bed_fit": Basis(
        "min(bed - part's size) over x, y, z ≥ 0 (mm), along its sides or turned about z",
        "geometry; printer's data sheet",
    ),
    "walls": Basis(
        "width from which opening a section removes more than corners ≥ larger of fits.wall_min_mm and "
        f"{WALL_LINES:g}·process.line_width_mm (mm), layers taller than it",
        f"{PRACTICE}; two lines: one alone comes loose (judgement)",
    ),
    "holes": Basis(
        "width at which a hole closes ≥ smaller of fits.hole_min_mm and fits.m2_tap_mm (mm)", f"{PRACTICE}; ISO 2306"
    ),
    "pins": Basis(
        "width at which the outline of a column vanishes ≥ fits.pin_min_mm (mm), columns taller than it whose longest "
        "side is less than three times it",
        PRACTICE,
    ),
    "overhangs": Basis(
        "reach over air of what is held on one side ≤ 2·process.line_width_mm (mm), undersides flatter than "
        "fits.overhang_deg",
        f"{PRACTICE}; two printed lines: judgement",
    ),
    "bridges": Basis("width over air of what is held on more sides ≤ fits.bridge_mm (mm)", PRACTICE),
    "solid": Basis(
        "faults of the re-read STL file = 0: open edges, inside out, volume, pieces",
        "definition of a printable solid; trimesh",
    ),
}

Fails = Callable[[Region, float], bool]
"""Tells whether something in a region is narrower than a width (mm)."""


def bed_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `bed_fit`: every part within the printer's bed, parallel to it or turned."""
    bed = robot.workshop.printer.bed_mm
    fitted = ((part.fit_to_bed(bed).margin_mm, part) for part in robot.parts)
    margin, part = min(fitted, key=lambda item: item[0])
    size = np.ptp(part.shape.bounds_mm, axis=0)
    yield limit(
        "bed_fit", margin, "mm",
        f"{part.name}, {size[0]:.0f} x {size[1]:.0f} x {size[2]:.0f} mm, on a bed of "
        f"{bed[0]:g} x {bed[1]:g} x {bed[2]:g} mm",
        ("a larger printer", *lower("carrying_link_mm")),
    )  # fmt: skip


def printability_findings(robot: Robot) -> list[Finding]:
    """Return the findings that need outlines and meshes: walls, holes, pins, overhangs, bridges, solid."""
    fits, process = robot.workshop.fits, robot.workshop.process
    wall_min = max(fits.wall_min_mm, WALL_LINES * process.line_width_mm)
    regions = [(drawing.name, *tall) for drawing in robot.parts for tall in _tall_regions(drawing, wall_min)]
    hole_min = min(fits.hole_min_mm, fits.m2_tap_mm)
    columns = [(name, height, piece) for name, height, region in regions for piece in region.decompose()]
    slender = [
        (name, piece)
        for name, height, piece in columns
        if height > fits.pin_min_mm and _longest_mm(piece) < 3.0 * fits.pin_min_mm  # longer ones are walls
    ]
    flat = [(name, region) for name, _, region in regions]
    finer = "a finer nozzle with its own fits"
    less = {key: (finer, *lower(f"fits.{key}", note="if your printer prints it")) for key in MINIMA}
    undersides = [(drawing.name, *side) for drawing in robot.parts for side in _undersides(drawing, fits, process)]
    reaches = [(size, name) for name, bridge, size in undersides if not bridge]
    spans = [(size, name) for name, bridge, size in undersides if bridge]
    free, wider = OVERHANG_LINES * process.line_width_mm, higher("fits.bridge_mm", note="if possible")
    return [
        _narrowest("walls", "wall", flat, _thin_wall, wall_min, less["wall_min_mm"]),
        _narrowest("holes", "hole", flat, partial(_narrow, -1.0), hole_min, (*less["hole_min_mm"], "drill it")),
        _narrowest("pins", "column", slender, partial(_narrow, 1.0), fits.pin_min_mm, less["pin_min_mm"]),
        _largest("overhangs", "overhang", reaches, free, "turn the part over, or use support"),
        _largest("bridges", "bridge", spans, fits.bridge_mm, ("use support", *wider)),
        *_solid_findings(robot.parts),
    ]


def _narrowest(
    name: str, what: str, regions: Sequence[tuple[str, Region]], fails: Fails, least_mm: float, ways: Remedy
) -> Finding:
    """Return the finding of the narrowest thing in named regions, looked for up to twice the least width.

    A short wall may fail at a width and not at twice as much; the least width itself is tried first, on all of them.
    """
    kept = not any(fails(region, least_mm) for _, region in regions)
    least_found, worst, where = (least_mm, 2.0 * least_mm, "") if kept else (0.0, least_mm, "")
    for part, region in regions:
        if not fails(region, worst):
            continue
        low, high = least_found, worst
        for _ in range(HALVINGS):
            middle = (low + high) / 2.0
            low, high = (low, middle) if fails(region, middle) else (middle, high)
        worst, where = high if kept else low, part
    found = f"the narrowest {what} is {worst:.2f} mm, in {where}" if where else f"no {what} is under {worst:.2f} mm"
    message = f"{found}; {least_mm:g} mm are needed"
    if not where:  # known only to be wider than the range of the search
        return limit(name, worst - least_mm, "mm", message, ways, allowed=least_mm)
    return at_least(name, worst, least_mm, "mm", message, ways)


def _largest(name: str, what: str, sizes: Sequence[tuple[float, str]], most_mm: float, ways: Remedy) -> Finding:
    """Return the finding of the largest of named sizes."""
    worst, where = max(sizes, default=(0.0, ""))
    found = f"the longest {what} is {worst:.2f} mm, in {where}" if where else f"no part has any {what}"
    return at_most(name, worst, most_mm, "mm", f"{found}; {most_mm:g} mm print without support", ways)


def _tall_regions(drawing: Drawing, least_mm: float) -> Iterator[tuple[float, Region]]:
    """Yield sections with the height over which they stay the same; lower ones (engravings, chamfers) are left out."""
    if isinstance(drawing.shape, Stack):
        for slab in drawing.shape.slabs:
            if slab.height_mm >= least_mm:
                yield slab.height_mm, slab.region
        return
    top = float(drawing.shape.bounds_mm[1, 2])
    for z in np.arange(SECTION_SPACING_MM, top - 0.5 * SECTION_SPACING_MM, SECTION_SPACING_MM):
        yield SECTION_SPACING_MM, drawing.solid.slice(float(z))


def _thin_wall(region: Region, width_mm: float) -> bool:
    """Tell whether opening a region by a width removes more than corners and the tips of teeth."""
    half = width_mm / 2.0 - ROUND_OFF_MM
    opened = region.offset(-half, JoinType.Miter).offset(half + ROUND_OFF_MM, JoinType.Miter)
    return any(piece.area() > 0.5 * width_mm**2 for piece in (region - opened).decompose())


def _vanishes(region: Region, width_mm: float) -> bool:
    return bool(region.offset(ROUND_OFF_MM - width_mm / 2.0, JoinType.Miter).is_empty())


def _narrow(sign: float, region: Region, width_mm: float) -> bool:
    """Tell whether a region's outline, holes filled (sign +1), or one of its holes (-1) is narrower than a width."""
    return any(_vanishes(contour, width_mm) for contour in _contours(region, sign))


def _contours(region: Region, sign: float) -> Iterator[Region]:
    """Yield a region's outer contours (sign +1) or its holes (-1) as filled regions."""
    for contour in region.to_polygons():
        x, y = np.asarray(contour).T
        if sign * (x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0:
            yield CrossSection([contour if sign > 0 else contour[::-1]])


def _undersides(drawing: Drawing, fits: Fits, process: Process) -> Iterator[tuple[bool, float]]:
    """Yield undersides over air: whether held on more than one side (a bridge), and how far they span (mm).

    Those of a stack that are surely shorter than the longest of their kind before them are left out.
    """
    angle = math.radians(fits.overhang_deg)
    if not isinstance(drawing.shape, Stack):
        yield from _mesh_undersides(drawing.mesh, angle)
        return
    leaning = process.layer_height_mm * math.tan(angle) + ROUND_OFF_MM
    slabs, longest = drawing.shape.slabs, {False: 0.0, True: 0.0}
    for below, above in itertools.pairwise(slabs):
        over = above.region - below.region
        if over.area() < SMALLEST_PIECE_MM2:
            continue
        carried = grown(below.region, leaning)
        if (over - carried).area() < SMALLEST_PIECE_MM2:
            continue
        for ledge in over.decompose():
            if (ledge - carried).area() < SMALLEST_PIECE_MM2:
                continue
            held = (grown(ledge, TOUCH_MM) ^ below.region).decompose()
            ring = any(True for piece in held for _ in _contours(piece, -1.0))
            inside = (ledge - union(_contours(below.region, 1.0))).is_empty()
            # such as the roof of a socket that is open at one end
            between = (ledge - grown(hull(held), TOUCH_MM)).is_empty()
            bridge, top = len(held) > 1 or (ring and inside) or between, _longest_mm(ledge)
            near = below.region ^ box_around(ledge, 2.0 * top)
            holds = partial(_vanishes, ledge) if bridge else partial(_covered, ledge, near)
            least = _least(holds, top, longest[bridge])
            if least is not None:
                longest[bridge] = max(longest[bridge], least)
                yield bridge, least


def _covered(ledge: Region, below: Region, reach_mm: float) -> bool:
    return bool((ledge - grown(below, reach_mm)).is_empty())


def _longest_mm(region: Region) -> float:
    low_x, low_y, high_x, high_y = region.bounds()
    return math.hypot(high_x - low_x, high_y - low_y)


def _least(holds: Callable[[float], bool], top_mm: float, longest_mm: float) -> float | None:
    """Return the least length up to `top_mm` from which on something holds; None where it is surely below another."""
    low, high, halvings = 0.0, top_mm, HALVINGS + 3
    surely = longest_mm - top_mm / 2**halvings
    if surely >= top_mm or (surely > 0.0 and holds(surely)):
        return None
    for _ in range(halvings):
        middle = (low + high) / 2.0
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


def _mesh_undersides(mesh: Trimesh, angle_rad: float) -> Iterator[tuple[bool, float]]:
    """Yield a mesh's undersides; level ones count as bridges across their narrow side."""
    import trimesh

    steep = -mesh.face_normals[:, 2] > math.sin(angle_rad) + 1e-3
    hangs = steep & (mesh.triangles_center[:, 2] > mesh.bounds[0, 2] + TOUCH_MM)
    faces = np.flatnonzero(hangs)
    adjacency = mesh.face_adjacency[hangs[mesh.face_adjacency].all(axis=1)]
    for patch in trimesh.graph.connected_components(adjacency, nodes=faces):
        flat = mesh.triangles[patch][:, :, :2].reshape(-1, 2)
        _, sizes = trimesh.bounds.oriented_bounds_2D(flat)
        yield bool((mesh.face_normals[patch, 2] < -0.99).all()), float(min(sizes))


def _solid_findings(drawings: Sequence[Drawing]) -> list[Finding]:
    """Return `solid`: what keeps a part's file from being one closed solid."""
    broken = [(drawing.name, found) for drawing in drawings if (found := faults(write_stl(drawing.mesh)))]
    remedy = "change the dimension that thins the part"
    if not broken:
        return [at_most("solid", 0, 0, "faults", "every part's file is one closed solid", remedy)]
    return [at_most("solid", len(found), 0, "faults", f"{name}: {', '.join(found)}", remedy) for name, found in broken]
