"""What evaluates a design in a search: the printed, the capsule or the published robot, chosen by name."""

import hashlib
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments, check_fields
from jumpcad.design import Design
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.files import Record, did_you_mean
from jumpcad.findings import errors
from jumpcad.mechanism.feasibility import geometry_findings, statics_findings
from jumpcad.search.estimate.estimated_robot import layout_figures, robot_figures
from jumpcad.search.estimate.refusal import layout_findings, room_findings, statics_refusal
from jumpcad.search.pick.tolerances import PREFIX, Tolerances, perturbed
from jumpcad.search.study.objective import CANNOT_BUILD, Evaluation, Objective, find_objective
from jumpcad.search.study.variant import NOTHING, Variant
from jumpcad.search.study.versions import code_digest, versions
from jumpcad.settings import Settings, load_settings
from jumpcad.simulation.engines import default_engine, require_engine
from jumpcad.simulation.prior import FLOOR_SHARE, PRINTED_MASS_SHARE
from jumpcad.version import __version__
from jumpcad.workshop import DEFAULT, Workshop, load_workshop, varied
from jumpcad.workshop.varied import Value

MODELS = ("printed", "capsule", "published")
PUBLISHED_FIGURES = ("fitness", "base_distance_m", "base_height_m", "spring_energy_j")
"""Figures of a jump of the published robot."""
GUESS_STEP_S = 0.002
"""Time step of the planar engine for a guess: within 0.3 % of the score at 0.1 ms on 37 robots of a search."""


@dataclass(frozen=True, repr=False)
class RobotModel:
    """A picklable function from design to evaluation.

    Parameters
    ----------
    name
        `printed`: built, simulated and checked in a workshop. `capsule`: the published masses as uniform capsules.
        `published`: the published simulation, after the geometric checks, which its study did not have.
    workshop
        Where `printed` is built; the default if None.
    settings, engine
        How `printed` and `capsule` are simulated; the default settings if None.
    stand_in
        Whether the evaluation of a printed robot has the figures of which stand-ins of others are made.
    perturbation
        What of a printed robot is made otherwise than designed, by the keys of `tolerances`.
    """

    name: str
    workshop: Workshop | None = None
    settings: Settings | None = None
    engine: str = "pybullet"
    stand_in: bool = False
    perturbation: Mapping[str, Value] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<RobotModel {self.name}, {self.describe()['engine']}>"

    def __post_init__(self) -> None:
        check_fields(self)
        if self.name not in MODELS:
            raise JumpcadError(
                f"{self.name!r} is not one of the models {', '.join(MODELS)}{did_you_mean(self.name, MODELS)}"
            )

    def __call__(self, design: Design, workshop: Mapping[str, Value] = NOTHING) -> Evaluation:
        """Evaluate a design, in the workshop with these values; one that cannot be built is a verdict, not an error."""
        if workshop:
            try:
                return self.varied(workshop)(design)
            except JumpcadError as error:  # the values do not go together
                return Evaluation("workshop", detail=str(error))
        findings = tuple(geometry_findings(design))
        rejecting = errors(findings)
        if rejecting:
            return Evaluation(rejecting[0].name, findings=findings)
        others_learn = self.stand_in or self.perturbation  # from every robot that is built
        refused = None if self.name != "printed" or others_learn else self.refused_first(design)
        if refused:
            return refused
        try:
            return {"printed": self._printed, "capsule": self._capsule, "published": self._published}[self.name](design)
        except CannotBuildError as error:
            return Evaluation(CANNOT_BUILD, findings=layout_findings(error), detail=str(error))

    def refused_first(self, design: Design) -> Evaluation | None:
        """Return the outcome of a design that an estimate of the printed robot's masses refuses; None of others."""
        refused = statics_refusal(design, self.workshop or load_workshop(), self.settings or Settings())
        if not refused:
            return None
        return Evaluation(refused[0].name, findings=(*geometry_findings(design), *refused))

    def varied(self, values: Mapping[str, Value]) -> "RobotModel":
        """Return the model of the robot in the workshop with other values, or made otherwise than designed."""
        others = {key: value for key, value in values.items() if not key.startswith(PREFIX)}
        model = replace(self, perturbation={key: value for key, value in values.items() if key not in others})
        return replace(model, workshop=varied(self.workshop or load_workshop(), others)) if others else model

    @property
    def tolerance_mm(self) -> float:
        """Error of a link's length (mm).

        A capsule or published robot is made in no workshop; for it this is 0.2 mm (judgement).
        """
        return 0.2 if self.workshop is None else self.workshop.fits.link_tolerance_mm

    @property
    def making(self) -> Tolerances:
        """How far what is made of a design differs from it: for a robot that is made in no workshop, lengths alone."""
        if self.workshop is None or self.name != "printed":
            return Tolerances(self.tolerance_mm)
        rate = self.workshop.safety.spring_rate_scatter / 2.0
        return Tolerances(self.tolerance_mm, rate, PRINTED_MASS_SHARE, FLOOR_SHARE, printed=True)

    @property
    def default_objective(self) -> str:
        """What is searched for unless the user says something else: only a printed robot has a size."""
        return "body_lengths" if self.name == "printed" else "fitness"

    def aiming_at(self, objective: str | Callable[..., Any] | None, default: str = "") -> Objective:
        """Return an objective, see `find_objective`; without one the default, the model's own if none is given.

        Raises
        ------
        JumpcadError
            If there is no such objective, or a jump of this robot lacks a figure that it needs.
        """
        aim = find_objective(default or self.default_objective if objective is None else objective)
        self.require_figures(aim)
        return aim

    def require_figures(self, objective: Objective) -> None:
        """Require that a jump of this robot has the figures of a named objective; a printed robot has them all.

        Raises
        ------
        JumpcadError
            If one is missing.
        """
        if self.name == "printed" or objective.code:
            return
        from jumpcad.simulation.jump import Jump

        names = PUBLISHED_FIGURES if self.name == "published" else [one.name for one in fields(Jump)]
        objective.score(Evaluation("jump", dict.fromkeys(names, 1.0)))

    def admits(self, design: Design) -> bool:
        """Whether the feasibility checks that need neither solids nor simulation accept a design (microseconds)."""
        if errors(geometry_findings(design)):
            return False
        if self.name != "capsule":
            return True
        from jumpcad.mechanism.capsule import capsule_robot

        return not errors(statics_findings(capsule_robot(design)))

    def laid_out(self, variant: Variant) -> Mapping[str, float] | Evaluation:
        """Return figures of the layout of a printed robot, or the outcome of one whose parts have no room.

        A sixth of an evaluation. What is refused here would be refused by the evaluation too.
        """
        from jumpcad.building import layout_of

        try:
            model = self.varied(variant.workshop) if variant.workshop else self
            return layout_figures(layout_of(variant.design, model.workshop or load_workshop()))
        except CannotBuildError as error:
            return Evaluation(CANNOT_BUILD, findings=layout_findings(error), detail=str(error))
        except JumpcadError as error:  # the values of the workshop do not go together
            return Evaluation("workshop", detail=str(error))

    def quick_score(self, design: Design, objective: Objective) -> float:
        """Return about what the capsule robot of a printed design scores; -inf where it does not jump, or is no guide.

        Where it has no such figure, its fitness ranks the designs: it has no size but that of its links.
        """
        if self.name != "printed":
            return -math.inf
        quick = RobotModel("capsule", None, load_settings("screening"), self.guess_engine)
        if not quick.admits(design):
            return -math.inf
        found = quick(design)
        if found.verdict != "jump":
            return -math.inf
        try:
            return objective.score(replace(found, findings=())) or 0.0
        except JumpcadError:
            return found.metrics["fitness"]

    @property
    def guess_engine(self) -> str:
        """The engine of what is only guessed: the planar one, compiled or not, unless it lacks what is asked for."""
        from jumpcad.simulation.planar import LACKING

        lacks = any(getattr(self.settings or Settings(), key) for key in LACKING)
        return self.engine if lacks else "planar"

    @property
    def guess_settings(self) -> Settings:
        """The settings of what is only guessed: those of the model with steps of `GUESS_STEP_S`, or longer ones."""
        settings = self.settings or Settings()
        return settings.model_copy(update={"dt_s": max(settings.dt_s, GUESS_STEP_S)})

    def describe(self) -> dict[str, Any]:
        """Return all that decides an evaluation, as plain data."""
        record: dict[str, Any] = {"name": self.name, "engine": "pybullet" if self.name == "published" else self.engine}
        for key in ("workshop", "settings"):
            value = getattr(self, key)
            record[key] = None if value is None else value.model_dump(mode="json")
        return record | ({"stand_in": True} if self.stand_in else {})

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the description and of the versions of the packages (hexadecimal)."""
        content = json.dumps([self.describe(), self.versions()], sort_keys=True)
        return hashlib.sha256(content.encode()).hexdigest()

    def versions(self) -> dict[str, str]:
        """Return the versions of the packages that decide an evaluation, and the hash of this one's code."""
        solids = ["manifold3d", "trimesh"] if self.name == "printed" else []
        return {"jumpcad": __version__, "code": code_digest()} | versions("numpy", self.describe()["engine"], *solids)

    def _printed(self, design: Design) -> Evaluation:
        from jumpcad.evaluation import evaluate_made

        result = evaluate_made(
            design, self.workshop, self.settings, self.engine, partial(perturbed, values=self.perturbation)
        )
        robot = result.robot
        findings = (*result.findings, *room_findings(robot.layout, robot.workshop.safety.room_reserve_mm))
        if self.perturbation:  # what the design keeps stands in its own row
            findings = (*result.jump.findings, *errors(findings[len(result.jump.findings) :]))
        figures = _figures(result.jump) | result.metrics | (robot_figures(result.robot) if self.stand_in else {})
        return Evaluation(result.verdict, figures, findings)

    def _capsule(self, design: Design) -> Evaluation:
        from jumpcad.mechanism.capsule import capsule_robot
        from jumpcad.simulation import simulate

        jump = simulate(capsule_robot(design), self.settings, self.engine)
        return Evaluation(jump.verdict, _figures(jump), tuple(jump.findings))

    def _published(self, design: Design) -> Evaluation:
        from jumpcad.paper import published

        jump = published.simulate(design)
        fitness = jump.distance_m / (design.l_max_mm / 1000.0)
        figures = (fitness, jump.distance_m, jump.base_height_m, jump.energy_j)
        metrics = dict(zip(PUBLISHED_FIGURES, figures, strict=True))
        return Evaluation("jump" if jump.distance_m > 0 else "no_takeoff", metrics, tuple(geometry_findings(design)))


@check_arguments
def robot_model(
    name: str = "printed",
    workshop: Workshop | str | Path | None = None,
    settings: Settings | str | Path | None = None,
    engine: str | None = None,
) -> RobotModel:
    """Return the model of a name; workshop and settings by name, as files, or loaded.

    Parameters
    ----------
    name
        One of `MODELS`.
    workshop
        Where `printed` is built, the default if None.
    settings, engine
        How `printed` and `capsule` are simulated: the default settings, and the first of PyBullet and MuJoCo that is
        installed, if None.

    Raises
    ------
    JumpcadError
        If there is no such model, engine, workshop or settings, or the model does not use what is given.
    """
    if engine is not None:
        require_engine(engine)
    uses = {"capsule": ("settings",), "published": ()}.get(name, ("workshop", "settings"))
    for option, value in (("workshop", workshop), ("settings", settings)):
        if value is not None and option not in uses:
            named = "" if isinstance(value, Record) else f" {value}"
            raise JumpcadError(f"{option}{named}: does not apply to the {name} robot; leave it out")
    if name == "published" and engine not in (None, "pybullet"):
        raise JumpcadError(f"engine {engine}: the published simulation exists in pybullet alone")
    if name not in MODELS or name == "published":
        return RobotModel(name)
    built_in = None
    if name == "printed":
        built_in = (
            workshop if isinstance(workshop, Workshop) else load_workshop(DEFAULT if workshop is None else workshop)
        )
    how = (
        settings.revalidated()
        if isinstance(settings, Settings)
        else load_settings("default" if settings is None else settings)
    )
    return RobotModel(name, built_in, how, engine or default_engine())


def _figures(jump: Any) -> dict[str, float]:
    """Return the plain figures of a jump."""
    return {name: float(value) for name, value in vars(jump).items() if isinstance(value, int | float)}
