"""Its doors."""

from jumpcad.robot.axles.axles import axles_and_pins
from jumpcad.robot.axles.spacers import spacers
from jumpcad.robot.axles.steel import BASIS, steel_findings
from jumpcad.robot.thing import Check, Thing

AXLES = Thing(spacers, axles_and_pins, (Check(steel_findings, BASIS),))
