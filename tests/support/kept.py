"""Functions that are called once for each of their cases: for tests of what becomes of the results."""

import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from jumpcad.parts.plates import PrintPlate
from jumpcad.robot.robot import Robot


def once(known: dict[object, Any], make: Callable[..., Any], key: Callable[..., object]) -> Callable[..., Any]:
    """Return a function that keeps its results in `known`, by its name and the key of its arguments."""

    def kept(*arguments: Any) -> Any:
        case = (make.__name__, key(*arguments))
        if case not in known:
            done = make(*arguments)
            known[case] = tuple(done) if isinstance(done, Iterator) else done
        return known[case]

    return kept


def robot_key(robot: Robot, *more: Any) -> object:
    """Return what tells robots apart: design, workshop, name, and the names of their parts."""
    parts = tuple(part.name for part in robot.parts)
    return robot.design.to_toml(), robot.workshop and robot.workshop.to_toml(), robot.name, parts, str(more)


def plate_key(plate: PrintPlate, bed_mm: Sequence[float]) -> object:
    """Return what a picture of a plate on a bed shows: the meshes of its parts, where each lies, and the bed."""
    seen = hashlib.sha256(repr(tuple(bed_mm)).encode())
    for placed in plate.items:
        mesh = placed.part.shown_mesh
        seen.update(repr((mesh.vertices.shape, mesh.faces.shape)).encode())
        for numbers in (mesh.vertices, mesh.faces, placed.T_bed_part):
            seen.update(numbers.tobytes())
    return seen.digest()


def threemf_key(plate: PrintPlate, settings: Mapping[str, str], picture: bytes) -> object:
    """Return what a plate's file holds: names, meshes and places of its parts, settings, and its picture."""
    seen = hashlib.sha256(picture)
    for placed in plate.items:
        mesh = placed.part.mesh
        seen.update(repr((placed.part.name, mesh.vertices.shape, mesh.faces.shape)).encode())
        for numbers in (mesh.vertices, mesh.faces, placed.T_bed_part):
            seen.update(numbers.tobytes())
    return plate.name, plate.material, tuple(settings.items()), seen.digest()
