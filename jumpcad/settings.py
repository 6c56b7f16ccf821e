"""Settings of a simulation: time step, damping, what is recorded; the friction of contacts from floor and surface."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from jumpcad.arguments import check_arguments
from jumpcad.files import Contradiction, Record, TomlTable, find_template
from jumpcad.mechanism.model import Mechanism, Multibody, Surface

Coefficient = Annotated[float, Field(ge=0, le=100)]
PRINTED_CLEARANCE_M = 0.001
"""What a printed robot's contacts must clear for a jump: judgement, some ten times what pads and floor give way under
its weight. A foot that tips over its nose hops by up to 0.5 mm, in some engines for 4 ms and in others not at all."""


class Draws(TomlTable):
    """What a calibration leaves open: values of settings that go together, one of each list for each draw.

    `jumpcad simulate --uncertain` reads them; a single jump takes the settings themselves.
    """

    spring_efficiency: Annotated[tuple[Annotated[float, Field(ge=0.1, le=1.5)], ...], Field(strict=False)] = ()
    pin_friction: Annotated[tuple[Annotated[float, Field(ge=0, le=2)], ...], Field(strict=False)] = ()

    def __bool__(self) -> bool:
        return bool(self.spring_efficiency)


class Settings(Record):
    """Settings of a simulated jump; the defaults are those of `templates/settings/default.toml`.

    The friction of a contact is the ground's coefficient times that of what touches it. Rolling and spinning friction
    are multiplied by the ground's coefficient in the same way. What is None follows the robot, see `coefficients`.
    """

    dt_s: Annotated[float, Field(ge=1e-6, le=1 / 240, description="time step")] = 1 / 2000
    push_off_steps: Annotated[
        int, Field(ge=0, le=10_000, description="time steps of a push-off at least, a shorter one has a finer step")
    ] = 60
    solver_iterations: Annotated[int, Field(ge=1, le=10_000, description="at most, in each time step")] = 100
    solver_residual: Annotated[
        float, Field(ge=0, le=1e-2, description="PyBullet stops iterating when no constraint is off by more")
    ] = 1e-5
    gravity_m_s2: Annotated[float, Field(ge=0.1, le=100)] = 9.81
    ground_friction: Coefficient | None = None
    foot_friction: Coefficient = 1.0
    body_friction: Coefficient | None = None
    rolling_friction_m: Coefficient = 0.0
    spinning_friction_m: Coefficient = 0.0
    restitution: Annotated[float, Field(ge=0, le=1)] = 0.0
    joint_damping_nms_per_rad: Coefficient | None = None
    pin_friction: Annotated[float, Field(ge=0, le=2, description="coefficient of dry friction in the pins")] | None = (
        None
    )
    spring_efficiency: Annotated[
        float, Field(ge=0.1, le=1.5, description="energy that the springs give over that of their rate and angle")
    ] = 1.0
    joint_friction_nm: Annotated[float, Field(ge=0, le=100, description="dry friction of each joint (its motor)")] = 0.0
    drag_area_m2: Annotated[
        float, Field(ge=0, le=1, description="drag coefficient times area of the flying robot, in air of 1.2 kg/m³")
    ] = 0.0
    takeoff_clearance_m: (
        Annotated[float, Field(ge=0, le=0.1, description="a flight in which no contact gets lower is a jump")] | None
    ) = None
    flight: Annotated[
        Literal["ballistic", "simulated"],
        Field(description="after take-off: in closed form, or on to the first touchdown"),
    ] = "ballistic"
    max_time_s: Annotated[float, Field(ge=1e-3, le=60, description="simulated time at which a run is stopped")] = 3.0
    trajectory: Annotated[bool, Field(description="record the poses and energies over time")] = False
    trajectory_rate_hz: Annotated[float, Field(ge=0.01, le=1e6, description="poses a second at most")] = 500.0
    draws: Draws = Draws()

    def contradictions(self) -> Iterator[Contradiction]:
        first, second = len(self.draws.spring_efficiency), len(self.draws.pin_friction)
        if first != second:
            yield ("draws", "pin_friction"), second, f"must be as many values as spring_efficiency has, {first}"

    def __repr__(self) -> str:
        changed = ", ".join(
            f"{name}={value:.5g}" if isinstance(value, float) else f"{name}={value}"
            for name, value in self.model_dump(exclude_defaults=True, exclude={"draws"}).items()
        )
        return f"<Settings: {(changed or 'all default')[:180]}>"


@dataclass(frozen=True)
class Coefficients:
    """Friction and damping of one robot under given settings; that of a contact is `ground` times its surface's."""

    ground: float
    foot: float
    body: float
    pin: float
    joint_damping_nms_per_rad: float

    def of(self, surface: Surface) -> float:
        """Return the coefficient of a surface, without the ground's factor."""
        return self.foot if surface == "foot" else self.body

    def contact(self, surface: Surface) -> float:
        """Return the coefficient of a surface on the ground."""
        return self.ground * self.of(surface)


STUDY = {"ground": 1.5, "body": 0.5, "pin": 0.0, "joint_damping_nms_per_rad": 0.001}
"""Of the capsule robot: what the published study's results were made with; its foot follows the settings."""


def coefficients(mechanism: Multibody, settings: Settings) -> Coefficients:
    """Return what rubs: what the settings say, and where they say nothing, the printed robot's own, else the study's.

    A printed robot's pins are dry: they have no viscous damping.
    """
    own, friction = STUDY, mechanism.friction
    if friction is not None:
        body = friction.body / friction.foot
        own = {"ground": friction.foot, "body": body, "pin": friction.pin, "joint_damping_nms_per_rad": 0.0}
    asked = {
        "ground": settings.ground_friction,
        "body": settings.body_friction,
        "pin": settings.pin_friction,
        "joint_damping_nms_per_rad": settings.joint_damping_nms_per_rad,
    }
    chosen = {name: own[name] if value is None else value for name, value in asked.items()}
    return Coefficients(foot=settings.foot_friction, **chosen)


def takeoff_clearance_m(mechanism: Multibody, settings: Settings) -> float:
    """Return how far all contacts must get from the ground for a jump: as the settings say, else the robot's own.

    0, that of the study's capsules and of robots that are no five-bars, asks for nothing but the time in the air.
    """
    if settings.takeoff_clearance_m is not None:
        return settings.takeoff_clearance_m
    return PRINTED_CLEARANCE_M if isinstance(mechanism, Mechanism) and mechanism.friction else 0.0


@check_arguments
def load_settings(name_or_path: str | Path) -> Settings:
    """Return the settings of a template (`default`, `screening`, `fine`, `published-table`) or of a TOML file.

    Raises
    ------
    JumpcadError
        If there is no such file, or a key is unknown or out of range.
    """
    return Settings.from_toml(find_template("settings", name_or_path))
