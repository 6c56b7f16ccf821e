"""The layout of one robot: every place and interval that parts and bought parts are made from (numpy only, mm).

In-plane places are in the body frame's x-z plane; intervals of y come from the lateral stack.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeVar

from jumpcad import dimensions
from jumpcad.catalogue import Bearing, LegBar
from jumpcad.design import Design
from jumpcad.drive import Drive
from jumpcad.drive.motor import cap_ear_mm
from jumpcad.errors import CannotBuildError
from jumpcad.mechanism.linkage import LEGS_APART, Linkage, toe_tip_mm
from jumpcad.robot.electronics.fittings import Fittings, electronics_obstacle, fittings_of, standoff_places, tray_place
from jumpcad.robot.electronics.place import Electronics
from jumpcad.robot.leg.place import PinHole, pin_hole
from jumpcad.robot.sensor.place import SensorNeeds, SensorPlace, sensor_obstacle, sensor_place
from jumpcad.robot.sizing import Sections, beside_leg_mm
from jumpcad.robot.space.inside import (
    Lateral,
    axle_obstacle,
    cam_obstacles,
    hub_obstacles,
    lateral_stack,
    legs_apart_mm,
    swept_obstacles,
)
from jumpcad.robot.space.room import Obstacle, disc, shortfall
from jumpcad.robot.springs.place import spring_boss_mm, spring_obstacles, spring_pin_place
from jumpcad.robot.stop.place import GIVE_ROOM_RAD, StopPlace, stop_angle_rad, stop_obstacles, stop_place
from jumpcad.robot.train.place import idler_obstacles, require_gear_room, require_shaft, train_obstacles, train_places
from jumpcad.strength.bearings import roller_screw_mm
from jumpcad.transforms import Array
from jumpcad.workshop import Workshop

Placed = TypeVar("Placed")
Retention = Literal["plates", "clips", "nuts"]
"""What keeps the axles in place: blind bores of the plates, clips in grooves, or screws as axles with lock nuts."""


@dataclass(frozen=True)
class Layout:
    """Where everything is; points (2,) are x-z in the body frame (mm).

    The places come with their inputs: linkage, sections, hub bearing (None where the hub runs on its axle)
    and drive. `toes_apart` says whether the foot is too large for the bed with its toes, so that they are
    separate parts. `toe_half_width_mm` is how far from the middle the toes touch the ground: at their tips, or at the
    ends of bars across them. `leg_bar` is what main leg and front link are made of between printed ends, if anything.
    `cap_ear_mm` is how far the ears for the motor cap's screws reach beyond the socket, `spring_boss_mm` the height of
    the boss for the springs' pin inside the right plate; 0 without. `things` are the places of what has looked for one
    on this machine (`jumpcad.robot.things`), None of what the robot goes without. `label` is engraved.
    """

    linkage: Linkage
    sections: Sections
    drive: Drive
    lateral: Lateral
    electronics: Electronics
    hub_bearing: Bearing | None
    toes_apart: bool
    axle_mm: float
    retention: Retention
    toe_half_width_mm: float
    hub_mm: Array
    front_mm: Array
    cam_axis_mm: Array
    idler_mm: Array | None
    motor_mm: Array
    motor_angle_rad: float
    cap_ear_mm: float
    spring_pin_mm: Array
    spring_boss_mm: float
    leg_pin_mm: float
    pin_hole: PinHole
    tray_mm: Array
    standoffs_mm: tuple[Array, ...]
    stop: StopPlace
    fittings: Fittings
    sensor: SensorPlace | None = None
    leg_bar: LegBar | None = None
    things: tuple[object, ...] = ()
    label: str = ""

    @property
    def design(self) -> Design:
        return self.linkage.design

    def of(self, kind: type[Placed]) -> Placed | None:
        """Return the place of a thing, by its type; None where the robot goes without."""
        return next((place for place in self.things if isinstance(place, kind)), None)

    @property
    def eye_x_mm(self) -> float:
        """How far along the foot its front eye is."""
        return self.design.l4_mm

    @property
    def axles(self) -> dict[str, Array]:
        """The dead axles that cross both plates."""
        axles = {"leg": self.hub_mm, "front": self.front_mm, "cam": self.cam_axis_mm}
        return axles if self.idler_mm is None else axles | {"idler": self.idler_mm}

    @property
    def toe_bar_mm(self) -> float:
        """Length of the bars across the toes' tips, outwards; 0 without."""
        return self.toe_half_width_mm - float(toe_tip_mm(self.design)[1])

    @property
    def floor_mm(self) -> float:
        """Thickness of what closes the plates' bores outside; 0 where axles pass the plates."""
        return dimensions.AXLE_FLOOR_MM if self.retention == "plates" else 0.0

    @property
    def boss_mm(self) -> float:
        """By how much the plates are thicker, inside, around the leg's axle."""
        return dimensions.AXLE_BOSS_MM if self.retention == "plates" else 0.0

    @property
    def spring_bore_room_mm(self) -> float:
        """Diameter of what may be around the leg's axle inside the springs' coils."""
        return min(2.0 * dimensions.SPACER_RADIUS_MM, self.drive.spring.mandrel_mm)

    @property
    def ankle_face_mm(self) -> float:
        """How far from the middle the foot's outer faces at the ankle are, between which its pin is kept."""
        sections = self.sections
        return beside_leg_mm(sections.thickness_mm) + max(sections.lug_thickness_mm, sections.toe_width_mm)


def make_layout(
    linkage: Linkage, sections: Sections, drive: Drive, electronics: Electronics, workshop: Workshop, *,
    hub_bearing: Bearing | None, roller: Bearing, toes_apart: bool, plate_mm: float, leg_pin_hole_mm: float,
    sensor: SensorNeeds | None = None,
) -> Layout:  # fmt: skip
    """Lay out a robot: the lateral stack first, then in the plane of motion one part after the other.

    `plate_mm` is the plates' thickness as grown, `leg_pin_hole_mm` the diameter of the left plate's hole through which
    the pin goes into the leg. Without `sensor` no switch says when the robot is wound.
    """
    lateral = lateral_stack(
        sections.thickness_mm, sections.lug_thickness_mm, roller.width_mm, drive.spring.body_length_mm,
        tuple(stage.wheel.face_width_mm for stage in reversed(drive.train.stages)), drive.train.motor, plate_mm,
        electronics.width_mm, roller_screw_mm(sections.thickness_mm, roller, workshop.catalogue),
        workshop.body.right_mm,
    )  # fmt: skip
    bought, reserve_mm, axle_mm = workshop.bought, workshop.safety.room_reserve_mm, workshop.bought.axle_mm
    ear_mm = cap_ear_mm(workshop.fits.wall_min_mm)
    inside, pin_radius = lateral.inside, drive.spring.arms.pin_radius_mm
    hub, front = linkage.back_pivot_mm, linkage.front_pivot_mm
    cam_axis = hub + drive.cam.geometry.axis_mm
    _require_legs_apart(linkage, sections, dimensions.GAP_MM + reserve_mm)
    stop_rad = stop_angle_rad(linkage, sections, math.radians(workshop.body.stop_deg), dimensions.GAP_MM + reserve_mm)
    moving = swept_obstacles(linkage, sections, drive, lateral, stop_rad + GIVE_ROOM_RAD)
    require_shaft(drive.train.motor, lateral)
    beside_hub, front_axle = hub_obstacles(hub, drive, lateral), axle_obstacle("front axle", front, lateral)
    cam_things = cam_obstacles(cam_axis, drive, lateral)
    wheel = drive.train.stages[-1].wheel
    require_gear_room([*beside_hub, front_axle], cam_axis, wheel.tip_radius_mm, lateral.gears[0])
    # close to the springs and to what moves, and without the leg, which meets the stop
    around_leg = swept_obstacles(linkage, sections, drive, lateral, stop_rad + GIVE_ROOM_RAD, dimensions.GAP_MM)[1:]
    around_leg += [*hub_obstacles(hub, drive, lateral, dimensions.GAP_MM), front_axle, *cam_things]
    stop = stop_place(
        around_leg, linkage, sections, stop_rad, workshop.stop_pad, inside, lateral.left_plate, reserve_mm
    )
    beside_hub += stop_obstacles(stop, inside)
    spring_pin = spring_pin_place([*moving, *cam_things, front_axle], hub, drive.spring, inside)
    obstacles = [*moving, *beside_hub, front_axle, *cam_things]
    through = pin_hole(linkage, around_leg, stop, lateral, pin_radius, leg_pin_hole_mm, axle_mm)
    obstacles += spring_obstacles(hub, spring_pin, drive.spring, inside)
    obstacles.append(through.obstacle((lateral.leg[1], lateral.left_plate[1])))
    idler, motor, angle = train_places(obstacles, drive, lateral, cam_axis, ear_mm)
    obstacles += train_obstacles(motor, angle, idler, drive, lateral, ear_mm)
    seats = {"leg": hub, "front": front, "cam": cam_axis, "spring": spring_pin}
    seats |= {} if idler is None else {"idler": idler}
    felt = None
    if sensor is not None:
        felt = sensor_place(obstacles, drive, lateral, cam_axis, seats, motor, axle_mm, sensor)
    obstacles += [sensor_obstacle(felt, lateral)] if felt else []
    tray = tray_place(obstacles, electronics, float(front[0]), inside)
    obstacles.append(electronics_obstacle(electronics, tray, inside))
    standoffs = standoff_places(obstacles, cam_axis, front, electronics, tray, inside)
    obstacles += [disc("standoff", place, dimensions.STANDOFF_PAD_MM / 2.0, inside) for place in standoffs]
    beside = [*seats.values(), stop.tab_mm]
    boss = spring_boss_mm(obstacles, spring_pin, axle_mm, lateral)
    fittings = fittings_of(obstacles, lateral, electronics, tray, beside, axle_mm / 2.0 + dimensions.PAD_WALL_MM)
    return Layout(
        linkage=linkage, sections=sections, drive=drive, lateral=lateral, electronics=electronics,
        hub_bearing=hub_bearing, toes_apart=toes_apart, axle_mm=axle_mm, retention=bought.retention,
        toe_half_width_mm=max(workshop.body.toe_half_width_mm, float(toe_tip_mm(linkage.design)[1])), hub_mm=hub,
        front_mm=front, cam_axis_mm=cam_axis, idler_mm=idler, motor_mm=motor, motor_angle_rad=angle, cap_ear_mm=ear_mm,
        spring_pin_mm=spring_pin, spring_boss_mm=boss, leg_pin_mm=pin_radius, pin_hole=through, tray_mm=tray,
        standoffs_mm=standoffs, stop=stop, leg_bar=workshop.leg_bar, fittings=fittings, sensor=felt,
    )  # fmt: skip


def moving_obstacles(layout: Layout) -> list[Obstacle]:
    """Return the room that links, cam and gears sweep, without a clearance."""
    drive, lateral = layout.drive, layout.lateral
    found = swept_obstacles(layout.linkage, layout.sections, drive, lateral, layout.stop.reach_rad, 0.0)
    turning = cam_obstacles(layout.cam_axis_mm, drive, lateral)
    turning += [] if layout.idler_mm is None else idler_obstacles(layout.idler_mm, drive, lateral)
    found += [o for o in turning if o.name not in ("cam axle", "idler axle")]
    pinion = drive.train.stages[0].pinion.tip_radius_mm
    return [*found, disc("pinion", layout.motor_mm, pinion, lateral.gears[-1])]


def _require_legs_apart(linkage: Linkage, sections: Sections, gap_mm: float) -> None:
    apart_mm = legs_apart_mm(linkage, sections)
    if (room := apart_mm - gap_mm) < 0:
        lie = "overlap by" if apart_mm < 0 else "come as near as"
        raise CannotBuildError(
            f"main leg and front link {lie} {abs(apart_mm):.2g} mm; {gap_mm:g} mm between them are needed, "
            f"{shortfall(room)} more than there is",
            "legs_apart", room, ways=LEGS_APART,
        )  # fmt: skip
