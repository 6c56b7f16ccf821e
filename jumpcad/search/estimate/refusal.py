"""Signed margins of what can refuse a design while it is laid out: negative in a refusal, positive in a robot.

A refusal ends the layout, so its message would be all that is known of it. Studies keep the missing millimetres, and
the screen learns them.
"""

from jumpcad.dimensions import GAP_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, limit
from jumpcad.layout.layout import Layout
from jumpcad.layout.sweep import legs_apart_mm


def refusal_findings(error: CannotBuildError) -> tuple[Finding, ...]:
    """Return the limit that a refusal missed, if it was a number."""
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
