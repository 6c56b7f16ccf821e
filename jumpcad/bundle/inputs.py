"""Design and workshop of a bundle, from which the same robot can be built again."""

import os
from pathlib import Path

from jumpcad.building import build
from jumpcad.bundle.manifest import Bundle, open_bundle
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import read_toml, template_names
from jumpcad.robot.robot import Robot
from jumpcad.workshop import Workshop, load_workshop

DESIGN = "design.toml"
WORKSHOP = "workshop.toml"


def robot_of(subject: Design | str | Path, workshop: Workshop | None = None, name: str | None = None) -> Robot:
    """Return the printed robot of what `inputs_of` takes, under its own name unless another is given."""
    design, shop, own_name = inputs_of(subject, workshop)
    return build(design, shop, own_name if name is None else name)


def inputs_of(subject: Design | str | Path, workshop: Workshop | None = None) -> tuple[Design, Workshop, str]:
    """Return design, workshop and name of a design, a template, a design file or a bundle, as the command line does."""
    if isinstance(subject, Design):
        return subject, workshop or load_workshop(subject.workshop_name), "robot"
    if os.path.isdir(subject) and str(subject) not in template_names("robots"):
        bundle = open_bundle(subject)
        if workshop is not None:
            raise JumpcadError(f"{subject}: is a bundle, which has a workshop of its own; leave the workshop out")
        return kept_design(bundle), kept_workshop(bundle), bundle.name
    design = load_design(subject)
    return design, workshop or load_workshop(design.workshop_name), Path(subject).name.removesuffix(".toml")


def kept_robot(bundle: Bundle) -> Robot:
    """Return the robot of a bundle, built again; raise what `kept_design`, `kept_workshop` and `build` raise."""
    return build(kept_design(bundle), kept_workshop(bundle), bundle.name)


def kept_design(bundle: Bundle) -> Design:
    """Return the design of a bundle."""
    return load_design(bundle.file(DESIGN))


def kept_workshop(bundle: Bundle) -> Workshop:
    """Return the workshop of a bundle."""
    path = bundle.file(WORKSHOP)
    data, _ = read_toml(path)
    for key in ("base", "printer"):
        if isinstance(data.get(key), str):
            raise JumpcadError(
                f"{path}: {key} = {data[key]!r}: a bundle's workshop is complete and names no other file"
            )
    return load_workshop(path)
