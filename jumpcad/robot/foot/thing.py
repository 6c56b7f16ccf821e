"""Its doors."""

from jumpcad.robot.foot import limits, sideways
from jumpcad.robot.foot.drawing import foot_and_toes
from jumpcad.robot.foot.pads import foot_hardware
from jumpcad.robot.thing import Check, Thing

FOOT = Thing(
    foot_and_toes,
    foot_hardware,
    (
        Check(limits.toe_findings, limits.BASIS),
        Check(limits.ground_findings, limits.GROUND_BASIS),
        Check(sideways.sideways_findings, sideways.BASIS),
    ),
)
