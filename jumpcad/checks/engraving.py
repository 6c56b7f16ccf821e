"""The robot's name on its plates: can all of its letters be engraved?"""

from jumpcad.findings import Finding, at_most
from jumpcad.robot import Robot
from jumpcad.solids.text import engravable


def engraving_findings(robot: Robot) -> list[Finding]:
    """Return `engraving` for a name with letters that cannot be engraved; they are left out."""
    lacking = "".join(dict.fromkeys(letter for letter in robot.name if not engravable(letter)))
    if not lacking:
        return []
    return [
        at_most(
            "engraving", len(lacking), 0, "letters",
            f"the engraving's font has no {lacking!r}: left out on the plates of {robot.name!r}",
            "use Latin, Greek or Cyrillic letters if the plates must show the whole name", "warning",
        )
    ]  # fmt: skip
