"""Checks of a finished robot: each is a function that returns findings, with signed margins and remedies.

A new check is a function in a file of its own and a line in `CHECKS`. Its finding may name what grows where it fails
(`Finding.grows`); `build` then makes that section stronger, if the check is cheap.

Names of findings by module: `mechanism.feasibility` loop, winding, below_ground, tips, too_weak; `strength`
leg_strength, hub_strength, lever_strength, leg_flex, leg_sideways, front_link_strength, front_link_buckling,
eye_strength, foot_lug_strength, toe_strength, toe_landing, toe_joint_strength, rail_strength, plate_seat,
cam_dog_strength, toe_bar_strength; `steel` leg_axle_strength, cam_axle_strength, spring_pin_strength,
leg_pin_strength, foot_pin_strength, roller_screw_strength, axle_retention, pin_retention, spring_fatigue,
axle_fatigue, hub_bearing_load; `drive` spring_stress, cam_*, gear_*, motor_torque, release_*; `electronics`
supply_voltage_*, motor_current_*, gearbox_torque, charging_current, wiring_*; `sensor` sensor_press,
sensor_overtravel, sensor_free, sensor_ready, sensor_open; `holding` electronics_hold; `leads` wires_clear;
`ground` ground_clearance, foot_clearance; `sideways`
sideways_tipping; `printability` bed_fit, walls, holes, pins, overhangs, bridges, solid; `interference` interference;
`stop` stop_strength, stop_plates, stop_leg, stop_pad, stop_clearance; `engraving` engraving; `assembly`
assembly_paths, tool_access.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from jumpcad.checks.assembly import assembly_findings
from jumpcad.checks.drive import drive_findings
from jumpcad.checks.electronics import electronics_findings
from jumpcad.checks.engraving import engraving_findings
from jumpcad.checks.ground import foot_findings, ground_findings
from jumpcad.checks.holding import holding_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.checks.leads import lead_findings
from jumpcad.checks.printability import bed_findings, printability_findings
from jumpcad.checks.sensor import sensor_findings
from jumpcad.checks.sideways import sideways_findings
from jumpcad.checks.stop import stop_findings
from jumpcad.checks.strength import strength_findings
from jumpcad.findings import Finding
from jumpcad.mechanism.feasibility import feasibility_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot import Robot

__all__ = ["CHECKS", "Check", "check", "constraint_findings", "quick_findings"]


@dataclass(frozen=True)
class Check:
    """An entry of the registry.

    `find` takes what the check `needs` (a Mechanism, or a Robot with its parts) and returns findings. A `cheap` check
    looks at no mesh and at no motion, takes about a millisecond, and runs for every design of a search.
    """

    find: Callable[[Any], Iterable[Finding]]
    needs: type[Mechanism] = Robot
    cheap: bool = False


CHECKS = (
    Check(feasibility_findings, needs=Mechanism, cheap=True),
    Check(strength_findings, cheap=True),
    Check(stop_findings, cheap=True),
    Check(drive_findings, cheap=True),
    Check(electronics_findings, cheap=True),
    Check(sensor_findings, cheap=True),
    Check(holding_findings, cheap=True),
    Check(lead_findings),
    Check(ground_findings, cheap=True),
    Check(sideways_findings, cheap=True),
    Check(bed_findings, cheap=True),
    Check(foot_findings),
    Check(printability_findings),
    Check(interference_findings),
    Check(engraving_findings),
    Check(assembly_findings),
)
"""Every check, in the order of its findings."""


def check(robot: Mechanism) -> list[Finding]:
    """Return the findings of every check, limits that are met included; without parts, those of feasibility only."""
    return _findings(robot, CHECKS)


def quick_findings(robot: Mechanism) -> list[Finding]:
    """Return the findings of the cheap checks, feasibility included."""
    return _findings(robot, (check for check in CHECKS if check.cheap))


def constraint_findings(robot: Robot) -> list[Finding]:
    """Return the findings of the cheap checks that need parts: those that a simulated jump does not include."""
    return _findings(robot, (check for check in CHECKS if check.cheap and check.needs is Robot))


def _findings(robot: Mechanism, checks: Iterable[Check]) -> list[Finding]:
    """Return the findings of those checks whose needs the robot meets."""
    return [found for check in checks if isinstance(robot, check.needs) for found in check.find(robot)]
