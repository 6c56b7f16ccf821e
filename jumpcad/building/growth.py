"""The printed robot of a design, strong enough: assembled, judged by strength checks, and grown where it is weak."""

from jumpcad.arguments import typed
from jumpcad.building.assembly import assembled
from jumpcad.checks.strength import strength_findings
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.robot import Robot
from jumpcad.strength.sizing import Growth
from jumpcad.workshop import Workshop, load_workshop

GROWTH_ROUNDS = 10
GROWS_ON_FAILURE = {
    "leg_strength": "leg",
    "leg_flex": "leg",
    "leg_sideways": "thickness",
    "hub_strength": "leg",
    "lever_strength": "lever",
    "front_link_strength": "front",
    "front_link_buckling": "front",
    "eye_strength": "thickness",
    "foot_lug_strength": "lug",
    "toe_strength": "toe",
    "toe_landing": "toe",
    "toe_joint_strength": "toe",
    "rail_strength": "rail",
    "plate_seat": "plate",
    "cam_key_strength": "key",
}
"""What grows when a check fails: a factor of `Growth`."""


@typed
def build(design: Design, workshop: Workshop | None = None, name: str = "robot") -> Robot:
    """Build the printed robot of a design in a workshop; its name, if it has one, is engraved on its plates.

    Sections grow until the strength checks pass, or until there is no room for more.

    Raises
    ------
    JumpcadError
        If the workshop was changed to what no file may say, or has the weight of a part that no robot has.
    CannotBuildError
        If the mechanism cannot work or cannot be laid out; the message names the reason and what to change.
    JumpcadError
        If an argument is of another type.
    """
    workshop = (workshop or load_workshop("default")).revalidated()
    refused = errors(geometry_findings(design))
    if refused:
        raise CannotBuildError(f"{refused[0].name}: {refused[0].message}: {refused[0].remedy}")
    growth = Growth()
    robot = assembled(design, workshop, name, growth)
    for _ in range(GROWTH_ROUNDS):
        weak = {
            GROWS_ON_FAILURE[finding.name]
            for finding in errors(strength_findings(robot))
            if finding.name in GROWS_ON_FAILURE
        }
        if not weak:
            break
        growth = growth.more(weak)
        try:
            robot = assembled(design, workshop, name, growth)
        except CannotBuildError:  # no room for more: the checks say what stays too weak
            break
    return robot
