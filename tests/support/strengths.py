"""Robots of a weaker or stronger workshop, and the margins of their strength checks."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from jumpcad.drive.spring_choice import springs_on_leg
from jumpcad.findings import Finding
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.robot.axles.steel import steel_findings
from jumpcad.robot.foot.limits import toe_findings
from jumpcad.robot.leg.thing import leg_findings
from jumpcad.robot.plates.thing import seat_finding
from jumpcad.robot.robot import Robot
from jumpcad.robot.train.thing import drive_findings
from jumpcad.workshop import Workshop
from jumpcad.workshop.workshop import Role
from support.said import ways


def strength_findings(robot: Robot) -> list[Finding]:
    """Return a finding for every way in which a robot could break when it jumps."""
    rooms = (leg_findings, toe_findings, steel_findings, seat_finding)
    return [
        *(one for room in rooms for one in room(robot)),
        *(one for one in drive_findings(robot) if "dog" in one.name),
    ]


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


def with_own(workshop: Workshop, role: Role, share: float) -> Workshop:
    """Return a workshop in which one kind of part has a material of its own: a share of its strength and stiffness."""
    usual = workshop.material(role)
    figures = ("strength_in_plane_mpa", "strength_interlayer_mpa", "modulus_mpa", "density_g_cm3")
    own = usual.model_copy(update={name: share * getattr(usual, name) for name in figures})
    roles = workshop.roles.model_copy(update={role: "own"})
    return workshop.model_copy(update={"roles": roles, "materials": {**workshop.materials, "own": own}})


def margins(robot: Robot) -> dict[str, float]:
    """Return the margin of every strength check."""
    return {finding.name: finding.margin for finding in strength_findings(robot)}


def helped(robot: Robot, find: Callable[[Robot], Iterable[Finding]]) -> set[str]:
    """Return the findings that what they advise to lower or to raise helps, by 3 %, the parts staying as they are.

    None may be worse for it.
    """
    usual, better = list(find(robot)), set()
    advised = {(finding.name, *way) for finding in usual for way in ways(finding)}
    for name, factor in {(name, factor) for _, name, factor in advised}:
        design = robot.design.model_copy(update={name: factor * getattr(robot.design, name)})
        layout = replace(robot.layout, linkage=Linkage(design), toe_half_width_mm=float(toe_tip_mm(design)[1]))
        other = find(replace(robot, design=design, springs=(springs_on_leg(design),), layout=layout))
        for before, after in zip(usual, other, strict=True):
            if (before.name, name, factor) in advised:
                assert after.margin > before.margin - 1e-9, (before.name, name)
                better |= {before.name} if after.margin > before.margin + 1e-9 else set()
    return better


def with_motor_of(workshop: Workshop, torque_nm: float) -> Workshop:
    """Return a workshop whose motors bear another torque."""
    safety = workshop.safety.model_copy(update={"motor_torque_max_nm": torque_nm})
    return workshop.model_copy(update={"safety": safety})
