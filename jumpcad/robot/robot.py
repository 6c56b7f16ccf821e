"""`Robot`: a mechanism with its parts, layout and workshop. `Thing`: what one folder of `jumpcad.robot` offers it."""

import os
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, Self, TypeVar

from jumpcad.drive.release import Release
from jumpcad.electronics.nets import Wiring, wiring_of
from jumpcad.electronics.supply import Supply, supply_of
from jumpcad.errors import JumpcadError
from jumpcad.files.complaints import shown
from jumpcad.files.outputs import DEVICE
from jumpcad.findings import Basis, Finding
from jumpcad.mechanism.model import Mechanism
from jumpcad.parts.part import Drawing, Part
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.layout import Layout
from jumpcad.strength.growth import Grown
from jumpcad.strength.loads import StopBlow
from jumpcad.workshop import Workshop

T = TypeVar("T")
NAME = re.compile(r"\w([\w .+-]*[\w+-])?")
LONGEST_NAME = 200
"""Longest name in bytes: file systems allow 255, with what file names add before and after it."""


@dataclass(frozen=True, repr=False, eq=False)
class Robot(Mechanism):
    """One printed robot; its bodies have the mass and inertia of its parts.

    `parts` are printed, `hardware` is bought, `layout` says where everything goes, and `workshop` what it is made with;
    `release` is the release of its springs by the cam, `stop_blow` the impact of its leg on the rest stop; `grown` says
    what is stronger than first sized. Robots are equal where name, design, workshop, mechanism and bodies' masses are.
    """

    parts: tuple[Part, ...] = field(compare=False)
    hardware: tuple[BoughtPart, ...] = field(compare=False)
    workshop: Workshop
    layout: Layout = field(compare=False)
    release: Release = field(compare=False)
    stop_blow: StopBlow
    grown: tuple[Grown, ...] = field(default=(), compare=False)

    @cached_property
    def supply(self) -> Supply:
        """Voltages and currents of its battery and boards."""
        return supply_of(self.layout.electronics)

    @cached_property
    def wiring(self) -> Wiring:
        """The net list of its electrical parts."""
        return wiring_of(self.layout.electronics, self.workshop.bought.pins, self.workshop.steering.wheel != "none")

    def __copy__(self) -> Self:
        """Return the robot itself: it does not change."""
        return self

    def __deepcopy__(self, memo: object) -> Self:
        """Return the robot itself: it does not change."""
        return self

    def __reduce__(self) -> NoReturn:
        """Refuse to be pickled: regions and solids live in a library that writes them with other last digits."""
        raise JumpcadError(
            "a Robot cannot be pickled or sent to another process: send its design and workshop and build it there; "
            "evaluate(...).to_dict() is plain data"
        )

    if TYPE_CHECKING:

        def show(self) -> Path | None:
            """Show the robot's page; `jumpcad.notebook` gives this method to the class."""


@dataclass(frozen=True)
class Check:
    """A function that returns findings, limits that are met included, and what they are about.

    `find` takes what the check `needs` (a Mechanism, or a Robot with its parts) and returns findings, whose names are
    in `basis`. A `cheap` check looks at no mesh and at no motion, takes about a millisecond, and runs for every design
    of a search.
    """

    find: Callable[[Any], Iterable[Finding]]
    basis: Mapping[str, Basis]
    needs: type[Mechanism] = Robot
    cheap: bool = True


@dataclass(frozen=True)
class Thing:
    """A thing on the robot, one folder of `jumpcad.robot`.

    `draw` yields its printed parts, `bought` its bought ones; `checks` are its limits. `place` returns where it is on a
    machine that has its place (then `Layout.of`), or None: a robot that goes without is asked for none of these.
    """

    draw: Callable[[Layout, Workshop], Iterable[Drawing]] = lambda layout, workshop: ()
    bought: Callable[[Layout, Workshop], Iterable[BoughtPart]] = lambda layout, workshop: ()
    checks: tuple[Check, ...] = ()
    place: Callable[[Layout, Workshop], object | None] | None = None


def decided_once(decide: Callable[[Robot], T]) -> Callable[[Robot], T]:
    """Let what a function decides about a robot be decided once: the robot, which does not change, carries it."""

    @wraps(decide)
    def known(robot: Robot) -> T:
        decided: dict[object, T] = vars(robot).setdefault("_carried", {})
        if decide not in decided:
            decided[decide] = decide(robot)
        return decided[decide]

    return known


def require_name(name: str) -> None:
    """Reject a robot's name that cannot be part of file names."""
    if not NAME.fullmatch(name):
        wrong = next((f", not U+{ord(letter):04X}" for letter in name if not re.match(r"[\w .+-]", letter)), "")
        raise JumpcadError(
            f"{shown(name)} is used in file names: use letters, digits, spaces, '.', '-', '+' and '_'{wrong}"
        )
    if device := DEVICE.match(name):
        raise JumpcadError(f"{shown(name)} is used in file names: {device[1]} is a device on Windows; use another name")
    if len(os.fsencode(name)) > LONGEST_NAME:
        raise JumpcadError(f"{shown(name)} is used in file names: use at most {LONGEST_NAME} bytes")
