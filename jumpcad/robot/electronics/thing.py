"""Its doors."""

from jumpcad.robot.electronics import limits
from jumpcad.robot.electronics.trays import trays
from jumpcad.robot.electronics.wired import electronics
from jumpcad.robot.thing import Check, Thing

ELECTRONICS = Thing(
    trays,
    electronics,
    (
        Check(limits.electronics_findings, limits.BASIS),
        Check(limits.holding_findings, limits.HOLDING_BASIS),
        Check(limits.lead_findings, limits.LEADS_BASIS, cheap=False),
    ),
)
