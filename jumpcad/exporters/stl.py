"""STL: one file per printed part, in printing orientation, mm; also for pads that are printed of a soft material."""

from collections.abc import Iterator

from jumpcad.parts.pads import is_printed
from jumpcad.robot import Robot
from jumpcad.solids.finish import require_part, to_trimesh
from jumpcad.solids.stl import write_stl


def stl_files(robot: Robot) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every part's file.

    Raises
    ------
    CannotBuildError
        If a part's file is not one closed solid.
    """
    for part in robot.parts:
        stl = write_stl(part.mesh)
        require_part(part.name, stl)
        yield f"stl/{part.name}.stl", stl
    workshop = robot.workshop
    for item in robot.hardware:
        if is_printed(item, workshop.foot_pad, workshop.stop_pad):
            stl = write_stl(to_trimesh(item.solid))
            require_part(item.name, stl)
            yield f"stl/{item.name}.stl", stl
