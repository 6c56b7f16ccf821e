"""Its doors."""

from jumpcad.robot.electronics import holding, lead_limits, limits
from jumpcad.robot.electronics.trays import trays
from jumpcad.robot.electronics.wired import electronics
from jumpcad.robot.thing import Check, Thing

ELECTRONICS = Thing(
    trays,
    electronics,
    (
        Check(limits.electronics_findings, limits.BASIS),
        Check(holding.holding_findings, holding.BASIS),
        Check(lead_limits.lead_findings, lead_limits.BASIS, cheap=False),
    ),
)
