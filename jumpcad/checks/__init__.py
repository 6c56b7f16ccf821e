"""Checks of a finished robot: each is a function that returns findings, with signed margins and remedies.

A new check is a function in its thing's folder, a table `BASIS` beside it with formula and source of its findings, and
a `Check` in the thing's line of `jumpcad.robot.things`; what looks at several things stands here, with a line in
`CHECKS`. Its finding may name what grows where it fails (`Finding.grows`); `build` then makes that section stronger, if
the check is cheap.
"""

from collections.abc import Iterable
from dataclasses import replace
from fnmatch import fnmatchcase

from jumpcad.checks import assembly, interference, printability, springs_loaded
from jumpcad.drive.spring_choice import for_bought_springs
from jumpcad.findings import Basis, Finding
from jumpcad.mechanism import feasibility
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot.robot import Check, Robot
from jumpcad.robot.things import THINGS, things_on

__all__ = [
    "CHECKS", "SYMBOLS", "Check", "basis_of", "check", "constraint_findings", "costly_findings", "quick_findings",
]  # fmt: skip

SYMBOLS = (
    "M bending moment, F force, T torque, σ and τ bending and shear stress; b, h, t width, height and thickness, A "
    "area, I second moment of a section, E modulus; U springs' energy, K stiffness of both springs, δ and p angles by "
    "which they are loaded from rest and at rest; l1 to l5 links, body to toes; r = (1 + "
    "safety.spring_rate_scatter)·(1 + safety.stress_reserve), s = safety.strength_factor·r of what is printed, "
    "safety.steel_factor·r of steel; others as the formula says"
)
"""What letters mean in the formulas of `basis`."""


CHECKS = (
    Check(feasibility.feasibility_findings, feasibility.BASIS, needs=Mechanism),
    *(check for thing in THINGS for check in thing.checks),
    Check(printability.bed_findings, printability.BASIS),
    Check(springs_loaded.foot_findings, springs_loaded.BASIS, cheap=False),
    Check(printability.printability_findings, printability.BASIS, cheap=False),
    Check(interference.interference_findings, interference.BASIS, cheap=False),
    Check(assembly.assembly_findings, assembly.BASIS, cheap=False),
    Check(springs_loaded.righting_findings, springs_loaded.RIGHTING_BASIS, cheap=False),
)
"""Every check, in the order of its findings."""


def check(robot: Mechanism) -> list[Finding]:
    """Return the findings of every check, limits that are met included; without parts, those of feasibility only."""
    return _findings(robot, CHECKS)


def quick_findings(robot: Mechanism) -> list[Finding]:
    """Return the findings of the cheap checks, feasibility included."""
    return _findings(robot, (check for check in CHECKS if check.cheap))


def costly_findings(robot: Robot) -> list[Finding]:
    """Return the findings that `build` and searches leave out, for they take seconds.

    Walls and overhangs of the prints, overlaps over the whole motion, and paths and tools of the assembly.
    """
    return _findings(robot, (check for check in CHECKS if not check.cheap))


def constraint_findings(robot: Robot) -> list[Finding]:
    """Return the findings of the cheap checks that need parts: those that a simulated jump does not include."""
    return _findings(robot, (check for check in CHECKS if check.cheap and check.needs is Robot))


def basis_of(name: str) -> Basis | None:
    """Return formula and source of the findings of a name, if any check makes them."""
    known = (item for check in CHECKS for item in check.basis.items())
    return next((basis for pattern, basis in known if fnmatchcase(name, pattern)), None)


def _findings(robot: Mechanism, checks: Iterable[Check]) -> list[Finding]:
    """Return the findings of those checks whose needs the robot meets, and whose thing it has."""
    there = things_on(robot.layout) if isinstance(robot, Robot) else THINGS
    without = [check.basis for thing in THINGS if thing not in there for check in thing.checks]
    ours = (check for check in checks if isinstance(robot, check.needs) and check.basis not in without)
    findings = [one for check in ours for one in check.find(robot)]
    if isinstance(robot, Robot) and robot.workshop.bought.spring:
        return [replace(found, ways=for_bought_springs(found.ways)) for found in findings]
    return findings
