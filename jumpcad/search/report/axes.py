"""Two axes of a picture in a page: scales with their ticks, and paths over them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import MaxNLocator

Scale = tuple[float, float, list[float]]
"""Lowest and highest value of an axis, and its ticks."""


def scale(values: Sequence[float], ticks: int = 6, whole: bool = False) -> Scale:
    """Return the scale of some values, with a twentieth of their reach on both sides; `whole` numbers as ticks."""
    low, high = min(values, default=0.0), max(values, default=1.0)
    reach = max(high - low, 1e-9 * max(abs(high), 1.0))
    low, high = low - 0.05 * reach, high + 0.05 * reach
    places = [round(float(tick), 12) for tick in MaxNLocator(ticks, integer=whole).tick_values(low, high)]
    return low, high, [tick for tick in places if low <= tick <= high]


@dataclass(frozen=True)
class Axes:
    """Two axes in a picture of some size; the title of `up` stands above its axis, that of `across` below."""

    across: Scale
    up: Scale
    width: float = 640.0
    height: float = 410.0
    left: float = 70.0
    right: float = 14.0
    top: float = 44.0
    foot: float = 62.0
    first: float = 0.0
    """What stands at the tick 0 of `across`."""

    def x(self, value: float) -> float:
        """Return the place of a value of `across`."""
        low, high, _ = self.across
        return self.left + (self.width - self.right - self.left) * (value - low) / (high - low)

    def y(self, value: float) -> float:
        """Return the place of a value of `up`."""
        low, high, _ = self.up
        return self.height - self.foot - (self.height - self.foot - self.top) * (value - low) / (high - low)

    def dots(self, places: Iterable[tuple[float, float]]) -> str:
        """Return the path that has a dot at each pair of values."""
        return "".join(f"M{self.x(x):.1f} {self.y(y):.1f}h0" for x, y in places)

    def steps(self, places: Sequence[tuple[float, float]]) -> str:
        """Return a step function's path: level from each pair of values to the next, and to the end of the axis."""
        if not places:
            return ""
        (x, y), *others = places
        drawn = f"M{self.x(x):.1f} {self.y(y):.1f}" + "".join(f"H{self.x(u):.1f}V{self.y(v):.1f}" for u, v in others)
        end = self.width - self.right if places[-1][0] >= x else self.x(self.across[0])
        return f"{drawn}H{end:g}"


def evenly(count: int, most: int) -> list[int]:
    """Return at most `most` of the indices of `count` things, evenly chosen, the first and the last among them."""
    return [round(place) for place in np.linspace(0, count - 1, min(count, most)).tolist()]
