"""Every thing on the robot, in the order in which layout, drawings, bought parts and checks take them."""

from jumpcad.robot.axles import axles, spacers, steel
from jumpcad.robot.cage import drawing as cage_drawing
from jumpcad.robot.cage import limits as cage_limits
from jumpcad.robot.cage.place import cage_place
from jumpcad.robot.electronics import holding, lead_limits, trays, wired
from jumpcad.robot.electronics import limits as electronics_limits
from jumpcad.robot.foot import bought as foot_bought
from jumpcad.robot.foot import drawing as foot_drawing
from jumpcad.robot.foot import limits as foot_limits
from jumpcad.robot.foot import pads, sideways, toe_limits
from jumpcad.robot.leg import bought as leg_bought
from jumpcad.robot.leg import drawing as leg_drawing
from jumpcad.robot.leg import limits as leg_limits
from jumpcad.robot.plates import bought as plates_bought
from jumpcad.robot.plates import drawing as plates_drawing
from jumpcad.robot.plates import engraving_limits
from jumpcad.robot.plates import limits as plates_limits
from jumpcad.robot.sensor import bought as sensor_bought
from jumpcad.robot.sensor import drawing as sensor_drawing
from jumpcad.robot.sensor import limits as sensor_limits
from jumpcad.robot.springs import bought as springs_bought
from jumpcad.robot.springs import drawing as springs_drawing
from jumpcad.robot.stop import drawing as stop_drawing
from jumpcad.robot.stop import limits as stop_limits
from jumpcad.robot.thing import Check, Thing
from jumpcad.robot.train import blocked
from jumpcad.robot.train import bought as train_bought
from jumpcad.robot.train import drawing as train_drawing
from jumpcad.robot.train import limits as train_limits

THINGS = {
    "leg": Thing(
        leg_drawing.legs,
        leg_bought.leg_hardware,
        (Check(leg_limits.leg_findings, leg_limits.BASIS),),
    ),
    "foot": Thing(
        foot_drawing.foot_and_toes,
        foot_bought.foot_hardware,
        (
            Check(toe_limits.toe_findings, toe_limits.BASIS),
            Check(foot_limits.ground_findings, foot_limits.BASIS),
            Check(sideways.sideways_findings, sideways.BASIS),
        ),
    ),
    "plates": Thing(
        plates_drawing.plates,
        plates_bought.standoffs,
        (
            Check(plates_limits.seat_finding, plates_limits.BASIS),
            Check(engraving_limits.engraving_findings, engraving_limits.BASIS, cheap=False),
        ),
    ),
    "train": Thing(
        train_drawing.train,
        train_bought.motor,
        (
            Check(train_limits.drive_findings, train_limits.BASIS),
            Check(blocked.blocked_findings, blocked.BASIS),
        ),
    ),
    "springs": Thing(springs_drawing.spring_bushings, springs_bought.springs),
    "axles": Thing(
        spacers.spacers,
        axles.axles_and_pins,
        (Check(steel.steel_findings, steel.BASIS),),
    ),
    "electronics": Thing(
        trays.trays,
        wired.electronics,
        (
            Check(electronics_limits.electronics_findings, electronics_limits.BASIS),
            Check(holding.holding_findings, holding.BASIS),
            Check(lead_limits.lead_findings, lead_limits.BASIS, cheap=False),
        ),
    ),
    "stop": Thing(
        stop_drawing.stop_bar,
        pads.stop_pad,
        (Check(stop_limits.stop_findings, stop_limits.BASIS),),
    ),
    "sensor": Thing(
        sensor_drawing.sensor_mount,
        sensor_bought.sensor,
        (Check(sensor_limits.sensor_findings, sensor_limits.BASIS),),
    ),
    "cage": Thing(
        cage_drawing.cage_bars,
        cage_drawing.cage_hardware,
        (Check(cage_limits.cage_findings, cage_limits.BASIS),),
        cage_place,
    ),
}
"""By name."""
