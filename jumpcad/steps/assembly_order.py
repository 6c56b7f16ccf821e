"""The order of assembly for any robot: `templates/guides/assembly_order.toml`, which says what each step does.

Parts are named by regular expressions. Parts that a robot lacks are left out.
"""

from dataclasses import dataclass
from typing import Any, Literal

from jumpcad.files import read_toml, templates_folder

ROBOT, LOWER, UPPER, LEFT = "robot", "lower tray", "upper tray", "left plate"
"""Assemblies that other modules name: the robot is built up on the right plate, the others on the bench."""


@dataclass(frozen=True)
class Tool:
    """A straight tool: the cylinder along the fastener's axis, from its end outwards, that must be free (mm).

    Lengths and diameters are those of a usual screwdriver, key or pair of pliers.
    """

    name: str
    diameter_mm: float
    length_mm: float


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


def _plan(step: dict[str, Any], tools: dict[str, Tool]) -> Plan:
    """Return a step of the file; its moves name their tools."""
    moves = []
    for move in step.pop("moves", ()):
        tool = tools[move.pop("tool")] if "tool" in move else None
        moves.append(Move(**{"parts": "", "tool": tool} | move | {"retention": tuple(move.get("retention", ()))}))
    return Plan(**step, moves=tuple(moves))


_data, _ = read_toml(templates_folder() / "guides" / "assembly_order.toml")
TOOLS = {name: Tool(**tool) for name, tool in _data["tools"].items()}
ORDER: tuple[Plan, ...] = tuple(_plan(step, TOOLS) for step in _data["steps"])
"""What is done, in this order."""
