"""Its doors."""

from jumpcad.robot.sensor.bought import sensor
from jumpcad.robot.sensor.drawing import sensor_mount
from jumpcad.robot.sensor.limits import BASIS, sensor_findings
from jumpcad.robot.thing import Check, Thing

SENSOR = Thing(sensor_mount, sensor, (Check(sensor_findings, BASIS),))
