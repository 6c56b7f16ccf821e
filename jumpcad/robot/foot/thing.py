"""Its doors."""

from jumpcad.robot.foot import limits, sideways, toe_limits
from jumpcad.robot.foot.bought import foot_hardware
from jumpcad.robot.foot.drawing import foot_and_toes
from jumpcad.robot.thing import Check, Thing

FOOT = Thing(
    foot_and_toes,
    foot_hardware,
    (
        Check(toe_limits.toe_findings, toe_limits.BASIS),
        Check(limits.ground_findings, limits.BASIS),
        Check(sideways.sideways_findings, sideways.BASIS),
    ),
)
