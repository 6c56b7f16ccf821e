"""The chain of voltages, the motor's current and torque when it is blocked, and the wiring."""

import itertools
import math
from collections.abc import Iterator

import numpy as np

from jumpcad.electronics.supply import Chosen, Link, Supply, chain
from jumpcad.findings import Basis, Finding, at_least, at_most, choose, higher, limit
from jumpcad.mechanism.linkage import LONGER_BODY
from jumpcad.robot.electronics import wiring
from jumpcad.robot.electronics.leads import way_in
from jumpcad.robot.layout import moving_obstacles
from jumpcad.robot.load_case import load_case
from jumpcad.robot.robot import Robot
from jumpcad.robot.space.inside import hub_obstacles
from jumpcad.robot.space.room import bar, clearance

ROUND_OFF_V = 1e-9
SHEETS = "ratings: makers' data sheets, templates/hardware/electronics.toml"
STALL = "I = D·U_full/(R_motor + R_battery + R_driver) of the blocked motor, D mean share of U under PWM"
USABLE = 0.8
"""Share of a battery's energy that is used before the firmware stops winding; practice with lithium polymer packs."""
BASIS = {
    "supply_voltage_motor": Basis(
        "D·U_empty ≥ U_min and D·U_full ≤ U_max (V); battery without load, D mean share of U under PWM, U_min and "
        "U_max of the motor",
        "makers' data sheets: templates/hardware/motors.toml",
    ),
    "supply_voltage_*": Basis(
        "U_empty - I·R_battery ≥ U_min and U_full ≤ U_max (V), I motor's largest current while it winds; behind a "
        "regulator U_out - the diode's drop, for both",
        SHEETS,
    ),
    "motor_current_*": Basis(f"I ≤ rated current (A); {STALL}", f"brushed motor: linear, Ohm; {SHEETS}"),
    "gearbox_torque": Basis(
        "(I - I_0)/(I_stall - I_0)·T_stall ≤ safety.motor_torque_max_nm (N·m), I_0 unloaded, I_stall and T_stall at "
        f"rated voltage; {STALL}, at which the torque is just allowed, else 1",
        "brushed motor: linear; limit: N20 makers, 2 kgf·cm",
    ),
    "charging_current": Basis(
        "charging current of the controller ≤ charge_ma of the battery, or 1 C (mA)",
        f"{SHEETS}; 1 C: makers of small cells",
    ),
    **wiring.BASIS,
}


def electronics_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `supply_voltage_*`, `motor_current_*`, `gearbox_torque`, `charging_current` and `wiring_*`."""
    chosen = robot.layout.electronics
    supply = robot.supply
    for link in links(robot):
        yield _voltage(link)
    yield from _currents(robot, chosen, supply)
    yield _gearbox(robot, supply)
    yield from _charging(chosen)
    yield from wiring.wiring_findings(chosen, robot.wiring)


def links(robot: Robot) -> list[Link]:
    """Return the chain of a robot, from the regulator to the winding."""
    chosen, train = robot.layout.electronics, robot.layout.drive.train
    torque_max = robot.workshop.safety.motor_torque_max_nm
    return list(chain(chosen, train.motor, robot.supply, train.peak_current_a, torque_max))


def _voltage(link: Link) -> Finding:
    """Return whether a link bears what it gets; value and limit are those of the end that is nearer to its limit.

    A least voltage of 0 is no limit.
    """
    low, high = link.gets_v
    name, at = f"supply_voltage_{link.role}", f"{link.name}{link.pin and f' at {link.pin}'}"
    gets = f"{low:.2f} to {high:.2f} V" if high > low else f"{low:.2f} V"
    if link.bears_v is None:
        message = f"{at} gets {gets}; what it bears is not known"
        return Finding(name, "warning", 0.0, "V", message, "give supply_v of this board: its inputs and their volts")
    least, most = link.bears_v
    over, under = most - high, low - least if least > 0.0 else math.inf
    value, allowed = (high, most) if over <= under else (low, least)
    message = f"{at} gets {gets} and bears {least:.2f} to {most:.2f} V"
    margin = min(over, under)
    margin = 0.0 if abs(margin) < ROUND_OFF_V else margin
    return limit(name, margin, "V", message, link.remedy, value=value, allowed=allowed)


def _currents(robot: Robot, chosen: Chosen, supply: Supply) -> Iterator[Finding]:
    """Yield whether everything in the motor's circuit bears the current of the blocked motor on a full battery."""
    train, torque_max = robot.layout.drive.train, robot.workshop.safety.motor_torque_max_nm
    stall = supply.driven(train.motor, supply.full_v, torque_max).stall_current_a
    bears = {"driver": (chosen.driver.name, chosen.driver.output_a),
             "battery": (chosen.battery.name, chosen.battery.discharge_a)}  # fmt: skip
    bears |= {role: (part.name, part.rated_a) for role in ("switch", "plug", "wire")
              if (part := chosen.components.get(role))}  # fmt: skip
    for role, (name, allowed) in bears.items():
        carries = f"{name} carries {stall:.2f} A while the motor is blocked"
        if allowed is None:
            message, remedy = f"{carries}; what it bears is not known", f"give the current that this {role} bears"
            yield Finding(f"motor_current_{role}", "warning", 0.0, "A", message, remedy)
            continue
        yield at_most(
            f"motor_current_{role}", stall, allowed, "A", f"{carries}; {allowed:g} A are allowed",
            f"another bought.{role}, or a motor with a larger resistance",
        )  # fmt: skip


def _charging(chosen: Chosen) -> Iterator[Finding]:
    """Yield whether the battery bears what the controller charges it with; elsewhere it is charged outside."""
    battery, current = chosen.battery, chosen.controller.charge_ma
    if not chosen.charged_by_usb or current is None:
        return
    rated = "by its charge_ma" if battery.charge_ma else "1 C, since its charge_ma is not given"
    yield at_most(
        "charging_current", current, battery.bears_ma, "mA",
        f"{chosen.controller.name} charges {battery.name} with {current:.0f} mA; {battery.bears_ma:.0f} mA are "
        f"allowed, {rated}",
        "another bought.battery: of a larger capacity, or with the charge_ma that its maker permits; or another "
        "bought.controller",
    )  # fmt: skip


def _gearbox(robot: Robot, supply: Supply) -> Finding:
    """Return whether the blocked motor overloads its gearbox with a full battery under the firmware's PWM."""
    motor, allowed = robot.layout.drive.train.motor, robot.workshop.safety.motor_torque_max_nm
    percent = math.floor(1000.0 * supply.pwm(motor, allowed)) / 10.0
    torque = supply.driven(motor, supply.full_v, allowed).stall_torque_nm
    cap = f", with PWM of at most {percent:g} %, which the firmware keeps" if percent < 100.0 else ""
    return at_most(
        "gearbox_torque", torque, allowed, "N·m",
        f"{motor.name} stalls with {1000.0 * torque:.0f} mN·m on a full battery{cap}; {1000.0 * allowed:.0f} mN·m are "
        "allowed",
        "a weaker motor, or a battery of fewer cells",
    )  # fmt: skip


def jumps_per_charge(robot: Robot) -> int:
    """Return how often a full battery winds the springs, without what the boards take while the robot waits."""
    usable = USABLE * robot.supply.usable_j
    return int(usable / robot.layout.drive.train.electrical_j)


HOLDING_BASIS = {
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


NEEDED_MM = 1.5
"""From a lead's middle to what moves; judgement: a lead of 1.2 mm and a millimetre of air."""
APART_MM, AROUND_MM = 1.0, 1.5
"""Between the points that are measured, and how far around a lead across the robot things count."""
FAR_MM = 100.0
"""Larger distances are not told apart."""
LEADS_BASIS = {
    "wires_clear": Basis(
        f"distance of a lead's middle, the wheel's from the tail on, from what moves and springs ≥ {NEEDED_MM:g} mm",
        "geometry; judgement: a lead of 1.2 mm and a millimetre of air",
    )
}


def lead_findings(robot: Robot) -> Iterator[Finding]:
    """Yield `wires_clear`: the least distance of leads of sensor and motors from what moves and from the springs."""
    layout = robot.layout
    moving = [*moving_obstacles(layout), *hub_obstacles(layout.hub_mm, layout.drive, layout.lateral, 0.0)[:2]]
    gaps: dict[str, float] = {}
    tray = layout.electronics.middle_mm(layout.tray_mm)
    for role in ("sensor", "motor", "steering motor"):
        way = way_in(layout, role)[2 * (role == "steering motor") :]  # its place has room for them at the mount
        if len(way) < 2:
            continue
        ends = [*way, np.array([tray[0], way[-1][1], tray[1]])]
        for start, end in itertools.pairwise(ends):
            y = (min(start[1], end[1]) - AROUND_MM, max(start[1], end[1]) + AROUND_MM)
            points = bar(start[[0, 2]], end[[0, 2]], APART_MM)
            gaps[role] = min(gaps.get(role, np.inf), float(clearance(moving, points, (0.0, 0.0), 0.0, y, FAR_MM).min()))
    if gaps:
        role = min(gaps, key=lambda name: gaps[name])
        gap = min(gaps[role], FAR_MM)
        far = "at least " if gap == FAR_MM else ""
        yield at_least(
            "wires_clear", gap, NEEDED_MM, "mm",
            f"the {role}'s leads pass {far}{gap:.1f} mm from what moves and springs; {NEEDED_MM:g} mm are needed",
            LONGER_BODY,
        )  # fmt: skip
