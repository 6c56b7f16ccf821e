"""The robot's name on its plates: can all of its letters be engraved?"""

from jumpcad.findings import Basis, Finding, at_most
from jumpcad.robot.robot import Robot
from jumpcad.solids.text import engravable

BASIS = {"engraving": Basis("letters of the name that the font lacks = 0", "character map of the font")}


def engraving_findings(robot: Robot) -> list[Finding]:
    """Return `engraving` for a name with letters that cannot be engraved; they are left out."""
    lacking = "".join(dict.fromkeys(letter for letter in robot.name if not engravable(letter)))
    if not lacking:
        return []
    return [
        at_most(
            "engraving", len(lacking), 0, "letters",
            f"the engraving's font lacks {len(lacking)} of the letters, {lacking!r}: left out on the plates of "
            f"{robot.name!r}",
            "use Latin, Greek or Cyrillic letters if the plates must show the whole name", "warning",
        )
    ]  # fmt: skip
