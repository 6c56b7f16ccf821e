"""Its doors."""

from jumpcad.robot.robot import Check, Thing
from jumpcad.robot.steering.drawing import steering_hardware, steering_parts
from jumpcad.robot.steering.limits import BASIS, steering_findings
from jumpcad.robot.steering.place import steering_place

STEERING = Thing(steering_parts, steering_hardware, (Check(steering_findings, BASIS),), steering_place)
