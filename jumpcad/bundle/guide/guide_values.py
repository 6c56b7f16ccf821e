"""The figures of one robot's guide, by the names that its templates use."""

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from jumpcad.building.bom import Bill
from jumpcad.bundle.drawings.spring_sheet import scale_in_words
from jumpcad.bundle.drawings.wiring import soldering_svg, wires
from jumpcad.bundle.facts import PAIR_PERCENT, arms_off_deg, early_torque_share, least_energy_share, torque_shares
from jumpcad.bundle.guide.operation_values import operation_values
from jumpcad.bundle.guide.order_values import ROD_SHORT_MM, order_values
from jumpcad.bundle.limits import limits_of
from jumpcad.dimensions import AXLE_END_PLAY_MM, GRAVITY_M_S2, MOTOR_CLAMP_MM
from jumpcad.drive import TorsionSpring
from jumpcad.drive.motor import window_mm
from jumpcad.errors import JumpcadError
from jumpcad.face import __version__
from jumpcad.findings import errors
from jumpcad.mechanism.model import BODY
from jumpcad.robot.electronics.limits import jumps_per_charge
from jumpcad.robot.foot.pads import printed_pads
from jumpcad.robot.robot import Robot
from jumpcad.robot.springs.thing import ORDERED
from jumpcad.robot.steering.drawing import steering_words
from jumpcad.simulation import headline
from jumpcad.steps.assembly_steps import ORDER, Step
from jumpcad.steps.step_views import motor_sense

REAMED_MM = 0.1
"""Of a reamed bore over its rod, in diameter."""


def loaded_grams(spring: TorsionSpring) -> float:
    """Return what a scale reads below an arm that is level and loaded as at the end of the lift."""
    return 1000.0 * spring.torque_nmm / spring.arms.lever_mm / GRAVITY_M_S2


def scale_range_kg(robot: Robot) -> float:
    """Return the range of a scale for the springs' test, in whole kilograms: a stiff spring's reading."""
    scatter = robot.workshop.safety.spring_rate_scatter
    return math.ceil((1.0 + scatter) * loaded_grams(robot.layout.drive.spring) / 1000.0)


TORQUE_M3_NM, TORQUE_M2_NM, TORQUE_PLASTIC_NM = 0.5, 0.1, 0.3
"""Judgement: a third of what M3 and M2 of strength 8.8 bear in steel, and hand-tight in plastic."""
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


def guide_values(robot: Robot, steps: Sequence[Step], bill: Bill) -> Mapping[str, Any]:
    """Return figures, articles and lists of everything that the guide says of a robot."""
    return MappingProxyType(
        operation_values(robot)
        | order_values(robot, bill)
        | _has(robot)
        | _springs(robot)
        | _sizes(robot)
        | _jump(robot)
        | {
            "mass_g": 1000.0 * robot.mass_kg,
            "version": __version__,
            "broken": [finding.name for finding in errors(limits_of(robot))],
            "number": dict.fromkeys((plan.key for plan in ORDER), "")
            | {step.key: str(number) for number, step in enumerate(steps, start=1)},
            "tools": sorted({one.move.tool.name for step in steps for one in step.placed if one.move.tool}),
            "pair_percent": PAIR_PERCENT,
            "ordered": ORDERED,
            "wires": [(str(start), str(end), colour, length) for _, start, end, colour, length in wires(robot)],
            "soldering": bool(soldering_svg(robot)),
            "jumps": float(f"{jumps_per_charge(robot):.2g}"),
        }
    )


def _has(robot: Robot) -> dict[str, Any]:
    """Return what decides between one instruction and another."""
    layout = robot.layout
    names = {item.name for item in robot.hardware}
    pads = {one.name for one in printed_pads(robot.hardware, robot.workshop)}
    button = bool(layout.electronics.controller.button)
    return {
        "retention": layout.retention, "spring_boss": layout.spring_boss_mm > 0.0, "toes_apart": layout.toes_apart,
        "idler": layout.idler_mm is not None, "balance_lead": "tie_balance_lead" in names,
        "nose_pads": any(name.startswith("nose_pad") for name in names),
        "printed_sole": any(name.startswith("nose_pad") for name in pads), "printed_stop": "stop_pad" in pads,
        # without a button USB stays in: where it feeds the driver too, nothing is to be read at the switch
        "read_current": "switch" in names and (button or layout.electronics.regulator is not None),
    }  # fmt: skip


def _springs(robot: Robot) -> dict[str, Any]:
    """Return what accepts a spring, and what hands feel; with the leg on its stop it is less loaded than at rest."""
    spring, layout = robot.layout.drive.spring, robot.layout
    at_stop = math.degrees(spring.preload_rad - layout.stop.angle_rad)
    per_deg_n, (narrower, wider) = spring.rate_nmm_per_deg / spring.arms.lever_mm, arms_off_deg(robot)
    least, most = torque_shares(robot)
    without = spring.stiffness_nm_per_rad * (spring.wound_rad - spring.preload_rad)
    return {
        "spring": spring, "stock": robot.workshop.stock_spring, "loadings": robot.workshop.safety.jumps,
        "asked_rate": robot.design.stiffness_nmm_per_deg / 2.0, "free_deg": math.degrees(spring.free_arm_angle_rad),
        "wound_deg": math.degrees(spring.wound_rad),
        "loaded_deg": math.degrees(spring.free_arm_angle_rad - spring.wound_rad),
        "preload_deg": math.degrees(spring.preload_rad), "preload_adds_nmm": spring.torque_nmm - 1000.0 * without,
        "narrower_deg": narrower, "wider_deg": wider, "slack_deg": math.ceil(max(0.0, -at_stop) - ROUND_OFF_DEG),
        "most_slack_deg": math.ceil(max(0.0, narrower - at_stop) - ROUND_OFF_DEG),
        "arm_n": max(1.0, (at_stop + wider) * per_deg_n), "stop_deg": max(0.0, at_stop),
        "stop_n": max(0.0, at_stop) * per_deg_n, "energy_j": robot.spring.energy_j,
        "push_ms": 1000.0 * robot.release.push_off_s, "reamed_mm": layout.axle_mm + REAMED_MM,
        "drawn_scale": scale_in_words(spring), "shank_mm": math.floor(2.0 * spring.mandrel_mm) / 2.0,
        "grams": loaded_grams(spring), "least_share": least, "most_share": most,
        "early_share": early_torque_share(robot), "weak_share": least_energy_share(robot),
        "scale_kg": scale_range_kg(robot),
    }  # fmt: skip


def _sizes(robot: Robot) -> dict[str, Any]:
    """Return lengths (mm) and articles that tell one thing from another; nothing of what a robot lacks."""
    articles = defaultdict(str, {item.name: item.article for item in robot.hardware})
    heights = defaultdict(float, {part.name: float(np.ptp(part.shape.bounds_mm[:, 2])) for part in robot.parts})
    low, high = robot.layout.lateral.outside
    window = window_mm(robot.layout.drive.train.motor)
    both = {1: "counter-clockwise", -1: "clockwise"}
    return {
        "articles": articles, "tube_mm": heights, "axle_mm": robot.layout.axle_mm, "axle_length_mm": high - low,
        "pin_hole_mm": robot.layout.pin_hole.diameter_mm, "felt": robot.layout.sensor,
        "left_plate_mm": float(np.ptp(robot.layout.lateral.left_plate)),
        "end_play_mm": (2.0 * AXLE_END_PLAY_MM, 2.0 * AXLE_END_PLAY_MM + ROD_SHORT_MM), "clamp_mm": MOTOR_CLAMP_MM,
        "window_mm": window, "block_mm": (window[0] + 2.0 * _prong_mm(robot), window[1] + PRONG_ENDS_MM),
        "m3_nm": TORQUE_M3_NM, "m2_nm": TORQUE_M2_NM, "plastic_nm": TORQUE_PLASTIC_NM, "press_n": PRESS_N,
        "dog_play_deg": math.degrees(robot.layout.drive.dog.play_rad), "cam_turn": both[1],
        "motor_turn": both[motor_sense(robot)],
        "steering": steering_words(robot),
    }  # fmt: skip


def _prong_mm(robot: Robot) -> float:
    """Return the width of the block on either side of the motor's window, in halves of a millimetre (down)."""
    layout, window = robot.layout, window_mm(robot.layout.drive.train.motor)
    angle, plate = layout.motor_angle_rad, layout.lateral.right_plate[0]
    axes = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    reach, width = (window[1] + PRONG_ENDS_MM) / 2.0 + PRONG_FREE_MM, window[0] / 2.0 + PRONG_MM[1]
    for item in (item for item in robot.hardware if item.body == BODY):
        points = item.shown_mesh.vertices @ item.T_body_part[:3, :3].T + item.T_body_part[:3, 3]
        outside = (points[points[:, 1] < plate - ROUND_OFF_MM][:, ::2] - layout.motor_mm) @ axes
        if not len(outside):
            continue
        across, along = np.maximum(outside.min(axis=0), -outside.max(axis=0))  # from the window's middle to the item
        if along < reach:
            width = min(width, float(across) - PRONG_FREE_MM)
    return max(PRONG_MM[0], math.floor(2.0 * (width - window[0] / 2.0)) / 2.0)


def _jump(robot: Robot) -> dict[str, Any]:
    """Return touchdown and rise as computed, to 10 mm, and the free room (m): no engine's last digits."""
    unknown = {"range_mm": None, "rise_mm": None, "far_m": 3.0, "high_m": 2.0}
    try:
        jump = headline(robot)
    except JumpcadError:
        return unknown
    reach, rise = jump.touchdown_distance_m, jump.com_rise_m
    if jump.verdict != "jump" or reach is None or rise is None:
        return unknown
    far, high = (max(1.0, math.ceil(2.0 * ROOM_AHEAD * metres) / 2.0) for metres in (reach, rise))
    return {"range_mm": 10 * round(100.0 * reach), "rise_mm": 10 * round(100.0 * rise), "far_m": far, "high_m": high}
