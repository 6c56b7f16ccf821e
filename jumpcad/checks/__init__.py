"""What can be wrong with a built robot, as findings with signed margins.

Names by module: `strength` leg_strength, hub_strength, lever_strength, leg_flex, leg_sideways, front_link_strength,
front_link_buckling, eye_strength, foot_lug_strength, toe_strength, toe_landing, toe_joint_strength, rail_strength,
plate_seat, cam_key_strength; `steel` leg_axle_strength, cam_axle_strength, spring_pin_strength, foot_pin_strength,
roller_screw_strength, spring_fatigue, axle_fatigue, hub_bearing_load; `drive` spring_stress, cam_*, gear_*,
motor_torque; `ground` ground_clearance, foot_clearance; `printability` bed_fit, walls, holes, pins, overhangs, bridges,
solid; `interference` interference; `engraving` engraving; and those of `jumpcad.mechanism.feasibility`: loop,
winding, below_ground, tips, too_weak.
"""

from jumpcad.checks.drive import drive_findings
from jumpcad.checks.engraving import engraving_findings
from jumpcad.checks.ground import foot_findings, ground_findings
from jumpcad.checks.interference import interference_findings
from jumpcad.checks.printability import bed_findings, printability_findings
from jumpcad.checks.strength import strength_findings
from jumpcad.findings import Finding
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.robot import Robot

__all__ = ["check", "constraint_findings"]


def check(robot: Mechanism) -> list[Finding]:
    """Return the findings of every check on a robot, kept limits included; a mechanism alone has the gate's only."""
    feasibility = [*geometry_findings(robot.design), *statics_findings(robot)]
    if not isinstance(robot, Robot):
        return feasibility
    return [
        *feasibility,
        *constraint_findings(robot),
        *foot_findings(robot),
        *printability_findings(robot),
        *interference_findings(robot),
        *engraving_findings(robot),
    ]


def constraint_findings(robot: Robot) -> list[Finding]:
    """Return the findings that are cheap enough for every design of a search: no meshes, no sweep.

    Those of the gate are not among them, since every simulated jump carries them.
    """
    return [*strength_findings(robot), *drive_findings(robot), *ground_findings(robot), *bed_findings(robot)]
