"""Which article is meant where a bill's name leaves a choice: bearings, long screws, a plug's half, tape, the motor."""

from collections.abc import Iterator

import numpy as np

from jumpcad.bundle.bom import bill_of_materials
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.files.markdown import plain
from jumpcad.robot import Robot
from jumpcad.strength.axles import SCREW_THREAD_MM

NUT_THREAD_MM = 18.0
"""Thread of M3 from the end, without its run-out (ISO 4762): it must begin before the lock nut."""


def bearings_order(robot: Robot) -> Iterator[str]:
    """Yield the bearings with their dimensions: unshielded ones of the same name are narrower."""
    billed = {item.name for item in bill_of_materials(robot).items}
    listed = "; ".join(
        f"{plain(one.name)}, {one.bore_mm:g} x {one.outer_mm:g} x {one.width_mm:g} mm"
        for one in robot.workshop.catalogue.bearings.values()
        if f"ball bearing {one.name}" in billed
    )
    if listed:
        yield f"- ball bearings with two metal shields (suffix ZZ; open ones may be narrower): {listed}"


def screw_axles_order(robot: Robot) -> Iterator[str]:
    """Yield where screws that serve as axles are found: they are longer than the norm's longest of their size."""
    if robot.layout.retention == "nuts":
        yield (
            "- screws M3 as axles: ISO 4762 lists M3 up to 30 mm; longer ones of the same dimensions are sold as "
            "ISO 4762 or DIN 912, strength class 12.9. Their smooth shank is what turns: not threaded up to the head"
        )
        yield from _smooth_under_the_leg(robot)
        low, high = robot.layout.lateral.outside
        yield (
            f"- {len(robot.layout.axles) + 1} rods of {robot.layout.axle_mm:g} mm, {high - low:.0f} mm long, any "
            "material, straight and deburred: they try the fits, and stand in for the axles until the screws come"
        )


def _smooth_under_the_leg(robot: Robot) -> Iterator[str]:
    """Yield longer screws to be cut, where leg and front link would turn on the thread of those in the bill."""
    lateral, stock = robot.layout.lateral, robot.workshop.catalogue.screws["M3 long"]
    low, high = lateral.outside
    (axle,) = (item for item in robot.hardware if item.name == "leg_axle")
    length = float(np.ptp(axle.shape.bounds_mm[:, 2])) - stock.cylinder_head_height_mm
    turns = high - lateral.leg[0]
    enough = (one for one in stock.lengths_mm if turns <= one - SCREW_THREAD_MM and one - NUT_THREAD_MM <= high - low)
    if length - SCREW_THREAD_MM < turns and (longer := next(enough, None)):
        yield (
            f"- of these, the axles of leg and front link: buy M3 x {longer:g} and cut them to {length:g} mm with the "
            f"cut-off disc, a nut on them that mends the thread as it is turned off. Leg and link turn as far as "
            f"{turns:.1f} mm from the head, where M3 x {length:g} has thread"
        )


def plug_order(robot: Robot) -> Iterator[str]:
    """Yield which half of a plug is meant, and what to do where its poles do not meet the battery's."""
    plug = chosen_parts(robot.workshop).components.get("plug")
    if plug is not None:
        yield (
            f"- {plain(plug.description)}: the half that mates with the battery's plug. Where plus does not meet plus, "
            "exchange the contacts of the robot's half, or solder its leads the other way round; not the battery's"
        )


def tape_order(robot: Robot) -> Iterator[str]:
    """Yield the pieces of foam tape under the boards."""
    boards = chosen_parts(robot.workshop).boards.items()
    pieces = ", ".join(f"{board.length_mm:g} x {board.width_mm:g} mm ({role})" for role, board in boards)
    yield f"- double-sided foam tape 1 mm thick: {pieces}; cut out under pads that are soldered from below"


def motor_order(robot: Robot) -> Iterator[str]:
    """Yield what to compare before the motor is ordered: shops' names for these motors are no articles."""
    motor = robot.layout.drive.train.motor
    sure = {"stated": "as its source states", "derived": "derived", "memory": "from memory"}[motor.confidence]
    yield (
        f"- gear motor: {plain(motor.article or motor.name)}. Compare before you order: {motor.ratio:.0f}:1, "
        f"{motor.voltage_v:g} V, {motor.no_load_rpm:.0f} rpm, {1000.0 * motor.no_load_current_a:.0f} mA without load, "
        f"{motor.stall_torque_nm:.3f} N·m and {motor.stall_current_a:g} A stalled, shaft {motor.shaft_mm:g} mm with a "
        f"flat, {motor.shaft_length_mm:g} mm long ({sure}: {plain(motor.source)}). Ratio, voltage, shaft and gearbox "
        "must agree; speed and torque may be 10 % off "
        "(judgement). An extended shaft at its back: cut that off with the disc before anything is soldered, the stub "
        "held in pliers, the motor wrapped against filings"
    )
