"""Bills of materials read back."""

import csv
import io

from jumpcad.bundle.bom import bill_of_materials, write_bom
from jumpcad.robot import Robot


def rows(robot: Robot) -> list[dict[str, str]]:
    """Return the lines of a robot's bill but for its total."""
    lines = table(write_bom(bill_of_materials(robot)))
    assert lines[-1]["kind"] == "total"
    return lines[:-1]


def table(bom: str) -> list[dict[str, str]]:
    """Return the lines of a bill."""
    return list(csv.DictReader(io.StringIO(bom)))
