"""A robot whose bodies are given in a TOML file, not printed: masses, inertias, springs, pins, what touches the ground.

With `[design]` it is the five-bar of a design, which every engine simulates; with `[[joints]]` any planar tree of
hinges with loops, which MuJoCo alone simulates. Files speak of g, mm and degrees; frames are those of
`jumpcad.mechanism.model`, of which x and z are given.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from jumpcad.design import Design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.files import Contradiction, Record, TomlTable, read_toml
from jumpcad.files.names import Name
from jumpcad.mechanism.capsule import capsule
from jumpcad.mechanism.linkage import Linkage
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.model import (
    BODY,
    BODY_NAMES,
    FOOT,
    Body,
    ContactSphere,
    Friction,
    Mechanism,
    Spring,
    Stop,
    five_bar,
)
from jumpcad.simulation.chain import Chain, ChainSpring, Hinge, PlanarLoop
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.transforms import Array

TOTAL_G = 2.0, 1000.0
"""Masses of robots that may be simulated."""
ADDS_UP_SHARE = 0.01
"""By which the masses of the bodies may differ from the stated mass of the robot, by rounding."""
ENERGY_SHARE = 0.02
"""By which the springs' energy may differ from the stated one, by rounding."""
HEIGHTS_M = 0.01, 50.0
"""Springs' energy over weight: outside, a unit is wrong; the best jumpers reach about 30 m."""
GYRATION_SHARE = 1e-3, 1.0
"""Radius of gyration of a body over the length of the robot's largest link: outside, a unit is wrong."""

Millimetres = Annotated[float, Field(ge=-1000, le=1000)]
Point = Annotated[tuple[Millimetres, Millimetres], Field(strict=False)]
Radius = Annotated[float, Field(ge=0.01, le=100)]
Contact = Annotated[tuple[Millimetres, Millimetres, Radius], Field(strict=False)]
Degrees = Annotated[float, Field(ge=-360, le=360)]
Stiffness = Annotated[float, Field(gt=0, le=1e5)]


class Rod(TomlTable):
    """A uniform rod with round ends, from point to point of its body's frame."""

    from_mm: Point
    to_mm: Point
    radius_mm: Radius
    density_kg_m3: Annotated[float, Field(ge=1, le=25_000)]

    @property
    def mass(self) -> MassProperties:
        """Its mass properties: the volume of a capsule times the density."""
        start, end = _point(self.from_mm), _point(self.to_mm)
        radius, length = self.radius_mm / 1000.0, float(np.linalg.norm(end - start))
        mass = self.density_kg_m3 * math.pi * radius**2 * (length + 4.0 / 3.0 * radius)
        return capsule(mass, radius, start, end)


class OwnBody(TomlTable):
    """A body: a mass with its centre and its inertia about y through that centre, or rods, or both together."""

    mass_g: Annotated[float, Field(gt=0, le=1e6)] | None = None
    centre_mm: Point = (0.0, 0.0)
    inertia_gmm2: Annotated[float, Field(gt=0, le=1e12)] | None = None
    rods: Annotated[tuple[Rod, ...], Field(strict=False)] = ()
    contacts_mm: Annotated[tuple[Contact, ...], Field(strict=False)] = ()

    def body(self, name: str, contacts: tuple[ContactSphere, ...]) -> Body:
        """Return the body; motion in the plane depends on the inertia about y alone, the others are set like it."""
        items = [rod.mass for rod in self.rods]
        if self.mass_g is not None and self.inertia_gmm2 is not None:
            inertia = self.inertia_gmm2 * 1e-9 * np.eye(3)
            items.append(MassProperties(self.mass_g / 1000.0, _point(self.centre_mm), inertia))
        whole = combined(items)
        return Body(name, whole.mass_kg, whole.com_m, whole.inertia_kg_m2, contacts)


class SpringTable(TomlTable):
    """What the design does not say of both springs together."""

    preload_deg: Annotated[float, Field(ge=0, le=180)] = 0.0
    one_sided: bool = False
    energy_j: Annotated[float, Field(gt=0, le=1e3)] | None = None


class StopTable(TomlTable):
    """The stop beyond rest."""

    angle_deg: Annotated[float, Field(ge=0, le=180)]
    stiffness_nmm_per_deg: Stiffness


class PinsTable(TomlTable):
    """Dry friction in the pins of leg, front, ankle and eye."""

    friction: Annotated[float, Field(ge=0, le=2)]
    radius_mm: Annotated[tuple[Radius, Radius, Radius, Radius], Field(strict=False)]


class FootTable(TomlTable):
    """What touches the ground; `body` is the standing body of a chain, `radius_mm` that of a five-bar's contacts."""

    body: Name | None = None
    radius_mm: Radius | None = None
    friction: Annotated[float, Field(ge=1e-3, le=2)]
    body_friction: Annotated[float, Field(ge=1e-3, le=2)] = 0.5


class JointTable(TomlTable):
    """A hinge of a chain: the child's frame at a point of the parent's, turned by `rest_deg`; positive turns +x down.

    `loaded_deg` is the coordinate in the loaded pose, where it is known; `range_deg` are the stops.
    """

    name: Name
    parent: Name
    child: Name
    at_mm: Point
    rest_deg: Degrees = 0.0
    loaded_deg: Degrees | None = None
    range_deg: Annotated[tuple[Degrees, Degrees], Field(strict=False)] | None = None
    friction_nmm: Annotated[float, Field(ge=0, le=1e5)] = 0.0


class LoopTable(TomlTable):
    """Two bodies' points that are one pin."""

    body_a: Name
    point_a_mm: Point
    body_b: Name
    point_b_mm: Point


class ChainSpringTable(TomlTable):
    """A spring on a joint of a chain, relaxed at the coordinate `free_deg`: where that is not 0, it is preloaded."""

    joint: Name
    stiffness_nmm_per_deg: Stiffness
    free_deg: Degrees = 0.0


class RobotFile(Record):
    """Everything that the file says."""

    name: Name
    mass_g: Annotated[float, Field(ge=TOTAL_G[0], le=TOTAL_G[1])] | None = None
    design: dict[str, float] | None = None
    bodies: dict[Name, OwnBody]
    foot: FootTable
    spring: SpringTable = SpringTable()
    stop: StopTable | None = None
    pins: PinsTable | None = None
    joints: Annotated[tuple[JointTable, ...], Field(strict=False)] = ()
    loops: Annotated[tuple[LoopTable, ...], Field(strict=False)] = ()
    springs: Annotated[tuple[ChainSpringTable, ...], Field(strict=False)] = ()

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield masses without inertia, bodies without mass, and keys of the other kind of robot."""
        for name, body in self.bodies.items():
            if (body.mass_g is None) != (body.inertia_gmm2 is None):
                yield ("bodies", name), body.mass_g, "give mass_g and inertia_gmm2 together, or rods instead"
            elif body.mass_g is None and not body.rods:
                yield ("bodies", name), "nothing", "has no mass: give mass_g with inertia_gmm2, or rods"
        if (self.design is None) == (not self.joints):
            yield ("joints",), len(self.joints), "give either [design], a five-bar, or [[joints]], a chain"
        elif self.design is not None:
            yield from self._not_five_bar()
        else:
            yield from self._no_chain()

    def _not_five_bar(self) -> Iterator[Contradiction]:
        if sorted(self.bodies) != sorted(BODY_NAMES):
            yield ("bodies",), ", ".join(self.bodies), f"a five-bar's are {', '.join(BODY_NAMES)}"
        if self.loops or self.springs or self.foot.body or any(one.contacts_mm for one in self.bodies.values()):
            yield ("design",), "a five-bar", "has its own loop, springs and contacts: leave those of a chain out"
        if self.foot.radius_mm is None:
            yield ("foot", "radius_mm"), None, "give the radius of what touches the ground"

    def _no_chain(self) -> Iterator[Contradiction]:
        if self.stop or self.pins or self.spring != SpringTable() or self.foot.radius_mm:
            yield ("joints",), "a chain", "has range_deg, friction_nmm and [[springs]]: leave those of a five-bar out"
        names = [joint.name for joint in self.joints]
        children = [joint.child for joint in self.joints]
        if len(set(names)) < len(names) or len(set(children)) < len(children):
            yield (
                ("joints",),
                ", ".join(names),
                "each joint needs a name, and a child, of its own; close loops by [[loops]]",
            )
        named = {"joints": {n for j in self.joints for n in (j.parent, j.child)},
                 "loops": {n for loop in self.loops for n in (loop.body_a, loop.body_b)},
                 "foot": {self.foot.body or ""}}  # fmt: skip
        for key, bodies in named.items():
            if wrong := sorted(bodies - set(self.bodies)):
                yield (key,), wrong[0], f"is no body; there are {', '.join(self.bodies)}"
        if len(set(self.bodies) - set(children)) != 1:
            yield ("joints",), len(self.joints), f"must hang all but one of {len(self.bodies)} bodies on others"
        for spring in self.springs:
            if spring.joint not in names:
                yield ("springs", "joint"), spring.joint, f"is no joint; there are {', '.join(names)}"
        if not self.springs:
            yield ("springs",), "none", "a chain jumps by springs: give [[springs]]"
        if self.foot.body in self.bodies and not self.bodies[self.foot.body].contacts_mm:
            yield ("bodies", self.foot.body, "contacts_mm"), "nothing", "the foot stands on them: give x, z and radius"


def is_robot_file(path: Path) -> bool:
    """Return whether a TOML file gives the bodies of a robot; a design does not."""
    return path.suffix == ".toml" and path.is_file() and "bodies" in read_toml(path)[0]


def load_robot(path: str | Path) -> Mechanism | Chain:
    """Return the robot of a file that gives its bodies: a URDF with its loop file, or a TOML file.

    Raises
    ------
    JumpcadError
        If there is no such file, or it holds what no robot can have.
    """
    return robot_from_urdf(Path(path)) if Path(path).suffix == ".urdf" else robot_from_toml(Path(path))


def robot_from_toml(path: Path) -> Mechanism | Chain:
    """Return the robot of a TOML file with bodies of its own.

    Raises
    ------
    JumpcadError
        If a key is unknown, missing or out of range, masses do not add up, the springs cannot hold the stated energy, a
        unit is off, a spring is on no joint, or a loop does not close.
    """
    file = RobotFile.from_toml(path)
    try:
        robot = five_bar_robot(file) if file.design is not None else _chain(file)
        _require_masses(file, robot)
        return robot
    except JumpcadError as error:
        raise JumpcadError(f"{path}: {error}") from None


def five_bar_robot(file: RobotFile) -> Mechanism:
    """Return the five-bar of a file, whose masses are not compared with the stated one.

    Raises
    ------
    JumpcadError
        If a value of the design is out of range, or its springs do not hold the stated energy.
    """
    design = Design(**file.design)  # type: ignore[arg-type]
    assert file.foot.radius_mm is not None
    radius = file.foot.radius_mm / 1000.0
    linkage = Linkage(design)
    stop = None
    if file.stop:
        stop = Stop("leg", math.radians(file.stop.angle_deg), _per_rad(file.stop.stiffness_nmm_per_deg))
    joints, loop, spring = five_bar(linkage, (-design.compression_rad, 0.0), design.peak_spring_torque_nm)
    spring = Spring(
        spring.joint, spring.stiffness_nm_per_rad, spring.wind_rad, math.radians(file.spring.preload_deg),
        file.spring.one_sided,
    )  # fmt: skip
    stated = file.spring.energy_j
    if stated is not None and abs(spring.energy_j / stated - 1.0) > ENERGY_SHARE:
        raise JumpcadError(
            f"spring.energy_j = {stated:g}: rate, loaded angle and preload hold {spring.energy_j:.4g} J: change "
            "stiffness_nmm_per_deg, compression_ratio or preload_deg, or leave energy_j out"
        )
    leg, front, ankle, eye = (radius / 1000.0 for radius in file.pins.radius_mm) if file.pins else (0.0,) * 4
    pin = file.pins.friction if file.pins else 0.0
    contacts = _contacts(design, radius)
    return Mechanism(
        file.name,
        design,
        {name: file.bodies[name].body(name, contacts.get(name, ())) for name in BODY_NAMES},
        joints,
        loop,
        spring,
        radius,
        stop=stop,
        friction=Friction(file.foot.friction, file.foot.body_friction, pin, (leg, front, ankle, eye)),
    )


def _contacts(design: Design, radius_m: float) -> dict[str, tuple[ContactSphere, ...]]:
    """Return the spheres at the front eye, at both toes' tips, and at the body's pivots."""
    l1, l4, l5 = (length / 1000.0 for length in (design.l1_mm, design.l4_mm, design.l5_mm))
    angle = math.pi - math.radians(design.ground_link_angle_deg)
    x, y = l5 * math.cos(angle), l5 * math.sin(angle)
    foot = {"front_eye": (l4, 0.0), "left_toe": (x, y), "right_toe": (x, -y)}
    body = {"back_pivot": (-l1 / 2.0, 0.0), "front_pivot": (l1 / 2.0, 0.0)}
    return {
        FOOT: tuple(ContactSphere(name, np.array([*at, 0.0]), radius_m, "foot") for name, at in foot.items()),
        BODY: tuple(ContactSphere(name, np.array([*at, 0.0]), radius_m, "body") for name, at in body.items()),
    }


def _chain(file: RobotFile) -> Chain:
    bodies = {
        name: body.body(
            name,
            tuple(
                ContactSphere(
                    f"{number}", _point((x, z)), radius / 1000.0, "foot" if name == file.foot.body else "body"
                )
                for number, (x, z, radius) in enumerate(body.contacts_mm)
            ),
        )
        for name, body in file.bodies.items()
    }
    assert file.foot.body is not None
    hinges = tuple(
        Hinge(
            joint.name, joint.parent, joint.child, _point(joint.at_mm), math.radians(joint.rest_deg),
            None if joint.loaded_deg is None else math.radians(joint.loaded_deg),
            joint.range_deg and (math.radians(joint.range_deg[0]), math.radians(joint.range_deg[1])),
            joint.friction_nmm / 1000.0,
        )
        for joint in file.joints
    )  # fmt: skip
    loops = (PlanarLoop(one.body_a, _point(one.point_a_mm), one.body_b, _point(one.point_b_mm)) for one in file.loops)
    springs = (
        ChainSpring(one.joint, _per_rad(one.stiffness_nmm_per_deg), math.radians(one.free_deg)) for one in file.springs
    )
    friction = {"foot": file.foot.friction, "body": file.foot.body_friction}
    return Chain(file.name, bodies, hinges, tuple(loops), tuple(springs), file.foot.body, friction)


def _require_masses(file: RobotFile, robot: Mechanism | Chain) -> None:
    """Reject masses that do not add up, and masses, inertias and energies in a wrong unit."""
    total_g = 1000.0 * robot.mass_kg
    if file.mass_g is not None and abs(total_g / file.mass_g - 1.0) > ADDS_UP_SHARE:
        raise JumpcadError(f"mass_g = {file.mass_g:g}: the bodies have {total_g:.4g} g together: one of them is wrong")
    if not TOTAL_G[0] <= total_g <= TOTAL_G[1]:
        raise JumpcadError(f"the bodies have {total_g:.4g} g together: must be {TOTAL_G[0]:g}…{TOTAL_G[1]:g}; give g")
    length_m = robot.design.l_max_mm / 1000.0 if isinstance(robot, Mechanism) else robot.length_m
    for name, body in robot.bodies.items():
        gyration_m = math.sqrt(float(body.inertia_kg_m2[1, 1]) / body.mass_kg)
        if not GYRATION_SHARE[0] <= gyration_m / length_m <= GYRATION_SHARE[1]:
            raise JumpcadError(
                f"bodies.{name}: inertia and mass have a radius of gyration of {1000.0 * gyration_m:.3g} mm, and the "
                f"longest link has {1000.0 * length_m:.3g} mm: give g·mm² about the body's own centre of mass"
            )
    energy_j = robot.spring.energy_j if isinstance(robot, Mechanism) else robot.spring_energy_j
    height_m = energy_j / robot.mass_kg / GRAVITY_M_S2
    if not HEIGHTS_M[0] <= height_m <= HEIGHTS_M[1]:
        raise JumpcadError(
            f"the springs' energy would lift the robot by {height_m:.3g} m: must be {HEIGHTS_M[0]:g}…{HEIGHTS_M[1]:g}: "
            "give g, mm and N·mm/°"
        )


def _point(point_mm: tuple[float, float]) -> Array:
    return np.array([point_mm[0] / 1000.0, 0.0, point_mm[1] / 1000.0])


def _per_rad(nmm_per_deg: float) -> float:
    return math.degrees(nmm_per_deg) / 1000.0
