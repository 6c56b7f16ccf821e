"""One parameter of a search: free in a range, free among choices, or fixed; and the changes that users request.

A parameter is one of a design's eight, or a value of the workshop by its dotted key.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from jumpcad.design import PARAMETERS, SEARCH_BOUNDS, limits_of
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import described, shown
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop, varied, workshop_value
from jumpcad.workshop.varied import Value

Kind = Literal["fix", "bound", "choose"]
INSIDE = 0.01
"""Share of a range at which its workshop is tried, besides at its ends."""
BY_FACTORS, FACTOR = ("carrying_link_mm", "d_coef", "e_coef", "stiffness_nmm_per_deg"), 7.0
"""What a search moves by factors where its range is so many times its lower end: a step of 2 mm is none for a leg of
200 mm, and too much for one of 40 mm."""
DECIMALS = 10
"""Of the values that a search tries: what is written is then what a person would write."""
FORMS: dict[Kind, tuple[str, str]] = {"fix": ("VALUE", ""), "bound": ("LO:HI", ":"), "choose": ("a,b,c", ",")}
"""Form of a change on the command line after `NAME=`, and the separator of its values."""
WORKSHOP = "; a value of the workshop is TABLE.NAME, as in body.plate_mm"
"""What else may be changed."""


@dataclass(frozen=True)
class SearchParameter:
    """The values of one parameter in a search, in the parameter's own unit.

    ``lower == upper`` means fixed; ``choices``, sorted, are the only values allowed. If the values are names, ``names``
    lists them, and ``choices`` are their indices from 0; names have no order.
    """

    name: str
    lower: float
    upper: float
    choices: tuple[float, ...] = ()
    names: tuple[str, ...] = ()

    @classmethod
    def among(cls, name: str, values: Sequence[Value]) -> "SearchParameter":
        """Return a parameter that is fixed at one value, or free among several: all names, or all numbers."""
        names = tuple(dict.fromkeys(value for value in values if isinstance(value, str)))
        choices = tuple(map(float, range(len(names)) if names else sorted({float(value) for value in values})))
        return cls(name, choices[0], choices[-1], choices if len(choices) > 1 else (), names)

    @property
    def free(self) -> bool:
        return self.lower < self.upper

    @property
    def width(self) -> float:
        return self.upper - self.lower

    @property
    def by_factors(self) -> bool:
        """Whether equal steps in the unit interval are equal factors."""
        return self.name in BY_FACTORS and not self.choices and self.upper >= FACTOR * self.lower > 0.0

    @property
    def scale(self) -> float:
        """Width in the unit interval of what the study searched, within which steps are judged; 1 of all else."""
        if self.choices or self.name not in SEARCH_BOUNDS:
            return 1.0
        lower, upper = map(self.unit, SEARCH_BOUNDS[self.name])
        return min(1.0, upper - lower)

    def unit(self, number: float) -> float:
        """Return the position of a number in the unit interval; outside of it if it is out of bounds."""
        if self.by_factors and number > 0.0:
            return math.log(number / self.lower) / math.log(self.upper / self.lower)
        return (number - self.lower) / self.width

    @property
    def levels(self) -> tuple[float, ...]:
        """Positions of the choices in the unit interval."""
        return tuple((choice - self.lower) / self.width for choice in self.choices)

    def at(self, units: npt.ArrayLike) -> Array:
        """Return the values (n,) at positions (n,) in the unit interval; with choices, the nearest ones."""
        units = np.asarray(units)
        values = self.lower + units * self.width
        if self.by_factors:
            values = self.lower * (self.upper / self.lower) ** units
        if not self.choices:
            return np.asarray(np.clip(values.round(DECIMALS), self.lower, self.upper))
        choices = np.array(self.choices)
        return np.asarray(choices[np.abs(values[:, None] - choices).argmin(axis=1)])

    def value(self, number: float) -> Value:
        """Return the value of a number: the number itself, or the name with this index."""
        return self.names[round(number)] if self.names else float(number)

    def number(self, value: Value) -> float:
        """Return the number of a value: the value itself, or the index of a name; NaN for an unknown name."""
        if not self.names:
            return value if isinstance(value, int | float) else float("nan")
        return float(self.names.index(value)) if value in self.names else float("nan")

    def held(self, number: float) -> "SearchParameter":
        """Return the parameter fixed at one of its values."""
        return self.among(self.name, [self.value(number)])

    def narrowed(self, centre: float, percent: float, limits: tuple[float, float]) -> "SearchParameter":
        """Return the parameter within a share (%) of its width on either side of a centre, and within limits."""
        reach = self.width * percent / 100.0
        return replace(self, lower=max(limits[0], centre - reach), upper=min(limits[1], centre + reach))

    def describe(self) -> dict[str, Any]:
        """Return the range, the choices or the fixed value as plain data."""
        if not self.free:
            return {"fixed": self.value(self.lower)}
        if self.choices:
            return {"choices": [self.value(choice) for choice in self.choices]}
        return {"lower": self.lower, "upper": self.upper}

    @classmethod
    def from_record(cls, name: str, record: Mapping[str, Any]) -> "SearchParameter":
        """Return the parameter of a record that `describe` returned."""
        if "lower" in record:
            return cls(name, record["lower"], record["upper"])
        return cls.among(name, record["choices"] if "choices" in record else [record["fixed"]])


def physical_limits(name: str) -> tuple[float, float]:
    """Return the least and the largest value of a design's parameter.

    For a value of the workshop they are infinite: the workshop checks its values itself.
    """
    return limits_of(name) if name in PARAMETERS else (-math.inf, math.inf)


def read_changes(kind: Kind, texts: Iterable[str]) -> dict[str, tuple[Any, ...]]:
    """Return the values by parameter of texts such as `NAME=VALUE` from the command line."""
    form, separator = FORMS[kind]
    found: dict[str, tuple[Any, ...]] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        name, items = name.strip(), value.split(separator) if separator else [value]
        if not equals or (kind == "bound" and len(items) != 2):
            raise JumpcadError(f"{text!r} is not of the form NAME={form}")
        require_new(name, found)
        if "." in name and kind != "bound":  # of the workshop: what is a number, the workshop decides
            found[name] = tuple(item.strip() for item in items)
        else:
            found[name] = tuple(_number(item, text, name) for item in items)
    return found


def require_new(name: str, changed: Iterable[str]) -> None:
    """Require that a parameter is not among those that were changed; raises `JumpcadError`."""
    if name in changed:
        raise JumpcadError(f"{name} is given twice: fix it, bound it or choose its values, only once")


def _number(text: str, whole: str, name: str) -> float:
    try:
        return float(text)
    except ValueError:
        if "." not in name:  # a name of nothing takes no number either
            known_name(name, WORKSHOP)
        raise JumpcadError(f"{whole!r}: {text.strip()!r} is not a number") from None


def changed_parameters(
    fixed: Mapping[str, Value], bounds: Mapping[str, Any], choices: Mapping[str, Any], workshop: Workshop | None
) -> dict[str, SearchParameter]:
    """Return the parameters that are fixed, bounded or chosen, by name; see `Space.make`."""
    asked: list[tuple[Kind, str, tuple[Any, ...]]] = [("fix", name, (value,)) for name, value in fixed.items()]
    asked += [("bound", name, several(name, limits)) for name, limits in bounds.items()]
    asked += [("choose", name, several(name, values)) for name, values in choices.items()]
    changed: dict[str, SearchParameter] = {}
    for kind, name, values in asked:
        require_new(name, changed)
        changed[name] = changed_parameter(kind, name, values, workshop)
    return changed


def changed_parameter(kind: Kind, name: str, asked: Sequence[Any], workshop: Workshop | None) -> SearchParameter:
    """Return a parameter with a user's value, two bounds, or choices; values of the workshop are checked by it.

    If the workshop's own value is a whole number, the choices are the whole numbers of a range.
    """
    if name in PARAMETERS:
        return _parameter(kind, name, [_possible(name, value) for value in asked])
    if "." not in str(name):
        known_name(name, WORKSHOP)
    if workshop is None:
        raise JumpcadError(f"{shown(name)}: this robot is made in no workshop; search it on the printed robot")
    is_whole = isinstance(workshop_value(workshop, name), int)
    parameter = _parameter(kind, name, [_tried(workshop, name, value) for value in asked], is_whole)
    if kind == "bound":  # 0 may mean "found", and small values be refused
        _tried(workshop, name, parameter.lower + INSIDE * parameter.width)
    return parameter


def _tried(workshop: Workshop, name: str, value: Any) -> Value:
    """Return a value that the workshop accepts: a text as a name, else as a number."""
    if not isinstance(value, int | float | str | np.integer | np.floating):
        raise JumpcadError(f"{name} = {described(value)} is neither a number nor a name")
    tried: list[Value] = [value] if isinstance(value, str) else [float(value)]
    if isinstance(workshop_value(workshop, name), bool):
        tried = [{"true": 1.0, "false": 0.0}.get(str(value), tried[0])]
    if isinstance(value, str):
        with suppress(ValueError):
            tried.append(float(value))
    complaint = JumpcadError(f"{name} = {described(value)} does not suit the workshop")
    for one in tried:
        try:
            varied(workshop, {name: one})
            return one
        except JumpcadError as error:
            complaint = error
    raise complaint


def _parameter(kind: Kind, name: str, values: Sequence[Value], is_whole: bool = False) -> SearchParameter:
    numbers = [float(value) for value in values if not isinstance(value, str)]
    if (numbers and len(numbers) < len(values)) or (kind == "bound" and len(numbers) < len(values)):
        raise JumpcadError(f"{name}: names and numbers do not mix: choose among names, or give a range of numbers")
    if kind != "bound":
        if not values:
            raise JumpcadError(f"{name} has no values to choose from; give at least one")
        if broken := [number for number in numbers if is_whole and number % 1.0]:
            raise JumpcadError(f"{name} = {broken[0]:g} is not a whole number, and it takes nothing else")
        return SearchParameter.among(name, values)
    if len(numbers) != 2:
        raise JumpcadError(f"{name} has {len(numbers)} bounds; give the lower and the upper one")
    lower, upper = numbers
    if lower >= upper:
        raise JumpcadError(f"{name} = {lower:g}:{upper:g} is an empty range: the first must be less than the second")
    if not is_whole:
        return SearchParameter(name, lower, upper)
    whole = [float(number) for number in range(math.ceil(lower), math.floor(upper) + 1)]
    if not whole:
        ends = f"{lower:g}:{upper:g}"
        raise JumpcadError(f"{name} = {ends} holds no whole number, and it takes nothing else: widen the range")
    return SearchParameter.among(name, whole)


def several(name: str, values: Any) -> tuple[Any, ...]:
    """Return a caller's values for one parameter; raises `JumpcadError` for a single number or text."""
    if isinstance(values, str | bytes):  # its letters are no values
        raise JumpcadError(f"{name} = {described(values)}: must be a list of values")
    try:
        return tuple(values)
    except TypeError:
        raise JumpcadError(f"{name} = {described(values)}: give several numbers, or fix the parameter") from None


def _possible(name: str, value: Any) -> float:
    """Return a value that a design can have."""
    if not isinstance(value, int | float | np.integer | np.floating):
        raise JumpcadError(f"{name} = {described(value)} is not a number")
    lower, upper = physical_limits(name)
    if not lower <= value <= upper:
        number = f"{value:g}" if isinstance(value, float) else shown(value)
        raise JumpcadError(f"{name} = {number} is outside {lower:g}…{upper:g}: no design can have it")
    return float(value)


def known_name(name: str, others: str = "") -> str:
    """Return the name of a parameter; raises `JumpcadError` for any other, and says what `others` there are."""
    if name not in PARAMETERS:
        hint = did_you_mean(str(name), PARAMETERS) or f"; the parameters are {', '.join(PARAMETERS)}{others}"
        raise JumpcadError(f"{shown(name)} is not a parameter of a design{hint}")
    return name
