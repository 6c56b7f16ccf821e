"""How loaded springs are slackened where board, driver, wires or motor fail: words of guide and firmware's README."""

from jumpcad.bundle.operation import switching_off
from jumpcad.bundle.wiring import wires
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.robot import Robot

HEADING = "Springs loaded, and nothing turns"
UNTRIED = (
    "Where board, driver, a motor wire or the motor has failed, `wind` and `jump` cannot slacken loaded springs. What "
    "follows is a judgement, not tried on a robot. If you are not sure, leave the leg tied and open nothing."
)


def stuck_items(robot: Robot) -> tuple[str, ...]:
    """Return what to do, in this order: tie the leg; free the cam by the motor, else by softening the pinion's bore."""
    chosen, spring = chosen_parts(robot.workshop), robot.layout.drive.spring
    pull_n = 2.0 * spring.torque_nmm / robot.design.carrying_link_mm
    plus = next((str(start) for _, start, end, *_ in wires(robot) if (end.part, end.pin) == ("motor", "+")), "motor +")
    hole_mm = robot.layout.drive.train.motor.shaft_mm + 2.0 * robot.workshop.fits.loose_mm
    cells = "one cell" if chosen.battery.cells == 1 else f"{chosen.battery.cells} cells"
    apart = (
        "Only when it is there, pushed by the springs' preload alone, is anything taken apart; the springs' pin of the "
        "leg first, as First winding and first jump says."
        if robot.layout.stop_preload_rad > 0.0
        else "Only when it hangs there, slack, is anything taken apart."
    )
    return (
        "Glasses on. Lay the robot on its side, feet away from you. Tie leg and body together with strong cord: two "
        "turns around the main leg near its lower end and around both plates, tight and knotted, so that the leg "
        f"cannot swing out. The springs pull there with up to {pull_n:.0f} N. Guide the cord with a wooden stick and "
        f"keep fingers out from between leg and body. {switching_off(chosen)}, unplug the battery.",
        f"Board, driver or motor wire dead: find the motor's wire that comes from {plus} and mark it (both have one "
        "colour, and they may have been exchanged at the driver). Cut both outside the right plate, strip the ends "
        "that lead to the motor, and keep them apart. The leg still tied, plug the spare socket (Order and "
        "cut: besides), whose leads end in crocodile clips that do not touch, onto a battery of "
        f"the kit's kind ({cells}); plus to the marked wire, until the roller has dropped off the cam, and take one "
        "off at once. A leg that was partly loaded is lifted on first, and the cord catches it. A cam that turns the "
        "other way: exchange the clips. Nothing turns within a second: take one off at once, the motor is blocked or "
        "dead.",
        "Motor blocked or dead: do not take off left plate, motor cap, axles or pins. The plates hold the springs' "
        "pins, and without them the load comes free. The pinion's teeth that hold the gears are between the wheels, "
        "where no cutter reaches them; the pinion is freed on its shaft instead. The leg tied, lay the robot on its "
        f"right plate. In the left plate's round hole of {hole_mm:.1f} mm, above the pinion, is the motor's shaft: "
        "press the fine tip of a soldering iron against it, set as for solder, off the plate, the room aired. The "
        "shaft heats the printed pinion until its bore is soft and it turns on the shaft; a minute or two. The gears "
        "may then turn back by themselves, and the cord catches the leg. Otherwise, the iron still there, push the "
        "teeth of the cam's gear, which stand out of the plates above and behind, with the stick: the way it winds "
        "until the roller has passed the drop; or, with springs partly loaded, back, until the cam has gone from "
        "under the roller, where it is far from the drop. Nothing yields within five minutes: leave the leg tied. "
        "Print a new pinion later.",
        "Then slacken the cord slowly, from the side, feet away from you; a knot that does not open is cut with a "
        f"long knife, no hand in the leg's way. The leg goes back to its stop. {apart}",
    )
