"""What commands are given: a template, a design file, a bundle, or a URDF file."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jumpcad.mechanism.model import Mechanism
    from jumpcad.robot import Robot


def designed(subject: str, workshop: str) -> "Robot":
    """Return the printed robot of a bundle (from the inputs that it keeps), of a template, or of a design file."""
    from jumpcad.building import build as build_robot
    from jumpcad.bundle.manifest import is_bundle, open_bundle
    from jumpcad.design import load_design
    from jumpcad.workshop import load_workshop

    if is_bundle(subject):
        bundle = open_bundle(subject)
        inputs = load_design(bundle.folder / "design.toml"), load_workshop(bundle.folder / "workshop.toml")
        return build_robot(*inputs, bundle.name)
    name = Path(subject).name.removesuffix(".toml")
    return build_robot(load_design(subject), load_workshop(workshop), name)


def written_robot(subject: str) -> "Mechanism | None":
    """Return the mechanism of a bundle or a URDF file, read from that file; None for anything else."""
    from jumpcad.bundle.manifest import is_bundle, open_bundle
    from jumpcad.simulation.from_urdf import robot_from_urdf

    path = Path(subject)
    if path.suffix == ".urdf":
        return robot_from_urdf(path)
    return robot_from_urdf(open_bundle(path).urdf) if is_bundle(path) else None
