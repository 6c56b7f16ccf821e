"""`evaluate`: build, simulate and check a design."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.building import built_and_checked
from jumpcad.building.bom import bill_of_materials
from jumpcad.building.growth import statics_refusal
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings
from jumpcad.robot.electronics.limits import jumps_per_charge
from jumpcad.robot.robot import Robot
from jumpcad.robot.steering.limits import steers
from jumpcad.robot.steering.place import Steering
from jumpcad.scene.visuals import extent_m
from jumpcad.simulation import Jump, Settings, simulate
from jumpcad.simulation.engines import require_engine
from jumpcad.transforms import ByValue
from jumpcad.workshop import Workshop

JUMP_FIGURES = {
    "touchdown_distance_m": "touchdown: way until any part touches the floor",
    "com_rise_m": "rise of the centre of mass",
    "ballistic_range_m": "range, floor or not",
    "touchdown_gap_m": "… of it, after the touchdown",
    "fitness": "range over the longest link",
    "spring_energy_j": "energy in the springs",
    "release_energy_ratio": "springs' energy left after the release, share",
    "takeoff_energy_ratio": "springs' energy in the robot at take-off, share",
    "takeoff_speed_m_s": "speed at take-off",
    "takeoff_angle_deg": "angle of take-off above the ground",
    "takeoff_time_s": "time from release to take-off",
    "air_time_s": "time from take-off to touchdown",
    "turn_deg": "turn of the body in flight, forwards",
    "turn_rate_deg_s": "rate of that turn",
    "touchdown_pitch_deg": "pitch at touchdown against the standing loaded robot, forwards",
    "clears_bar_mm": "highest thin bar that it passes over",
    "bar_distance_mm": "distance of that bar from its nose",
    "lands_on_mm": "highest step that it lands on",
    "step_distance_mm": "distance of that step from its nose",
    "lateral_offset_mm": "centre of mass beside the leg, to the left",
    "mass_kg": "mass",
}
"""Figures of a jump, and what they are."""
FIGURES = JUMP_FIGURES | {
    "body_lengths": "touchdown distance over the robot's size",
    "size_m": "size, the longest side of the robot at rest",
    "electrical_energy_j": "electrical energy of a jump",
    "motor_energy_j": "… of it, the motor's",
    "boards_energy_j": "… of it, the boards' while winding",
    "winding_time_s": "time to wind",
    "cost_eur": "parts and filament, partly estimated, in euros",
    "jumps_per_charge": "jumps of a full battery",
    "rest_distance_m": "median way to where it comes to rest, of simulated landings; where asked for",
    "robust_touchdown_m": "touchdown that nine of ten robots as made reach, on any floor; where asked for",
    "robust_pitch_deg": "worst pitch at touchdown of robots as made, either way, on any floor; where asked for",
    "rights_itself": "share of attitudes from which it rolls onto its feet (stable poses); where asked for",
    "turn_per_rev_deg": "turn of the robot for one turn of its steering wheel; of robots with one",
    "steering_rate_deg_s": "rate at which it turns, the battery's voltage nominal; likewise",
    "steering_margin_mm": "how far below the feet's plane the loaded robot's wheel is at the worst; likewise",
    "turn_energy_j": "electrical energy of a turn by 90°; likewise",
    "body_mass_kg": "mass of the body",
    "main_leg_mass_kg": "mass of the main leg",
    "front_link_mass_kg": "mass of the front link",
    "foot_mass_kg": "mass of the foot",
}
"""Figures of an evaluation of a printed robot, and what they are."""


@dataclass(frozen=True, repr=False, eq=False)
class EvaluationResult(ByValue):
    """A design built, simulated and checked.

    `findings` are those of gate, audit and checks. `metrics` are figures that the jump does not have: masses (kg),
    energy and time of winding, `size_m` (the longest link, or the standing robot's extent where that is larger) and
    `body_lengths`, by name with unit; `electrical_energy_j` is that of motor and of boards while the motor winds.
    """

    robot: Robot
    jump: Jump
    findings: tuple[Finding, ...]
    metrics: dict[str, float]

    @property
    def verdict(self) -> str:
        return self.jump.verdict

    @property
    def fitness(self) -> float:
        """Ballistic range over the longest link; 0 for everything but a jump."""
        return self.jump.fitness

    @property
    def body_lengths(self) -> float:
        """Touchdown distance over the robot's size; 0 for everything but a jump.

        Unlike `fitness` it does not grow when the links are shortened about a battery that stays as large.
        """
        return self.metrics["body_lengths"]

    @cached_property
    def rights_itself(self) -> float:
        """Share of attitudes from which the wound robot rolls onto its feet, by its stable poses."""
        from jumpcad.collision.hulls import share_on_feet

        return share_on_feet(self.robot)

    def __repr__(self) -> str:
        rejected = ", ".join(finding.name for finding in errors(self.findings))[:80]
        return f"<EvaluationResult: {self.jump!r}, {f'rejected by {rejected}' if rejected else 'no errors'}>"

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        return {
            "design": self.robot.design.model_dump(),
            "jump": self.jump.to_dict(),
            "metrics": self.metrics,
            "findings": [finding.to_dict() for finding in self.findings],
        }


class _Refused(EvaluationResult):
    """A design whose springs are surely too weak: what else is asked of it than its verdict is computed then."""

    _gate: tuple[Finding, ...]
    _build: partial[EvaluationResult]

    def __init__(self, gate: tuple[Finding, ...], build: partial[EvaluationResult]) -> None:
        object.__setattr__(self, "_gate", gate)
        object.__setattr__(self, "_build", build)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Refused) and self._build.args == other._build.args

    def __hash__(self) -> int:
        return hash(self._build.args[0])

    @cached_property
    def _whole(self) -> EvaluationResult:
        return self._build()

    def __getattr__(self, name: str) -> Any:
        if name in ("robot", "jump", "metrics"):
            return getattr(self._whole, name)
        raise AttributeError(name)

    @property
    def findings(self) -> tuple[Finding, ...]:
        try:
            return self._whole.findings
        except CannotBuildError:
            return self._gate

    @property
    def verdict(self) -> str:
        return self._gate[-1].name

    @property
    def fitness(self) -> float:
        return 0.0

    @property
    def body_lengths(self) -> float:
        return 0.0


@check_arguments
def evaluate(
    design: Design | str | Path,
    workshop: Workshop | None = None,
    settings: Settings | None = None,
    engine: str | None = None,
) -> EvaluationResult:
    """Build a design in a workshop, simulate its jump with the mass and inertia of its parts, and check its limits.

    Design and workshop are as for `jumpcad.build`, settings and engine as for `jumpcad.simulate`. The robot
    has no name, so none is engraved. Where the springs cannot raise a body alone, the verdict is `too_weak` before
    anything is drawn; the robot, its jump and its metrics are computed when they are asked for.

    Raises
    ------
    CannotBuildError
        If the mechanism cannot work, or there is no room for its parts; of a robot that is too weak when it is asked
        for.
    """
    from jumpcad.bundle.manifest import inputs_of

    design, workshop, _ = inputs_of(design, workshop)
    design, workshop = design.revalidated(), workshop.revalidated()
    settings = (settings or Settings()).revalidated()
    if engine is not None:
        require_engine(engine)
    whole = partial(_evaluated, design, workshop, settings, engine)
    geometry = geometry_findings(design)
    refused = () if errors(geometry) else statics_refusal(design, workshop, settings)
    return _Refused((*geometry, *refused), whole) if refused else whole()


def _evaluated(design: Design, workshop: Workshop, settings: Settings, engine: str | None) -> EvaluationResult:
    robot, findings = built_and_checked(design, workshop, name="")
    jump = simulate(robot, settings, engine)
    return EvaluationResult(robot, jump, (*jump.findings, *findings), _metrics(robot, jump))


def evaluate_made(
    design: Design, workshop: Workshop, settings: Settings | None, engine: str,
    made: Callable[[Robot, Settings], tuple[Robot, Settings]],
) -> EvaluationResult:  # fmt: skip
    """Return what `evaluate` returns, but with the jump of what `made` returns for robot and settings.

    The rest is the design's, whose robot is kept: of several made of one design only the first takes time to build.
    """
    robot, findings = _designed(design, workshop)
    jump = simulate(*made(robot, settings or Settings()), engine)
    return EvaluationResult(robot, jump, (*jump.findings, *findings), _metrics(robot, jump))


@lru_cache(maxsize=1)
def _designed(design: Design, workshop: Workshop) -> tuple[Robot, list[Finding]]:
    return built_and_checked(design.revalidated(), workshop.revalidated(), name="")


def _metrics(robot: Robot, jump: Jump) -> dict[str, float]:
    """Return size and touchdown distance over size, energy and time of winding, and the masses."""
    train = robot.layout.drive.train
    size_m = max(robot.design.l_max_mm / 1000.0, float(extent_m(robot).max()))
    masses = {f"{name}_mass_kg": body.mass_kg for name, body in robot.bodies.items()}
    return (
        {
            "body_lengths": (jump.touchdown_distance_m or 0.0) / size_m,
            "size_m": size_m,
            "mass_kg": robot.mass_kg,
            "electrical_energy_j": train.electrical_j,
            "motor_energy_j": train.motor_j,
            "boards_energy_j": train.boards_j,
            "winding_time_s": train.winding_s,
            "cost_eur": bill_of_materials(robot).cost_eur or 0.0,
            "jumps_per_charge": float(jumps_per_charge(robot)),
        }
        | masses
        | (steers(robot).figures if robot.layout.of(Steering) else {})
    )
