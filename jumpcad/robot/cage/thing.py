"""Its doors."""

from jumpcad.robot.cage.drawing import cage_bars, cage_hardware
from jumpcad.robot.cage.limits import BASIS, cage_findings
from jumpcad.robot.cage.place import cage_place
from jumpcad.robot.thing import Check, Thing

CAGE = Thing(cage_bars, cage_hardware, (Check(cage_findings, BASIS),), cage_place)
