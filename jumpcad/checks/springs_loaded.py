"""With springs loaded: clearance of the body above the foot (mm), and does a robot with a cage roll onto its feet?"""

from collections.abc import Iterator

from jumpcad.checks.interference import Position, box_of, pieces_of, pose_of
from jumpcad.collision.hulls import least_share_on_feet
from jumpcad.findings import Basis, Finding, at_least, higher, limit, lower
from jumpcad.mechanism.model import BODY, FOOT
from jumpcad.robot.cage.place import Cage
from jumpcad.robot.robot import Robot
from jumpcad.transforms import Array

FOOT_GAP_MM = 0.5
"""Least gap; judgement: play of the joints and the flexing of legs and foot."""
SEARCH_MM = 3.0
"""Larger gaps are not measured."""
BASIS = {
    "foot_clearance": Basis(
        f"least distance of the foot from what the body carries, springs loaded ≥ {FOOT_GAP_MM:g} mm",
        f"solids, exact; {FOOT_GAP_MM:g} mm: judgement, as for the ground",
    )
}


def foot_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `foot_clearance`: the gap between the foot and what the body carries, springs loaded (exact)."""
    layout = robot.layout
    linkage = robot.linkage
    loaded = Position("springs loaded", -robot.design.compression_rad, layout.drive.cam.law.lift_rad)

    body, foot = (
        [(piece, pose_of(piece, layout, linkage, loaded)) for piece in pieces_of(robot) if piece.body == name]
        for name in (BODY, FOOT)
    )
    gaps = (
        (one.solid.transform(T_one[:3]).min_gap(other.solid.transform(T_other[:3]), SEARCH_MM), one.name)
        for one, T_one in body
        for other, T_other in foot
        if _near(box_of(one, T_one), box_of(other, T_other))
    )
    gap, name = min(gaps, default=(SEARCH_MM, ""))
    found = f"{name} comes within {gap:.1f} mm" if gap < SEARCH_MM else f"nothing comes within {gap:g} mm"
    yield limit(
        "foot_clearance", gap - FOOT_GAP_MM, "mm",
        f"{found} of the foot with loaded springs; {FOOT_GAP_MM:g} mm are needed",
        lower("compression_ratio") + higher("ground_link_angle_deg"),
        value=gap if gap < SEARCH_MM else None, allowed=FOOT_GAP_MM,
    )  # fmt: skip


def _near(a: Array, b: Array) -> bool:
    """Whether two boxes (2, 3) may be nearer to each other than is searched."""
    return bool((a[0] < b[1] + SEARCH_MM).all() and (b[0] < a[1] + SEARCH_MM).all())


RIGHTED = 90.0
"""Least percentage of stable poses on its feet, wherever the centre of mass is within its shifts. Judgement: robots
above it rose from every drop in simulation."""
CROUCH = (*higher("compression_ratio", note="it crouches lower"), "take the sizes that jumpcad cage DESIGN finds")
RIGHTING_BASIS = {
    "cage_rights": Basis(
        f"least share of stable poses on the feet ≥ {RIGHTED:g} %, springs loaded, the centre of mass as computed and "
        "moved by 3 mm up, 4 mm along, 2 mm across",
        "Goldberg et al., Part pose statistics (1999); limit: judgement",
    )
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
