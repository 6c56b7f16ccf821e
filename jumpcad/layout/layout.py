"""The plan of one robot: every place and interval that parts and bought parts are made from (numpy only, mm).

In-plane places are in the body frame's x-z plane; intervals of y come from the lateral stack.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Battery, Bearing, Board, Motor
from jumpcad.design import Design
from jumpcad.dimensions import (
    CLEAR_MM,
    GAP_MM,
    SPACER_RADIUS_MM,
    STANDOFF_RADIUS_MM,
    STRAP_EDGE_MM,
    STRAP_SLOT_MM,
    TRAY_LENGTH_MIN_MM,
    TRAY_MM,
)
from jumpcad.drive import Drive
from jumpcad.drive.socket import socket_half_mm
from jumpcad.errors import CannotBuildError
from jumpcad.layout.lateral import Lateral, lateral_stack
from jumpcad.layout.places import around, best_place, grid_candidates, ring_candidates
from jumpcad.layout.room import EVERYWHERE, Obstacle, bar, box_obstacle, clearance, disc
from jumpcad.layout.sweep import legs_apart_mm, link_obstacles
from jumpcad.mechanism.linkage import Linkage
from jumpcad.strength.sizing import Sections
from jumpcad.transforms import Array


@dataclass(frozen=True)
class Electronics:
    """What the trays carry."""

    battery: Battery
    controller: Board
    driver: Board

    @property
    def names(self) -> str:
        """What they are, in words."""
        return f"{self.battery.name}, {self.controller.name} and {self.driver.name}"

    @property
    def length_mm(self) -> float:
        """Along x: the battery, or both boards one behind the other."""
        boards = self.controller.width_mm + self.driver.width_mm + 1.0
        return max(max(self.battery.length_mm, boards) + 2.0, TRAY_LENGTH_MIN_MM)

    @property
    def width_mm(self) -> float:
        """Across the robot (y): the battery with its strap, or a board."""
        strap = 2.0 * (1.5 * STRAP_SLOT_MM[0] + STRAP_EDGE_MM)
        return max(self.battery.width_mm + strap, self.controller.length_mm + 2.0, self.driver.length_mm + 2.0)

    @property
    def upper_tray_mm(self) -> float:
        """From the bottom of the lower tray to that of the upper one."""
        return TRAY_MM + self.battery.height_mm + 1.0

    @property
    def height_mm(self) -> float:
        """From the bottom of the lower tray to the top of the boards."""
        return self.upper_tray_mm + TRAY_MM + max(self.controller.height_mm, self.driver.height_mm)


@dataclass(frozen=True)
class Layout:
    """Where everything is; points (2,) are x-z in the body frame (mm)."""

    design: Design
    sections: Sections
    drive: Drive
    lateral: Lateral
    electronics: Electronics
    axle_mm: float
    hub_mm: Array
    front_mm: Array
    cam_axis_mm: Array
    idler_mm: Array | None
    motor_mm: Array
    motor_angle_rad: float
    spring_pin_mm: Array
    leg_pin_mm: float
    tray_mm: Array
    standoffs_mm: tuple[Array, ...]
    hub_bearing: Bearing | None = None
    toes_apart: bool = False
    """Whether the foot is too large for the bed with its toes, so that they are parts of their own."""

    @property
    def axles(self) -> dict[str, Array]:
        """The dead axles that cross both plates."""
        axles = {"leg": self.hub_mm, "front": self.front_mm, "cam": self.cam_axis_mm}
        return axles if self.idler_mm is None else axles | {"idler": self.idler_mm}


def make_layout(
    design: Design,
    sections: Sections,
    drive: Drive,
    electronics: Electronics,
    plate_mm: float,
    roller_width_mm: float,
    axle_mm: float,
) -> Layout:
    """Lay out a robot.

    Raises
    ------
    CannotBuildError
        If something finds no room; the message names it, what is in its way, and the number to change.
    """
    linkage = Linkage(design)
    hub, front = linkage.back_pivot_mm, linkage.front_pivot_mm
    cam, spring, train = drive.cam, drive.spring, drive.train
    cam_axis = hub + cam.cam_axis_mm
    lateral = lateral_stack(
        sections.thickness_mm,
        sections.lug_thickness_mm,
        roller_width_mm,
        spring.body_length_mm,
        tuple(stage.face_width_mm for stage in reversed(train.stages)),
        train.motor,
        plate_mm,
        electronics.width_mm,
    )
    inside = lateral.inside
    lever_y = (-sections.thickness_mm / 2.0 - 2.6, lateral.cam[1] + 1.7)
    moving = link_obstacles(linkage, sections, cam.lever_length_mm, cam.lever_start_rad, lever_y, CLEAR_MM)
    _require_legs_apart(linkage, sections)
    _require_shaft(train.motor, lateral)
    wheel = train.stages[-1].wheel
    hub_things = [
        disc("left spring", hub, spring.outer_diameter_mm / 2.0 + CLEAR_MM, lateral.spring_left),
        disc("right spring", hub, spring.outer_diameter_mm / 2.0 + CLEAR_MM, lateral.spring_right),
        disc("leg axle", hub, SPACER_RADIUS_MM + CLEAR_MM, inside),
        disc("front axle", front, SPACER_RADIUS_MM + CLEAR_MM, inside),
    ]
    cam_things = [
        disc("cam", cam_axis, cam.outer_radius_mm + CLEAR_MM, lateral.cam),
        disc("cam gear", cam_axis, wheel.tip_radius_mm + CLEAR_MM, lateral.gears[0]),
        disc("cam axle", cam_axis, SPACER_RADIUS_MM + CLEAR_MM, inside),
    ]
    _require_gear_room(hub_things, cam_axis, wheel.tip_radius_mm, lateral.gears[0])
    obstacles = [*moving, *hub_things, *cam_things]
    spring_pin = _spring_pin([*moving, *cam_things, *hub_things[3:]], hub, spring.pin_radius_mm, inside)
    obstacles.append(
        Obstacle(
            "spring arm",
            bar(hub, hub + (spring_pin - hub) * (1.0 + 2.0 / spring.pin_radius_mm)),
            1.5 + CLEAR_MM,
            inside,
        )
    )
    idler, motor, angle = _train_places(obstacles, drive, lateral, cam_axis)
    obstacles += [
        box_obstacle("motor", motor, socket_half_mm(train.motor), angle, inside),
        disc("pinion", motor, train.stages[0].pinion.tip_radius_mm + CLEAR_MM, lateral.gears[-1]),
    ]
    if idler is not None:
        obstacles += _idler_obstacles(idler, drive, lateral)
    tray = _tray_place(obstacles, electronics, design.l1_mm, inside)
    centre = tray + np.array([0.0, electronics.height_mm / 2.0])
    obstacles.append(
        box_obstacle("electronics", centre, (electronics.length_mm / 2.0, electronics.height_mm / 2.0), 0.0, inside)
    )
    standoffs = _standoffs(obstacles, cam_axis, front, centre, electronics, inside)
    return Layout(
        design=design,
        sections=sections,
        drive=drive,
        lateral=lateral,
        electronics=electronics,
        axle_mm=axle_mm,
        hub_mm=hub,
        front_mm=front,
        cam_axis_mm=cam_axis,
        idler_mm=idler,
        motor_mm=motor,
        motor_angle_rad=angle,
        spring_pin_mm=spring_pin,
        leg_pin_mm=spring.pin_radius_mm,
        tray_mm=tray,
        standoffs_mm=standoffs,
    )


def _require_legs_apart(linkage: Linkage, sections: Sections) -> None:
    room = legs_apart_mm(linkage, sections) - GAP_MM
    if room < 0:
        raise CannotBuildError(
            f"main leg and front link come {-room:.1f} mm nearer than the {GAP_MM:g} mm that they need between them: "
            "lower compression_ratio, or raise d_coef or rest_angle_deg"
        )


def _require_shaft(motor: Motor, lateral: Lateral) -> None:
    """Refuse a motor whose shaft does not reach into its pinion by its diameter (judgement; usual for hubs)."""
    needed = lateral.gears[-1][0] + motor.shaft_mm - lateral.motor[1]
    if motor.shaft_length_mm < needed - 1e-9:
        raise CannotBuildError(
            f"the shaft of motor {motor.name} is {motor.shaft_length_mm:g} mm long; {needed:.1f} mm reach through its "
            f"cap and {motor.shaft_mm:g} mm into its pinion: allow a motor with a longer shaft"
        )


def _require_gear_room(hub_things: list[Obstacle], axis: Array, tip_mm: float, y: tuple[float, float]) -> None:
    room = clearance(hub_things, axis[None], (0.0, 0.0), 0.0, y)[0] - tip_mm
    if room < 0:
        raise CannotBuildError(
            f"the cam gear's tip radius of {tip_mm:.1f} mm is {-room:.1f} mm too large beside the leg's axle: "
            "allow a stronger motor (a smaller ratio), or a smaller gear module"
        )


def _spring_pin(obstacles: list[Obstacle], hub: Array, radius_mm: float, inside: tuple[float, float]) -> Array:
    """Return the place of the pin that holds the springs' body arms: across both plates, in front of the hub."""

    def place(step_deg: float) -> Array:
        angles = np.radians(np.arange(20.0, 131.0, step_deg))
        places = around(hub, radius_mm, angles)
        index = best_place(
            "spring pin", obstacles, places, (1.5, 1.5), 0.0, inside,
            lambda p: np.abs(np.arctan2(p[:, 1] - hub[1], p[:, 0] - hub[0]) - math.radians(40.0)),
            "lower stiffness_nmm_per_deg (a smaller spring) or raise carrying_link_mm",
        )  # fmt: skip
        return np.asarray(places[index])

    try:
        return place(5.0)
    except CannotBuildError:
        return place(1.0)


def _train_places(
    obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array
) -> tuple[Array | None, Array, float]:
    """Return the idler's place (two stages), the motor's, and the motor's direction."""
    stages, motor = drive.train.stages, drive.train.motor
    half = socket_half_mm(motor)
    body_y = (lateral.inside[0], lateral.gears[-1][0] - GAP_MM)
    target = np.array([0.0, 14.0])
    remedy = (
        "raise d_coef or carrying_link_mm (a longer body), or allow a smaller motor than "
        f"{motor.name} ({motor.width_mm:g} x {motor.height_mm:g} mm)"
    )

    tip = stages[0].pinion.tip_radius_mm
    meshes_with = "cam gear" if len(stages) == 1 else "idler wheel"

    def motor_place(around: Array, extra: list[Obstacle]) -> tuple[Array, float]:
        places, angles = ring_candidates(around, stages[0].centre_distance_mm)
        others = [obstacle for obstacle in obstacles + extra if obstacle.name != meshes_with]
        free = clearance(others, places, (0.0, 0.0), 0.0, lateral.gears[-1]) >= tip
        if not free.any():
            raise CannotBuildError(f"no room for the pinion of {tip:.1f} mm radius on the motor: {remedy}")
        places, angles = places[free], angles[free]
        index = best_place(
            "motor", obstacles + extra, places, half, angles, body_y,
            lambda p: np.linalg.norm(p - target, axis=1), remedy,
        )  # fmt: skip
        return places[index], float(angles[index])

    if len(stages) == 1:
        place, angle = motor_place(cam_axis, [])
        return None, place, angle
    candidates, _ = ring_candidates(cam_axis, stages[-1].centre_distance_mm)
    wheel_free = clearance(obstacles, candidates, (0.0, 0.0), 0.0, lateral.gears[1]) - stages[0].wheel.tip_radius_mm
    others = [o for o in obstacles if o.name != "cam gear"]
    axle_free = clearance(others, candidates, (0.0, 0.0), 0.0, lateral.inside) - SPACER_RADIUS_MM
    free = np.minimum(wheel_free, axle_free)
    best: tuple[float, Array, Array, float] | None = None
    for candidate in candidates[free >= 0][::2]:
        try:
            place, angle = motor_place(candidate, _idler_obstacles(candidate, drive, lateral))
        except CannotBuildError:
            continue
        cost = float(np.linalg.norm(place - target) + np.linalg.norm(candidate - target))
        if best is None or cost < best[0]:
            best = (cost, candidate, place, angle)
    if best is None:
        raise CannotBuildError(f"no room for the idler and the motor beside the cam: {remedy}")
    return best[1:]


def _idler_obstacles(place: Array, drive: Drive, lateral: Lateral) -> list[Obstacle]:
    """Return the idler's wheel, pinion and axle as obstacles."""
    first, last = drive.train.stages[0], drive.train.stages[-1]
    return [
        disc("idler wheel", place, first.wheel.tip_radius_mm + CLEAR_MM, lateral.gears[1]),
        disc("idler pinion", place, last.pinion.tip_radius_mm + CLEAR_MM, lateral.gears[0]),
        disc("idler axle", place, SPACER_RADIUS_MM + CLEAR_MM, lateral.inside),
    ]


def _tray_place(
    obstacles: list[Obstacle], electronics: Electronics, l1_mm: float, inside: tuple[float, float]
) -> Array:
    """Return the middle of the lower tray's underside.

    Over the front pivot the battery balances cam and motor: the body's centre of mass then lies between the pivots.
    """
    half = (electronics.length_mm / 2.0, electronics.height_mm / 2.0)
    places = grid_candidates((-l1_mm / 2.0, l1_mm / 2.0 + 30.0), (0.0, 60.0), 2.0)
    target = np.array([0.5 * l1_mm, 0.0])
    index = best_place(
        "battery and electronics", obstacles, places + np.array([0.0, half[1]]), half, 0.0, inside,
        lambda p: np.abs(p[:, 0] - target[0]) + 1.2 * np.abs(p[:, 1] - half[1]),
        "raise d_coef or carrying_link_mm (a longer body), or choose a smaller battery or smaller boards: "
        f"{electronics.names} take {electronics.length_mm:.1f} x {electronics.height_mm:.1f} mm",
    )  # fmt: skip
    return np.asarray(places[index])


def _standoffs(
    obstacles: list[Obstacle],
    cam_axis: Array,
    front: Array,
    centre: Array,
    electronics: Electronics,
    inside: tuple[float, float],
) -> tuple[Array, ...]:
    """Return the places of the standoffs that, with the axles, hold the plates apart at the top of the body."""
    top_z = centre[1] + electronics.height_mm / 2.0 + STANDOFF_RADIUS_MM + GAP_MM
    wanted = [
        np.array([centre[0] + electronics.length_mm / 2.0, top_z]),
        np.array([(cam_axis[0] + centre[0]) / 2.0, max(top_z, cam_axis[1])]),
    ]
    places = grid_candidates((cam_axis[0] - 20.0, max(front[0], centre[0]) + 40.0), (0.0, 80.0), 2.0)
    found: list[Array] = []
    for target in wanted:
        taken = [disc("standoff", place, STANDOFF_RADIUS_MM + CLEAR_MM + 8.0, EVERYWHERE) for place in found]
        index = best_place(
            "standoffs", [*obstacles, *taken], places, (STANDOFF_RADIUS_MM, STANDOFF_RADIUS_MM), 0.0, inside,
            lambda p, target=target: np.linalg.norm(p - target, axis=1),  # type: ignore[misc]
            "raise carrying_link_mm",
        )  # fmt: skip
        found.append(places[index])
    return tuple(found)
