"""Its doors."""

from jumpcad.robot.plates import engraving_limits, limits
from jumpcad.robot.plates.bought import standoffs
from jumpcad.robot.plates.drawing import plates
from jumpcad.robot.thing import Check, Thing

PLATES = Thing(
    plates,
    standoffs,
    (
        Check(limits.seat_finding, limits.BASIS),
        Check(engraving_limits.engraving_findings, engraving_limits.BASIS, cheap=False),
    ),
)
