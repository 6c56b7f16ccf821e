"""STL: one file per printed part, in printing orientation, mm; also for pads that are printed of a soft material."""

from collections.abc import Iterator

from jumpcad.parts.plates import Printable
from jumpcad.robot.foot.pads import printed_pads
from jumpcad.robot.robot import Robot
from jumpcad.solids.stl import require_part, write_stl


def stl_files(robot: Robot) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every part's file."""
    parts: list[Printable] = [*robot.parts, *printed_pads(robot.hardware, robot.workshop)]
    for part in parts:
        stl = write_stl(part.mesh)
        require_part(part.name, stl)
        yield f"stl/{part.name}.stl", stl
