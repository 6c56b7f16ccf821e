"""Limits that a search keeps on any figure: `-30<=touchdown_pitch_deg<=30`, `mass_kg<=0.15`, `leg_strength>=5`."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from jumpcad.arguments import check_arguments
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import described, shown
from jumpcad.findings import Finding, at_least, at_most
from jumpcad.search.study.objective import instead_of

NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)"
FORM = re.compile(rf"\s*(?:{NUMBER}\s*<=\s*)?([A-Za-z_]\w*)\s*(?:(<=|>=)\s*{NUMBER})?\s*", re.I)


@dataclass(frozen=True)
class Requirement:
    """The least and the largest value of a figure, or of the margin of a limit; None where there is none."""

    name: str
    least: float | None = None
    most: float | None = None

    def __str__(self) -> str:
        low = "" if self.least is None else f"{_number(self.least)}<="
        return f"{low}{self.name}" + ("" if self.most is None else f"<={_number(self.most)}")

    @classmethod
    def parse(cls, text: str) -> "Requirement":
        """Return the requirement that a text says."""
        found = FORM.fullmatch(text)
        low, name, sign, number = found.groups() if found else (None, "", None, None)
        if not name or (low is None and number is None) or (low is not None and sign == ">="):
            raise JumpcadError(
                f"{shown(text)}: is no requirement: write LO<=FIGURE<=HI, FIGURE>=LO or FIGURE<=HI, such as "
                "-30<=touchdown_pitch_deg<=30"
            )
        value = None if number is None else float(number)
        least = value if sign == ">=" else None if low is None else float(low)
        return cls.of(name, least, value if sign == "<=" else None)

    @classmethod
    @check_arguments
    def of(cls, name: str, least: float | None, most: float | None) -> "Requirement":
        """Return a requirement on a figure."""
        if not (limits := [one for one in (least, most) if one is not None]) or not all(map(math.isfinite, limits)):
            raise JumpcadError(
                f"{name} = ({least}, {most}): give a number as least or largest value, None for no limit"
            )
        if least is not None and most is not None and not least <= most:
            raise JumpcadError(f"{name}: at least {least:g} and at most {most:g} cannot both hold; exchange them")
        if name == "rights_itself" and least is not None and least > 1.0:
            raise JumpcadError(f"{name}>={least:g}: it is a share, at most 1: require 0.9 for 90 %")
        return cls(name, least, most)

    def __and__(self, other: "Requirement") -> "Requirement":
        """Return the tighter of both limits on either side; raises `JumpcadError` if they contradict each other."""
        least, most = ([one for one in pair if one is not None]
                       for pair in ((self.least, other.least), (self.most, other.most)))  # fmt: skip
        return self.of(self.name, max(least, default=None), min(most, default=None))

    def at(self, margin: float) -> float:
        """Return the figure that has a margin to the only limit."""
        return (self.most or 0.0) - margin if self.least is None else self.least + margin

    def findings(self, value: float) -> Iterator[Finding]:
        """Yield a finding of a value for each limit, named after it."""
        remedy = "change what the figure depends on, or require less"
        for sign, bound, found in ((">=", self.least, at_least), ("<=", self.most, at_most)):
            if bound is not None:
                name = f"{self.name}{sign}{_number(bound)}"
                yield found(name, value, bound, "", f"{self.name} is {value:.4g}, required is {name}", remedy)


def _number(value: float) -> str:
    """Return a number with all of its digits: a study tells searches apart by them."""
    return repr(float(value)).removesuffix(".0")


Required = Mapping[str, tuple[float | None, float | None]]
"""At least and at most, by figure: requirements as a program gives them."""


def requirements_of(asked: Iterable[str] | Required, known: Iterable[str]) -> tuple[Requirement, ...]:
    """Return requirements, one of each figure, sorted by name, of texts or of pairs by name."""
    if isinstance(asked, Mapping):
        for name, limits in asked.items():
            if not isinstance(limits, tuple | list) or len(limits) != 2:
                raise JumpcadError(f"{name} = {described(limits)}: give (least, largest) value, None for no limit")
        found = [Requirement.of(name, *limits) for name, limits in asked.items()]
    else:
        found = [Requirement.parse(text) for text in asked]
    names = sorted(known)
    for one in found:
        if one.name not in names and not any(one.name.startswith(name[:-1]) for name in names if name.endswith("*")):
            raise JumpcadError(
                f"{one.name}: a jump of this robot has no such figure{instead_of(one.name, names)}; "
                "`jumpcad list figures` names all"
            )
    whole: dict[str, Requirement] = {}
    for one in found:
        whole[one.name] = whole.get(one.name, one) & one
    return tuple(sorted(whole.values(), key=str))


def violations(
    requirements: Iterable[Requirement], figures: Mapping[str, float], margins: Mapping[str, float]
) -> Iterator[Finding]:
    """Yield the findings of requirements on figures and margins that are there."""
    for one in requirements:
        value = figures.get(one.name, margins.get(one.name))
        if value is not None:
            yield from one.findings(value)
