"""One parameter of a search: free in a range, free among choices, or fixed; and changes of it that users ask for."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from jumpcad.design import PARAMETERS, Design
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import described, shown
from jumpcad.transforms import Array

Kind = Literal["fix", "bound", "choose"]
FORMS: dict[Kind, tuple[str, str]] = {"fix": ("VALUE", ""), "bound": ("LO:HI", ":"), "choose": ("a,b,c", ",")}
"""Of a change on the command line: what follows `NAME=`, and what separates its numbers."""


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

    def at(self, units: npt.ArrayLike) -> Array:
        """Return the values (n,) at places (n,) in the unit interval; of choices, the nearest ones."""
        values = np.clip(self.lower + np.asarray(units) * self.width, self.lower, self.upper)
        if not self.choices:
            return values
        choices = np.array(self.choices)
        nearest: Array = choices[np.abs(values[:, None] - choices).argmin(axis=1)]
        return nearest

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


def physical_limits(name: str) -> tuple[float, float]:
    """Return the least and the greatest value that a design can have in a parameter."""
    limits = Design.model_fields[name].metadata
    lower = next(limit.ge for limit in limits if hasattr(limit, "ge"))
    upper = next(limit.le for limit in limits if hasattr(limit, "le"))
    return float(lower), float(upper)


def read_change(kind: Kind, text: str) -> Change:
    """Return the change that a text of the command line stands for."""
    form, separator = FORMS[kind]
    name, equals, value = text.partition("=")
    if not equals:
        raise JumpcadError(f"{text!r} is not of the form NAME={form}")
    name = known_name(name.strip())
    values = [_number(item, text) for item in (value.split(separator) if separator else [value])]
    if kind == "bound" and len(values) != 2:
        raise JumpcadError(f"{text!r} is not of the form NAME=LO:HI")
    return Change(kind, name, tuple(values))


def _number(text: str, whole: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise JumpcadError(f"{whole!r}: {text.strip()!r} is not a number") from None


def changed_parameters(changes: Iterable[Change]) -> dict[str, Parameter]:
    """Return the changed parameters by name."""
    changed: dict[str, Parameter] = {}
    for change in changes:
        name = known_name(change.name)
        if name in changed:
            raise JumpcadError(f"{name} is given twice: fix it, bound it or choose its values, only once")
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


def several(name: str, values: Any) -> tuple[Any, ...]:
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
        If it is not a number, or no design can have it.
    """
    if not isinstance(value, int | float | np.integer | np.floating):
        raise JumpcadError(f"{name} = {described(value)} is not a number")
    lower, upper = physical_limits(name)
    if not lower <= value <= upper:
        number = f"{value:g}" if isinstance(value, float) else shown(value)
        raise JumpcadError(f"{name} = {number} is outside {lower:g}…{upper:g}: no design can have it")
    return float(value)


def known_name(name: str) -> str:
    """Return the name of a parameter; raises `JumpcadError` for any other."""
    if name not in PARAMETERS:
        hint = did_you_mean(str(name), PARAMETERS) or f"; the parameters are {', '.join(PARAMETERS)}"
        raise JumpcadError(f"{shown(name)} is not a parameter of a design{hint}")
    return name


def narrowed(parameter: Parameter, centre: float, percent: float) -> Parameter:
    """Return a parameter with its range narrowed to a share (%) of its width on either side of a centre."""
    if not 0 < percent <= 100:
        raise JumpcadError(f"within {percent:g} % is outside 0…100 %: a share of each parameter's range")
    reach = parameter.width * percent / 100.0
    lower, upper = physical_limits(parameter.name)
    return replace(parameter, lower=max(lower, centre - reach), upper=min(upper, centre + reach))
