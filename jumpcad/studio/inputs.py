"""Inputs of the page: ends and steps of sliders; what happens when a person changes one, and not the program."""

import math
from collections.abc import Callable
from typing import Any

from jumpcad.design import SEARCH_BOUNDS, limits_of

WIDER = 0.5
"""How far sliders extend beyond the bounds of the search, over the bounds' distance."""


def when_changed(handle: Any, act: Callable[[], object]) -> None:
    """Call a function whenever an input of viser is changed in a browser."""

    def changed(event: Any) -> None:
        if event.client is not None:
            act()

    handle.on_update(changed)


def slider_ends(key: str, value: float) -> tuple[float, float]:
    """Return the ends of a parameter's slider: the search's bounds, widened, within what a design may be."""
    bounds, (lowest, highest) = SEARCH_BOUNDS[key], limits_of(key)
    more = WIDER * (bounds.upper - bounds.lower)
    low = max(lowest, min(bounds.lower - more, value))
    high = min(highest, max(bounds.upper + more, value))
    return round(low, 4), round(high, 4)


def slider_step(span: float) -> float:
    """Return a slider's step: a power of ten, at most a 500th of the slider's range."""
    return min(1.0, 10.0 ** math.floor(math.log10(span / 500.0)))
