"""The search space: each of the eight parameters free in a range, free among choices, or fixed.

Methods work in the unit cube of the free parameters. Choices are placed in it in proportion to their values.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any, Self

import numpy as np
from scipy.stats import qmc

from jumpcad.arguments import require_fields, typed
from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design
from jumpcad.errors import JumpcadError
from jumpcad.search.parameter import (
    Change,
    Kind,
    Parameter,
    changed_parameters,
    known_name,
    narrowed,
    read_change,
    several,
)
from jumpcad.transforms import Array

NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, repr=False)
class Space:
    """The part of the design space that is searched: one `Parameter` each, in the order of `PARAMETERS`."""

    parameters: tuple[Parameter, ...]

    def __repr__(self) -> str:
        return f"<Space: {', '.join(p.name for p in self.free)} free>"

    def __post_init__(self) -> None:
        require_fields(self)
        if not any(parameter.free for parameter in self.parameters):
            raise JumpcadError("all eight parameters are fixed: nothing is left to search; free at least one")

    @classmethod
    def default(cls) -> Self:
        """Return the bounds that the published study searched."""
        return cls(tuple(Parameter(name, limits.lower, limits.upper) for name, limits in SEARCH_BOUNDS.items()))

    @classmethod
    @typed
    def make(
        cls,
        fixed: Mapping[str, float] = NOTHING,
        bounds: Mapping[str, tuple[float, float]] = NOTHING,
        choices: Mapping[str, Sequence[float]] = NOTHING,
        around: Design | None = None,
        only: Iterable[str] = (),
        within_percent: float | None = None,
    ) -> Self:
        """Return the default space with changes.

        Parameters
        ----------
        fixed, bounds, choices
            By name of a parameter: its value, its lower and upper limit, its allowed values. Each parameter is in at
            most one of them.
        around
            A design that gives the values of what is not free and the middle of `within_percent`.
        only
            Names of the parameters that stay free; all others are fixed at `around`.
        within_percent
            Narrow every range to this share of its width on either side of `around`.

        Raises
        ------
        JumpcadError
            For an unknown name, a value outside of what a design can be, an empty range or nothing left free.
        """
        changes = [Change("fix", name, (value,)) for name, value in fixed.items()]
        changes += [Change("bound", name, several(name, limits)) for name, limits in bounds.items()]
        changes += [Change("choose", name, several(name, values)) for name, values in choices.items()]
        return cls._changed(changes, around, only, within_percent)

    @classmethod
    @typed
    def parse(
        cls,
        fix: Iterable[str] = (),
        bound: Iterable[str] = (),
        choose: Iterable[str] = (),
        around: Design | None = None,
        only: Iterable[str] = (),
        within_percent: float | None = None,
    ) -> Self:
        """Return the default space with changes from a command line; see `make`.

        Parameters
        ----------
        fix, bound, choose
            ``NAME=VALUE``, ``NAME=LO:HI`` and ``NAME=a,b,c``, each parameter in at most one of them.
        around, only, within_percent
            As for `make`.

        Raises
        ------
        JumpcadError
            As `make`, and for a text of another form.
        """
        texts: tuple[tuple[Kind, Iterable[str]], ...] = (("fix", fix), ("bound", bound), ("choose", choose))
        changes = [read_change(kind, text) for kind, some in texts for text in some]
        return cls._changed(changes, around, only, within_percent)

    @classmethod
    def _changed(
        cls, changes: Iterable[Change], around: Design | None, only: Iterable[str], within_percent: float | None
    ) -> Self:
        only = [known_name(name) for name in only]
        if around is None and (only or within_percent is not None):
            raise JumpcadError("to free only some parameters, or to search near a design, say around which design")
        changed = changed_parameters(changes)
        centre = dict(zip(PARAMETERS, around.to_vector(), strict=True)) if around else {}
        parameters = []
        for name, limits in SEARCH_BOUNDS.items():
            parameter = Parameter(name, limits.lower, limits.upper)
            if only and name not in only:
                parameter = Parameter(name, centre[name], centre[name])
            elif within_percent is not None:
                parameter = narrowed(parameter, centre[name], within_percent)
            parameters.append(changed.get(name, parameter))
        return cls(tuple(parameters))

    @cached_property
    def free(self) -> tuple[Parameter, ...]:
        """The parameters that the search moves."""
        return tuple(parameter for parameter in self.parameters if parameter.free)

    @property
    def dimension(self) -> int:
        """Number of free parameters."""
        return len(self.free)

    @property
    def size(self) -> float:
        """Number of different designs; infinite if a free parameter is continuous."""
        return math.prod(len(parameter.choices) or math.inf for parameter in self.free)

    def to_design(self, unit: Sequence[float] | Array) -> Design:
        """Return the design at a point (dimension,) of the unit cube."""
        return Design.from_vector(self.values(np.asarray(unit, dtype=float)[None])[0].tolist())

    def values(self, units: Array) -> Array:
        """Return the parameters (n, 8), as a design's vector has them, at points (n, dimension) of the unit cube."""
        columns = iter(units.T)
        return np.column_stack(
            [
                parameter.at(next(columns)) if parameter.free else np.full(len(units), parameter.lower)
                for parameter in self.parameters
            ]
        )

    def to_unit(self, design: Design) -> Array:
        """Return the point (dimension,) of a design; outside of the unit cube where the design is out of bounds."""
        vector = design.to_vector()
        pairs = zip(self.parameters, vector, strict=True)
        return np.array([(value - parameter.lower) / parameter.width for parameter, value in pairs if parameter.free])

    def contains(self, design: Design) -> bool:
        """Whether a design has the fixed values and lies within all ranges and choices (to 1e-9 of a range)."""
        for parameter, value in zip(self.parameters, design.to_vector(), strict=True):
            slack = 1e-9 * max(parameter.width, abs(parameter.upper))
            allowed = parameter.choices or (min(max(value, parameter.lower), parameter.upper),)
            if all(abs(value - near) > slack for near in allowed):
                return False
        return True

    def snap(self, units: Array) -> Array:
        """Return points (n, dimension) of the unit cube with every choice moved to its nearest level."""
        snapped = np.clip(units, 0.0, 1.0)
        for column, parameter in enumerate(self.free):
            if parameter.choices:
                levels = np.asarray(parameter.levels)
                nearest = np.abs(snapped[:, column, None] - levels).argmin(axis=1)
                snapped[:, column] = levels[nearest]
        return snapped

    def spread(self, count: int, generator: np.random.Generator) -> Array:
        """Return `count` scrambled Sobol points (count, dimension) of the unit cube."""
        power = max(0, math.ceil(math.log2(max(count, 1))))
        return self.snap(qmc.Sobol(self.dimension, seed=generator).random_base2(power)[:count])

    @classmethod
    def from_record(cls, record: Mapping[str, Mapping[str, Any]]) -> Self:
        """Return the space that `describe` described."""
        parameters = []
        for name, part in record.items():
            choices = tuple(part.get("choices", ()))
            lower = part.get("lower", part.get("fixed", min(choices, default=0.0)))
            upper = part.get("upper", part.get("fixed", max(choices, default=0.0)))
            parameters.append(Parameter(name, lower, upper, choices))
        return cls(tuple(parameters))

    def describe(self) -> dict[str, Any]:
        """Return the space as plain data, as the study file keeps it."""
        return {parameter.name: parameter.describe() for parameter in self.parameters}
