"""The blocked motor: what its torque does to teeth and dog, if nothing lets the cam turn (N·m, MPa).

Warnings: it takes a fault to block the motor, and neither part grows for it.
"""

from collections.abc import Iterator

from jumpcad.findings import Basis, Finding, at_most
from jumpcad.robot.load_case import load_case
from jumpcad.robot.robot import Robot

BLOCKED_FACTOR = 1.5
"""Factor of safety of printed parts; judgement: less than for every jump, since a motor is blocked by a fault alone."""
TORQUE = "T stall torque on a full battery under the firmware's PWM times the ratio, without losses"
WEAKER = "a weaker motor, a battery of fewer cells, or a stronger material for the gears"
BASIS = {
    "gear_blocked": Basis(
        f"largest F/(b·m·Y) of the pairs ≤ the gears' strength_in_plane_mpa/{BLOCKED_FACTOR:g} (MPa); {TORQUE} up to "
        "the pair, others as of `gear_strength_*`",
        "Lewis (Shigley 14-1); factor: judgement",
    ),
    "cam_dog_blocked": Basis(
        f"stress as of `cam_dog_strength` ≤ the gears' strength_interlayer_mpa/{BLOCKED_FACTOR:g} (MPa); {TORQUE}",
        "Shigley 3-10 to 3-12; factor: judgement",
    ),
}


def blocked_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `gear_blocked` and `cam_dog_blocked`."""
    case, train = load_case(robot), robot.layout.drive.train
    supply, allowed = robot.supply, robot.workshop.safety.motor_torque_max_nm
    torque = supply.driven(train.motor, supply.full_v, allowed).stall_torque_nm
    gears, worst = robot.workshop.material("gears"), 0.0
    for pair in train.stages:
        worst = max(worst, pair.pinion.lewis_stress_mpa(torque))
        torque *= pair.ratio
    dog = case.dog_stress_mpa(torque)
    for name, what, stress, strength in (
        ("gear_blocked", "teeth of the gears", worst, gears.strength_in_plane_mpa),
        ("cam_dog_blocked", "the cam's dog", dog, gears.strength_interlayer_mpa),
    ):
        allowed = strength / BLOCKED_FACTOR
        message = f"{what}, motor blocked: {stress:.1f} of {allowed:.1f} MPa"
        yield at_most(name, stress, allowed, "MPa", message, WEAKER, "warning")
