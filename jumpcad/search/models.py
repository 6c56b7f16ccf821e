"""What evaluates a design in a search: the printed, the capsule or the published robot, a class of each."""

import hashlib
import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, ClassVar

from jumpcad.arguments import check_arguments, check_fields
from jumpcad.building import layout_of
from jumpcad.building.growth import statics_refusal
from jumpcad.checks import CHECKS
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.evaluation import FIGURES, JUMP_FIGURES, evaluate_made
from jumpcad.face import __version__
from jumpcad.files import Record, did_you_mean
from jumpcad.findings import Finding, errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.mechanism.model import Mechanism
from jumpcad.mechanism.variants import capsule_robot
from jumpcad.process import T
from jumpcad.search.estimate import estimated_robot as estimated
from jumpcad.search.study.code_hash import code_digest, versions
from jumpcad.search.study.objective import CANNOT_BUILD, Evaluation, Objective
from jumpcad.search.study.requirement import Required, Requirement, requirements_of, violations
from jumpcad.search.study.variant import NOTHING, PREFIX, Tolerances, Variant, perturbed
from jumpcad.settings import Settings, load_settings
from jumpcad.simulation import simulate
from jumpcad.simulation.engines import default_engine, require_engine
from jumpcad.simulation.planar import LACKING
from jumpcad.simulation.prior import FLOOR_SHARE, PRINTED_MASS_SHARE, floors
from jumpcad.simulation.uncertain import ROBUST_PITCH, ROBUST_TOUCHDOWN, robust_figures
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, varied
from jumpcad.workshop.varied import Value

MODELS = ("printed", "capsule", "published")
PUBLISHED_FIGURES = ("fitness", "base_distance_m", "base_height_m", "spring_energy_j")
"""Figures of a jump of the published robot."""
RIGHTS_ITSELF, RESTS = "rights_itself", "rest_distance_m"
COSTLY = (RIGHTS_ITSELF, RESTS, ROBUST_TOUCHDOWN, ROBUST_PITCH)
"""Figures of a printed robot that are computed where a requirement or the objective asks for them alone."""
ESTIMATE_STEP_S = 0.002
"""Time step of the planar engine for an estimate: within 0.3 % of the score at 0.1 ms on 37 robots of a search."""
LENGTH_MM = 0.2
"""Error of a link's length of a robot that is made in no workshop; judgement."""


@dataclass(frozen=True, repr=False)
class RobotModel:
    """A picklable, pure function from design to evaluation: geometric checks, then what the class of a robot does.

    Workshop and settings are the default ones if None. Required figures of the jump hold on slippery and rough floors.
    """

    name: ClassVar[str]
    figure_names: ClassVar[Sequence[str]] = PUBLISHED_FIGURES
    """Names of the figures of a jump, as `jumpcad list figures` has them."""
    default_objective: ClassVar[str] = "fitness"
    """What is searched for unless the user says something else: only a printed robot has a size."""
    packages: ClassVar[Sequence[str]] = ()
    """Packages whose versions decide an evaluation, besides numpy and the engine."""
    limit_names: ClassVar[Sequence[str]] = ()
    """Names of the limits of which a search may require margins; `*` stands for the end of several."""
    workshop: Workshop | None = None
    settings: Settings | None = None
    engine: str = field(default_factory=default_engine)
    requirements: tuple[Requirement, ...] = ()

    def __post_init__(self) -> None:
        check_fields(self)

    def __repr__(self) -> str:
        return f"<RobotModel {self.name}, {self.engine}>"

    def __call__(self, design: Design) -> Evaluation:
        """Evaluate a design; one that cannot be built is a verdict, not an error."""
        return self._unless_refused(design, self._evaluated)

    def _unless_refused(self, design: Design, found: Callable[[Design], T]) -> T | Evaluation:
        findings = tuple(geometry_findings(design))
        if rejecting := errors(findings):
            return Evaluation(rejecting[0].name, findings=findings)
        try:
            return found(design)
        except CannotBuildError as error:  # the limit that it missed, if it was a number, is learned
            why, margin = str(error), error.margin
            missed = [] if margin is None else [Finding(error.limit, "error", margin, error.unit, why, "")]
            return Evaluation(CANNOT_BUILD, findings=tuple(missed), detail=why)

    def _evaluated(self, design: Design) -> Evaluation:
        """Evaluate a design whose geometry is right."""
        raise NotImplementedError

    @property
    def making(self) -> Tolerances:
        """How far what is made of a design differs from it: of a robot that is made in no workshop, lengths alone."""
        if self.workshop is None:
            return Tolerances(LENGTH_MM)
        length, rate = self.workshop.fits.link_tolerance_mm, self.workshop.safety.spring_rate_scatter / 2.0
        return Tolerances(length, rate, PRINTED_MASS_SHARE, FLOOR_SHARE, printed=True)

    def requiring(self, asked: Iterable[str] | Required) -> "RobotModel":
        """Return the model whose evaluations are rejected where a requirement is not kept."""
        found = requirements_of(asked, [*self.figure_names, *self.limit_names])
        if not found:
            return self
        if isinstance(self, PublishedModel):
            raise JumpcadError(f"require: does not apply to the {self.name} robot; leave it out")
        return replace(self, requirements=found)

    def requires(self, name: str) -> bool:
        return any(one.name == name for one in self.requirements)

    def required(self, found: Evaluation, on_floors: Iterable[Mapping[str, float]] = ()) -> Evaluation:
        """Return an evaluation with the findings of all requirements, also of its figures on other floors."""
        if found.verdict != "jump" or not self.requirements:
            return found
        more = [one for figures in on_floors for one in violations(self.requirements, figures, {})]
        kept = violations(self.requirements, found.metrics, found.margins)
        return replace(found, findings=(*found.findings, *kept, *more))

    def on_floors(self, robot: Mechanism, settings: Settings, engine: str) -> list[dict[str, float]]:
        """Return figures of a robot's jumps on slippery and rough floors, if a requirement depends on them."""
        if not any(one.name in JUMP_FIGURES for one in self.requirements):
            return []
        return [plain_figures(simulate(robot, floor, engine)) for floor in floors(robot, settings)]

    def admits(self, design: Design) -> bool:
        """Whether the feasibility checks that need neither solids nor simulation accept a design (microseconds)."""
        return not errors(geometry_findings(design))

    def quick_score(self, _design: Design, _objective: Objective) -> float:
        """Return about what a design scores, from a model that is much quicker; -inf where there is none."""
        return -math.inf

    def describe(self) -> dict[str, Any]:
        """Return all that decides an evaluation, as plain data."""
        record: dict[str, Any] = {"name": self.name, "engine": self.engine}
        if self.requirements:
            record["require"] = list(map(str, self.requirements))
        for key in ("workshop", "settings"):
            value = getattr(self, key)
            record[key] = None if value is None else value.model_dump(mode="json")
        return record

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the description and of the versions of the packages (hexadecimal)."""
        content = json.dumps([self.describe(), self.versions()], sort_keys=True)
        return hashlib.sha256(content.encode()).hexdigest()

    def versions(self) -> dict[str, str]:
        """Return the versions of the packages that decide an evaluation, and the hash of this one's code."""
        return {"jumpcad": __version__, "code": code_digest()} | versions("numpy", self.engine, *self.packages)


@dataclass(frozen=True, repr=False)
class PublishedModel(RobotModel):
    """The published simulation, after the geometric checks, which its study did not have."""

    engine: str = "pybullet"
    name = "published"

    def _evaluated(self, design: Design) -> Evaluation:
        from jumpcad.paper import published

        jump = published.simulate(design)
        fitness = jump.distance_m / (design.l_max_mm / 1000.0)
        figures = (fitness, jump.distance_m, jump.base_height_m, jump.energy_j)
        metrics = dict(zip(PUBLISHED_FIGURES, figures, strict=True))
        return Evaluation("jump" if jump.distance_m > 0 else "no_takeoff", metrics, tuple(geometry_findings(design)))


@dataclass(frozen=True, repr=False)
class CapsuleModel(RobotModel):
    """The published masses as uniform capsules, simulated with some settings (the default ones if None)."""

    name = "capsule"
    figure_names = tuple(JUMP_FIGURES)

    def admits(self, design: Design) -> bool:
        """Whether the robot stands and its springs are strong enough, too."""
        return super().admits(design) and not errors(statics_findings(capsule_robot(design)))

    def _evaluated(self, design: Design) -> Evaluation:
        jump = simulate(capsule_robot(design), self.settings, self.engine)
        return self.required(Evaluation(jump.verdict, plain_figures(jump), tuple(jump.findings)))


@dataclass(frozen=True, repr=False)
class PrintedModel(RobotModel):
    """A robot that is built, simulated and checked in a workshop."""

    stand_in: bool = False  # the evaluation has the figures from which other robots are estimated
    scored: tuple[str, ...] = ()  # figures of `COSTLY` that the objective needs
    perturbation: Mapping[str, Value] = field(default_factory=dict)  # made otherwise than designed, by keys of `MADE`
    name = "printed"
    figure_names = tuple(FIGURES)
    default_objective = "body_lengths"
    packages = ("manifold3d", "trimesh")
    limit_names = tuple(name for check in CHECKS if check.cheap for name in check.basis)

    def __call__(self, design: Design, workshop: Mapping[str, Value] = NOTHING) -> Evaluation:
        """Evaluate a design, in the workshop with these values; values that do not go together are a verdict."""
        if not workshop:
            return super().__call__(design)
        try:
            return self.varied(workshop)(design)
        except JumpcadError as error:
            return Evaluation("workshop", detail=str(error))

    def _evaluated(self, design: Design) -> Evaluation:
        others_learn = self.stand_in or self.perturbation  # from every robot that is built
        refused = None if others_learn else self.refused_first(design)
        return refused or self._built(design)

    def _built(self, design: Design) -> Evaluation:
        shop, made = self.workshop or load_workshop(), partial(perturbed, values=self.perturbation)
        settings = self.settings or Settings()
        result = evaluate_made(design, shop, self.settings, self.engine, made)
        robot = result.robot
        findings = (*result.findings, *estimated.room_findings(robot.layout, robot.workshop.safety.room_reserve_mm))
        if self.perturbation:  # what the design keeps stands in its own row
            findings = (*result.jump.findings, *errors(findings[len(result.jump.findings) :]))
        figures = plain_figures(result.jump) | result.metrics
        figures |= estimated.robot_figures(robot) if self.stand_in else {}
        asked = self.asked
        if RIGHTS_ITSELF in asked:
            figures[RIGHTS_ITSELF] = result.rights_itself  # a fifth of an evaluation more
        if RESTS in asked:
            from jumpcad.landing.landing import rest_distance_m

            figures[RESTS] = rest_distance_m(*made(robot, settings)) if result.verdict == "jump" else 0.0
        figures |= self.robust(robot, settings)
        # of what is made otherwise the floor is one
        others = [] if self.perturbation else self.on_floors(robot, settings, self.estimate_engine)
        return self.required(Evaluation(result.verdict, figures, findings), others)

    @property
    def asked(self) -> set[str]:
        """Those of `COSTLY` that are computed."""
        return {name for name in COSTLY if name in self.scored or (self.requires(name) and not self.perturbation)}

    def robust(self, robot: Mechanism, settings: Settings) -> dict[str, float]:
        """Return the figures of a robot as it may be made, if they are asked for."""
        asked = self.asked & {ROBUST_TOUCHDOWN, ROBUST_PITCH}
        if not asked:
            return {}
        scatter = (self.workshop or load_workshop()).safety.spring_rate_scatter
        found = robust_figures(*perturbed(robot, settings, self.perturbation), scatter)
        return {name: found[name] for name in asked}

    def refused_first(self, design: Design) -> Evaluation | None:
        """Return the outcome of a design that an estimate of the robot's masses refuses; None of others."""
        refused = statics_refusal(design, self.workshop or load_workshop(), self.settings or Settings())
        if not refused:
            return None
        return Evaluation(refused[0].name, findings=(*geometry_findings(design), *refused))

    def varied(self, values: Mapping[str, Value]) -> "PrintedModel":
        """Return the model of the robot in the workshop with other values, or made otherwise than designed."""
        others = {key: value for key, value in values.items() if not key.startswith(PREFIX)}
        model = replace(self, perturbation={key: value for key, value in values.items() if key not in others})
        return replace(model, workshop=varied(self.workshop or load_workshop(), others)) if others else model

    def laid_out(self, variant: Variant) -> Mapping[str, float] | Evaluation:
        """Return figures of the layout of a printed robot, or the outcome of one whose parts have no room.

        A sixth of an evaluation. What is refused here would be refused by the evaluation too.
        """

        def figures(design: Design) -> Mapping[str, float]:
            model = self.varied(variant.workshop) if variant.workshop else self
            return estimated.layout_figures(layout_of(design, model.workshop or load_workshop()))

        try:
            return self._unless_refused(variant.design, figures)
        except JumpcadError as error:  # the values of the workshop do not go together
            return Evaluation("workshop", detail=str(error))

    def quick_score(self, design: Design, objective: Objective) -> float:
        """Return about what the `quick_robot` of the design scores; -inf where it does not jump.

        Where it has no such figure, its touchdown ranks the designs.
        """
        robot = estimated.quick_robot(design) if self.admits(design) else None
        if robot is None or errors(statics_findings(robot)):
            return -math.inf
        jump = simulate(robot, load_settings("screening"), self.estimate_engine)
        if jump.verdict != "jump":
            return -math.inf
        size = estimated.quick_size_m(design)
        figures = plain_figures(jump)
        figures |= {"size_m": size, "body_lengths": figures["touchdown_distance_m"] / size}
        return score_or_touchdown(Evaluation(jump.verdict, figures), objective)

    @cached_property
    def estimate_engine(self) -> str:
        """The engine of what is only estimated: the planar one, compiled or not, unless it lacks what is asked for."""
        lacks = any(getattr(self.settings or Settings(), key) for key in LACKING)
        return self.engine if lacks else "planar"

    @cached_property
    def estimate_settings(self) -> Settings:
        """The settings of what is only estimated: the model's with steps of `ESTIMATE_STEP_S`, or longer ones."""
        settings = self.settings or Settings()
        return settings.model_copy(update={"dt_s": max(settings.dt_s, ESTIMATE_STEP_S), "push_off_steps": 0})

    def describe(self) -> dict[str, Any]:
        more = {"stand_in": self.stand_in, "scored": list(self.scored)}
        return super().describe() | {name: value for name, value in more.items() if value}


def score_or_touchdown(evaluation: Evaluation, objective: Objective) -> float:
    """Return what a robot scores, or its touchdown (m) where it lacks a figure for it; -inf where it is rejected."""
    try:
        score = objective.score(evaluation)
    except JumpcadError:
        score = evaluation.metrics["touchdown_distance_m"]
    return -math.inf if score is None else score


@check_arguments
def robot_model(
    name: str = "printed", workshop: Workshop | str | Path | None = None,
    settings: Settings | str | Path | None = None, engine: str | None = None,
) -> RobotModel:  # fmt: skip
    """Return the model of a name of `MODELS`; workshop and settings by name, as files, or loaded.

    If None, the default workshop and settings, and the first of PyBullet and MuJoCo that is installed.
    """
    if engine is not None:
        require_engine(engine)
    for option, value, without in (
        ("workshop", workshop, ("capsule", "published")),
        ("settings", settings, ("published",)),
    ):
        if value is not None and name in without:
            named = "" if isinstance(value, Record) else f" {value}"
            raise JumpcadError(f"{option}{named}: does not apply to the {name} robot; leave it out")
    if name == "published" and engine not in (None, "pybullet"):
        raise JumpcadError(f"engine {engine}: the published simulation exists in pybullet alone")
    if name not in MODELS:
        raise JumpcadError(f"{name!r} is not one of the models {', '.join(MODELS)}{did_you_mean(name, MODELS)}")
    if name == "published":
        return PublishedModel()
    settings = load_settings("default") if settings is None else settings
    how = settings.revalidated() if isinstance(settings, Settings) else load_settings(settings)
    if name == "capsule":
        return CapsuleModel(settings=how, engine=engine or default_engine())
    shop = workshop if isinstance(workshop, Workshop) else load_workshop(DEFAULT if workshop is None else workshop)
    return PrintedModel(workshop=shop, settings=how, engine=engine or default_engine())


def plain_figures(jump: Any) -> dict[str, float]:
    return {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
