"""What a builder uses up, and spares: rows of the bill without mass or price, since none of it stays on the robot."""

from jumpcad.robot.cage.place import Cage
from jumpcad.robot.foot.pads import printed_pads
from jumpcad.robot.robot import Robot

ALWAYS = (
    "solder with flux core, 0.5 to 1 mm", "heat-shrink tube 4 mm, 0.1 m", "super glue (CA), thin", "isopropyl alcohol",
    "grease, silicone or lithium", "light oil", "adhesive tape", "emery cloth", "spare cable ties 2.5 mm",
    "spare foam tape",
)  # fmt: skip
DUST = ("gloves", "mask (FFP2)", "sandpaper")
"""For fibre that is cut and sanded."""


def used_up(robot: Robot) -> tuple[str, ...]:
    """Return the names of what the guide tells the builder to use up."""
    layout, parts = robot.layout, robot.electrical_parts.components
    found = list(ALWAYS)
    if "plug" in parts:
        found.append("second battery and socket like the robot's, leads insulated")
    if printed_pads(robot.hardware, robot.workshop):
        found.append("super glue (CA) that stays flexible")
    if layout.of(Cage) is not None or layout.leg_bar is not None:
        found += DUST
    if layout.leg_bar is not None:
        found += ["epoxy, two components, movable for 20 min or longer, 5 g", "baking paper"]
    return tuple(found)
