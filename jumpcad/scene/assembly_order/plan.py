"""What a step of assembly does: its moves of parts, each with direction and tool.

Parts are named by regular expressions. Parts that a robot lacks are left out.
Lengths and diameters of tools are those of a usual screwdriver, key or pair of pliers.
"""

from dataclasses import dataclass
from typing import Literal

ROBOT, LEG, FRONT, FOOT, STOP = "robot", "leg", "front link", "foot", "rest stop"
LOWER, UPPER, LEFT = "lower tray", "upper tray", "left plate"
"""Assemblies: the robot is built up on the right plate, the others on the bench."""
TOE_PADS = "toe_(left|right)_pad"
"""Pads under the toes' tips, which come on with toes that are parts of their own."""


@dataclass(frozen=True)
class Tool:
    """A straight tool: the cylinder along the fastener's axis, from its end outwards, that must be free (mm)."""

    name: str
    diameter_mm: float
    length_mm: float


HEX_M3 = Tool("hex key 2 mm, long end", 3.0, 50.0)
"""ISO 2936: 2.3 mm across corners, long arm 50 mm."""
TORX_M2 = Tool("screwdriver T6", 3.0, 50.0)
"""Socket 6 of ISO 14580; a blade of 3 mm."""
HEX_AXLE = Tool("hex key 2.5 mm, long end", 3.5, 50.0)
NUT_M3 = Tool("nut driver 5.5 mm", 9.0, 40.0)
PLIERS = Tool("needle-nose pliers", 4.0, 40.0)
"""Both jaws together at the tip of electronics pliers; judgement."""
CLIP = Tool("clip applicator", 6.0, 30.0)
PRESS = Tool("flat-ended bolt or thumb", 8.0, 40.0)


@dataclass(frozen=True)
class Move:
    """Things that take their place together.

    Attributes
    ----------
    parts
        Pattern of their names.
    along
        A side from which they come, `head last` for screws and pins, `from outside` for toes, `from the leg`,
        `into its notch` for a hoop of the cage, or `sideways` for a clip: from any side that is free.
    way
        How the path is checked. `straight`: along its whole length, on the shapes; `bent`: over the part's own size
        only, for split pins, which pliers bring; `snapped`: likewise, sideways onto a groove; `laid`: not at all, for
        what is soldered or flexible.
    past
        Pattern of parts that may be in the way, because one of the two yields.
    through
        Pattern of parts with a hole on the path: the picture shows what moves before it.
    tool, reach
        What fastens them, and the side from which the tool comes: by default `along`, else one of its values.
    trial
        Whether it is taken off again at the end of the step.
    brings
        An assembly of an earlier step that is put on as one piece.
    retention
        The kinds of axle retention with which this move is needed; empty: all.
    lacks
        Pattern of things with which this move is made in a later step.
    """

    parts: str
    along: str = "from the left"
    way: Literal["straight", "snapped", "bent", "laid"] = "straight"
    past: str = ""
    through: str = ""
    tool: Tool | None = None
    reach: str = ""
    trial: bool = False
    brings: str = ""
    retention: tuple[str, ...] = ()
    lacks: str = ""


@dataclass(frozen=True)
class Plan:
    """A step for any robot: its moves onto an assembly. Its words are in `templates/guides/steps/KEY.md.j2`."""

    key: str
    title: str
    onto: str = ROBOT
    moves: tuple[Move, ...] = ()


def pin_moves(name: str, reach: str, clips: tuple[str, str] = ("from the right", "from the left")) -> tuple[Move, ...]:
    """Return the moves of a pin with its split pin, to which pliers come from a side, or with its clips."""
    return (
        Move(name, "from the left"),
        Move(rf"{name}_split_pin", "from the front", "bent", past=name, tool=PLIERS, reach=reach),
        *clip_moves(name, clips),
    )


def clip_moves(name: str, reach: tuple[str, str] = ("from the right", "from the left")) -> tuple[Move, ...]:
    """Return the moves of the clips at the right and the left end of an axle, sideways onto their grooves."""
    return tuple(
        Move(rf"({name})_clip_{end}", "sideways", "snapped", past=rf"({name})", tool=CLIP, reach=side)
        for end, side in enumerate(reach, start=1)
    )
