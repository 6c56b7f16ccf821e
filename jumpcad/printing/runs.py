"""Runs of layers that are alike: where a part's cross-section stays the same, or changes steadily."""

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jumpcad.solids.slab import SMALLEST_AREA_MM2
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
