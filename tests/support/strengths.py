"""Robots of a weaker or stronger workshop, and the margins of their strength checks."""

from dataclasses import replace

from jumpcad.checks.strength import strength_findings
from jumpcad.robot import Robot


def changed(robot: Robot, role: str, **figures: float) -> Robot:
    """Return a robot whose workshop has other figures, in a role's material or in a section."""
    workshop = robot.workshop
    assert workshop is not None
    if role in ("links", "body", "gears"):
        name = workshop.material_name(role)  # type: ignore[arg-type]
        material = workshop.materials[name].model_copy(update=figures)
        return replace(
            robot, workshop=workshop.model_copy(update={"materials": {**workshop.materials, name: material}})
        )
    section = getattr(workshop, role).model_copy(update=figures)
    return replace(robot, workshop=workshop.model_copy(update={role: section}))


def margins(robot: Robot) -> dict[str, float]:
    """Return the margin of every strength check."""
    return {finding.name: finding.margin for finding in strength_findings(robot)}
