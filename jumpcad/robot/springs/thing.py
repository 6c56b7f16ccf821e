"""Its doors."""

from jumpcad.robot.springs.bought import springs
from jumpcad.robot.springs.drawing import spring_bushings
from jumpcad.robot.thing import Thing

SPRINGS = Thing(spring_bushings, springs)
