"""The JSON file beside a URDF: what URDF cannot express, with the limits for a file that is read."""

from typing import Annotated, Any, Literal

from pydantic import Field

from jumpcad.errors import JumpcadError
from jumpcad.files import Record, TomlTable

Length = Annotated[float, Field(ge=-10, le=10)]
Angle = Annotated[float, Field(ge=-20, le=20)]
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
    foot_depth_m: Annotated[float, Field(ge=1e-5, le=1)]
    surfaces: dict[str, Literal["foot", "body"]]

    @classmethod
    def of(cls, data: Any) -> "LoopFile":
        """Return the content of a file.

        Raises
        ------
        JumpcadError
            Naming what is missing, unknown, or out of range.
        """
        if not isinstance(data, dict):
            raise JumpcadError("is not a table of values")
        return cls(**data)
