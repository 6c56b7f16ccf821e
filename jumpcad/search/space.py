"""The search space: each of the eight parameters free in a range, free among choices, or fixed; and values of the
workshop in the same way.

Methods work in the unit cube of the free parameters. Choices are placed in it in proportion to their values,
names evenly.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from jumpcad.arguments import check_arguments, check_fields
from jumpcad.design import PARAMETERS, PRINTED_BOUNDS, SEARCH_BOUNDS, Bounds, Design
from jumpcad.drive import SpringLimits
from jumpcad.drive.spring_choice import STIFFNESS, rest_angles_deg
from jumpcad.errors import JumpcadError
from jumpcad.robot.springs.place import PLATE_PINS_RAD
from jumpcad.search.parameter import SearchParameter, changed_parameters, known_name, physical_limits, read_changes
from jumpcad.search.study.variant import NOTHING, Key, Variant
from jumpcad.simulation.prior import sobol
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop, workshop_value
from jumpcad.workshop.varied import Value

ROOM_UP_TO_RAD = math.radians(75.0)
"""Directions of the springs' pin up to which there mostly is room; judgement: in 60 robots of the default bounds the
cam begins at 40 to 80°."""
THINGS = {
    "cage": ("rod", "glass-1.5", ("cage.", "cage_")),
    "steering": ("wheel", "o-ring", ("steering.", "steering_", "turn_per_rev_deg", "turn_energy_j")),
}
"""What a workshop may lack: the key that brings it, a value, and how names begin that are of it alone."""
STUDY = "study"
"""What `--bound` takes for the bounds of the study."""


def _with_springs(workshop: Workshop, lowest_deg: float) -> dict[str, SearchParameter]:
    """Return stiffness and rest angle as springs from stock have them; nothing where they are made to order."""
    stock, angle = workshop.stock_spring, "rest_angle_deg"
    if stock is None:
        return {}
    lower, upper = physical_limits(STIFFNESS)
    found = {STIFFNESS: SearchParameter.among(STIFFNESS, [min(max(2.0 * stock.rate_nmm_per_deg, lower), upper)])}
    free = tuple(pin for pin in PLATE_PINS_RAD if pin <= ROOM_UP_TO_RAD)
    anywhere = SpringLimits(0.0, 0.0, workshop.bought.axle_mm, 1.0, free)
    reached = rest_angles_deg(stock, math.radians(workshop.spring.preload_deg), anywhere)
    angles = [one for one in reached if one >= lowest_deg]
    return found | ({angle: SearchParameter(angle, float(angles[0]), float(angles[-1]))} if len(angles) > 1 else {})


def require_things(
    workshop: Workshop, changed: Mapping[str, SearchParameter], names: Sequence[str], surely: bool = False
) -> None:
    """Require that a workshop, with what is changed in it, may have what names are of, or has it `surely`."""
    for thing, (key, value, beginnings) in THINGS.items():
        place = f"{thing}.{key}"
        values = changed[place].names if place in changed else (getattr(getattr(workshop, thing), key),)
        lacks = {"", "none"} & set(values) and (surely or place not in changed)
        if lacks and (named := [one for one in names if one.startswith(beginnings)]):
            raise JumpcadError(f"{named[0]}: the workshop has no {thing}: fix {place} too, {place}={value}")


def apart(
    points: Iterable[Array], least: float, count: int, admits: Callable[[int], bool] = lambda _index: True
) -> list[int]:
    """Return the indices of the first points (d,) that are admitted and differ by `least` along some axis."""
    chosen: dict[int, Array] = {}
    for index, point in enumerate(points):
        if len(chosen) == count:
            break
        if all(np.abs(point - other).max() >= least for other in chosen.values()) and admits(index):
            chosen[index] = point
    return list(chosen)


@dataclass(frozen=True, repr=False)
class Space:
    """The parameters of a search: a design's in the order of `PARAMETERS`, then the workshop's by their keys."""

    parameters: tuple[SearchParameter, ...]

    def __repr__(self) -> str:
        return f"<Space: {', '.join(p.name for p in self.free)} free>"

    def __post_init__(self) -> None:
        check_fields(self)
        if not any(parameter.free for parameter in self.parameters):
            raise JumpcadError("all parameters are fixed: nothing is left to search; free at least one")

    @classmethod
    def default(cls) -> Self:
        """Return the bounds that the published study searched."""
        return cls(tuple(SearchParameter(name, limits.lower, limits.upper) for name, limits in SEARCH_BOUNDS.items()))

    @classmethod
    @check_arguments
    def make(
        cls,
        fixed: Mapping[str, Value] = NOTHING,
        bounds: Mapping[str, tuple[float, float]] = NOTHING,
        choices: Mapping[str, Sequence[Value]] = NOTHING,
        around: Design | None = None,
        only: Iterable[str] = (),
        within_percent: float | None = None,
        workshop: Workshop | None = None,
        study: bool = False,
    ) -> Self:
        """Return the usual space with changes: `PRINTED_BOUNDS` in a workshop, else the study's `SEARCH_BOUNDS`.

        Where the workshop has springs from stock, the stiffness is theirs, and the rest angle, unless the search is
        `around` a design, one at which their arms may reach their pins.

        Parameters
        ----------
        fixed, bounds, choices
            By name of a parameter, or by a key of the workshop such as `body.plate_mm`: its value, its lower and upper
            limit, its allowed values. Each is in at most one of them. Bounds that are `SEARCH_BOUNDS` are as `study`.
        around, only, within_percent
            A design; names of the parameters that stay free, the others fixed at it; the percentage of its width to
            which every range of a design is narrowed on either side of it.
        workshop
            The workshop whose values may be varied; None for a robot that is made in none.
        study
            Whether the study's bounds are the usual ones, whatever the workshop.
        """
        only = [known_name(name) for name in only]
        usual: Mapping[str, Bounds] = PRINTED_BOUNDS
        if workshop is None or study or bounds == SEARCH_BOUNDS:
            usual, bounds = SEARCH_BOUNDS, {} if bounds == SEARCH_BOUNDS else bounds
        if around is None and (only or within_percent is not None):
            raise JumpcadError(
                "to free only some parameters, or search near a design, say around which (around, or --around DESIGN)"
            )
        if within_percent is not None and not 0 < within_percent <= 100:
            raise JumpcadError(f"within {within_percent:g} % is outside 0…100 %: a share of each parameter's range")
        changed = changed_parameters(fixed, bounds, choices, workshop)
        if workshop:
            require_things(workshop, changed, list(changed))
        centre = dict(zip(PARAMETERS, around.to_vector(), strict=True)) if around else {}
        parameters, lowest_deg = [], usual["rest_angle_deg"].lower
        with_springs = _with_springs(workshop, lowest_deg) if workshop and "bought.spring" not in changed else {}
        for name, limits in usual.items():
            parameter = SearchParameter(name, limits.lower, limits.upper)
            if name in with_springs and (around is None or not with_springs[name].free):
                parameter = with_springs[name]
            elif only and name not in only:
                parameter = parameter.held(centre[name])
            elif within_percent is not None:
                parameter = parameter.narrowed(centre[name], within_percent, physical_limits(name))
            parameters.append(changed.pop(name, parameter))
        return cls((*parameters, *changed.values()))

    @classmethod
    @check_arguments
    def parse(
        cls, fix: Iterable[str] = (), bound: Iterable[str] = (), choose: Iterable[str] = (), **others: Any
    ) -> Self:
        """Return the usual space with changes ``NAME=VALUE``, ``NAME=LO:HI`` and ``NAME=a,b,c``; the rest as `make`.

        The bound ``study`` stands for all of the study's.
        """
        fixed = {name: value for name, (value,) in read_changes("fix", fix).items()}
        others["study"] = others.get("study", False) or STUDY in (bound := list(bound))
        bounds: dict[str, Any] = read_changes("bound", (one for one in bound if one != STUDY))
        return cls.make(fixed, bounds, read_changes("choose", choose), **others)

    @cached_property
    def free(self) -> tuple[SearchParameter, ...]:
        """The parameters that the search moves."""
        return tuple(parameter for parameter in self.parameters if parameter.free)

    @property
    def of_workshop(self) -> tuple[SearchParameter, ...]:
        """The parameters that are values of the workshop, free or fixed."""
        return self.parameters[len(PARAMETERS) :]

    @property
    def varies_workshop(self) -> bool:
        return any(parameter.free for parameter in self.of_workshop)

    @property
    def categories(self) -> tuple[int, ...]:
        """Number of names of each free parameter; 0 if its values are numbers."""
        return tuple(len(parameter.names) for parameter in self.free)

    @cached_property
    def scale(self) -> Array:
        """Lengths (dimension,) along the axes of the unit cube that count as 1: the widths that the study searched."""
        return np.array([parameter.scale for parameter in self.free])

    @property
    def dimension(self) -> int:
        return len(self.free)

    @property
    def size(self) -> float:
        """Number of different designs; infinite if a free parameter is continuous."""
        return math.prod(len(parameter.choices) or math.inf for parameter in self.free)

    def to_design(self, unit: Sequence[float] | Array) -> Design:
        """Return the design at a point (dimension,) of the unit cube."""
        return self.to_variant(unit).design

    def to_variant(self, unit: Sequence[float] | Array) -> Variant:
        """Return the design and the workshop's values at a point (dimension,) of the unit cube."""
        numbers, eight = self.values(np.asarray(unit, dtype=float)[None])[0].tolist(), len(PARAMETERS)
        workshop = {one.name: one.value(number) for one, number in zip(self.of_workshop, numbers[eight:], strict=True)}
        return Variant(Design.from_vector(numbers[:eight]), workshop)

    def values(self, units: Array) -> Array:
        """Return the parameters (n, 8 + w) at points (n, dimension) of the unit cube.

        The first eight are a design's vector, the others the workshop's; names are given by their indices.
        """
        columns = iter(units.T)
        fixed = np.ones(len(units))
        return np.column_stack([one.at(next(columns)) if one.free else one.lower * fixed for one in self.parameters])

    def to_unit(self, one: Design | Variant) -> Array:
        """Return the point (dimension,) of a design or variant; outside of the unit cube if it is out of bounds."""
        key = (variant := Variant.of(one)).key
        if key not in self._units:
            numbers = ((parameter, parameter.number(variant.value(parameter.name))) for parameter in self.free)
            self._units[key] = tuple(parameter.unit(number) for parameter, number in numbers)
        return np.array(self._units[key])

    @cached_property
    def _units(self) -> dict[Key, tuple[float, ...]]:
        """Points of variants that were asked for: every step of a search asks for all of its trials."""
        return {}

    def begun(self, design: Design, workshop: Workshop | None) -> Variant:
        """Return a design with the workshop's own values, or the nearest ones that the space has."""
        values = {}
        for one in self.of_workshop:
            number = one.number(workshop_value(workshop, one.name)) if workshop else math.nan
            unit = one.unit(number) if one.free and math.isfinite(number) else 0.0
            values[one.name] = one.value(float(one.at([min(max(unit, 0.0), 1.0)])[0]))
        return Variant(design, values)

    def contains(self, one: Design | Variant) -> bool:
        """Tell whether a design or variant has the fixed values and is within all ranges and choices (to 1e-9)."""
        variant = Variant.of(one)
        names = [parameter.name for parameter in self.of_workshop]
        return list(variant.workshop) == names and not self.outside(variant)

    def outside(self, variant: Variant) -> str:
        """Return the first parameter whose value the space does not have, and the value; mostly nothing."""
        for parameter in self.parameters:
            value = parameter.number(variant.value(parameter.name))
            slack = 1e-9 * max(parameter.width, abs(parameter.upper))
            allowed = parameter.choices or (min(max(value, parameter.lower), parameter.upper),)
            if not any(abs(value - near) <= slack for near in allowed):  # nor is NaN
                return f"{parameter.name} = {variant.value(parameter.name)}"
        return ""

    def snap(self, units: Array) -> Array:
        """Return points (n, dimension) of the unit cube with every choice moved to its nearest level."""
        return self._chosen(np.clip(units, 0.0, 1.0), lambda at, levels: np.abs(at[:, None] - levels).argmin(axis=1))

    def spread(self, count: int, generator: np.random.Generator) -> Array:
        """Return `count` scrambled Sobol points (count, dimension) of the unit cube, with every choice as often."""
        power = max(0, math.ceil(math.log2(max(count, 1))))
        return self.drawn(sobol(self.dimension, 2**power, generator)[:count])

    def drawn(self, units: Array) -> Array:
        """Return evenly distributed points (n, dimension) with choices, each for an equal part of its axis.

        Of three names that `snap` finds at 0, ½ and 1, the second would be as frequent as both others together.
        """
        return self._chosen(units.copy(), lambda at, levels: (at * len(levels)).astype(int))

    def _chosen(self, units: Array, which: Callable[[Array, Array], Array]) -> Array:
        """Put points at the levels of choices that a function tells from places along an axis."""
        for column, parameter in enumerate(self.free):
            if parameter.choices:
                levels = np.asarray(parameter.levels)
                units[:, column] = levels[which(units[:, column], levels)]
        return units

    def near(self, centre: Variant, names: Sequence[str] = (), percent: float | None = None) -> "Space | None":
        """Return the part of the space about one of its variants; None if nothing stays free in it.

        Only `names` vary, all if empty; ranges reach so many per cent of their width to either side, all of it if None.
        """
        parts = []
        for parameter in self.parameters:
            number = parameter.number(centre.value(parameter.name))
            if names and parameter.name not in names:
                parameter = parameter.held(number)
            elif percent is not None and not parameter.choices:
                parameter = parameter.narrowed(number, percent, (parameter.lower, parameter.upper))
            parts.append(parameter)
        return Space(tuple(parts)) if any(part.free for part in parts) else None

    @classmethod
    def from_record(cls, record: Mapping[str, Mapping[str, Any]]) -> Self:
        """Return the space of a record that `describe` returned."""
        return cls(tuple(SearchParameter.from_record(name, part) for name, part in record.items()))

    def describe(self) -> dict[str, Any]:
        """Return the space as plain data, as the study file keeps it."""
        return {parameter.name: parameter.describe() for parameter in self.parameters}
