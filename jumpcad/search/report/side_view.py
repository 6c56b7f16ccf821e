"""The linkage of a design from the side, at rest and with loaded springs, as SVG inside a page.

Drawn from the eight numbers alone: links are the lines between their joints. Both poses stand on the same flat foot.
"""

from collections.abc import Iterable

import numpy as np

from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import Linkage
from jumpcad.scene.parameters import standing_joints
from jumpcad.search.report.text import escape_html
from jumpcad.transforms import Array

POINTS = ("toe tip", "ankle", "front eye", "front pivot", "back pivot")
LINKS = {
    "toes": ("toe tip", "ankle"),
    "foot": ("ankle", "front eye"),
    "front link": ("front eye", "front pivot"),
    "main leg": ("ankle", "back pivot"),
    "body": ("back pivot", "front pivot"),
}
POSES = {"loaded": "springs loaded", "rest": "at rest"}
"""Poses in the order in which they are drawn, and their labels."""
SCALE_BAR_MM = 50
EDGE_MM = 12.0

Box = tuple[float, float, float, float]
"""Lowest x and z, highest x and z (mm)."""


def joints_mm(design: Design) -> dict[str, Array]:
    """Return the `POINTS` (5, 2) of each pose in mm: x forward from the ankle, z up from the ground.

    Raises
    ------
    CannotBuildError
        If the design has no assembled pose, or its loop does not close when loaded.
    """
    found = {}
    for name, leg_rad in zip(POSES, (-design.compression_rad, 0.0), strict=True):
        # Toes spread sideways, so that from the side they look shorter.
        at = standing_joints(Linkage(design), leg_rad)
        corners = (at[one] for one in ("toe", "ankle", "eye", "front", "back"))
        found[name] = np.round([(point.real, point.imag) for point in corners], 1) + 0.0
    return found


def box_mm(designs: Iterable[Design]) -> Box:
    """Return the common bounding box of designs in both poses, so that they are drawn to one scale."""
    corners = [np.zeros((1, 2))]
    for design in designs:
        try:
            corners += joints_mm(design).values()
        except CannotBuildError:
            continue
    every = np.concatenate(corners)
    low, high = every.min(axis=0) - EDGE_MM, every.max(axis=0) + EDGE_MM
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def side_view(design: Design, box: Box) -> str:
    """Return the side view as an SVG element; a paragraph with the reason if the design has no such poses."""
    try:
        poses = joints_mm(design)
    except CannotBuildError as error:
        return f"<p>{escape_html(str(error))}</p>"
    left, low, right, high = box
    width, height = right - left, high - low + 16.0
    lines = [
        f'<svg class="side" viewBox="{left:.1f} {-high:.1f} {width:.1f} {height:.1f}" role="img" '
        'aria-label="the linkage from the side, at rest and with loaded springs">',
        f'<path class="ground" d="M{left:.1f} 0H{right:.1f}" />',
    ]
    for name, meaning in POSES.items():
        place = dict(zip(POINTS, poses[name].tolist(), strict=True))
        lines.append(f'<g class="{name}"><title>{meaning}</title>')
        for link, (start, end) in LINKS.items():
            (x, z), (u, w) = place[start], place[end]
            kind = link.replace(" ", "-")
            line = f"M{x:.1f} {0.0 - z:.1f}L{u:.1f} {0.0 - w:.1f}"
            lines.append(f'<path class="{kind}" d="{line}"><title>{link}, {meaning}</title></path>')
        lines += [f'<circle cx="{x:.1f}" cy="{0.0 - z:.1f}" r="2.2" />' for x, z in list(place.values())[1:]]
        lines.append("</g>")
    below = 9.0 - low - EDGE_MM
    lines += [
        f'<path class="scale" d="M{left + 4:.1f} {below:.1f}h{SCALE_BAR_MM}" />',
        f'<text x="{left + 4:.1f}" y="{below + 9:.1f}">{SCALE_BAR_MM} mm</text>',
        "</svg>",
    ]
    return "\n".join(lines)
