"""Spring, cam, gears and motor: the limits of their synthesis, and those of the release, as findings."""

from dataclasses import replace

from jumpcad.drive import cam_findings, release, spring, stock_spring, train
from jumpcad.findings import Finding, Severity
from jumpcad.robot.robot import Robot

ROUND_OFF = 1e-6
BASIS = spring.BASIS | cam_findings.BASIS | train.BASIS | release.BASIS | stock_spring.BASIS


def drive_findings(robot: Robot) -> list[Finding]:
    """Return the drive's findings; `spring_stress`, `cam_*`, `gear_*`, `motor_*`, `release_*` by what they limit."""
    return [_judged(found) for found in (*robot.layout.drive.findings, *robot.release.findings)]


def _judged(found: Finding) -> Finding:
    """Return a finding with its severity; the cam's search ends on its limits, within about 1e-9."""
    failed: Severity = "warning" if found.severity == "warning" else "error"  # of what wears
    margin = 0.0 if abs(found.margin) < ROUND_OFF else found.margin
    return replace(found, margin=margin, severity="info" if margin >= 0.0 else failed)
