"""The closed surface of a stack, built without 3D booleans.

Faces of a 3D union may lie nanometres apart; rounding to 32 bits in a file then opens the surface. Here every
corner lies on a grid that 32-bit floats hold exactly, and all outlines of a stack are cut at each other's corners and
crossings first (iterated snap rounding, Hobby 1999). Walls and caps then have the same edges, so that the surface is
closed, before and after writing. docs/decisions/skin.md compares this with 3D booleans.
"""

from collections import defaultdict
from collections.abc import Sequence

import manifold3d
import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

GRID_MM = 2.0**-10  # about a micrometre; 32-bit floats hold its multiples exactly up to 16 m
SHORT_STEPS = 4  # edges up to this many grid steps long become points
MAX_ROUNDS = 50  # three or four are usual


def skin(heights_mm: Sequence[tuple[float, float]], contours_mm: Sequence[Sequence[Floats]]) -> tuple[Floats, Ints]:
    """Return vertices (n, 3) in mm and triangles (m, 3) of slabs on top of each other.

    Bottom and top of the slabs ascend; they may touch but not overlap. Each slab has closed contours (k, 2): outlines
    counter-clockwise, holes clockwise.
    """
    points, edges, signs = _conforming(*_chains(contours_mm))
    levels = sorted({z for pair in heights_mm for z in pair})
    count = len(points)
    triangles: list[Ints] = []
    for slab, (z0, z1) in enumerate(heights_mm):
        low, high = count * levels.index(z0), count * levels.index(z1)
        start, end = _directed(edges, signs[:, slab])
        triangles += [
            np.column_stack([start + low, end + low, end + high]),
            np.column_stack([start + low, end + high, start + high]),
        ]
    nothing = np.zeros(len(edges), dtype=np.int64)
    for number, z in enumerate(levels):
        below = next((signs[:, slab] for slab, pair in enumerate(heights_mm) if pair[1] == z), nothing)
        above = next((signs[:, slab] for slab, pair in enumerate(heights_mm) if pair[0] == z), nothing)
        triangles.append(_difference(points, edges, below, above) + count * number)
        triangles.append(_difference(points, edges, above, below)[:, ::-1] + count * number)
    faces = np.concatenate(triangles)
    flat = points * GRID_MM
    vertices = np.concatenate([np.column_stack([flat, np.full(count, z)]) for z in levels])
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)


def _chains(contours_mm: Sequence[Sequence[Floats]]) -> tuple[Ints, Ints, Ints]:
    """Return grid points (n, 2), edges (m, 2) and for each edge and slab how often the slab's outline runs along it."""
    owner, starts, ends = [], [], []
    for slab, contours in enumerate(contours_mm):
        for contour in contours:
            snapped = np.rint(contour / GRID_MM).astype(np.int64)
            starts.append(snapped)
            ends.append(np.roll(snapped, -1, axis=0))
            owner.append(np.full(len(snapped), slab))
    points, index = _unique(np.concatenate([*starts, *ends]))
    edges = index.reshape(2, -1).T
    signs = np.zeros((len(edges), len(contours_mm)), dtype=np.int64)
    signs[np.arange(len(edges)), np.concatenate(owner)] = 1
    return (points, *_merged(edges, signs))


def _unique(pairs: Ints) -> tuple[Ints, Ints]:
    """Return every pair (n, 2) of 32-bit numbers once, in order, and for each of them where it is in that list."""
    keys, index = np.unique((pairs[:, 0] << 32) + pairs[:, 1], return_inverse=True)
    first = (keys + (1 << 31)) >> 32
    return np.column_stack([first, keys - (first << 32)]), index


def _merged(edges: Ints, signs: Ints) -> tuple[Ints, Ints]:
    """Return every edge once, from its lower to its higher point; opposite runs cancel."""
    backwards = edges[:, 0] > edges[:, 1]
    signs = np.where(backwards[:, None], -signs, signs)
    unique, index = _unique(np.sort(edges, axis=1))
    total = np.zeros((len(unique), signs.shape[1]), dtype=np.int64)
    np.add.at(total, index, signs)
    kept = total.any(axis=1) & (unique[:, 0] != unique[:, 1])
    return unique[kept], total[kept]


def _conforming(points: Ints, edges: Ints, signs: Ints) -> tuple[Ints, Ints, Ints]:
    """Cut edges until they meet in common end points only, and no point lies within half a grid step of an edge.

    Edges of a few grid steps become a point: where two outlines cross, rounding can leave one at which four faces of
    the surface would meet.
    """
    for _ in range(MAX_ROUNDS):
        points = np.concatenate([points, _crossings(points, edges)])
        points, index = _unique(points)
        edges = index[edges]
        hit_edges, hit_points = _hits(points, edges)
        if len(hit_edges):
            edges, signs = _merged(*_cut(points, edges, signs, hit_edges, hit_points))
            continue
        run = points[edges[:, 1]] - points[edges[:, 0]]
        short = edges[(run**2).sum(axis=1) <= SHORT_STEPS**2]
        if not len(short):
            return points, edges, signs
        target = np.arange(len(points))
        for first, second in short.tolist():
            target[second] = target[first]
        edges, signs = _merged(target[edges], signs)
        used, edges = np.unique(edges, return_inverse=True)
        points, edges = points[used], edges.reshape(-1, 2)
    raise RuntimeError(f"outlines do not converge on their grid in {MAX_ROUNDS} rounds")


def _within(keys: Ints, low: Ints, high: Ints) -> tuple[Ints, Ints]:
    """Return all pairs (interval, key) with low ≤ key ≤ high."""
    order = np.argsort(keys, kind="stable")
    first = np.searchsorted(keys[order], low, side="left")
    counts = np.maximum(np.searchsorted(keys[order], high, side="right") - first, 0)
    intervals = np.repeat(np.arange(len(low)), counts)
    steps = np.arange(len(intervals)) - np.repeat(np.cumsum(counts) - counts, counts)
    return intervals, order[np.repeat(first, counts) + steps]


def _crossings(points: Ints, edges: Ints) -> Ints:
    """Return the grid points (k, 2) nearest to where two edges cross inside both."""
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    low, high = np.minimum(start, end), np.maximum(start, end)
    i, j = _within(low[:, 0], low[:, 0], high[:, 0])
    near = (i != j) & (low[i, 1] <= high[j, 1]) & (low[j, 1] <= high[i, 1])
    i, j = i[near], j[near]
    run_i, run_j, between = end[i] - start[i], end[j] - start[j], start[j] - start[i]
    turn = _cross(run_i, run_j)
    along_i, along_j = _cross(between, run_j), _cross(between, run_i)
    sign = np.sign(turn)
    inside = (turn != 0) & (sign * along_i > 0) & (sign * along_i < abs(turn))
    inside &= (sign * along_j > 0) & (sign * along_j < abs(turn))
    share = along_i[inside] / turn[inside]
    crossing = start[i][inside] + share[:, None] * run_i[inside]
    return np.asarray(np.rint(crossing), dtype=np.int64)


def _hits(points: Ints, edges: Ints) -> tuple[Ints, Ints]:
    """Return the pairs (edge, point) in which an edge passes through the grid square around a point not its own."""
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    low, high = np.minimum(start, end), np.maximum(start, end)
    edge, point = _within(points[:, 0], low[:, 0], high[:, 0])
    y = points[point, 1]
    near = (low[edge, 1] <= y) & (y <= high[edge, 1]) & (edges[edge] != point[:, None]).all(axis=1)
    edge, point = edge[near], point[near]
    run = end[edge] - start[edge]
    off = abs(_cross(run, points[point] - start[edge]))
    hit = 2 * off <= abs(run).sum(axis=1)
    return edge[hit], point[hit]


def _cut(points: Ints, edges: Ints, signs: Ints, hit_edges: Ints, hit_points: Ints) -> tuple[Ints, Ints]:
    """Return the edges led through the points that they hit, in order along each edge."""
    run = points[edges[hit_edges, 1]] - points[edges[hit_edges, 0]]
    along = ((points[hit_points] - points[edges[hit_edges, 0]]) * run).sum(axis=1)
    edge = np.concatenate([np.arange(len(edges)), hit_edges])
    start = np.concatenate([edges[:, 0], hit_points])
    position = np.concatenate([np.full(len(edges), -1), along])
    order = np.lexsort((start, position, edge))
    edge, start = edge[order], start[order]
    last = np.append(edge[1:] != edge[:-1], True)
    end = np.where(last, edges[edge, 1], np.roll(start, -1))
    return np.column_stack([start, end]), signs[edge]


def _directed(edges: Ints, sign: Ints) -> tuple[Ints, Ints]:
    """Return start and end points of the edges along which an outline runs."""
    forwards, backwards = edges[sign > 0], edges[sign < 0]
    return np.concatenate([forwards[:, 0], backwards[:, 1]]), np.concatenate([forwards[:, 1], backwards[:, 0]])


def _difference(points: Ints, edges: Ints, a: Ints, b: Ints) -> Ints:
    """Return the triangles (n, 3), counter-clockwise, that cover region a without region b."""
    alone_a, alone_b = (a != 0) & (b == 0), (b != 0) & (a == 0)
    bounds = np.where((a != 0) & (a == -b), a, 0)
    bounds[alone_a] = np.where(_inside(points, edges, edges[alone_a], b), 0, a[alone_a])
    bounds[alone_b] = np.where(_inside(points, edges, edges[alone_b], a), -b[alone_b], 0)
    if not bounds.any():
        return np.zeros((0, 3), dtype=np.int64)
    loops = _loops(points, *_directed(edges, bounds))
    triangles = manifold3d.triangulate([points[loop] * GRID_MM for loop in loops], GRID_MM / 2.0)
    return np.concatenate(loops)[np.asarray(triangles, dtype=np.int64)]


def _inside(points: Ints, edges: Ints, asked: Ints, sign: Ints) -> npt.NDArray[np.bool_]:
    """Tell which of the asked edges (k, 2) have their middle inside the region that the signed edges bound."""
    middle = points[asked].sum(axis=1)  # twice the middle, to stay with whole numbers
    start, end = (2 * points[ends] for ends in _directed(edges, sign))
    wall, point = _within(middle[:, 1], np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1]) - 1)
    upwards = np.sign(end[wall, 1] - start[wall, 1])
    right = upwards * _cross(end[wall] - start[wall], middle[point] - start[wall]) > 0
    winding = np.zeros(len(asked), dtype=np.int64)
    np.add.at(winding, point[right], upwards[right])
    return np.asarray(winding != 0)


def _loops(points: Ints, starts: Ints, ends: Ints) -> list[Ints]:
    """Return closed loops of point numbers; where several meet in a point they part so as not to cross."""
    following: dict[int, list[int]] = defaultdict(list)
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        following[start].append(end)
    loops = []
    while following:
        # a point from which only one edge starts, if there is one
        first = next((point for point, ways in following.items() if len(ways) == 1), next(iter(following)))
        loop = [first]
        while True:
            here = loop[-1]
            choices = following[here]
            chosen = 0
            if len(choices) > 1 and len(loop) > 1:
                back = points[loop[-2]] - points[here]
                ahead = (points[choices] - points[here]).T
                clockwise = (np.arctan2(back[1], back[0]) - np.arctan2(ahead[1], ahead[0])) % (2.0 * np.pi)
                chosen = int(np.argmin(clockwise))
            there = choices.pop(chosen)
            if not choices:
                del following[here]
            if there == first:
                break
            loop.append(there)
        loops.append(np.array(loop))
    return loops


def _cross(a: Ints, b: Ints) -> Ints:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
