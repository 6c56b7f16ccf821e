"""The printed robot of a design: assembled, checked, and strengthened where larger sections can pass a failed check.

A design whose springs cannot raise its body is refused before anything is drawn.
"""

import itertools
import math
from collections.abc import Iterable
from dataclasses import replace

from jumpcad.arguments import check_arguments
from jumpcad.building.assembly import assembled
from jumpcad.catalogue import Battery, Board, Component
from jumpcad.checks import constraint_findings
from jumpcad.design import Design
from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.electronics.supply import chosen_parts
from jumpcad.errors import CannotBuildError
from jumpcad.files.records import composed
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import BODY
from jumpcad.mechanism.variants import capsule_robot, with_spring_factor
from jumpcad.robot.robot import Robot, require_name
from jumpcad.settings import Settings
from jumpcad.strength.growth import Grown, Growth
from jumpcad.workshop import Workshop, load_workshop, varied

GROWTH_ROUNDS = 10


@check_arguments
def build(design: Design, workshop: Workshop | None = None, name: str = "robot") -> Robot:
    """Build the printed robot of a design in a workshop, or in its own; its name, if any, is engraved on its plates.

    Sections grow until the checks that name them pass (`Finding.grows`), or until there is no room for more.

    Raises
    ------
    JumpcadError
        If design or workshop were changed to invalid values, or has the weight of a part that no robot has; if the name
        cannot be a file's name; or if an argument has a wrong type.
    CannotBuildError
        If the mechanism cannot work or cannot be laid out; the message names the reason and what to change.
    """
    workshop = (workshop or load_workshop(design.workshop_name)).revalidated()
    return built_and_checked(design.revalidated(), workshop, name)[0]


def built_and_checked(design: Design, workshop: Workshop, name: str) -> tuple[Robot, list[Finding]]:
    """Return the robot of valid design and workshop as `build` does, and its `constraint_findings`."""
    name = composed(name)
    if name:
        require_name(name)
    if refused := errors(geometry_findings(design)):
        first = refused[0]
        raise CannotBuildError(f"{first.name}: {first.message}", first.name, first.margin, first.unit, first.ways)
    robot, findings, growth, grown = _grown(assembled(design, workshop, name, Growth()), Growth())
    if (stronger := growth.stronger(workshop)) != growth:
        robot, findings, *_ = _grown(assembled(design, workshop, name, stronger, robot), stronger)
    robot = replace(robot, grown=grown) if grown else robot
    if "balance" in (workshop.seats.battery, workshop.seats.boards):
        return _balanced(robot, findings)
    return robot, findings


def _grown(robot: Robot, growth: Growth) -> tuple[Robot, list[Finding], Growth, tuple[Grown, ...]]:
    """Return a robot grown until its limits hold or nothing has room, its findings, by what it grew, and for which."""
    findings, uses = constraint_findings(robot), dict[tuple[str, str], tuple[float, float]]()
    ever_weak: list[Finding] = []
    for _ in range(GROWTH_ROUNDS):
        weak = [finding for finding in errors(findings) if finding.grows]
        if not weak:
            break
        found = _first_with_room(robot, (growth.leap(weak, uses), growth.more(weak)))
        if found is None:  # the checks report what stays too weak
            break
        uses = growth.uses(weak)
        ever_weak += weak
        robot, growth = found
        findings = constraint_findings(robot)
    return robot, findings, growth, growth.grown(ever_weak)


def _balanced(robot: Robot, findings: list[Finding]) -> tuple[Robot, list[Finding]]:
    """Return the robot with its electronics where they balance it best, of all places that fit, and its findings."""
    workshop, seats = robot.workshop, robot.workshop.seats
    batteries = ("leg", "right", "left") if seats.battery == "balance" else (seats.battery,)
    plates = ("right", "left") if seats.boards == "balance" else (seats.boards,)
    found = [(robot, findings)]
    for battery, boards in list(itertools.product(batteries, plates))[1:]:  # it is built as the first
        there = varied(workshop, {"seats.battery": battery, "seats.boards": boards})
        try:
            moved, judged = built_and_checked(robot.design, there, robot.name)
        except CannotBuildError:
            continue
        found.append((replace(moved, workshop=workshop), judged))
    return min(found, key=lambda one: (len(errors(one[1])), abs(one[0].lateral_offset_mm)))


def _first_with_room(before: Robot, growths: Iterable[Growth]) -> tuple[Robot, Growth] | None:
    """Return a robot grown, and its growth, by the first of some for which there is room; None if for none."""
    for growth in dict.fromkeys(growths):
        try:
            return assembled(before.design, before.workshop, before.name, growth, before), growth
        except CannotBuildError:
            continue
    return None


BARE_BODY_KG = 0.0555
"""A body without electrical parts; the lightest of 2,000 in `benchmarks/refuse.py` has more."""


def statics_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return `too_weak` of springs that could not raise the published body alone; nothing of others.

    It has 70 g; printed bodies have 71 g and more, and legs besides (`benchmarks/refuse.py`); less with lighter
    electrical parts than any that are shipped. Nothing is said where the user weighed parts. The design has passed the
    checks of its geometry.
    """
    if workshop.mass.weighed_g:
        return ()
    chosen, plain = chosen_parts(workshop), capsule_robot(design)
    parts: list[Battery | Board | Component] = [chosen.battery, *chosen.boards.values(), *chosen.components.values()]
    body_kg = min(plain.bodies[BODY].mass_kg, BARE_BODY_KG + sum(part.mass_g for part in parts) / 1000.0)
    bodies = {name: replace(one, mass_kg=body_kg if name == BODY else 0.0) for name, one in plain.bodies.items()}
    spring = springs_on_leg(design, workshop.stock_spring, math.radians(workshop.spring.preload_deg))
    robot = with_spring_factor(replace(plain, bodies=bodies, springs=(spring,)), settings.spring_efficiency)
    _, weak = statics_findings(robot, settings.gravity_m_s2)
    return tuple(replace(one, message=f"{one.message}; for its body alone") for one in errors([weak]))
