"""The tables of a workshop: printer, process, materials, fits, bought parts, body, release, ground, safety, masses."""

import math
from typing import Annotated, Literal

from pydantic import Field

from jumpcad.catalogue import ElectricalParts
from jumpcad.files import TomlTable
from jumpcad.files.records import Name, OptionalName, Text

# Lower limits keep quotients finite: they are below any figure of a robot that is printed and jumps.
Positive = Annotated[float, Field(ge=1e-4, le=1e4)]
Price = Annotated[float, Field(ge=0, le=1e4)]
"""Of what is there already, 0."""
SmallPositive = Annotated[float, Field(ge=1e-12, le=1e-5)]
Backlash = Annotated[float, Field(ge=0, le=30)]
Length = Annotated[float, Field(ge=0.01, le=1e4)]
BedSide = Annotated[float, Field(ge=10, le=1e4)]
Stress = Annotated[float, Field(ge=0.1, le=1e4)]
Stronger = Annotated[float, Field(ge=1, le=3)]
Share = Annotated[float, Field(ge=1e-3, le=1)]


class Printer(TomlTable):
    """A machine: usable bed (x, y, z) and nozzle."""

    name: Text
    bed_mm: Annotated[tuple[BedSide, BedSide, BedSide], Field(strict=False)]
    nozzle_mm: Annotated[float, Field(ge=0.1, le=2)]
    source: Text = ""


class Process(TomlTable):
    """Print settings; the printed mass follows from them."""

    layer_height_mm: Annotated[float, Field(ge=0.03, le=1.5)]
    first_layer_mm: Annotated[float, Field(ge=0.03, le=1.5)]
    line_width_mm: Annotated[float, Field(ge=0.1, le=4)]
    perimeters: Annotated[int, Field(ge=1, le=20)]
    top_layers: Annotated[int, Field(ge=0, le=50)]
    bottom_layers: Annotated[int, Field(ge=0, le=50)]
    infill: Annotated[float, Field(ge=0, le=1)]
    infill_pattern: Literal["grid", "rectilinear", "gyroid", "triangles", "cubic", "honeycomb"]
    solid_below_area_mm2: Annotated[float, Field(ge=0, le=1e6)]
    part_spacing_mm: Annotated[float, Field(ge=0, le=50)]


class Material(TomlTable):
    """A material: strengths along the layers and between them, and what is known of its temperatures and price."""

    density_g_cm3: Annotated[float, Field(ge=0.3, le=10)]
    strength_in_plane_mpa: Stress
    strength_interlayer_mpa: Stress
    modulus_mpa: Annotated[float, Field(ge=1, le=1e6)]
    price_eur_per_kg: Price | None = None
    nozzle_c: Annotated[float, Field(ge=100, le=500)] | None = None
    bed_c: Annotated[float, Field(ge=0, le=200)] | None = None
    source: Text = ""


class Roles(TomlTable):
    """Which material a kind of part is printed in."""

    links: Name
    body: Name
    gears: Name


SHARES = {"press_mm": 0.5, "eye_mm": 0.5, "lying_mm": 0.5, "sliding_mm": 0.5, "loose_mm": 0.5, "rib_mm": -0.5,
          "m2_tap_mm": 1.0, "m2_clearance_mm": 1.0, "m3_tap_mm": 1.0, "m3_insert_mm": 1.0, "m3_clearance_mm": 1.0,
          "holes_small_mm": -1.0}  # fmt: skip
"""Of `holes_small_mm`, by which fits are drawn larger: those per side by half of it, diameters by all."""


class Fits(TomlTable):
    """Every tolerance offset, as modelled. Fits are added per side; screw holes are given by their drawn diameter.

    The limits allow for any usable printer: holes come out up to 1 mm too small in diameter, hardly ever
    too large. What a shaft turns in or passes is never drawn smaller than the shaft; a screw cuts its thread in a hole
    between its core and its own diameter, and passes one that is wider than itself. Where they still come out
    `holes_small_mm` smaller in diameter than they should, all are drawn wider by it; it is no play.
    """

    press_mm: Annotated[float, Field(ge=-0.2, le=0.5)]
    rib_mm: Annotated[float, Field(ge=0, le=0.3)]
    eye_mm: Annotated[float, Field(ge=0, le=0.8)]
    lying_mm: Annotated[float, Field(ge=-0.2, le=0.8)]
    sliding_mm: Annotated[float, Field(ge=0, le=0.8)]
    loose_mm: Annotated[float, Field(ge=0, le=1)]
    holes_small_mm: Annotated[float, Field(ge=-0.4, le=1)]
    backlash_circumferential_mm: Annotated[float, Field(ge=0, le=1)]
    m2_tap_mm: Annotated[float, Field(ge=1.4, le=2.2)]
    m2_clearance_mm: Annotated[float, Field(ge=2, le=3.5)]
    m3_tap_mm: Annotated[float, Field(ge=2.2, le=3.2)]
    m3_insert_mm: Annotated[float, Field(ge=3, le=6)]
    m3_clearance_mm: Annotated[float, Field(ge=3, le=5)]
    wall_min_mm: Annotated[float, Field(ge=0.1, le=10)]
    wall_mm: Annotated[float, Field(ge=0.1, le=10)]
    pin_min_mm: Annotated[float, Field(ge=0.01, le=20)]
    hole_min_mm: Annotated[float, Field(ge=0.01, le=20)]
    first_layer_chamfer_mm: Annotated[float, Field(ge=0, le=2)]
    overhang_deg: Annotated[float, Field(ge=0, le=80)]
    bridge_mm: Annotated[float, Field(ge=0.01, le=200)]

    @property
    def drawn(self) -> "Fits":
        """The fits with which holes are drawn: wider by `holes_small_mm`, of which nothing is left."""
        if (more := self.holes_small_mm) == 0.0:
            return self
        larger = {key: round(getattr(self, key) + share * more, 6) for key, share in SHARES.items()}
        return self.model_copy(update=larger)

    @property
    def link_tolerance_mm(self) -> float:
        """Error of a printed link's length (mm): both its ends have the play of a sliding fit."""
        return 2.0 * self.sliding_mm


class BoughtParts(ElectricalParts):
    """Names in the catalogue, shipped or the user's own; an empty list of motors allows every one.

    `kit` is the kit that the electrical parts come from; a file that names one takes all of them over, and those that
    it names itself override the kit's. An empty name leaves a part out, such as a
    regulator; a robot without switch or plug is refused. `pins` are pins of the controller for `motor`,
    `sleep`, `ready` (the sensor), `battery` (its voltage), `steer`, `steer_reverse`, `gyro_data` and `gyro_clock` where
    the program's choice does not suit.
    `leg_bearing` may be "any", the lightest that carries its load, or empty, which means none. `spring` is empty where
    springs of the design's stiffness are made to order.
    `leg` is the bar that main leg and front link are made of between printed ends, empty where they are printed whole.
    `axle` is the rod that axles are cut from. `retention` keeps them in place: blind bores of the screwed plates, clips
    in grooves, or screws as axles with lock nuts; pins of foot and leg have clips too, or are clevis pins.
    """

    kit: OptionalName
    leg_bearing: OptionalName
    roller: Name
    pins: dict[
        Literal["motor", "sleep", "ready", "battery", "steer", "steer_reverse", "gyro_data", "gyro_clock"], Name
    ] = Field(default_factory=dict)
    spring: OptionalName
    leg: OptionalName
    axle_mm: Length
    axle: Name
    retention: Literal["plates", "clips", "nuts"]


class BodyPlates(TomlTable):
    """The two plates of the body, the stop between them, and how wide the robot stands.

    The leg touches `stop_pad` at `stop_deg` past rest. `toe_half_width_mm` is the least distance of the toes' ends from
    the middle (0: that of the design). The right plate stands `right_mm` further out than it must.
    """

    plate_mm: Annotated[float, Field(ge=1, le=10)]
    stop_deg: Annotated[float, Field(ge=3, le=8)]
    stop_pad: OptionalName
    toe_half_width_mm: Annotated[float, Field(ge=0, le=200)]
    right_mm: Annotated[float, Field(ge=0, le=40)]


class CageTable(TomlTable):
    """The cage that rights the robot: two hoops of `rod` (empty: no cage) between cross bars, and a `bow` between both.

    What is 0 follows from the height at which the loaded robot crouches. `arc_deg` and `lean_deg` are of the hoops,
    which lean outwards; `rear_behind_mm` and `front_ahead_mm` are from the plates to the bars. The rear horns' tips are
    wider by `rear_tip_mm`.
    """

    rod: OptionalName
    bow: bool
    lean_deg: Annotated[float, Field(ge=0, le=45)]
    arc_deg: Annotated[float, Field(ge=0, le=310)]
    rear_behind_mm: Annotated[float, Field(ge=0, le=100)]
    rear_tip_mm: Annotated[float, Field(ge=0, le=20)]
    front_ahead_mm: Annotated[float, Field(ge=0, le=100)]
    rear_radius_mm: Annotated[float, Field(ge=0, le=250)]
    front_radius_mm: Annotated[float, Field(ge=0, le=250)]
    bar_mm: Annotated[float, Field(ge=4, le=10)]


class SteeringTable(TomlTable):
    """The wheel under the tail that turns the robot while it crouches: a printed one with an `o-ring`, or "none".

    What is 0 is found: the wheel's radius with its ring, how far below the feet's plane it reaches in the loaded pose
    (`dip_mm`), and how far it is behind the leg's axle, along the ground. It stands `aside_mm` to the right of the
    plates' middle, so that the toe to the left bears more. `base_mm` is the thickness of its mount.
    `gyroscope` is the board that measures its turns, a carrier of the LSM6DSO; without one they go by time.
    """

    wheel: Literal["none", "o-ring"]
    motor: Name
    radius_mm: Annotated[float, Field(ge=0, le=30)]
    dip_mm: Annotated[float, Field(ge=0, le=10)]
    behind_mm: Annotated[float, Field(ge=0, le=120)]
    aside_mm: Annotated[float, Field(ge=0, le=15)]
    base_mm: Annotated[float, Field(ge=1, le=8)]
    gyroscope: OptionalName = ""


class Seats(TomlTable):
    """How exactly the sensor sits over its track, where the electronics lie, and what holds them.

    The land's height under the plunger may be off by `sensor_axial_mm`, land and plunger along the track by
    `sensor_along_mm`. From the sensor's contact the cam stands within `sensor_stop_s`; `sensor_reserve_deg` of cam
    angle are kept besides, before the drop and after it. `battery` lies near the leg or at a plate, the controller with
    its USB socket at the plate `boards`; "balance" is where the robot's centre of mass comes nearest to the leg.
    `strap_n` and `tie_n` are what the battery's strap and a cable
    tie hold.
    """

    sensor_axial_mm: Annotated[float, Field(ge=0, le=2)]
    sensor_along_mm: Annotated[float, Field(ge=0, le=3)]
    sensor_stop_s: Annotated[float, Field(ge=0, le=1)]
    sensor_reserve_deg: Annotated[float, Field(ge=0, le=20)]
    battery: Literal["leg", "left", "right", "balance"]
    boards: Literal["left", "right", "balance"]
    strap_n: Positive
    tie_n: Positive


class Ground(TomlTable):
    """The floor that the robot jumps on, and the pad under nose and toes; coefficients of dry friction on that floor.

    `friction` is the pad's; without a pad (an empty name) the feet have `bare_friction`, that of what is printed, as
    the body has.
    """

    surface: Text
    pad: OptionalName
    friction: Annotated[float, Field(ge=1e-3, le=2)]
    bare_friction: Annotated[float, Field(ge=1e-3, le=2)]

    @property
    def foot_friction(self) -> float:
        return self.friction if self.pad else self.bare_friction


class Pins(TomlTable):
    """The pins that the links turn on, dry."""

    friction: Annotated[float, Field(ge=0, le=2)]


PRELOAD_MAX_DEG = 90.0
"""Judgement: arms of stock springs, mostly 180° apart, meet their pins with 60 to 80°."""


class SpringTable(TomlTable):
    """The springs: loaded by `preload_deg` already in the rest pose."""

    preload_deg: Annotated[float, Field(ge=0, le=PRELOAD_MAX_DEG)]


class Safety(TomlTable):
    """Safety factors, limits of springs, motor and legs, and reserves for deviations from the computed robot.

    Loads are taken as those of the stiffest springs within `spring_rate_scatter`, and more by `stress_reserve`. Other
    reserves are kept below the motor's torque and the cam's pressure angle, above gaps, and in the room for the rest
    stop and between main leg and front link; `kick_reserve` is added to
    the torque peak at the gear motor when the released cam strikes. The centre of mass lies at most `lateral_offset_mm`
    beside the leg (0: no limit).
    """

    strength_factor: Annotated[float, Field(ge=1, le=20)]
    motor_stall_share: Share
    motor_torque_max_nm: Positive
    gear_efficiency: Share
    spring_stress_share: Share
    spring_rate_scatter: Annotated[float, Field(ge=0, le=0.5)]
    stress_reserve: Annotated[float, Field(ge=0, le=1)]
    kick_reserve: Annotated[float, Field(ge=0, le=1)]
    motor_torque_reserve: Annotated[float, Field(ge=0, le=0.9)]
    pressure_angle_reserve_deg: Annotated[float, Field(ge=0, le=20)]
    gap_reserve_mm: Annotated[float, Field(ge=0, le=1)]
    room_reserve_mm: Annotated[float, Field(ge=0, le=5)]
    jumps: Annotated[float, Field(ge=1, le=1e9)]
    landing_stop_mm: Length
    lateral_offset_mm: Annotated[float, Field(ge=0, le=50)]
    roll_reserve_deg: Annotated[float, Field(ge=0, le=45)]
    leg_flex_share: Share
    steel_yield_mpa: Stress
    steel_factor: Annotated[float, Field(ge=1, le=20)]
    bearing_factor: Annotated[float, Field(ge=0.4, le=20)]

    @property
    def load_factor(self) -> float:
        """By how much loads may be larger than those computed."""
        return (1.0 + self.spring_rate_scatter) * (1.0 + self.stress_reserve)

    @property
    def printed_factor(self) -> float:
        """Safety factor of printed parts, with the reserves."""
        return self.strength_factor * self.load_factor

    @property
    def metal_factor(self) -> float:
        """Safety factor of axles, pins and screws, with the reserves."""
        return self.steel_factor * self.load_factor

    @property
    def motor_share(self) -> float:
        """Share of a motor's allowed torque that the computed springs may need."""
        return (1.0 - self.motor_torque_reserve) / (1.0 + self.spring_rate_scatter)


class StrengthTable(TomlTable):
    """By how much parts that broke are made thicker or higher than their limits ask for; `eyes` are the links'."""

    main_leg: Stronger
    front_link: Stronger
    eyes: Stronger
    foot: Stronger
    body_plates: Stronger
    cam: Stronger
    stop_bar: Stronger


class ReleaseTable(TomlTable):
    """The dog between cam and cam gear, and assumptions and limits of the release; ranges are (least, largest).

    `play_deg` is the dog's free play, "auto" by the rule in `drive.dog`, 0 a rigid key. `ease_deg` is the cam angle
    before the drop over which the motor's torque falls to 0.
    """

    play_deg: Literal["auto"] | Annotated[float, Field(ge=0, le=90)]
    ease_deg: Annotated[float, Field(ge=0, le=90)]
    corner_radius_mm: Annotated[float, Field(ge=0, le=3)]
    friction: Annotated[float, Field(ge=0, le=1)]
    rotor_kg_m2: Annotated[tuple[SmallPositive, SmallPositive], Field(strict=False)]
    backlash_deg: Annotated[tuple[Backlash, Backlash], Field(strict=False)]
    rebound: Annotated[float, Field(ge=0, le=1)]
    train_nm_per_rad: Positive
    contact_n_per_mm: Annotated[float, Field(ge=100, le=1e6)]
    energy_ratio_min: Share

    @property
    def play_rad(self) -> float | None:
        """The fixed play; None where it follows from the cam."""
        return None if self.play_deg == "auto" else math.radians(self.play_deg)


class Masses(TomlTable):
    """Where printed masses come from; a weighed mass (g, by part) overrides the model."""

    model: Literal["printed", "solid"]
    weighed_g: dict[Name, Positive]
