"""The search space: each of the eight parameters free in a range, free among choices, or fixed.

Methods work in the unit cube of the free parameters. Choices are placed in it in proportion to their values.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal, Self

import numpy as np
from scipy.stats import qmc

from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import described, shown
from jumpcad.transforms import Array

Kind = Literal["fix", "bound", "choose"]
FORMS: dict[Kind, tuple[str, str]] = {"fix": ("VALUE", ""), "bound": ("LO:HI", ":"), "choose": ("a,b,c", ",")}
"""Of a change on the command line: what follows `NAME=`, and what separates its numbers."""
NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Parameter:
    """What a search may do with one parameter, in the parameter's own unit.

    ``lower == upper`` means fixed; ``choices``, sorted, lists the only values allowed.
    """

    name: str
    lower: float
    upper: float
    choices: tuple[float, ...] = ()

    @property
    def free(self) -> bool:
        """Whether the search may move it."""
        return self.lower < self.upper

    @property
    def width(self) -> float:
        """Width of its range."""
        return self.upper - self.lower

    @property
    def levels(self) -> tuple[float, ...]:
        """Places of the choices in the unit interval."""
        return tuple((choice - self.lower) / self.width for choice in self.choices)

    def at(self, unit: float) -> float:
        """Return the value at a place in the unit interval; for choices the nearest one."""
        value = min(max(self.lower + unit * self.width, self.lower), self.upper)
        return min(self.choices, key=lambda choice: abs(choice - value)) if self.choices else value

    def describe(self) -> dict[str, Any]:
        """Return the range, the choices or the fixed value as plain data."""
        if not self.free:
            return {"fixed": self.lower}
        return {"choices": list(self.choices)} if self.choices else {"lower": self.lower, "upper": self.upper}


@dataclass(frozen=True)
class Change:
    """What a user asks for one parameter: its value, its two bounds, or its choices."""

    kind: Kind
    name: str
    values: tuple[float, ...]


@dataclass(frozen=True, repr=False)
class Space:
    """The part of the design space that is searched: one `Parameter` each, in the order of `PARAMETERS`."""

    parameters: tuple[Parameter, ...]

    def __repr__(self) -> str:
        return f"<Space: {', '.join(p.name for p in self.free)} free>"

    def __post_init__(self) -> None:
        if not any(parameter.free for parameter in self.parameters):
            raise JumpcadError("all eight parameters are fixed: nothing is left to search; free at least one")

    @classmethod
    def default(cls) -> Self:
        """Return the bounds that the published study searched."""
        return cls(tuple(Parameter(name, limits.lower, limits.upper) for name, limits in SEARCH_BOUNDS.items()))

    @classmethod
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
        changes += [Change("bound", name, _several(name, limits)) for name, limits in bounds.items()]
        changes += [Change("choose", name, _several(name, values)) for name, values in choices.items()]
        return cls._changed(changes, around, only, within_percent)

    @classmethod
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
        changes = [_read(kind, text) for kind, some in texts for text in some]
        return cls._changed(changes, around, only, within_percent)

    @classmethod
    def _changed(
        cls, changes: Iterable[Change], around: Design | None, only: Iterable[str], within_percent: float | None
    ) -> Self:
        only = [_known(name) for name in only]
        if around is None and (only or within_percent is not None):
            raise JumpcadError("to free only some parameters, or to search near a design, say around which design")
        changed = _parameters(changes)
        centre = dict(zip(PARAMETERS, around.to_vector(), strict=True)) if around else {}
        parameters = []
        for name, limits in SEARCH_BOUNDS.items():
            parameter = Parameter(name, limits.lower, limits.upper)
            if only and name not in only:
                parameter = Parameter(name, centre[name], centre[name])
            elif within_percent is not None:
                parameter = _narrowed(parameter, centre[name], within_percent)
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
        places = iter(unit)
        return Design.from_vector(
            [parameter.at(float(next(places))) if parameter.free else parameter.lower for parameter in self.parameters]
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


def physical_limits(name: str) -> tuple[float, float]:
    """Return the least and the greatest value that a design can have in a parameter."""
    limits = Design.model_fields[name].metadata
    lower = next(limit.ge for limit in limits if hasattr(limit, "ge"))
    upper = next(limit.le for limit in limits if hasattr(limit, "le"))
    return float(lower), float(upper)


def _read(kind: Kind, text: str) -> Change:
    """Return the change that a text of the command line stands for."""
    form, separator = FORMS[kind]
    name, equals, value = text.partition("=")
    if not equals:
        raise JumpcadError(f"{text!r} is not of the form NAME={form}")
    name = _known(name.strip())
    values = [_number(item, text) for item in (value.split(separator) if separator else [value])]
    if kind == "bound" and len(values) != 2:
        raise JumpcadError(f"{text!r} is not of the form NAME=LO:HI")
    return Change(kind, name, tuple(values))


def _number(text: str, whole: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise JumpcadError(f"{whole!r}: {text.strip()!r} is not a number") from None


def _parameters(changes: Iterable[Change]) -> dict[str, Parameter]:
    """Return the changed parameters by name."""
    changed: dict[str, Parameter] = {}
    for change in changes:
        name = _known(change.name)
        if name in changed:
            raise JumpcadError(f"{name} is given twice: fix it, bound it or choose its values, once")
        changed[name] = _parameter(change)
    return changed


def _parameter(change: Change) -> Parameter:
    name, values = change.name, [_possible(change.name, value) for value in change.values]
    if change.kind == "bound":
        if len(values) != 2:
            raise JumpcadError(f"{name} has {len(values)} bounds; give the lower and the upper one")
        lower, upper = values
        if lower >= upper:
            raise JumpcadError(
                f"{name} = {lower:g}:{upper:g} is an empty range: the first must be less than the second"
            )
        return Parameter(name, lower, upper)
    choices = tuple(sorted(set(values)))
    if not choices:
        raise JumpcadError(f"{name} has no values to choose from; give at least one")
    return Parameter(name, choices[0], choices[-1], choices if len(choices) > 1 else ())


def _several(name: str, values: Any) -> tuple[Any, ...]:
    """Return the numbers that a caller gives for one parameter."""
    try:
        return tuple(values)
    except TypeError:
        raise JumpcadError(f"{name} = {described(values)}: give several numbers, or fix the parameter") from None


def _possible(name: str, value: Any) -> float:
    """Return a value that a design can have.

    Raises
    ------
    JumpcadError
        If it is no number, or no design can have it.
    """
    if not isinstance(value, int | float | np.integer | np.floating):
        raise JumpcadError(f"{name} = {described(value)} is not a number")
    lower, upper = physical_limits(name)
    if not lower <= value <= upper:
        number = f"{value:g}" if isinstance(value, float) else shown(value)
        raise JumpcadError(f"{name} = {number} is outside {lower:g}…{upper:g}: no design can have it")
    return float(value)


def _known(name: str) -> str:
    if name not in PARAMETERS:
        hint = did_you_mean(name, PARAMETERS) or f"; the parameters are {', '.join(PARAMETERS)}"
        raise JumpcadError(f"{name!r} is not a parameter of a design{hint}")
    return name


def _narrowed(parameter: Parameter, centre: float, percent: float) -> Parameter:
    if not 0 < percent <= 100:
        raise JumpcadError(f"within {percent:g} % is outside 0…100 %: a share of each parameter's range")
    reach = parameter.width * percent / 100.0
    lower, upper = physical_limits(parameter.name)
    return replace(parameter, lower=max(lower, centre - reach), upper=min(upper, centre + reach))
