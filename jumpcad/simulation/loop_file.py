"""The JSON file beside a URDF: what URDF cannot express, with the limits for a file that is read."""

from typing import Annotated, Any, Literal

from pydantic import Field

from jumpcad.files import Record, TomlTable

Length = Annotated[float, Field(ge=-10, le=10)]
Angle = Annotated[float, Field(ge=-20, le=20)]
Radius = Annotated[float, Field(ge=0, le=0.1)]
Point = Annotated[tuple[Length, Length, Length], Field(strict=False)]
JointName = Literal["leg", "front", "ankle"]
BodyName = Literal["body", "main_leg", "front_link", "foot"]


class LoopSection(TomlTable):
    """The closure of the five-bar, see `jumpcad.robot.Loop`."""

    body_a: BodyName
    point_a_m: Point
    body_b: BodyName
    point_b_m: Point


class SpringSection(TomlTable):
    """Both springs together, see `jumpcad.robot.Spring`."""

    joint: Literal["leg"]
    stiffness_nm_per_rad: Annotated[float, Field(ge=1e-4, le=1e3)]
    rest_rad: Annotated[float, Field(ge=0, le=0)]
    wind_rad: Annotated[float, Field(ge=1e-4, le=3.1416)]
    preload_rad: Annotated[float, Field(ge=0, le=3.1416)] = 0.0
    one_sided: bool = False


class StopSection(TomlTable):
    """The stop beyond rest, see `jumpcad.robot.Stop`."""

    joint: Literal["leg"]
    angle_rad: Annotated[float, Field(ge=0, le=3.1416)]
    stiffness_nm_per_rad: Annotated[float, Field(ge=1e-4, le=1e6)]


class RollerOffSection(TomlTable):
    """Where the jump begins, see `jumpcad.robot.RollerOff`."""

    leg_rad: Annotated[float, Field(ge=-3.1416, le=0)]
    leg_rad_s: Annotated[float, Field(ge=0, le=1e4)]
    energy_ratio: Annotated[float, Field(ge=1e-3, le=1.01)]


class FrictionSection(TomlTable):
    """Friction on the ground and in the pins, see `jumpcad.robot.Friction`."""

    foot: Annotated[float, Field(ge=1e-3, le=2)]
    body: Annotated[float, Field(ge=1e-3, le=2)]
    pin: Annotated[float, Field(ge=0, le=2)]
    pin_radius_m: Annotated[tuple[Radius, Radius, Radius, Radius], Field(strict=False)]


class ReleaseSection(TomlTable):
    """The pose at release; simulations find it themselves."""

    joint_rad: dict[JointName, Angle]
    body_position_m: Point
    body_pitch_rad: Angle


class LoopFile(Record):
    """Everything that the file says; the design is validated as any other."""

    design: dict[str, Any]
    loop: LoopSection
    spring: SpringSection
    travel_rad: Annotated[
        dict[JointName, Annotated[tuple[Angle, Angle], Field(strict=False)]], Field(min_length=3, max_length=3)
    ]
    release: ReleaseSection
    stop: StopSection | None = None
    roller_off: RollerOffSection | None = None
    friction: FrictionSection | None = None
    foot_depth_m: Annotated[float, Field(ge=1e-5, le=1)]
    surfaces: dict[str, Literal["foot", "body"]]
