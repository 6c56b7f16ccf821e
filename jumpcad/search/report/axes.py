"""Two axes as SVG inside a page: scales, grid, ticks and titles. Colours and letters are those of the page's style."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import MaxNLocator

from jumpcad.search.report.text import escape_html

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

    def dots(self, places: Iterable[tuple[float, float]], kind: str) -> str:
        """Return a path that has a dot at each pair of values."""
        drawn = "".join(f"M{self.x(x):.1f} {self.y(y):.1f}h0" for x, y in places)
        return f'<path class="dots {kind}" d="{drawn}" />'

    def steps(self, places: Sequence[tuple[float, float]], kind: str) -> str:
        """Return a step function: level from each pair of values to the next, and to the end of the axis."""
        if not places:
            return ""
        (x, y), *others = places
        drawn = f"M{self.x(x):.1f} {self.y(y):.1f}" + "".join(f"H{self.x(u):.1f}V{self.y(v):.1f}" for u, v in others)
        end = self.width - self.right if places[-1][0] >= x else self.x(self.across[0])
        return f'<path class="{kind}" d="{drawn}H{end:g}" />'

    def drawn(self, across: str, up: str) -> list[str]:
        """Return grid, ticks and titles."""
        right, foot = self.width - self.right, self.height - self.foot
        lines = []
        for value in self.across[2]:
            label = f"{value + self.first:g}"
            lines.append(f'<path class="grid" d="M{self.x(value):.1f} {self.top:g}V{foot:g}" />')
            lines.append(
                f'<text x="{self.x(value):.1f}" y="{foot + 22:g}" text-anchor="middle">{escape_html(label)}</text>'
            )
        for value in self.up[2]:
            lines.append(f'<path class="grid" d="M{self.left:g} {self.y(value):.1f}H{right:g}" />')
            lines.append(f'<text x="{self.left - 7:g}" y="{self.y(value) + 5:.1f}" text-anchor="end">{value:g}</text>')
        middle = (self.left + right) / 2.0
        lines.append(f'<text x="{middle:g}" y="{self.height - 10:g}" text-anchor="middle">{escape_html(across)}</text>')
        lines.append(f'<text x="4" y="22">{escape_html(up)}</text>')
        return lines


def evenly(count: int, most: int) -> list[int]:
    """Return at most `most` of the indices of `count` things, evenly chosen, the first and the last among them."""
    return [round(place) for place in np.linspace(0, count - 1, min(count, most)).tolist()]
