"""Design and workshop of a bundle, from which the same robot can be built again."""

from jumpcad.building import build
from jumpcad.bundle.manifest import Bundle
from jumpcad.design import Design, load_design
from jumpcad.errors import JumpcadError
from jumpcad.files import read_toml
from jumpcad.robot import Robot
from jumpcad.workshop import Workshop, load_workshop

DESIGN = "design.toml"
WORKSHOP = "workshop.toml"


def kept_robot(bundle: Bundle) -> Robot:
    """Return the robot of a bundle, built again; raise what `kept_design`, `kept_workshop` and `build` raise."""
    return build(kept_design(bundle), kept_workshop(bundle), bundle.name)


def kept_design(bundle: Bundle) -> Design:
    """Return the design of a bundle.

    Raises
    ------
    JumpcadError
        If its file is missing, is a link, or is not a design.
    """
    return load_design(bundle.file(DESIGN))


def kept_workshop(bundle: Bundle) -> Workshop:
    """Return the workshop of a bundle.

    Raises
    ------
    JumpcadError
        If its file is missing, is a link, is not a workshop, or names another file.
    """
    path = bundle.file(WORKSHOP)
    data, _ = read_toml(path)
    for key in ("base", "printer"):
        if isinstance(data.get(key), str):
            raise JumpcadError(
                f"{path}: {key} = {data[key]!r}: a bundle's workshop is complete and names no other file"
            )
    return load_workshop(path)
