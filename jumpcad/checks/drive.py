"""Spring, cam, gears and motor: the margins that their synthesis found, judged."""

from jumpcad.findings import Finding, limit
from jumpcad.robot import Robot


def drive_findings(robot: Robot) -> list[Finding]:
    """Return the drive's findings; `spring_stress`, `cam_*`, `gear_*` and `motor_*` by what they limit."""
    return [
        limit(found.name, _rounded(found.margin), found.unit, found.message, found.remedy)
        for found in robot.layout.drive.findings
    ]


def _rounded(margin: float) -> float:
    return 0.0 if abs(margin) < 1e-6 else margin
