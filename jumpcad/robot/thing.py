"""What a thing on the robot offers: where it goes, how it is drawn, what is bought for it, what limits it."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from jumpcad.findings import Basis, Finding
from jumpcad.mechanism.model import Mechanism
from jumpcad.parts.part import Drawing
from jumpcad.parts.purchased import BoughtPart
from jumpcad.robot.layout import Layout
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop


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

    `draw` yields its printed parts and `bought` its bought ones. `checks` are its limits. `place` returns where it is
    on a machine that has its place already, or None where a robot goes without; the layout then has it (`Layout.of`).
    """

    draw: Callable[[Layout, Workshop], Iterable[Drawing]] = lambda layout, workshop: ()
    bought: Callable[[Layout, Workshop], Iterable[BoughtPart]] = lambda layout, workshop: ()
    checks: tuple[Check, ...] = ()
    place: Callable[[Layout, Workshop], object | None] = lambda layout, workshop: None
