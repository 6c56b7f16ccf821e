"""What to expect of one robot on the bench, in words with its own numbers: they fill the texts of the steps."""

import math
import re
from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np

from jumpcad.bundle.arrival import REAMED_MM
from jumpcad.bundle.battery_reading import pin_share, state_off_v
from jumpcad.bundle.firmware import AFTER_RELEASE_MS, LANDING_MS, numbers
from jumpcad.bundle.operation import (
    by_button,
    cable,
    charging,
    charging_loaded,
    switching_off,
    to_stop,
    usb_out,
)
from jumpcad.bundle.ordering import ROD_SHORT_MM, strap_mm
from jumpcad.bundle.springs import arms_off_deg
from jumpcad.bundle.switch_order import nutted_screw
from jumpcad.bundle.wiring import wires
from jumpcad.dimensions import AXLE_END_PLAY_MM, MOTOR_CLAMP_MM
from jumpcad.drive.socket import window_mm
from jumpcad.electronics.chosen import chosen_parts
from jumpcad.electronics.nets import Wiring, wiring_of
from jumpcad.electronics.supply import boards_beside_a, supply_of
from jumpcad.errors import JumpcadError
from jumpcad.mechanism.model import BODY
from jumpcad.robot import Robot
from jumpcad.scene.assembly_steps import Step
from jumpcad.scene.step_views import motor_sense
from jumpcad.simulation import default_engine, simulate

TORQUE_M3_NM, TORQUE_M2_NM, TORQUE_PLASTIC_NM = 0.5, 0.1, 0.3
"""Judgement: a third of what M3 and M2 of strength 8.8 bear in steel, and hand-tight in plastic."""
FREE = ("no contact", "contact")
"""At the free sensor, by its pin's level at the ready position."""
PRESS_N = 50.0
"""Judgement: makers give no axial load for gear heads of the N20 size; that of a thumb."""
PRONG_MM, PRONG_ENDS_MM, PRONG_FREE_MM = (3.0, 6.0), -1.0, 0.5
"""Least and most width of the block on either side of the window, its length over the window's, and what stays free
between it and what stands beside it, such as a standoff's screw head; judgement."""
ROUND_OFF_MM = 1e-3
ROUND_OFF_DEG = 1e-6
"""By how much lengths and angles that are computed miss round numbers."""
ROOM_AHEAD = 2.0
"""Free floor over the computed range, and height over the rise; judgement."""


def expected(robot: Robot, steps: Sequence[Step]) -> dict[str, str]:
    """Return words by the names that the steps' texts use."""
    return _drive(robot) | _springs(robot) | _sizes(robot) | _jump(robot) | _order(steps)


def filled(text: str, words: Mapping[str, str]) -> str:
    """Return a text with its names in braces replaced."""
    return re.sub(r"\{(\w+)\}", lambda found: words[found[1]], text)


def _drive(robot: Robot) -> dict[str, str]:
    """Return what motor, battery and firmware do."""
    workshop, train, cam = robot.workshop, robot.layout.drive.train, robot.layout.drive.cam
    chosen, values = chosen_parts(workshop), numbers(robot)
    supply, wiring = supply_of(chosen), wiring_of(chosen, workshop.bought.pins)
    free = supply.driven(train.motor, supply.nominal_v, workshop.safety.motor_torque_max_nm)
    duty = supply.duty(train.motor, workshop.safety.motor_torque_max_nm)
    # the battery gives that share of the motor's current: in PWM's pauses some of it flows back
    free_a, peak_a = (duty * motor_a for motor_a in (train.motor.no_load_current_a, train.peak_current_a))
    boards_a = supply.boards_w / supply.nominal_v
    read_a = boards_a if chosen.controller.button else boards_beside_a(chosen)
    both = {1: "counter-clockwise", -1: "clockwise"}
    return {
        "free_rpm": f"{free.no_load_rpm:.0f}",
        "boards_ma": f"{1000.0 * read_a:.0f}",
        "free_ma": f"{1000.0 * (free_a + read_a):.0f}",
        "boards_a": f"{read_a:.2f}",
        "free_a": f"{free_a + read_a:.2f}",
        "boards_read": "the boards included" if chosen.controller.button else "the controller left to the computer",
        "dry_s": f"{2.0 * math.pi * train.ratio / (free.no_load_rpm * math.pi / 30.0):.1f}",
        "wind_s": f"{train.winding_s:.1f}",
        "wind_ma": f"{1000.0 * train.electrical_j / supply.nominal_v / train.winding_s:.0f}",
        "wind_j": f"{train.electrical_j:.2f}",
        "peak_ma": f"{1000.0 * (peak_a + boards_a):.0f}",
        "wind_max": f"{(values['WIND_MAX_MS'] or 0) / 1000.0:.1f}",
        "release_ms": f"{values['RELEASE_MAX_MS']}",
        "after_ms": f"{AFTER_RELEASE_MS}",
        "landing_s": f"{LANDING_MS / 1000.0:g}",
        "battery_v": f"{supply.nominal_v:g} to {supply.full_v:g}",
        "nominal_v": f"{supply.nominal_v:g}",
        "min_v": f"{values['BATTERY_MIN_V']:g}",
        **_measured(wiring, supply.nominal_v),
        "off": switching_off(chosen),
        "off_then": switching_off(chosen)[0].lower() + switching_off(chosen)[1:],
        "charge_how": charging(chosen),
        "charge_loaded": charging_loaded(chosen),
        "cable": cable(chosen.controller),
        "wind_by": by_button("wind", chosen.controller),
        "jump_by": by_button("jump", chosen.controller),
        "stop_by": to_stop(chosen),
        "usb_out": usb_out(chosen),
        "contact": wiring.contact,
        "driver_supply": " and ".join(
            f"the {start}" for _, start, end, *_ in wires(robot) if end.part == "capacitor" and start.part == "driver"
        )
        or "the driver's supply pins",
        "free": FREE[wiring.ready_level],
        "pressed": FREE[1 - wiring.ready_level],
        "ready_deg": f"{values['READY_DEG'] or 0:.0f}",
        "cam_turn": both[1],
        "motor_turn": both[motor_sense(robot)],
        "stroke": f"{math.degrees(cam.law.compression_rad):.0f}",
        "lift": f"{math.degrees(cam.law.lift_rad):.0f}",
        "dog_play": f"{math.degrees(robot.layout.drive.dog.play_rad):.0f}",
        "beep": " (a short beep is the capacitor)" if "capacitor" in chosen.components else "",
        "motor_wire": f"{max((mm for *_, end, _, mm in wires(robot) if end.part == 'motor'), default=0.0):.0f}",
    }


def _measured(wiring: Wiring, volts: float) -> dict[str, str]:
    """Return what is to be read at the battery's divider; at a nominal voltage of the battery."""
    low, high = pin_share(wiring)
    return {
        "divider_pin": wiring.pins.get("battery", ""),
        "divider_share": f"{low:.3f} to {high:.3f}",
        "divider_v": f"{volts * low:.2f} to {volts * high:.2f}",
        "state_off": f"{state_off_v(wiring, volts):.1f}",
    }


def _springs(robot: Robot) -> dict[str, str]:
    """Return what hands feel of the springs; with the leg on its stop they are less loaded than at rest."""
    spring = robot.layout.drive.spring
    at_stop = math.degrees(robot.layout.stop_preload_rad)
    per_deg_n, (narrower, wider) = spring.rate_nmm_per_deg / spring.arms.lever_mm, arms_off_deg(robot)
    return {
        "near_stop": _near_stop(max(0.0, -at_stop), max(0.0, narrower - at_stop)),
        "wider": f"{wider:.0f}",
        "arm_n": f"{max(1.0, (at_stop + wider) * per_deg_n):.0f}",
        "pin_hole": f"{robot.layout.pin_hole.diameter_mm:.1f}",
        "preload": f"{max(0.0, at_stop):.1f}",
        "preload_n": f"{max(0.0, at_stop) * per_deg_n:.1f}",
        "energy": f"{robot.spring.energy_j:.2f}",
        "push_ms": f"{1000.0 * robot.release.push_off_s:.0f}",
        "foot_n": f"{2.0 * spring.torque_nmm / robot.design.carrying_link_mm:.1f}",
    }


def _near_stop(ordered_deg: float, narrow_deg: float) -> str:
    """Return where the leg is slack: before its stop, with springs as ordered and with the narrowest arms accepted."""
    ordered, narrow = (math.ceil(deg - ROUND_OFF_DEG) for deg in (ordered_deg, narrow_deg))
    if ordered > 0:
        return (
            f"Near its stop the leg is slack, for up to {ordered}° with springs as ordered, for up to {narrow}° with "
            "arms narrower than ordered: that is no fault."
        )
    if narrow > 0:
        return f"With arms narrower than ordered the leg is slack for up to {narrow}° before its stop: no fault."
    return "The springs push it against its stop."


def _sizes(robot: Robot) -> dict[str, str]:
    """Return lengths and articles that tell one thing from another; nothing of what a robot lacks."""
    articles = defaultdict(str, {item.name: item.article for item in robot.hardware})
    heights = defaultdict(float, {part.name: float(np.ptp(part.drawing.shape.bounds_mm[:, 2])) for part in robot.parts})
    outside = robot.layout.lateral.outside
    window = window_mm(robot.layout.drive.train.motor)
    right, left = heights["front_spacer_right"], heights["front_spacer_left"]
    return {
        "eye_drill": f"{robot.layout.axle_mm + REAMED_MM:g}",
        "end_play": f"{2.0 * AXLE_END_PLAY_MM:g} mm, or {2.0 * AXLE_END_PLAY_MM + ROD_SHORT_MM:g}",
        "axle_length": f"{outside[1] - outside[0]:.0f}",
        "front_tubes": f"{right:.1f} mm on the right, {left:.1f} mm on the left",
        "bushing_left": f"{heights['spring_bushing_left']:.1f}",
        "bushing_right": f"{heights['spring_bushing_right']:.1f}",
        "cam_tube": f"{heights['cam_spacer_right']:.1f}",
        "cam_left_tube": f"{heights['cam_spacer_left']:.1f}",
        "idler_tube": f"{heights['idler_spacer_right']:.1f}",
        "ankle_pin": articles["ankle_pin"],
        "front_pin": articles["front_eye_pin"],
        "leg_pin": articles["leg_spring_pin"],
        "torque_m3": f"{TORQUE_M3_NM:g}",
        "torque_m2": f"{TORQUE_M2_NM:g}",
        "torque_plastic": f"{TORQUE_PLASTIC_NM:g}",
        "press_n": f"{PRESS_N:.0f}",
        "clamp": f"{MOTOR_CLAMP_MM:g}",
        "window": f"{window[0]:g} x {window[1]:g}",
        "block": f"{window[0] + 2.0 * _prong_mm(robot):g} x {window[1] + PRONG_ENDS_MM:g}",
        "groove": f"{window[0]:g}",
        "strap": f"{strap_mm(robot):.0f}",
        "nutted_screws": f"screws {nutted_screw(robot)}",
    }


def _prong_mm(robot: Robot) -> float:
    """Return the width of the block on either side of the motor's window, in halves of a millimetre (down)."""
    layout, window = robot.layout, window_mm(robot.layout.drive.train.motor)
    angle, plate = layout.motor_angle_rad, layout.lateral.right_plate[0]
    axes = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    reach, width = (window[1] + PRONG_ENDS_MM) / 2.0 + PRONG_FREE_MM, window[0] / 2.0 + PRONG_MM[1]
    for item in (item for item in robot.hardware if item.body == BODY):
        points = item.look.vertices @ item.T_body_part[:3, :3].T + item.T_body_part[:3, 3]
        outside = (points[points[:, 1] < plate - ROUND_OFF_MM][:, ::2] - layout.motor_mm) @ axes
        if not len(outside):
            continue
        across, along = np.maximum(outside.min(axis=0), -outside.max(axis=0))  # from the window's middle to the item
        if along < reach:
            width = min(width, float(across) - PRONG_FREE_MM)
    return max(PRONG_MM[0], math.floor(2.0 * (width - window[0] / 2.0)) / 2.0)


def _jump(robot: Robot) -> dict[str, str]:
    """Return range and rise as computed, to 10 mm: no engine's last digits reach the guide."""
    try:
        jump = simulate(robot, engine=default_engine())
    except JumpcadError:
        return {"range": "?", "rise": "?", "far": "3", "high": "2"}
    reach, rise = jump.ballistic_range_m, jump.com_rise_m
    if jump.verdict != "jump" or reach is None or rise is None:
        return {"range": "0", "rise": "0", "far": "3", "high": "2"}
    return {
        "range": f"{10.0 * round(100.0 * reach):.0f}",
        "rise": f"{10.0 * round(100.0 * rise):.0f}",
        "far": f"{max(1.0, math.ceil(2.0 * ROOM_AHEAD * reach) / 2.0):g}",
        "high": f"{max(1.0, math.ceil(2.0 * ROOM_AHEAD * rise) / 2.0):g}",
    }


def _order(steps: Sequence[Step]) -> dict[str, str]:
    """Return the numbers of steps that others refer to."""
    return {f"step_{step.key}": str(number) for number, step in enumerate(steps, start=1)}
