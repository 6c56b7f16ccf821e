"""Does a robot with a cage roll onto its feet while it winds?"""

from collections.abc import Iterator

from jumpcad.collision.stable_poses import least_share_on_feet
from jumpcad.findings import Basis, Finding, at_least, higher
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.robot import Robot

RIGHTED = 90.0
"""Least percentage of stable poses on its feet, wherever the centre of mass is within its shifts. Judgement: robots
above it rose from every drop in simulation."""
CROUCH = (*higher("compression_ratio", note="it crouches lower"), "take the sizes that jumpcad cage DESIGN finds")
BASIS = {
    "cage_rights": Basis(
        f"least share of stable poses on the feet ≥ {RIGHTED:g} %, springs loaded, the centre of mass as computed and "
        "moved by 3 mm up, 4 mm along, 2 mm across",
        "Goldberg et al., Part pose statistics (1999); limit: judgement",
    ),
}


def righting_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `cage_rights`, a warning; nothing without a cage."""
    if robot.layout.of(Cage) is None:
        return
    share = 100.0 * least_share_on_feet(robot)
    yield at_least(
        "cage_rights", share, RIGHTED, "%",
        f"from {share:.1f} % of all attitudes it rolls onto its feet while it winds, the worst centre of mass assumed; "
        f"{RIGHTED:g} % are needed", CROUCH, "warning",
    )  # fmt: skip
