"""The figures of a validated model, each with the ends of its range."""

import typing
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel

TINY = 5e-324
"""The smallest number above 0: one over it overflows."""

Place = tuple[str | int, ...]
"""Keys and places in lists that lead to a figure; `*` stands for any name of a table of tables."""


@dataclass(frozen=True)
class Range:
    """What a figure may be: from `low` to `high`; `open` where the low end is not in it, or an end is missing."""

    low: float
    high: float
    whole: bool
    open: bool

    def ends(self) -> list[float]:
        """Return both ends; of a range from 0, the smallest number above it too."""
        return [self.low, *([TINY] if self.low == 0.0 and not self.whole else []), self.high]


def figures(model: type[BaseModel], place: Place = ()) -> Iterator[tuple[Place, Range]]:
    """Yield every number in a model with its range."""
    for name, field in model.model_fields.items():
        yield from _figures(field.annotation, list(field.metadata), (*place, name))


def _figures(kind: Any, limits: list[Any], place: Place) -> Iterator[tuple[Place, Range]]:
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        more = [limit for one in inner[1:] for limit in getattr(one, "metadata", [one])]
        yield from _figures(inner[0], [*limits, *more], place)
    elif isinstance(kind, type) and issubclass(kind, BaseModel):
        yield from figures(kind, place)
    elif kind in (float, int):
        yield place, _range(limits, kind is int)
    elif origin is dict:
        yield from _figures(inner[1], [], (*place, "*"))
    elif origin is tuple:
        for number, one in enumerate(inner):
            yield from _figures(one, [], (*place, number))
    else:
        for one in inner:  # of a union
            yield from _figures(one, limits, place)


def _range(limits: list[Any], whole: bool) -> Range:
    lows = [limit.ge for limit in limits if isinstance(limit, Ge)]
    highs = [limit.le for limit in limits if isinstance(limit, Le)]
    is_open = not (lows and highs) or any(isinstance(limit, Gt | Lt) for limit in limits)
    return Range(max(lows, default=0.0), min(highs, default=0.0), whole, is_open)
