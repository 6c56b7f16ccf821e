"""A labelled drawing of the eight parameters of a design, as SVG: at rest, springs loaded, and the foot from above."""

import cmath
import math
from collections.abc import Sequence
from html import escape

from jumpcad.design import Design
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.planar import points

WIDTH_PX, HEIGHT_PX = 1000, 330
PANEL_PX = 230.0
"""Width of the largest drawing in a panel."""
BASE_PX = 270.0
"""Height of the ground line, below the picture's upper edge."""
EXTENSION_PX = 46.0
"""Length of the body's line beyond the front pivot: both legs are parallel, and there is room for their angle."""
BELOW_ARC = 0.66
"""Where the front link's label is along it, so that it is below that of the angle."""
BODY, LEG, FRONT, FOOT, INK, GHOST = "#4a4f57", "#1f6fb2", "#c8641a", "#2f8f4e", "#22262b", "#9aa1aa"

Points = dict[str, complex]


def parameter_drawing(design: Design) -> str:
    """Return the SVG document of a design's drawing; every parameter is a label with its value.

    Raises
    ------
    CannotBuildError
        If the design has no assembled pose, or its loop does not close with loaded springs.
    """
    linkage = Linkage(design)
    rest, loaded = standing_joints(linkage, 0.0), standing_joints(linkage, -design.compression_rad)
    scale = PANEL_PX / max(_width(rest), _width(loaded), design.l4_mm + design.l5_mm)
    panels = [
        _panel(80, "At rest", _at_rest(design, rest, scale)),
        _panel(430, "Springs loaded", _with_springs_loaded(design, linkage, loaded, scale)),
        _panel(735, "The foot, from above", _foot(design, scale)),
    ]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH_PX} {HEIGHT_PX}" '
        'font-family="DejaVu Sans, Arial, sans-serif" font-size="12" role="img">'
    )
    title = "<title>The eight parameters of a design</title>"
    background = f'<rect width="{WIDTH_PX}" height="{HEIGHT_PX}" fill="#ffffff"/>'
    return "\n".join([head, title, background, *panels, "</svg>"]) + "\n"


def standing_joints(linkage: Linkage, leg_rad: float) -> Points:
    """Return the joints in the frame of the ankle with the foot flat, as x + iz (mm); the toes' tip from the side."""
    pose = linkage.pose([leg_rad])
    turn = cmath.exp(1j * float(pose.foot_rad[0]))
    ankle, eye = (complex(points(joint)[0]) for joint in (pose.ankle_mm, pose.front_eye_mm))
    back, front = (complex(points(joint)) for joint in (linkage.back_pivot_mm, linkage.front_pivot_mm))
    seen = {name: (joint - ankle) * turn for name, joint in {"back": back, "front": front, "eye": eye}.items()}
    return seen | {"ankle": 0j, "toe": complex(float(toe_tip_mm(linkage.design)[0]), 0.0)}


def _width(joints: Points) -> float:
    along = [joint.real for joint in joints.values()]
    return max(along) - min(along)


def _at_rest(design: Design, joints: Points, scale: float) -> list[str]:
    at = _placed(joints, scale)
    body = cmath.phase(joints["front"] - joints["back"])
    leg = cmath.phase(joints["eye"] - joints["front"])
    along_body = at["front"] + EXTENSION_PX * _below(body)
    return [
        _ground(at),
        _line(at["front"], along_body, GHOST, 1.0, dashed=True),
        *_links(at),
        _arc(at["front"], 34.0, leg, body),
        _coil(at["back"]),
        _label(_middle(at["back"], at["ankle"]) + complex(-10, -8), "end", "carrying_link_mm",
               f"{design.l2_mm:g} mm", LEG),
        _label(at["front"] + BELOW_ARC * (at["eye"] - at["front"]) + complex(10, -8), "start", "c_coef",
               f"× main leg = {design.l3_mm:.1f} mm", FRONT),
        _label(_middle(at["ankle"], at["eye"]) + complex(0, 22), "middle", "d_coef",
               f"× main leg = {design.l4_mm:.1f} mm", FOOT),
        _label(at["front"] + 42.0 * _below(0.5 * (leg + body)), "start", "rest_angle_deg",
               f"{design.rest_angle_deg:g}°", INK),
        _label(at["back"] + complex(0, -38), "middle", "stiffness_nmm_per_deg",
               f"{design.stiffness_nmm_per_deg:g} N·mm/°, both springs", INK),
    ]  # fmt: skip


def _with_springs_loaded(design: Design, linkage: Linkage, joints: Points, scale: float) -> list[str]:
    at = _placed(joints, scale)
    body = cmath.phase(joints["front"] - joints["back"])
    leg = cmath.phase(joints["ankle"] - joints["back"])
    before = body - linkage.rest_rad
    ghost = at["back"] + scale * design.l2_mm * _below(before)
    degrees, top = math.degrees(design.compression_rad), min(at["back"].imag, at["front"].imag)
    return [
        _ground(at),
        _line(at["back"], ghost, GHOST, 2.0, dashed=True),
        *_links(at),
        _arc(at["back"], 60.0, before, leg),
        _label(complex(at["back"].real - 6.0, top - 30.0), "start", "compression_ratio",
               f"{design.compression_ratio:.3g} of the way to a flat leg: {degrees:.1f}°", INK),
    ]  # fmt: skip


def _foot(design: Design, scale: float) -> list[str]:
    ankle = complex(scale * design.l5_mm * math.cos(math.radians(design.ground_link_angle_deg)), -90.0)
    eye = ankle + scale * design.l4_mm
    angle = math.radians(design.ground_link_angle_deg)
    back = complex(-math.cos(angle), math.sin(angle))
    tips = [ankle + scale * design.l5_mm * toe for toe in (back, back.conjugate())]
    return [
        _line(ankle, ankle - scale * design.l5_mm, GHOST, 1.0, dashed=True),
        _line(ankle, eye, FOOT, 6.0),
        *(_line(ankle, tip, FOOT, 4.0) for tip in tips),
        *(_joint(joint) for joint in (ankle, eye)),
        _arc(ankle, 44.0, math.pi - angle, math.pi),
        _label(tips[1] + complex(0, -24), "start", "e_coef", f"× main leg = {design.l5_mm:.1f} mm each", FOOT),
        _label(tips[0] + complex(0, 22), "start", "ground_link_angle_deg", f"{design.ground_link_angle_deg:g}°", INK),
    ]


def _placed(joints: Points, scale: float) -> Points:
    """Return where joints are drawn: x to the right, y down, from the lower left corner of a panel's drawing (px)."""
    left = min(joint.real for joint in joints.values())
    return {name: scale * (joint - left).conjugate() for name, joint in joints.items()}


def _links(at: Points) -> list[str]:
    pairs = (("ankle", "toe", FOOT, 3.0), ("ankle", "eye", FOOT, 6.0), ("front", "eye", FRONT, 5.0),
             ("back", "ankle", LEG, 6.0), ("back", "front", BODY, 9.0))  # fmt: skip
    lines = [_line(at[one], at[other], colour, width) for one, other, colour, width in pairs]
    return [*lines, *(_joint(at[name]) for name in ("back", "front", "ankle", "eye"))]


def _panel(left_px: float, title: str, content: Sequence[str]) -> str:
    heading = f'<text x="{left_px + PANEL_PX / 2.0:g}" y="28" text-anchor="middle" font-size="15" fill="{INK}">'
    return "\n".join(
        [f"{heading}{escape(title)}</text>", f'<g transform="translate({left_px:g} {BASE_PX:g})">', *content, "</g>"]
    )


def _ground(at: Points) -> str:
    return _line(complex(at["toe"].real - 8, 6), complex(at["eye"].real + 8, 6), GHOST, 1.0)


def _line(start: complex, end: complex, colour: str, width: float, dashed: bool = False) -> str:
    dashes = ' stroke-dasharray="5 4"' if dashed else ""
    return (
        f'<line x1="{start.real:.1f}" y1="{start.imag:.1f}" x2="{end.real:.1f}" y2="{end.imag:.1f}" '
        f'stroke="{colour}" stroke-width="{width:g}" stroke-linecap="round"{dashes}/>'
    )


def _joint(at: complex) -> str:
    return f'<circle cx="{at.real:.1f}" cy="{at.imag:.1f}" r="4" fill="#ffffff" stroke="{INK}" stroke-width="1.5"/>'


def _arc(centre: complex, radius: float, start_rad: float, end_rad: float) -> str:
    """Return the arc between two directions, counter-clockwise from the first one; less than half a turn."""
    start, end = (centre + radius * _below(angle) for angle in (start_rad, end_rad))
    sweep = int((end_rad - start_rad) % (2.0 * math.pi) > math.pi)
    return (
        f'<path d="M {start.real:.1f} {start.imag:.1f} A {radius:g} {radius:g} 0 0 {sweep} {end.real:.1f} '
        f'{end.imag:.1f}" fill="none" stroke="{INK}" stroke-width="1.5"/>'
    )


def _coil(centre: complex) -> str:
    """Return the springs about the leg's pivot, as a spiral."""
    turns = [centre + (7.0 + 0.25 * step) * _below(0.3 * step) for step in range(64)]
    path = " ".join(f"{at.real:.1f},{at.imag:.1f}" for at in turns)
    return f'<polyline points="{path}" fill="none" stroke="{INK}" stroke-width="1"/>'


def _label(at: complex, anchor: str, name: str, value: str, colour: str) -> str:
    over_lines = 'stroke="#ffffff" stroke-width="3" paint-order="stroke"'
    where = f'x="{at.real:.1f}" text-anchor="{anchor}" {over_lines}'
    return (
        f'<text {where} y="{at.imag:.1f}" font-weight="bold" class="parameter" fill="{colour}">{name}</text>'
        f'<text {where} y="{at.imag + 14.0:.1f}" font-size="11" fill="{INK}">{escape(value)}</text>'
    )


def _below(angle_rad: float) -> complex:
    """Return the unit vector of a direction, counter-clockwise from the right, with y down."""
    return cmath.exp(-1j * angle_rad)


def _middle(one: complex, other: complex) -> complex:
    return (one + other) / 2.0
