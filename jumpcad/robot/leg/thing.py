"""Its doors."""

from jumpcad.robot.leg.bought import leg_hardware
from jumpcad.robot.leg.drawing import legs
from jumpcad.robot.leg.limits import BASIS, leg_findings
from jumpcad.robot.thing import Check, Thing

LEG = Thing(legs, leg_hardware, (Check(leg_findings, BASIS),))
