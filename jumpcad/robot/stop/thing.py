"""Its doors."""

from jumpcad.robot.foot.pads import stop_pad
from jumpcad.robot.stop.drawing import stop_bar
from jumpcad.robot.stop.limits import BASIS, stop_findings
from jumpcad.robot.thing import Check, Thing

STOP = Thing(stop_bar, stop_pad, (Check(stop_findings, BASIS),))
