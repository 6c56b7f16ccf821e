"""What refuses a design before it is built, and by how much: an estimate of its masses, and its layout.

A robot that falls or is too weak whatever the error of `estimated_masses` is not built. One direction of each error
alone can refuse wrongly: less energy is needed than estimated, or the centre of mass is farther ahead.
`benchmarks/refuse.py` measures both in robots that no other limit rejects; a reserve is added.

A layout ends with its first refusal. Studies keep the missing millimetres, which are learned.
"""

from dataclasses import replace

from jumpcad.design import Design
from jumpcad.dimensions import GAP_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, limit
from jumpcad.layout.layout import Layout
from jumpcad.layout.sweep import legs_apart_mm
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search.estimate.estimated_masses import known, robot_of_masses
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop

LIGHTER = 0.18
"""Share by which less energy may be needed than estimated: at most 13 % in 2,301 robots."""
AHEAD_MM = 16.0
"""How far ahead of its estimate the centre of mass may be: at most 12.1 mm in these robots."""


def statics_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return which of `tips` and `too_weak` are violated for certain; none where nothing can be said.

    The margins are those of the estimate. The design has passed the checks of its geometry.
    """
    if not known(design, workshop):
        return ()
    robot = with_spring_factor(robot_of_masses(design, workshop), settings.spring_efficiency)
    return tuple(_estimated(one) for one in statics_findings(robot, settings.gravity_m_s2) if is_certain(one))


def is_certain(finding: Finding) -> bool:
    """Tell whether a limit of the statics is violated whatever the error of the estimate.

    The centre of mass is never too far ahead: the body hangs behind the ankle.
    """
    assert finding.value is not None
    assert finding.limit is not None
    if finding.name == "tips":
        return finding.margin < -AHEAD_MM
    return finding.value < (1.0 - LIGHTER) * finding.limit


def _estimated(finding: Finding) -> Finding:
    error = f"{AHEAD_MM:g} mm" if finding.name == "tips" else f"{100.0 * LIGHTER:g} % of what is needed"
    return replace(finding, message=f"{finding.message}; by an estimate of the masses, at most {error} too strict")


def layout_findings(error: CannotBuildError) -> tuple[Finding, ...]:
    """Return the limit that a refused layout missed, with its negative margin, if it was a number."""
    if error.margin is None:
        return ()
    return (Finding(error.limit, "error", error.margin, error.unit, str(error), ""),)


def room_findings(layout: Layout, reserve_mm: float) -> tuple[Finding, ...]:
    """Return what a robot has left, above a reserve, of the room for which most designs are refused."""
    gap, room = legs_apart_mm(layout.linkage, layout.sections), layout.stop.room_mm
    needed = GAP_MM + reserve_mm
    apart = f"main leg and front link are {gap:.2f} mm apart, of {needed:g} mm at least"
    return (
        limit("legs_apart", gap - GAP_MM - reserve_mm, "mm", apart, ""),
        limit("stop_room", room, "mm", f"the rest stop has {room:.2f} mm of room, of 0 mm at least", ""),
    )
