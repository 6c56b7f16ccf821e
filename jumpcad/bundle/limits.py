"""The limits of a robot in one order, the violated ones first, with their use in words, for report.html."""

from collections.abc import Iterable, Sequence
from typing import Any

from jumpcad.checks import check
from jumpcad.findings import SHOWN_AS, Finding, errors
from jumpcad.robot.robot import Robot, decided_once
from jumpcad.simulation import Jump

JUST = "at the limit"
SEVERITIES = ("error", "warning", "info")
WIDEST = 1.25
"""Use at which a bar has its full length; longer bars are cut off."""
AT_LIMIT = 5e-4
"""Largest difference of a use from 1, or of a margin from 0, that is shown as "at the limit", where sizing ends.

A margin of exactly 0 is that of a condition that holds or does not, and is not shown so.
"""


@decided_once
def limits_of(robot: Robot) -> list[Finding]:
    """Return the findings of every check of a robot, checked once."""
    return check(robot)


def with_verdict(limits: Sequence[Finding], jump: Jump) -> list[Finding]:
    """Return limits with what forbids the jump, which is a violated limit too: what is counted and named everywhere."""
    known = {finding.name for finding in limits}
    return [*limits, *(finding for finding in errors(jump.findings) if finding.name not in known)]


def limit_values(findings: Sequence[Finding]) -> dict[str, Any]:
    """Return what report.html says of limits: violated ones, kept ones by their use, those without a share."""
    every = ordered(findings)
    violated = [finding for finding in every if finding.severity != "info"]
    kept = [finding for finding in every if finding.severity == "info"]
    without = [finding for finding in kept if finding.use is None]
    just_kept = [finding for finding in without if used(finding) == JUST]
    return {
        "violated": violated, "tightest": tightest(findings), "violation": violation(findings),
        "violated_class": "error" if errors(violated) else "warning",
        "kept": [finding for finding in kept if finding.use is not None], "just_kept": just_kept,
        "without": without[len(just_kept) :], "count": counted_limits(findings),
        "uncounted": sum(not finding.counts and not finding.is_note for finding in findings), "used": used,
        "width": lambda finding: 100.0 * min(finding.use, WIDEST) / WIDEST,
    }  # fmt: skip


def violation(findings: Sequence[Finding]) -> str:
    """Return how many limits are violated, and whether to build the robot; empty where none is."""
    violated = [finding for finding in findings if finding.severity != "info"]
    if not violated:
        return ""
    are = "is" if len(violated) == 1 else "are"
    means = "do not build it as it is" if errors(violated) else "it can be built, but read the warnings first"
    return f"{len(violated)} of its {counted_limits(findings)} limits {are} violated: {means}"


def counted_limits(findings: Iterable[Finding]) -> int:
    """Return the number of limits that a robot is said to have: see `Finding.counts`."""
    return sum(finding.counts for finding in findings)


def ordered(findings: Iterable[Finding]) -> list[Finding]:
    """Return errors, then warnings, then the others; each from the highest use on.

    What has no use comes last; but with a margin of almost 0, it counts as wholly used.
    """
    return sorted(
        findings,
        key=lambda one: (SEVERITIES.index(one.severity), -(one.use if one.use is not None else used(one) == JUST)),
    )


def tightest(findings: Iterable[Finding]) -> list[Finding]:
    """Return the limits that count as `ordered`: what check, compare, report and studio name first."""
    return [one for one in ordered(findings) if one.counts and not one.is_note]


def used(finding: Finding) -> str:
    """Return how much of a limit is used, in words; the margin of one without a share."""
    if finding.use is None:
        if 0.0 < abs(finding.margin) < AT_LIMIT:
            return JUST
        if finding.margin == 0.0 and not finding.unit:
            return "holds" if finding.severity == "info" else "does not hold"
        unit, factor = SHOWN_AS.get(finding.unit, (finding.unit, 1.0))
        return f"margin {factor * finding.margin:.3g} {unit}".strip()
    return JUST if abs(finding.use - 1.0) < AT_LIMIT else f"{100.0 * finding.use:.0f} % used"
