"""What a flying robot passes over and lands on, from the ways of its lowest points (m)."""

from dataclasses import dataclass

import numpy as np

from jumpcad.mechanism.linkage import Complex
from jumpcad.transforms import Array


@dataclass(frozen=True)
class Obstacles:
    """The highest thin bar that a robot passes over and the highest step that it lands on; 0 where there is none.

    Their distances are from the nose of the standing robot.
    """

    clears_bar_mm: float = 0.0
    bar_distance_mm: float = 0.0
    lands_on_mm: float = 0.0
    step_distance_mm: float = 0.0


def obstacles(bottoms_m: Complex, centre_m: Array, nose_m: float) -> Obstacles:
    """Return what a flight passes over and lands on.

    Parameters
    ----------
    bottoms_m
        Lowest points of the robot's parts, x + iz (n, parts), at n moments up to the touchdown.
    centre_m
        Where the centre of mass is along the way (n,).
    nose_m
        Where the standing robot ends in front: no obstacle is nearer.

    Notes
    -----
    All parts have passed a bar by the touchdown. The edge of a step lies below whatever passes it while the robot
    rises, and before the centre of mass when the robot, falling, comes down to its height.
    """
    if len(bottoms_m) < 2 or not np.ptp(bottoms_m.real, axis=0).any():  # straight up: over nothing
        return Obstacles()
    lowest, width = bottoms_m.imag.min(axis=1), 1.5 * float(np.abs(np.diff(bottoms_m.real, axis=0)).max())
    apex, first = int(np.argmax(lowest)), float(bottoms_m.real.min())
    bins = ((bottoms_m.real - first) / width).astype(int)
    whole, rising = (np.full(bins.max() + 1, np.inf) for _ in range(2))
    np.minimum.at(whole, bins, bottoms_m.imag)
    np.minimum.at(rising, bins[: apex + 1], bottoms_m.imag[: apex + 1])
    place = first + width * (np.arange(len(whole)) + 0.5)
    passed = (place > nose_m) & (place < bottoms_m[-1].real.min()) & np.isfinite(whole)
    bar = int(np.argmax(np.where(passed, whole, -np.inf)))
    bar_m = float(whole[bar]) if passed[bar] else 0.0
    over = np.where(place > nose_m, rising, -np.inf)
    edges = np.maximum.accumulate(over)  # the best edge up to a place
    before = np.clip(np.searchsorted(place, centre_m[apex:]) - 1, 0, len(place) - 1)
    heights = np.minimum(lowest[apex:], edges[before])
    best = int(np.argmax(heights))
    step_m, edge = float(heights[best]), float(place[int(np.argmax(over[: before[best] + 1]))])
    found = [(bar_m, float(place[bar])), (step_m, edge)]
    figures = [(1000.0 * high, 1000.0 * (at - nose_m)) if high > 0.0 else (0.0, 0.0) for high, at in found]
    return Obstacles(*figures[0], *figures[1])
