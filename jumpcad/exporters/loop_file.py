"""The JSON file beside a URDF: loop, spring, release and what else URDF cannot express, both ways by one model."""

import json
from dataclasses import asdict
from typing import Annotated, Any, Literal

from pydantic import Field

from jumpcad.files import Record, TomlTable
from jumpcad.mechanism.model import BodyName, JointName, Mechanism, release_pose

Length = Annotated[float, Field(ge=-10, le=10)]
Angle = Annotated[float, Field(ge=-20, le=20)]
Radius = Annotated[float, Field(ge=0, le=0.1)]
Point = Annotated[tuple[Length, Length, Length], Field(strict=False)]
Corner = Annotated[tuple[Length, Length], Field(strict=False)]
Outline = Annotated[list[Corner], Field(min_length=3, max_length=1000)]

OWN = "stop", "roller_off", "friction"
"""Attributes of `Mechanism` that only printed robots have, and their names in the file."""


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
    """The JSON file beside a URDF: what URDF cannot express; the design is validated as any other."""

    design: dict[str, Any]
    loop: LoopSection
    spring: SpringSection
    stop: StopSection | None = None
    roller_off: RollerOffSection | None = None
    friction: FrictionSection | None = None
    travel_rad: Annotated[
        dict[JointName, Annotated[tuple[Angle, Angle], Field(strict=False)]], Field(min_length=3, max_length=3)
    ]
    release: ReleaseSection
    foot_depth_m: Annotated[float, Field(ge=1e-5, le=1)]
    outline_m: dict[BodyName, Outline] = Field(default_factory=dict)
    surfaces: dict[str, Literal["foot", "body"]]


def write_loop(mechanism: Mechanism) -> str:
    """Return the document of a mechanism: loop, spring, pose at release, outlines, surfaces of the spheres."""
    release, loop = release_pose(mechanism), mechanism.loop
    said: dict[str, Any] = {
        "design": mechanism.design.model_dump(),
        "loop": asdict(loop) | {"point_a_m": loop.point_a_m.tolist(), "point_b_m": loop.point_b_m.tolist()},
        "spring": asdict(mechanism.spring) | {"rest_rad": 0.0},
        **{key: asdict(value) for key in OWN if (value := getattr(mechanism, key)) is not None},
        "travel_rad": {joint.name: (joint.lower_rad, joint.upper_rad) for joint in mechanism.joints},
        "release": {
            "joint_rad": release.joint_rad,
            "body_position_m": release.body_position_m.tolist(),
            "body_pitch_rad": release.body_pitch_rad,
        },
        "foot_depth_m": mechanism.foot_depth_m,
        "outline_m": {
            name: [(round(one.real, 6), round(one.imag, 6)) for one in corners.tolist()]
            for name, corners in mechanism.outline_m.items()
        },
        "surfaces": {contact.name: contact.surface for body in mechanism.bodies.values() for contact in body.contacts},
    }
    return json.dumps(LoopFile(**said).model_dump(exclude_defaults=True), indent=2, allow_nan=False) + "\n"
