"""Robots side by side: figures, what differs in design and workshop, and a page on which they jump to one scale."""

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.building import build
from jumpcad.building.bom import bill_of_materials
from jumpcad.bundle.limits import limits_of, tightest, used, with_verdict
from jumpcad.bundle.manifest import robot_of
from jumpcad.bundle.viewer import lane, lanes_values
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.face import __version__
from jumpcad.files import template_names
from jumpcad.files.templates import fill, templates_folder
from jumpcad.findings import Finding
from jumpcad.landing.series import jumps
from jumpcad.robot.robot import Robot
from jumpcad.simulation import Jump, headline
from jumpcad.simulation.uncertain import uncertainty_of
from jumpcad.studio.points import Points
from jumpcad.transforms import ByValue
from jumpcad.workshop import Workshop
from jumpcad.workshop.varied import leaves

HOPS = 10
"""Jumps in a row from which the metres of a charge are computed."""
FIGURES = {
    "touchdown_distance_m": ("touchdown", "mm", 1000.0, 0),
    "as_made_m": ("touchdown as made, median", "mm", 1000.0, 0),
    "ballistic_range_m": ("range, floor or not", "mm", 1000.0, 0),
    "com_rise_m": ("rise", "mm", 1000.0, 0),
    "turn_deg": ("turn forwards", "°", 1.0, 0),
    "mass_kg": ("mass", "g", 1000.0, 1),
    "spring_energy_j": ("spring energy", "mJ", 1000.0, 0),
    "spring_stiffness_nm_per_rad": ("stiffness", "N·mm/°", 1000.0 * math.pi / 180.0, 2),
    "electrical_energy_j": ("energy of a jump", "J", 1.0, 2),
    "winding_time_s": ("winding", "s", 1.0, 1),
    "metres_per_charge": ("metres per charge, unaided", "m", 1.0, 1),
    "cost_eur": ("cost with estimates", "€", 1.0, 2),
}
"""Label, unit, factor from SI and digits of each figure that is compared."""
PRICE = ("spring_energy_j", "winding_time_s", "mass_kg", "cost_eur")
"""Figures that a longer jump may have cost: what changed of them is said."""


@dataclass(frozen=True)
class ComparedRobot:
    """A robot under its label, with its jump and what is compared of it."""

    label: str
    robot: Robot
    jump: Jump

    @cached_property
    def findings(self) -> list[Finding]:
        """Its limits that count, the violated ones first, then the tightest."""
        return tightest(with_verdict(limits_of(self.robot), self.jump))

    @cached_property
    def figures(self) -> dict[str, float | None]:
        """Return `FIGURES` of the robot; None where it has none, as the way of one that stays on the ground."""
        train, jump = self.robot.layout.drive.train, self.jump
        made = uncertainty_of(self.robot) if jump.verdict == "jump" else None
        way = jumps(self.robot, HOPS).metres_per_charge if jump.verdict == "jump" else None
        found = {"as_made_m": made.quantiles["touchdown_distance_m"][1] if made else None,
                 "spring_stiffness_nm_per_rad": self.robot.spring.stiffness_nm_per_rad,
                 "electrical_energy_j": train.electrical_j, "winding_time_s": train.winding_s,
                 "metres_per_charge": way, "cost_eur": bill_of_materials(self.robot).cost_eur}  # fmt: skip
        return {name: found[name] if name in found else getattr(jump, name) for name in FIGURES}

    @property
    def violated(self) -> list[str]:
        return [one.name for one in self.findings if one.severity != "info"]

    @cached_property
    def values(self) -> dict[str, Any]:
        """The numbers of its design, without a stiffness that springs from stock do not have, and its workshop's."""
        bought = {"stiffness_nmm_per_deg"} if self.robot.workshop.stock_spring else set()
        return self.robot.design.model_dump(exclude=bought) | leaves(self.robot.workshop.model_dump())


@dataclass(frozen=True, eq=False)
class Comparison(ByValue):
    """Robots side by side; `refused` says by label why others cannot be built."""

    robots: tuple[ComparedRobot, ...]
    refused: dict[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<Comparison: {', '.join(one.label for one in self.robots)}>"

    def _repr_html_(self) -> str:
        return fill("report/comparison_table.html.j2", {"comparison": self})

    @cached_property
    def differing(self) -> list[Finding]:
        """The worst limit of each robot, but for those used alike by all of them, such as what equal boards bear."""
        alike = set.intersection(*({(limit.name, used(limit)) for limit in one.findings} for one in self.robots))
        differ = [[limit for limit in one.findings if (limit.name, used(limit)) not in alike] for one in self.robots]
        return [(limits or one.findings)[0] for limits, one in zip(differ, self.robots, strict=True)]

    @cached_property
    def differs(self) -> dict[str, list[Any]]:
        """What differs in designs and workshops: a value of each robot by name, None where it has no such value.

        Sources of values are left out, and materials that not all robots have: their roles differ.
        """
        every = set.intersection(*(set(one.values) for one in self.robots))
        names = [
            name
            for name in dict.fromkeys(name for one in self.robots for name in one.values)
            if not name.endswith(".source") and (name in every or not name.startswith("materials."))
        ]
        values = {name: [one.values.get(name) for one in self.robots] for name in names}
        return {name: found for name, found in values.items() if any(value != found[0] for value in found)}

    def rows(self) -> Iterator[list[str]]:
        """Yield the table: a label and what it says of each robot."""
        yield ["verdict", *(f"{one.jump.verdict} ({one.jump.engine})" for one in self.robots)]
        for name, (label, unit, factor, digits) in FIGURES.items():
            figures = [one.figures[name] for one in self.robots]
            shown = ["–" if value is None else f"{factor * value:.{digits}f}" for value in figures]
            yield [f"{label} ({unit})", *shown]
        first_ones = [one.findings[0] for one in self.robots]
        for label, limits in (("tightest", first_ones), ("tightest that differs", self.differing)):
            yield [label, *(f"{limit.name}, {used(limit)}" for limit in limits)]
        first, *others = (one.figures for one in self.robots)
        for name in PRICE if others else ():
            shares = (_more(first[name], figures[name]) for figures in others)
            yield [f"{FIGURES[name][0]}, against the first", "–", *shares]
        yield ["violated limits", *(str(len(one.violated)) for one in self.robots)]
        for name, values in self.differs.items():
            yield [name, *("–" if value in (None, "") else f"{value:g}" if isinstance(value, float) else str(value)
                           for value in values)]  # fmt: skip

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        robots = [
            {"name": one.label, "verdict": one.jump.verdict, **one.figures, "violated": one.violated,
             "tightest": one.findings[0].name, "tightest_that_differs": limit.name}
            for one, limit in zip(self.robots, self.differing, strict=True)
        ]  # fmt: skip
        return {"robots": robots, "refused": self.refused, "differs": self.differs}

    def to_html(self) -> str:
        """Return the page: one file, without network, with the tables and the jumps side by side to one scale."""
        lanes = [lane(one.label, one.robot, one.jump.trajectory) for one in self.robots]
        style = (templates_folder() / "report" / "style.css").read_text(encoding="ascii")
        values = {"comparison": self, "style": style, "version": __version__} | lanes_values(lanes)
        return fill("report/comparison.html.j2", values)


def changes_in_words(before: Mapping[str, float | None], after: Mapping[str, float | None]) -> str:
    """Return what a robot takes more or less of `PRICE` than the one that a search began with."""
    parts = []
    for name in PRICE:
        (label, unit, factor, digits), old, new = FIGURES[name], before.get(name), after.get(name)
        if old and new:
            values = f"{factor * old:.{digits}f} → {factor * new:.{digits}f} {unit}"
            parts.append(f"{label} {values} ({_more(old, new)})")
    return ", ".join(parts)


def _more(before: float | None, after: float | None) -> str:
    return f"{round(100.0 * (after / before - 1.0)):+d} %" if before and after else "–"


@check_arguments
def compare(robots: Sequence[Robot | Design | str | Path], workshop: Workshop | None = None) -> Comparison:
    """Compare robots: their jumps, masses, energies, costs and limits, and what differs in what they are built from.

    Parameters
    ----------
    robots
        Robots, designs, templates' names, files of designs, bundles, and trials of a study as `F.db#28`.
    workshop
        In which designs are built; their own without. Bundles and trials have their own.

    Raises
    ------
    JumpcadError
        If there are less than two, or one cannot be read; the message names it.
    CannotBuildError
        If none of them can be built.
    """
    if len(robots) < 2:
        raise JumpcadError(f"compare takes two robots or more, not {len(robots)}")
    found: dict[str, ComparedRobot] = {}
    refused: dict[str, str] = {}
    for number, one in enumerate(robots, start=1):
        label = str(one) if isinstance(one, str | Path) else one.name if isinstance(one, Robot) else "robot"
        label = f"{label} ({number})" if label in found | refused else label
        try:
            robot = _robot(one, workshop)
        except CannotBuildError as refusal:
            refused[label] = str(refusal)
            continue
        found[label] = ComparedRobot(label, robot, headline(robot, trajectory=True))
    if not found:
        raise CannotBuildError("; ".join(f"{label}: {why}" for label, why in refused.items()))
    return Comparison(tuple(found.values()), refused)


def _robot(one: Robot | Design | str | Path, workshop: Workshop | None) -> Robot:
    if isinstance(one, Robot):
        return one
    file, mark, number = str(one).rpartition("#")
    if mark and file.endswith(".db"):
        if not number.isdecimal():
            raise JumpcadError(f"{one}: a trial is named by its number in the study, as in {file}#28")
        points = Points(Path(file))
        trial = points.trial(int(number))
        return build(trial.design, points.workshop_of(trial), f"{Path(file).stem}-{number}")
    if str(one).endswith(".db"):
        raise JumpcadError(f"{one}: is a study; a trial of it is named by its number, as in {one}#28")
    is_bundle = not isinstance(one, Design) and os.path.isdir(one) and str(one) not in template_names("robots")
    return robot_of(one, None if is_bundle else workshop)
