"""Its doors."""

from jumpcad.robot.thing import Check, Thing
from jumpcad.robot.train import limits
from jumpcad.robot.train.bought import motor
from jumpcad.robot.train.drawing import train

TRAIN = Thing(
    train,
    motor,
    (
        Check(limits.drive_findings, limits.BASIS),
        Check(limits.blocked_findings, limits.BLOCKED_BASIS),
    ),
)
