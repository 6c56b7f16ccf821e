"""Clearance of body, legs and lever above the ground while the legs move (mm)."""

import numpy as np

from jumpcad.dimensions import AXLE_END_RADIUS_MM, PAD_WALL_MM, STANDOFF_PAD_MM, STOP_EDGE_MM, STOP_PAD_MM
from jumpcad.drive.socket import socket_half_mm
from jumpcad.findings import Basis, Finding, at_least, higher, lower
from jumpcad.robot.robot import Robot
from jumpcad.robot.stop.place import TAB_MM
from jumpcad.robot.train.motor_socket import ear_places, motor_box
from jumpcad.transforms import Array, direction

GROUND_GAP_MM = 0.5
"""Least gap to the ground; judgement: play of the joints and the flexing of legs and foot."""
POSITIONS = 9
BASIS = {
    "ground_clearance": Basis(
        f"least height above the ground of body, roller and legs' ends, from loaded to rest ≥ {GROUND_GAP_MM:g} mm + "
        "safety.gap_reserve_mm (mm), the foot flat",
        f"geometry; {GROUND_GAP_MM:g} mm: judgement, play of the joints and flexing of legs and foot",
    ),
}


def ground_findings(robot: Robot) -> list[Finding]:
    """Return `ground_clearance`: the lowest point of body, legs and lever above the ground, from loaded to rest."""
    layout = robot.layout
    linkage, sections, cam = robot.linkage, layout.sections, layout.drive.cam
    leg = np.linspace(-robot.design.compression_rad, 0.0, POSITIONS)
    pose = linkage.pose(leg)
    down = np.stack([np.sin(pose.foot_rad), np.cos(pose.foot_rad)], axis=-1)  # up, in the body's frame
    fixed, radii = _body_discs(robot)
    tips = layout.hub_mm + cam.lever_length_mm * direction(-cam.lever_start_rad + leg)
    heights = {
        "the body": (down @ fixed.T - _along(pose.ankle_mm, down)[:, None] - radii).min(axis=1),
        "the roller": _along(tips - pose.ankle_mm, down) - cam.roller_radius_mm,
        "the legs' ends": np.full(POSITIONS, -sections.eye_radius_mm),
    }
    name, lowest = min(((what, float(height.min())) for what, height in heights.items()), key=lambda item: item[1])
    clearance = lowest + sections.ground_mm
    needed = GROUND_GAP_MM + robot.workshop.safety.gap_reserve_mm
    return [
        at_least(
            "ground_clearance", clearance, needed, "mm",
            f"least height of {name} above the ground: {clearance:.1f} mm; {needed:g} mm are needed",
            lower("compression_ratio") + higher("rest_angle_deg"),
        )
    ]  # fmt: skip


def _along(vector: Array, unit: Array) -> Array:
    """Return the components (n,) of vectors (n, 2) along units (n, 2)."""
    along: Array = np.einsum("ij,ij->i", vector, unit)
    return along


def _body_discs(robot: Robot) -> tuple[Array, Array]:
    """Return the lowest parts of the body as discs: middles (n, 2) in its frame and radii (n,)."""
    layout = robot.layout
    pad = max(layout.axle_mm / 2.0 + PAD_WALL_MM, AXLE_END_RADIUS_MM)
    discs = [(place, pad) for place in layout.axles.values()]
    discs += [(place, STANDOFF_PAD_MM / 2.0) for place in layout.standoffs_mm]
    stop = layout.stop
    boxes = [(stop.tab_mm, TAB_MM, STOP_EDGE_MM), (stop.middle_mm, (STOP_PAD_MM, stop.depth_mm), 0.0)]
    discs += [
        (middle + a * (size[0] / 2.0 + edge) * stop.along + b * (size[1] / 2.0 + edge) * stop.behind, 0.0)
        for middle, size, edge in boxes
        for a in (-1.0, 1.0)
        for b in (-1.0, 1.0)
    ]
    discs.append((layout.hub_mm, layout.drive.spring.outer_diameter_mm / 2.0))
    discs.append((layout.cam_axis_mm, layout.drive.cam.outer_radius_mm))
    discs.append((layout.cam_axis_mm, layout.drive.train.stages[-1].wheel.tip_radius_mm))
    discs += [(place, layout.cap_ear_mm / 2.0) for place in ear_places(layout)]
    motor = layout.drive.train.motor
    socket = motor_box(layout, *(2.0 * half for half in socket_half_mm(motor, 0.0)))
    discs += [(corner, 0.0) for corner in socket.to_polygons()[0]]
    if layout.idler_mm is not None:
        discs.append((layout.idler_mm, layout.drive.train.stages[0].wheel.tip_radius_mm))
    half = layout.electronics.length_mm / 2.0
    discs += [(layout.tray_mm + np.array([x, 0.0]), 0.0) for x in (-half, half)]
    return np.array([place for place, _ in discs]), np.array([radius for _, radius in discs])
