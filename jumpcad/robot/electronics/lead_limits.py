"""Whether the leads of sensor and motor keep away from what moves, outside the plates and on their way to the trays."""

import itertools
from collections.abc import Iterator

import numpy as np

from jumpcad.findings import Basis, Finding, at_least, higher
from jumpcad.robot.electronics.leads import way_in
from jumpcad.robot.layout import moving_obstacles
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.room import bar, clearance

NEEDED_MM = 1.5
"""From a lead's middle to what moves; judgement: a lead of 1.2 mm and a millimetre of air."""
APART_MM, AROUND_MM = 1.0, 1.5
"""Between the points that are measured, and how far around a lead across the robot things count."""
FAR_MM = 100.0
"""Larger distances are not told apart."""
BASIS = {
    "wires_clear": Basis(
        f"least distance of a lead's middle from what moves, along its way ≥ {NEEDED_MM:g} mm",
        "geometry; judgement: a lead of 1.2 mm and a millimetre of air",
    )
}


def lead_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `wires_clear`: the least distance of the leads of sensor and motor from what moves."""
    layout = robot.layout
    moving = moving_obstacles(layout)
    gaps: dict[str, float] = {}
    tray = layout.electronics.middle_mm(layout.tray_mm)
    for role in ("sensor", "motor"):
        way = way_in(layout, role)
        if len(way) < 2:
            continue
        ends = [*way, np.array([tray[0], way[-1][1], tray[1]])]
        for start, end in itertools.pairwise(ends):
            y = (min(start[1], end[1]) - AROUND_MM, max(start[1], end[1]) + AROUND_MM)
            points = bar(start[[0, 2]], end[[0, 2]], APART_MM)
            gaps[role] = min(gaps.get(role, np.inf), float(clearance(moving, points, (0.0, 0.0), 0.0, y, FAR_MM).min()))
    if gaps:
        role = min(gaps, key=lambda name: gaps[name])
        gap = min(gaps[role], FAR_MM)
        far = "at least " if gap == FAR_MM else ""
        yield at_least(
            "wires_clear", gap, NEEDED_MM, "mm",
            f"the {role}'s leads pass {far}{gap:.1f} mm from what moves; {NEEDED_MM:g} mm are needed",
            higher("d_coef", "carrying_link_mm", note="a longer body"),
        )  # fmt: skip
