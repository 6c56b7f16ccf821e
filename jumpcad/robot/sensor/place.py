"""The switch that says when the cam is ready: its place outside the left plate, and the land on the cam gear (mm).

The switch's plunger points through the plate at the cam gear's left face. A ring groove in that face leaves the plunger
free; a land in the groove presses it from a little before the drop until a little after it. The land is on the gear, so
it opens the switch although the cam runs ahead in its dog.
"""

import math
from dataclasses import dataclass

import numpy as np

from jumpcad.catalogue import Component, Travel
from jumpcad.dimensions import CLEAR_MM, GAP_MM, PAD_WALL_MM
from jumpcad.drive import Drive
from jumpcad.errors import CannotBuildError
from jumpcad.findings import choose, higher
from jumpcad.robot.space.inside import Lateral
from jumpcad.robot.space.room import TURN_STEPS, Obstacle, around, best_place, box_obstacle, disc, shortfall
from jumpcad.transforms import Array

GEAR_PLAY_MM = 0.1
"""Left of the cam gear's hub; judgement: the least that turns freely, since the land's height counts."""
SLACK_MM = (2.0 * GAP_MM / 2.0 + GEAR_PLAY_MM) / 2.0 - GEAR_PLAY_MM
"""How far the land is, in the middle of its play, to the right of where it is drawn: the plunger pushes the gear to the
right as far as it goes; cam spacer, cam and gear each have half a gap."""
FREE_MM = 0.1
"""Between the free plunger and the groove at the worst; judgement."""
TRACK_WALL_MM = 1.6
"""Wall between the groove and the dog's pockets or the teeth; judgement: four lines of a 0.4 mm nozzle."""
TRACK_EDGE_MM = 0.3
"""Between the groove's wall and the plunger at the worst; judgement."""
WEB_MIN_MM = 1.6
"""Least thickness of the gear under the groove; judgement: eight layers of 0.2 mm."""
RADIUS_WANTED_MM = 12.0
"""Of the land's middle; judgement: farther out an angle is more exact, and the plate larger."""
OPENING_MM = 0.4
"""Around the switch's case in the plate; the mount holds it."""
MOUNT_WALL_MM, MOUNT_PLAY_MM = 1.4, 0.2
"""Wall of the mount, and play around the case in it, either side; judgement."""
EAR_RADIUS_MM, HEAD_RADIUS_MM = 2.6, 1.9
"""Of the mount's ears, and room for its screws' heads: M2 heads of 3.8 mm (ISO 14580)."""
TERMINALS_MM = 6.0
"""Room beyond the mount for terminals and the bend of their wires; judgement."""
PLACE_WANTED_MM = np.array([0.0, 14.0])
"""Where the switch is wanted in the body frame; judgement: the plate is there anyway."""


@dataclass(frozen=True)
class SensorNeeds:
    """A switch and what its place depends on.

    - `axial_mm`: How far the land's height under the plunger may be from the drawing, either way.
    - `along_mm`: How far land and plunger may be off along the track, either way.
    - `stop_rad`: How far the cam turns at most from the switch's contact until it stands.
    - `reserve_rad`: Kept free besides, before the drop and after it.
    - `layer_mm`: Layer height: the land's ramps climb one layer a step.
    """

    part: Component
    travel: Travel
    axial_mm: float
    along_mm: float
    stop_rad: float
    reserve_rad: float
    layer_mm: float

    @property
    def case_mm(self) -> tuple[float, float]:
        """Length and width of the switch's case."""
        return self.part.length_mm or 0.0, self.part.width_mm or 0.0

    @property
    def ear_mm(self) -> float:
        """From the plunger to the mount's screws, along the long side."""
        return self.case_mm[0] / 2.0 + MOUNT_PLAY_MM + MOUNT_WALL_MM + HEAD_RADIUS_MM

    @property
    def half_mm(self) -> tuple[float, float]:
        """Half of the mount's length and width."""
        return self.ear_mm + EAR_RADIUS_MM, self.case_mm[1] / 2.0 + MOUNT_PLAY_MM + MOUNT_WALL_MM


@dataclass(frozen=True)
class SensorPlace:
    """Where the switch is, and the track that it feels.

    - `place_mm`: The plunger's axis (2,) in the body frame's x-z plane.
    - `turn_rad`: Turn of the switch's long side in x-z, counter-clockwise from x.
    - `direction_rad`: Direction of the plunger from the cam's axis, counter-clockwise from x.
    - `radius_mm`: Of the plunger from the cam's axis.
    - `depth_mm`: Of the groove below the land.
    - `base_mm`: From the plate's outer face to the switch's base, outwards.
    - `scatter_rad`: How far the angle at which the switch operates may be from the drawn one, either way.
    - `ready_rad`, `open_rad`: Cam angle before the end of the lift at which it closes, and after it at which it opens
      again, as drawn.
    """

    needs: SensorNeeds
    place_mm: Array
    turn_rad: float
    direction_rad: float
    radius_mm: float
    half_width_mm: float
    depth_mm: float
    base_mm: float
    scatter_rad: float
    ready_rad: float
    open_rad: float

    @property
    def press_mm(self) -> float:
        """How far the land presses the plunger beyond its operating position, as drawn."""
        return self.needs.travel.operating_mm - middle_mm(self.needs.travel)

    def land_rad(self, above_mm: float, lift_rad: float) -> tuple[float, float]:
        """Return where the land begins and ends at a height above the groove.

        Counter-clockwise from x at cam angle 0. Both ramps rise at 45°; at the height at which the switch operates they
        are as far from the drop as `ready_rad` and `open_rad` say.
        """
        nearer = (above_mm - (self.depth_mm - self.press_mm)) / self.radius_mm
        begin = self.direction_rad + lift_rad - self.ready_rad + nearer
        return begin, self.direction_rad + lift_rad + self.open_rad - nearer


def middle_mm(travel: Travel) -> float:
    """Return the plunger's position, from the base, halfway between its surest operating one and its end of travel."""
    return (travel.operating_mm - travel.operating_tolerance_mm + travel.total_mm) / 2.0


def track_mm(travel: Travel, along_mm: float) -> float:
    """Return the width of the track with a wall either side."""
    return travel.pin_mm + 2.0 * (along_mm + TRACK_EDGE_MM + TRACK_WALL_MM)


def sensor_place(
    obstacles: list[Obstacle], drive: Drive, lateral: Lateral, cam_axis: Array, axles: dict[str, Array], motor: Array,
    axle_mm: float, needs: SensorNeeds,
) -> SensorPlace:  # fmt: skip
    """Return the place of the switch beside the cam gear: along its track, where the plate is free.

    It keeps away from the seats of `axles`, the axles and pins that the plate holds, and from the motor's shaft.
    """
    travel, half = needs.travel, needs.half_mm
    low, high, width = _track_mm(drive, needs)
    depth = needs.layer_mm * math.ceil(
        (travel.free_mm + FREE_MM + needs.axial_mm - middle_mm(travel)) / needs.layer_mm - 1e-9
    )
    thickness = drive.train.stages[-1].wheel.face_width_mm
    if thickness - depth < WEB_MIN_MM:
        raise CannotBuildError(
            f"no room for the sensor's groove: {depth:.1f} mm deep, it leaves {thickness - depth:.1f} of the cam "
            f"gear's {thickness:g} mm; {WEB_MIN_MM:g} mm are needed: choose a bought.sensor with less travel",
            "sensor_groove", thickness - depth - WEB_MIN_MM,
        )  # fmt: skip
    y = (lateral.gears[0][1], lateral.left_plate[1] + half[1])
    seat = axle_mm / 2.0 + PAD_WALL_MM
    kept = [disc(f"{name} axle's seat", place, seat, y) for name, place in axles.items()]
    shaft = disc("motor's shaft", motor, drive.train.motor.shaft_mm / 2.0 + CLEAR_MM, y)
    free = [o for o in obstacles if o.name not in ("motor", "cam axle", "leg axle", "front axle", "idler axle")]
    wanted = float(np.clip(RADIUS_WANTED_MM, low, high))
    radii = sorted({round(r, 3) for r in (wanted, low, (low + high) / 2.0, high)}, key=lambda r: abs(r - wanted))
    refusal: CannotBuildError | None = None
    for radius in radii:
        directions = np.linspace(0.0, 2.0 * math.pi, TURN_STEPS, endpoint=False)
        places = around(cam_axis, radius, directions)
        try:
            best = best_place(
                "sensor beside the cam gear", [*free, *kept, shaft], places, half, directions + math.pi / 2.0, y,
                lambda p: np.linalg.norm(p - PLACE_WANTED_MM, axis=1),
                higher("d_coef", "carrying_link_mm") + choose("a smaller", "bought.sensor"),
            )  # fmt: skip
        except CannotBuildError as found:
            refusal = refusal or found
            continue
        direction = float(directions[best])
        slope = needs.axial_mm + travel.operating_tolerance_mm
        scatter = (slope + needs.along_mm) / radius
        reach = lateral.left_plate[1] - lateral.gears[0][1]
        return SensorPlace(
            needs=needs, place_mm=places[best], turn_rad=direction + math.pi / 2.0, direction_rad=direction,
            radius_mm=radius, half_width_mm=width / 2.0, depth_mm=depth,
            base_mm=middle_mm(travel) - reach - SLACK_MM, scatter_rad=scatter,
            ready_rad=scatter + needs.stop_rad + needs.reserve_rad, open_rad=scatter + needs.reserve_rad,
        )  # fmt: skip
    assert refusal is not None
    raise refusal


def sensor_obstacle(sensor: SensorPlace, lateral: Lateral) -> Obstacle:
    """Return the switch with its mount as an obstacle for what is placed after it."""
    y = (lateral.gears[0][1], lateral.left_plate[1] + sensor.base_mm + MOUNT_WALL_MM + TERMINALS_MM)
    half = np.array(sensor.needs.half_mm) + CLEAR_MM
    return box_obstacle("sensor", sensor.place_mm, half, sensor.turn_rad, y)


def _track_mm(drive: Drive, needs: SensorNeeds) -> tuple[float, float, float]:
    """Return the smallest and largest radius of the track's middle, and its width."""
    width = track_mm(needs.travel, needs.along_mm) - 2.0 * TRACK_WALL_MM
    wheel = drive.train.stages[-1].wheel
    inner = drive.dog.outer_mm / 2.0 + TRACK_WALL_MM
    outer = wheel.root_radius_mm - TRACK_WALL_MM
    if outer - inner < width:
        raise CannotBuildError(
            f"no room for the sensor's track on the cam gear: {shortfall(outer - inner - width)} too little between "
            f"its dog of {drive.dog.outer_mm:.1f} mm and its teeth, {2.0 * wheel.root_radius_mm:.1f} mm at their roots"
            ": allow a motor that needs a larger cam gear, or choose bought.sensor with a thinner plunger",
            "sensor_track", outer - inner - width,
        )  # fmt: skip
    return inner + width / 2.0, outer - width / 2.0, width
