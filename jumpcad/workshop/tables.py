"""The tables of a workshop: printer, process, materials, fits, bought parts, body, ground, pins, safety, masses."""

from typing import Annotated, Literal

from pydantic import Field

from jumpcad.files import TomlTable
from jumpcad.files.names import Name, OptionalName, Text

Positive = Annotated[float, Field(gt=0, le=1e4)]
Share = Annotated[float, Field(gt=0, le=1)]


class Printer(TomlTable):
    """A machine: usable bed (x, y, z) and nozzle."""

    name: Text
    bed_mm: Annotated[tuple[Positive, Positive, Positive], Field(strict=False)]
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
    solid_below_area_mm2: Annotated[float, Field(ge=0)]
    part_spacing_mm: Annotated[float, Field(ge=0, le=50)]


class Material(TomlTable):
    """A material: strengths along the layers and between them, and its price where one is entered."""

    density_g_cm3: Annotated[float, Field(ge=0.3, le=10)]
    strength_in_plane_mpa: Positive
    strength_interlayer_mpa: Positive
    modulus_mpa: Annotated[float, Field(gt=0, le=1e6)]
    price_eur_per_kg: Positive | None = None
    source: Text = ""


class Roles(TomlTable):
    """Which material a kind of part is printed in."""

    links: Name
    body: Name
    gears: Name


class Fits(TomlTable):
    """Every tolerance offset, as modelled. Fits are added per side; screw holes are given by their drawn diameter.

    The limits allow for any usable printer: holes come out up to 1 mm too small in diameter, hardly ever
    too large. What a shaft turns in or passes is never drawn smaller than the shaft; a screw cuts its thread in a hole
    between its core and its own diameter, and passes one that is wider than itself.
    """

    press_mm: Annotated[float, Field(ge=-0.2, le=0.5)]
    sliding_mm: Annotated[float, Field(ge=0, le=0.8)]
    loose_mm: Annotated[float, Field(ge=0, le=1)]
    hole_allowance_diameter_mm: Annotated[float, Field(ge=-0.4, le=1)]
    backlash_circumferential_mm: Annotated[float, Field(ge=0, le=1)]
    m2_tap_mm: Annotated[float, Field(ge=1.4, le=2.2)]
    m2_clearance_mm: Annotated[float, Field(ge=2, le=3.5)]
    m3_tap_mm: Annotated[float, Field(ge=2.2, le=3.2)]
    m3_insert_mm: Annotated[float, Field(ge=3, le=6)]
    m3_clearance_mm: Annotated[float, Field(ge=3, le=5)]
    wall_min_mm: Annotated[float, Field(ge=0.1, le=10)]
    wall_mm: Annotated[float, Field(ge=0.1, le=10)]
    pin_min_mm: Annotated[float, Field(gt=0, le=20)]
    hole_min_mm: Annotated[float, Field(gt=0, le=20)]
    first_layer_chamfer_mm: Annotated[float, Field(ge=0, le=2)]
    overhang_deg: Annotated[float, Field(ge=0, le=80)]
    bridge_mm: Annotated[float, Field(gt=0, le=200)]


class BoughtParts(TomlTable):
    """Names in the catalogue, shipped or the user's own; an empty list of motors allows every one.

    `kit` is the kit that the electrical parts come from; a file that names one takes all of them over, and those that
    it names itself override the kit's. An empty name leaves a part out. `pins` are pins of the controller for `motor`,
    `sleep`, `ready` (the sensor) and `battery` (its voltage) where the program's choice does not suit.
    `leg_bearing` may be "any", the lightest that bears its load, or empty, which means none. `spring` is empty where
    springs of the design's stiffness are made to order.
    """

    kit: OptionalName
    motors: Annotated[tuple[Name, ...], Field(strict=False)]
    leg_bearing: OptionalName
    roller: Name
    battery: Name
    controller: Name
    driver: Name
    regulator: OptionalName
    sensor: OptionalName
    switch: OptionalName
    plug: OptionalName
    capacitor: OptionalName
    diode: OptionalName
    wire: OptionalName
    pins: dict[Literal["motor", "sleep", "ready", "battery"], Name] = Field(default_factory=dict)
    spring: OptionalName
    axle_mm: Positive


class BodyPlates(TomlTable):
    """The two plates of the body."""

    plate_mm: Annotated[float, Field(ge=1, le=10)]


class SpringTable(TomlTable):
    """How the springs sit: loaded by `preload_deg` already in the rest pose."""

    preload_deg: Annotated[float, Field(ge=0, le=45)]


class Ground(TomlTable):
    """The floor that the robot jumps on, and the pad under nose and toes; coefficients of dry friction on that floor.

    `friction` is the pad's; without a pad (an empty name) the feet have `bare_friction`, that of what is printed, as
    the body has.
    """

    surface: Text
    pad: OptionalName
    friction: Annotated[float, Field(gt=0, le=2)]
    bare_friction: Annotated[float, Field(gt=0, le=2)]

    @property
    def foot_friction(self) -> float:
        """Friction of the feet on the floor."""
        return self.friction if self.pad else self.bare_friction


class Pins(TomlTable):
    """The pins that the links turn on, dry."""

    friction: Annotated[float, Field(ge=0, le=2)]


class Safety(TomlTable):
    """Safety factors, and what springs, motor and legs may be loaded with."""

    strength_factor: Annotated[float, Field(ge=1, le=20)]
    motor_stall_share: Share
    motor_torque_max_nm: Positive
    gear_efficiency: Share
    spring_stress_share: Share
    spring_rate_scatter: Annotated[float, Field(ge=0, le=0.5)]
    jumps: Annotated[float, Field(ge=1, le=1e9)]
    landing_stop_mm: Positive
    leg_flex_share: Share
    steel_yield_mpa: Positive
    steel_factor: Annotated[float, Field(ge=1, le=20)]
    bearing_factor: Annotated[float, Field(ge=0.4, le=20)]


class Masses(TomlTable):
    """Where printed masses come from; a weighed mass (g, by part) overrides the model."""

    model: Literal["printed", "solid"]
    weighed_g: dict[Name, Positive]
