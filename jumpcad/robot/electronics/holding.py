"""What holds battery and boards at a landing, against their inertia."""

from collections.abc import Iterator

from jumpcad.findings import Basis, Finding, at_most, choose, higher
from jumpcad.robot.load_case import load_case
from jumpcad.robot.robot import Robot

BASIS = {
    "electronics_hold": Basis(
        "2·m·a ≤ seats.strap_n/safety.strength_factor (N), tie_n for boards; a = landing force/robot's mass, landing "
        "force = m·g + U/safety.landing_stop_mm",
        "sudden load on an elastic support: twice (Shigley, ch. 4); strap and tie: judgement, makers' usual ratings",
    )
}


def holding_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `electronics_hold`: the part that uses most of what its strap or tie holds, at twice the landing's blow.

    The landing's force over the robot's mass is the acceleration of everything on the body; a part that is suddenly
    stopped by an elastic strap is loaded twice as much.
    """
    seats, case = robot.workshop.seats, load_case(robot)
    acceleration = case.landing_n / robot.mass_kg
    held = {"battery": ("strap", seats.strap_n)}
    held |= dict.fromkeys((*robot.layout.electronics.boards, "plug", "capacitor"), ("cable tie", seats.tie_n))
    masses = {item.name: item.mass_kg for item in robot.hardware if item.name in held}
    loads = {name: 2.0 * mass * acceleration for name, mass in masses.items()}
    worst = max(loads, key=lambda name: loads[name] / held[name][1])
    what, allowed = held[worst][0], held[worst][1] / robot.workshop.safety.strength_factor
    yield at_most(
        "electronics_hold", loads[worst], allowed, "N",
        f"at a landing of {acceleration:.0f} m/s² the {worst} pulls with {loads[worst]:.1f} N on its {what}, which "
        f"holds {allowed:.1f} N",
        higher("safety.landing_stop_mm", note="a softer floor") + choose("a lighter", "bought.battery"),
    )  # fmt: skip
