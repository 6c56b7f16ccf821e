"""A labelled drawing of the eight parameters of a design, as SVG: at rest, springs loaded, and the foot from above.

Its lines and labels are in `templates/drawings/parameters.svg.j2`; here is where the joints are.
"""

import cmath
import math

from jumpcad.design import Design
from jumpcad.files.rendering import fill
from jumpcad.mechanism.linkage import Linkage, toe_tip_mm
from jumpcad.mechanism.planar import points

PANEL_PX = 230.0
"""Width of the largest drawing in a panel."""

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
    values = {
        "design": design,
        "width": PANEL_PX,
        "scale": scale,
        "rest": _placed(rest, scale),
        "rest_body_rad": cmath.phase(rest["front"] - rest["back"]),
        "rest_leg_rad": cmath.phase(rest["eye"] - rest["front"]),
        "loaded": _placed(loaded, scale),
        "loaded_leg_rad": cmath.phase(loaded["ankle"] - loaded["back"]),
        "before_rad": cmath.phase(loaded["front"] - loaded["back"]) - linkage.rest_rad,
        "compression_deg": math.degrees(design.compression_rad),
        "foot": _foot(design, scale),
        "toe_rad": math.radians(design.ground_link_angle_deg),
        "pi": math.pi,
        "xy": complex,
        "towards": lambda angle_rad: cmath.exp(-1j * angle_rad),
    }
    return fill("drawings/parameters.svg.j2", values)


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


def _foot(design: Design, scale: float) -> Points:
    """Return the foot's joints from above: the ankle so far from the panel's edge that its toes have room (px)."""
    angle = math.radians(design.ground_link_angle_deg)
    ankle, back = complex(scale * design.l5_mm * math.cos(angle), -90.0), complex(-math.cos(angle), math.sin(angle))
    near, far = (ankle + scale * design.l5_mm * toe for toe in (back, back.conjugate()))
    return {"ankle": ankle, "eye": ankle + scale * design.l4_mm, "near_tip": near, "far_tip": far}


def _placed(joints: Points, scale: float) -> Points:
    """Return where joints are drawn: x to the right, y down, from the lower left corner of a panel's drawing (px)."""
    left = min(joint.real for joint in joints.values())
    return {name: scale * (joint - left).conjugate() for name, joint in joints.items()}
