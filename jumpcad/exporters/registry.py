"""The registry of file formats; a new one is a module and a line in `EXPORTERS`."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from jumpcad.exporters.dxf import dxf_files
from jumpcad.exporters.glb import glb_files
from jumpcad.exporters.mjcf_robot import mjcf_files
from jumpcad.exporters.ros2 import ros2_files
from jumpcad.exporters.sdf import sdf_files
from jumpcad.exporters.step import require_step, step_files
from jumpcad.exporters.stl import stl_files
from jumpcad.exporters.threemf import threemf_files
from jumpcad.exporters.urdf import urdf_files
from jumpcad.robot.robot import Robot

Files = Iterable[tuple[str, str | bytes]]
"""Paths, relative to a bundle's folder and written with '/', with their contents."""


@dataclass(frozen=True)
class Exporter:
    """An entry of the registry: a name, and the function that makes files from a robot.

    An `optional` one writes only on request, by name; `require` raises `JumpcadError` if a library that it needs is
    missing.
    """

    name: str
    files: Callable[[Robot], Files]
    optional: bool = False
    require: Callable[[], None] = lambda: None


EXPORTERS = (
    Exporter("stl", stl_files),
    Exporter("step", step_files, optional=True, require=require_step),
    Exporter("3mf", threemf_files),
    Exporter("urdf", urdf_files),
    Exporter("mjcf", mjcf_files),
    Exporter("sdf", sdf_files),
    Exporter("glb", glb_files),
    Exporter("dxf", dxf_files),
    Exporter("ros2", ros2_files, optional=True),
)
"""Every file format, in the order in which a bundle's files are written."""


def chosen(optional: Iterable[str] = ()) -> list[Exporter]:
    """Return the exporters of a bundle: all that are not optional, and the optional ones that are named."""
    named = set(optional)
    exporters = [exporter for exporter in EXPORTERS if not exporter.optional or exporter.name in named]
    for exporter in exporters:
        exporter.require()
    return exporters
