"""What refuses a design before it is built, and by how much: its layout.

A layout ends with its first refusal. Studies keep the missing millimetres, which are learned.
"""

from jumpcad.dimensions import GAP_MM
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, limit
from jumpcad.robot.layout import Layout
from jumpcad.robot.space.sweep import legs_apart_mm


def layout_findings(error: CannotBuildError) -> tuple[Finding, ...]:
    """Return the limit that a refused layout missed, with its negative margin, if it was a number."""
    if error.margin is None:
        return ()
    return (Finding(error.limit, "error", error.margin, error.unit, str(error), ""),)


def room_findings(layout: Layout, reserve_mm: float) -> tuple[Finding, ...]:
    """Return what a robot has left, above a reserve, of the room for which most designs are refused."""
    gap, room, way = legs_apart_mm(layout.linkage, layout.sections), layout.stop.room_mm, layout.pin_hole.room_mm
    needed = GAP_MM + reserve_mm
    apart = f"main leg and front link are {gap:.2f} mm apart, of {needed:g} mm at least"
    return (
        limit("legs_apart", gap - GAP_MM - reserve_mm, "mm", apart, ""),
        limit("stop_room", room, "mm", f"the rest stop has {room:.2f} mm of room, of 0 mm at least", ""),
        limit("pin_way", way, "mm", f"the leg's pin has {way:.2f} mm of room on its way, of 0 mm at least", ""),
    )
