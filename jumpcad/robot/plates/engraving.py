"""Letters engraved in a plate, where its face has room for them."""

import itertools

import numpy as np
import numpy.typing as npt
from numpy.lib.stride_tricks import sliding_window_view

from jumpcad.solids.outline import Region, contained, middle_of, rectangle, text

ENGRAVING_MM = 0.5
TEXT_HEIGHTS_MM = (4.5, 3.5)
TEXT_EDGE_MM = 0.8
"""Least margin around a label: two printed lines."""
TEXT_STEP_MM = 1.0


def letters_on(label: str, face: Region, mirrored: bool) -> Region | None:
    """Return a plate's label, or its last letter alone, at the place nearest to the pivots' line that has room for it.

    Seen from the left, x points to the left. Where nothing fits there are no letters.
    """
    low_x, low_z, high_x, high_z = face.bounds()
    x, z = np.meshgrid(np.arange(low_x, high_x, TEXT_STEP_MM), np.arange(low_z, high_z, TEXT_STEP_MM))
    places = np.column_stack([x.ravel(), z.ravel()])
    outside = ~contained(face, places).reshape(x.shape)
    order = np.lexsort((np.abs(places[:, 0]), np.abs(places[:, 1])))
    for words, height in itertools.product((label, label[-1]), TEXT_HEIGHTS_MM):
        letters = text(words, height)
        letters = letters.translate(tuple(-middle_of(letters)))
        letters = letters.mirror((1.0, 0.0)) if mirrored else letters
        low_x, low_z, high_x, high_z = letters.bounds()
        size = (high_x - low_x + 2.0 * TEXT_EDGE_MM, high_z - low_z + 2.0 * TEXT_EDGE_MM)
        box, possible = rectangle(size), _possible(outside, size)
        for place in places[order[possible[order]]]:
            if (box.translate(tuple(place)) - face).area() < 1e-6:
                return letters.translate(tuple(place))
    return None


def _possible(outside: npt.NDArray[np.bool_], size_mm: tuple[float, float]) -> npt.NDArray[np.bool_]:
    """Return around which places (n,) of a grid a box covers none that is outside; the box may still cross an edge."""
    reach_x, reach_z = (int((side / 2.0 - 1e-3) / TEXT_STEP_MM) for side in size_mm)
    padded = np.pad(outside, ((reach_z, reach_z), (reach_x, reach_x)), constant_values=True)
    covered = sliding_window_view(padded, (2 * reach_z + 1, 2 * reach_x + 1))
    return ~covered.any(axis=(2, 3)).ravel()
