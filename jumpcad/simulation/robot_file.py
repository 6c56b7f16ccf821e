"""A robot whose bodies are given in a file, not printed: masses, inertias, springs, pins, what touches the ground.

With `[design]` it is the five-bar of a design, which every engine simulates; with `[[joints]]` any planar tree of
hinges with loops, which MuJoCo alone simulates. Files speak of g, mm and degrees; frames are those of
`jumpcad.mechanism.model`, of which x and z are given.
"""

import math
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from jumpcad.arguments import check_arguments
from jumpcad.design import Design
from jumpcad.dimensions import GRAVITY_M_S2
from jumpcad.errors import JumpcadError
from jumpcad.files import Contradiction, Record, TomlTable, read_toml
from jumpcad.files.records import Name
from jumpcad.mechanism import model
from jumpcad.mechanism.mass import MassProperties, combined
from jumpcad.mechanism.variants import capsule, capsule_robot
from jumpcad.simulation.from_urdf import robot_from_urdf
from jumpcad.transforms import Array

TOTAL_G = 2.0, 1000.0
"""Masses of robots that may be simulated."""
ADDS_UP_SHARE, ENERGY_SHARE = 0.01, 0.02
"""By which the bodies' masses, and the springs' energy, may differ from the stated ones, by rounding."""
HEIGHTS_M = 0.01, 50.0
"""Springs' energy over weight: outside, a unit is wrong; the best jumpers reach about 30 m."""
GYRATION_SHARE = 1e-3, 1.0
"""Radius of gyration of a body over the length of the robot's largest link: outside, a unit is wrong."""

TAKEN = {"world", "root x", "root z", "root pitch"}
"""Names of a chain's model in MuJoCo."""

Millimetres = Annotated[float, Field(ge=-1000, le=1000)]
Point = Annotated[tuple[Millimetres, Millimetres], Field(strict=False)]
Radius = Annotated[float, Field(ge=0.01, le=100)]
Degrees = Annotated[float, Field(ge=-360, le=360)]
Contact = Annotated[tuple[Millimetres, Millimetres, Radius], Field(strict=False)]
Stiffness = Annotated[float, Field(gt=0, le=1e5)]

MOST = 100
"""Bodies, hinges, loops and springs, and rods and contacts of a body; judgement: far more than a jumping robot has."""
MANY = Field(strict=False, max_length=MOST)


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
        return capsule(self.density_kg_m3 * math.pi * radius**2 * (length + 4.0 / 3.0 * radius), radius, start, end)


class OwnBody(TomlTable):
    """A mass with its centre and its inertia about y through that centre, or rods, or both together."""

    mass_g: Annotated[float, Field(gt=0, le=1e6)] | None = None
    centre_mm: Point = (0.0, 0.0)
    inertia_gmm2: Annotated[float, Field(gt=0, le=1e12)] | None = None
    rods: Annotated[tuple[Rod, ...], MANY] = ()
    contacts_mm: Annotated[tuple[Contact, ...], MANY] = ()

    def body(self, name: str, contacts: tuple[model.ContactSphere, ...]) -> model.Body:
        """Return the body; motion in the plane depends on the inertia about y alone, the others are set like it."""
        items = [rod.mass for rod in self.rods]
        if self.mass_g is not None and self.inertia_gmm2 is not None:
            inertia = self.inertia_gmm2 * 1e-9 * np.eye(3)
            items.append(MassProperties(self.mass_g / 1000.0, _point(self.centre_mm), inertia))
        return model.Body.of(name, combined(items), contacts)


class SpringTable(TomlTable):
    """What the design does not say of both springs together; `energy_j` is a check."""

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
    """A hinge of a chain: the child's frame at a point of the parent's, turned by `rest_deg`.

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
    bodies: Annotated[dict[Name, OwnBody], Field(max_length=MOST)]
    foot: FootTable
    spring: SpringTable = SpringTable()
    stop: StopTable | None = None
    pins: PinsTable | None = None
    joints: Annotated[tuple[JointTable, ...], MANY] = ()
    loops: Annotated[tuple[LoopTable, ...], MANY] = ()
    springs: Annotated[tuple[ChainSpringTable, ...], MANY] = ()

    def contradictions(self) -> Iterator[Contradiction]:
        """Yield bodies without mass or inertia, and what does not belong to this kind of robot."""
        for name, body in self.bodies.items():
            if (body.mass_g is None) != (body.inertia_gmm2 is None) or not (body.mass_g or body.rods):
                yield ("bodies", name), body.mass_g, "give mass_g and inertia_gmm2 together, or rods"
        five_bar = self.design is not None
        others = (
            self.foot.body or self.joints or self.loops or self.springs
            if five_bar
            else self.foot.radius_mm or self.stop or self.pins or self.spring != SpringTable()
        )
        if others or (five_bar and any(body.contacts_mm for body in self.bodies.values())):
            reason = "has keys of the other kind: [design] is of a five-bar, [[joints]] and [[springs]] of a chain"
            yield ("design",), "a five-bar" if five_bar else "none", reason
        elif five_bar:
            if sorted(self.bodies) != sorted(model.BODY_NAMES):
                yield ("bodies",), ", ".join(self.bodies), f"a five-bar's are {', '.join(model.BODY_NAMES)}"
            if self.foot.radius_mm is None:
                yield ("foot", "radius_mm"), None, "give the radius of what touches the ground"
        else:
            yield from self._broken_chain()

    def _broken_chain(self) -> Iterator[Contradiction]:
        """Yield what is no tree of hinges with springs on a foot."""
        known = {self.joints[0].parent} if self.joints else set(self.bodies)
        for joint in self.joints:
            if joint.parent not in known or joint.child in known:
                reason = "must hang a new body on one that stands before it in the list; [[loops]] close loops"
                yield ("joints", "child"), joint.child, reason
            known.add(joint.child)
            low, high = joint.range_deg or (-math.inf, math.inf)
            if not (low < high and low <= (low if joint.loaded_deg is None else joint.loaded_deg) <= high):
                reason = f"must be the least and the largest angle of {joint.name}, loaded_deg between both"
                yield ("joints", "range_deg"), joint.range_deg, reason
        ends = [name for loop in self.loops for name in (loop.body_a, loop.body_b)]
        for key, name in (("foot", self.foot.body), *(("loops", end) for end in ends)):
            if name not in self.bodies:
                yield (key,), name, f"is no body; there are {', '.join(self.bodies)}"
        if known != set(self.bodies):
            yield ("joints",), ", ".join(sorted(known ^ set(self.bodies))), "hangs on no joint, or is no body"
        joints = [joint.name for joint in self.joints]
        for spring in self.springs:
            if spring.joint not in joints:
                yield ("springs", "joint"), spring.joint, f"is no joint; there are {', '.join(joints)}"
        sprung = [spring.joint for spring in self.springs]
        if not self.springs or len(set(joints)) < len(joints) or len(set(sprung)) < len(sprung):
            reason = "a chain needs springs, at most one on a joint, and joints with names of their own"
            yield ("springs",), len(self.springs), reason
        for name in sorted({*self.bodies, *joints} & TAKEN):
            yield ("name",), name, "is taken by the simulation: choose another name"
        if self.foot.body in self.bodies and not self.bodies[self.foot.body].contacts_mm:
            yield ("bodies", self.foot.body, "contacts_mm"), "nothing", "the foot stands on them: give x, z and radius"


def is_robot_file(path: Path) -> bool:
    """Return whether a TOML file gives the bodies of a robot; a design does not."""
    return path.suffix == ".toml" and os.path.isfile(path) and "bodies" in read_toml(path)[0]


@check_arguments
def load_robot(path: str | Path) -> model.Multibody:
    """Return the robot of a file that gives its bodies: a URDF with its loop file, or a TOML file.

    Raises
    ------
    JumpcadError
        If there is no such file, or it holds what no robot can have: unknown keys, masses that do not add up, springs
        that cannot hold the stated energy or act on no joint, units that are off, loops that do not close.
    """
    path = Path(path)
    if path.suffix == ".urdf":
        return robot_from_urdf(path)
    file = RobotFile.from_toml(path)
    try:
        robot = five_bar_robot(file) if file.design is not None else _chain(file)
        _require_plausible(file, robot)
        return robot
    except JumpcadError as error:
        raise JumpcadError(f"{path}: {error}") from None


def five_bar_robot(file: RobotFile) -> model.Mechanism:
    """Return the five-bar of a file, whose masses are not compared with the stated one."""
    capsules, foot = capsule_robot(Design(**(file.design or {}))), file.foot
    spring = replace(
        capsules.spring, preload_rad=math.radians(file.spring.preload_deg), one_sided=file.spring.one_sided
    )
    stated = file.spring.energy_j
    if stated is not None and abs(spring.energy_j / stated - 1.0) > ENERGY_SHARE:
        raise JumpcadError(
            f"spring.energy_j = {stated:g}: rate, loaded angle and preload hold {spring.energy_j:.4g} J: change "
            "stiffness_nmm_per_deg, compression_ratio or preload_deg, or leave energy_j out"
        )
    radius_m = (foot.radius_mm or 0.0) / 1000.0
    bodies = {
        name: file.bodies[name].body(name, tuple(replace(one, radius_m=radius_m) for one in body.contacts))
        for name, body in capsules.bodies.items()
    }
    leg, front, ankle, eye = (radius / 1000.0 for radius in file.pins.radius_mm) if file.pins else (0.0,) * 4
    pin = file.pins.friction if file.pins else 0.0
    stop = file.stop
    return replace(
        capsules, name=file.name, bodies=bodies, springs=(spring,), foot_depth_m=radius_m,
        stop=model.Stop("leg", math.radians(stop.angle_deg), _per_rad(stop.stiffness_nmm_per_deg)) if stop else None,
        friction=model.Friction(foot.friction, foot.body_friction, pin, (leg, front, ankle, eye)),
    )  # fmt: skip


def _chain(file: RobotFile) -> model.Multibody:
    foot = file.foot
    bodies = {}
    for name, body in file.bodies.items():
        contacts = tuple(
            model.ContactSphere(f"{number}", _point((x, z)), radius / 1000.0, "foot" if name == foot.body else "body")
            for number, (x, z, radius) in enumerate(body.contacts_mm)
        )
        bodies[name] = body.body(name, contacts)
    return model.Multibody(
        file.name,
        bodies,
        tuple(
            model.Joint(one.name, one.parent, one.child, _point(one.at_mm), math.radians(one.rest_deg),
                  math.radians(low), math.radians(high), 0.0, model.JOINT_SPEED_RAD_S, one.friction_nmm / 1000.0,
                  one.range_deg is not None, None if one.loaded_deg is None else math.radians(one.loaded_deg))
            for one in file.joints
            for low, high in [one.range_deg or (-math.inf, math.inf)]
        ),
        tuple(model.Loop(one.body_a, _point(one.point_a_mm), one.body_b, _point(one.point_b_mm)) for one in file.loops),
        tuple(
            model.Spring(one.joint, _per_rad(one.stiffness_nmm_per_deg), 0.0, math.radians(one.free_deg))
            for one in file.springs
        ),
        friction=model.Friction(foot.friction, foot.body_friction),
    )  # fmt: skip


def _require_plausible(file: RobotFile, robot: model.Multibody) -> None:
    """Reject masses that do not add up, and masses, inertias and energies in a wrong unit."""
    total_g = 1000.0 * robot.mass_kg
    if file.mass_g is not None and abs(total_g / file.mass_g - 1.0) > ADDS_UP_SHARE:
        raise JumpcadError(f"mass_g = {file.mass_g:g}: the bodies have {total_g:.4g} g together: one of them is wrong")
    if not TOTAL_G[0] <= total_g <= TOTAL_G[1]:
        raise JumpcadError(f"the bodies have {total_g:.4g} g together: must be {TOTAL_G[0]:g}…{TOTAL_G[1]:g}; give g")
    length_m = robot.length_m
    for name, body in robot.bodies.items():
        gyration_m = math.sqrt(float(body.inertia_kg_m2[1, 1]) / body.mass_kg)
        if not GYRATION_SHARE[0] <= gyration_m / length_m <= GYRATION_SHARE[1]:
            raise JumpcadError(
                f"bodies.{name}: inertia and mass have a radius of gyration of {1000.0 * gyration_m:.3g} mm, and the "
                f"longest link has {1000.0 * length_m:.3g} mm: give g·mm² about the body's own centre of mass"
            )
    height_m = robot.spring_energy_j / robot.mass_kg / GRAVITY_M_S2
    if not HEIGHTS_M[0] <= height_m <= HEIGHTS_M[1]:
        raise JumpcadError(
            f"the springs' energy would lift the robot by {height_m:.3g} m: must be {HEIGHTS_M[0]:g}…{HEIGHTS_M[1]:g}: "
            "give g, mm and N·mm/°"
        )


def _point(point_mm: tuple[float, float]) -> Array:
    return np.array([point_mm[0] / 1000.0, 0.0, point_mm[1] / 1000.0])


def _per_rad(nmm_per_deg: float) -> float:
    return math.degrees(nmm_per_deg) / 1000.0
