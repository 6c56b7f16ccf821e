"""Its doors."""

from jumpcad.robot.plates import limits
from jumpcad.robot.plates.bought import standoffs
from jumpcad.robot.plates.drawing import plates
from jumpcad.robot.thing import Check, Thing

PLATES = Thing(
    plates,
    standoffs,
    (
        Check(limits.seat_finding, limits.BASIS),
        Check(limits.engraving_findings, limits.ENGRAVING_BASIS, cheap=False),
    ),
)
