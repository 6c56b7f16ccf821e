"""The manifest's entries about electronics: voltages, energies, jumps per charge."""

from typing import Any

from jumpcad.checks.electronics import links
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.supply import supply_of
from jumpcad.robot import Robot

DIGITS = 6
USABLE = 0.8
"""Share of a battery's energy that is used before the firmware stops winding; practice with lithium polymer packs."""


def electronics_facts(robot: Robot) -> dict[str, Any]:
    """Return the battery's voltages (empty, full), and for each part the supplied and the permitted voltages."""
    chosen, train = chosen_parts(robot.workshop), robot.layout.drive.train
    supply = supply_of(chosen)
    empty, full = chosen.battery.range_v
    chained = [
        {
            "role": link.role,
            "name": link.name,
            "pin": link.pin,
            "gets_v": _rounded(link.gets_v),
            "bears_v": None if link.bears_v is None else _rounded(link.bears_v),
        }
        for link in links(robot)
    ]
    return {
        "kit": robot.workshop.bought.kit,
        "battery": chosen.battery.name,
        "battery_v": [empty, full],
        "boards": [item for item in chained if item["role"] in chosen.boards],
        "motor": next(item for item in chained if item["role"] == "motor"),
        "pwm_cap": round(supply.pwm(train.motor, robot.workshop.safety.motor_torque_max_nm), DIGITS),
        "energy_j": {"motor": round(train.motor_j, DIGITS), "boards": round(train.boards_j, DIGITS)},
        "jumps_per_charge": jumps_per_charge(robot),
    }


def jumps_per_charge(robot: Robot) -> int:
    """Return how often a full battery winds the springs, without what the boards take while the robot waits."""
    usable = USABLE * supply_of(chosen_parts(robot.workshop)).usable_j
    return int(usable / robot.layout.drive.train.electrical_j)


def _rounded(volts: tuple[float, float]) -> list[float]:
    return [round(value, DIGITS) for value in volts]
